//! Small kernels, written by hand, that read one kind of resource each.

use super::{Fixture, Kernel, Stage};

pub const COLOR: &str = r#"{"group": 0, "binding": 0, "name": "color", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 1,
    "extent": "output"}"#;
pub const DEPTH: &str = r#"{"group": 0, "binding": 1, "name": "depth", "type": "texture",
    "view_dimension": "2d-array", "multisampled": false, "sample_type": "unfilterable-float", "components": 1, "layers": 3, "samples": 1,
    "extent": "output"}"#;
/// In a group of its own, and not the next one.
pub const PARAMS: &str = r#"{"group": 2, "binding": 4, "name": "params", "type": "uniform", "buffer_type": "uniform",
    "size": 32, "fields": [
        {"name": "offset", "type": "vec4f", "offset": 0, "size": 16},
        {"name": "scale", "type": "f32", "offset": 16, "size": 4, "default": 2.0},
        {"name": "steps", "type": "i32", "offset": 20, "size": 4, "default": -3}]}"#;

/// `color`, unchanged.
pub const COPY: Kernel = Kernel {
    name: "copy",
    bindings: &[COLOR],
    declarations: "@group(0) @binding(0) var color: texture_2d<f32>;",
    result: "textureLoad(color, pixel, 0)",
};

/// `color` with the three layers of `depth` in place of red, green and blue.
pub const LAYERS: Kernel = Kernel {
    name: "layers",
    bindings: &[COLOR, DEPTH],
    declarations: "@group(0) @binding(0) var color: texture_2d<f32>;
        @group(0) @binding(1) var depth: texture_2d_array<f32>;",
    result: "vec4f(textureLoad(depth, pixel, 0, 0).x, textureLoad(depth, pixel, 1, 0).x,
        textureLoad(depth, pixel, 2, 0).x, textureLoad(color, pixel, 0).w)",
};

/// `color * scale + offset + steps`.
pub const ADD: Kernel = Kernel {
    name: "add",
    bindings: &[COLOR, PARAMS],
    declarations: "struct Params { offset: vec4f, scale: f32, steps: i32 }
        @group(0) @binding(0) var color: texture_2d<f32>;
        @group(2) @binding(4) var<uniform> params: Params;",
    result: "textureLoad(color, pixel, 0) * params.scale + params.offset + f32(params.steps)",
};

/// `small`, which is of any size, filtered over a target that is 4 pixels wide.
pub const SCALE: Kernel = Kernel {
    name: "scale",
    bindings: &[
        r#"{"group": 0, "binding": 0, "name": "small", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "float", "components": 4, "layers": 1, "samples": 1, "extent": "any"}"#,
        r#"{"group": 0, "binding": 1, "name": "linear", "type": "sampler", "sampler_type": "filtering"}"#,
    ],
    declarations: "@group(0) @binding(0) var small: texture_2d<f32>;
        @group(0) @binding(1) var linear: sampler;",
    result: "textureSampleLevel(small, linear, vec2f((f32(pixel.x) + 0.5) / 4.0, 0.5), 0.0)",
};

/// The element of `weights` in the pixel's column, and how many elements there are.
pub const TABLE: Kernel = Kernel {
    name: "table",
    bindings: &[
        r#"{"group": 0, "binding": 3, "name": "weights", "type": "buffer", "buffer_type": "read-only-storage",
    "element": "vec3f", "stride": 16}"#,
    ],
    declarations: "@group(0) @binding(3) var<storage, read> weights: array<vec3f>;",
    result: "vec4f(weights[pixel.x], f32(arrayLength(&weights)))",
};

/// The mean of a texel's four samples.
pub const RESOLVE: Kernel = Kernel {
    name: "resolve",
    bindings: &[r#"{"group": 0, "binding": 0, "name": "color", "type": "texture",
    "view_dimension": "2d", "multisampled": true, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 4,
    "extent": "output"}"#],
    declarations: "@group(0) @binding(0) var color: texture_multisampled_2d<f32>;",
    result: "0.25 * (textureLoad(color, pixel, 0) + textureLoad(color, pixel, 1)
        + textureLoad(color, pixel, 2) + textureLoad(color, pixel, 3))",
};

/// Tests whether a quarter of the pixel's column is less than `depth`, and reads the depth itself.
pub const SHADOW: Kernel = Kernel {
    name: "shadow",
    bindings: &[
        r#"{"group": 0, "binding": 0, "name": "depth", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "depth", "components": 1, "layers": 1, "samples": 1, "extent": "any"}"#,
        r#"{"group": 0, "binding": 1, "name": "compare", "type": "sampler", "sampler_type": "comparison"}"#,
    ],
    declarations: "@group(0) @binding(0) var depth: texture_depth_2d;
        @group(0) @binding(1) var compare: sampler_comparison;",
    result: "vec4f(textureSampleCompareLevel(depth, compare, vec2f(0.5), f32(pixel.x) / 4.0),
        textureLoad(depth, vec2i(0), 0), 0.0, 1.0)",
};

/// A cube, a volume, and integers.
pub const SHAPES: Kernel = Kernel {
    name: "shapes",
    bindings: &[
        r#"{"group": 0, "binding": 0, "name": "around", "type": "texture",
    "view_dimension": "cube", "multisampled": false, "sample_type": "float", "components": 4, "layers": 1, "samples": 1, "extent": "any"}"#,
        r#"{"group": 0, "binding": 1, "name": "volume", "type": "texture",
    "view_dimension": "3d", "multisampled": false, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 1,
    "extent": "any"}"#,
        r#"{"group": 0, "binding": 2, "name": "ids", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "uint", "components": 1, "layers": 1, "samples": 1, "extent": "any"}"#,
        r#"{"group": 0, "binding": 3, "name": "linear", "type": "sampler", "sampler_type": "filtering"}"#,
    ],
    declarations: "@group(0) @binding(0) var around: texture_cube<f32>;
        @group(0) @binding(1) var volume: texture_3d<f32>;
        @group(0) @binding(2) var ids: texture_2d<u32>;
        @group(0) @binding(3) var linear: sampler;",
    result: "textureSampleLevel(around, linear, vec3f(1.0, 0.0, 0.0), 0.0) + textureLoad(volume, vec3i(0), 0)
        + f32(textureLoad(ids, vec2i(0), 0).x)",
};

/// `table` added up in `bins`, and again in `more`.
pub const BINS: Kernel = Kernel {
    name: "sums",
    bindings: &[
        r#"{"group": 0, "binding": 3, "name": "table", "type": "buffer", "buffer_type": "read-only-storage",
    "element": "u32", "stride": 4}"#,
        r#"{"group": 0, "binding": 4, "name": "bins", "type": "buffer", "buffer_type": "storage", "element": "u32", "stride": 4}"#,
        r#"{"group": 0, "binding": 5, "name": "more", "type": "buffer", "buffer_type": "storage", "element": "u32", "stride": 4}"#,
    ],
    declarations: "@group(0) @binding(3) var<storage, read> table: array<u32>;
        @group(0) @binding(4) var<storage, read_write> bins: array<u32>;
        @group(0) @binding(5) var<storage, read_write> more: array<u32>;
        fn noted(pixel: vec2i) -> vec4f { bins[pixel.x] = table[pixel.x]; more[pixel.y] = 1u; return vec4f(1.0); }",
    result: "noted(pixel)",
};

/// `color * scale + offset`, called `tinted`, whose uniforms are immediates.
pub fn tinted(stage: Stage) -> Fixture {
    let plain = Kernel {
        name: "tinted",
        bindings: &[COLOR],
        declarations: "struct Params { offset: vec4f, scale: f32 }
            @group(0) @binding(0) var color: texture_2d<f32>;
            var<immediate> params: Params;",
        result: "textureLoad(color, pixel, 0) * params.scale + params.offset",
    };
    let Fixture { manifest, wgsl } = plain.emit(stage);
    let immediates = r#""features": ["immediates"], "immediates": {"name": "params", "size": 32, "fields": [
        {"name": "offset", "type": "vec4f", "offset": 0, "size": 16},
        {"name": "scale", "type": "f32", "offset": 16, "size": 4, "default": 2.0}]}, "bindings""#;
    let manifest = manifest.replacen(r#""bindings""#, immediates, 1);
    Fixture { manifest, wgsl }
}
