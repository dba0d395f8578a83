//! Plans of chains, written by hand, with kernels for their passes.

use super::{Fixture, Gpu, Kernel, Stage};
use straightline_runtime::manifest::Format;
use straightline_runtime::manifest::chain::{
    CHAIN_SCHEMA, ChainPlan, PassPlan, PicturePlan, ReadPlan, SizeOp, SizeRule, SizeTerm,
};
use straightline_runtime::{Chain, Error, PassOptions, Shader};

const BIG: &str = r#"{"group": 0, "binding": 0, "name": "big", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 1,
    "extent": "any"}"#;
const SMALL: &str = r#"{"group": 0, "binding": 1, "name": "small", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 1,
    "extent": "any"}"#;

/// Every second texel of `big`.
pub const DOWN: Kernel = Kernel {
    name: "down",
    bindings: &[BIG],
    declarations: "@group(0) @binding(0) var big: texture_2d<f32>;",
    result: "textureLoad(big, min(2 * pixel, vec2i(textureDimensions(big)) - 1), 0)",
};

/// `color` and the texel of `small` that covers it, added.
pub const BLEND: Kernel = Kernel {
    name: "blend",
    bindings: &[super::COLOR, SMALL],
    declarations: "@group(0) @binding(0) var color: texture_2d<f32>;
        @group(0) @binding(1) var small: texture_2d<f32>;",
    result: "textureLoad(color, pixel, 0) + textureLoad(small, min(pixel / 2, vec2i(textureDimensions(small)) - 1), 0)",
};

/// `color` and one.
pub const MORE: Kernel = Kernel {
    name: "more",
    bindings: &[super::COLOR],
    declarations: "@group(0) @binding(0) var color: texture_2d<f32>;",
    result: "textureLoad(color, pixel, 0) + 1.0",
};

/// Writes `color` as `low`, and its double as `high`.
pub fn split(stage: Stage) -> Fixture {
    let read = "@group(0) @binding(0) var color: texture_2d<f32>;";
    let output = |name: &str, place: &str| {
        format!(
            r#"{{"name": "{name}", {place}, "access": "write-only", "view_dimension": "2d", "format": "rgba32float"}}"#
        )
    };
    let (outputs, workgroup, wgsl) = match stage {
        Stage::Compute => (
            [
                output("low", r#""group": 0, "binding": 1"#),
                output("high", r#""group": 0, "binding": 2"#),
            ],
            r#""workgroup_size": [8, 8, 1],"#,
            format!(
                "{read}
                @group(0) @binding(1) var low: texture_storage_2d<rgba32float, write>;
                @group(0) @binding(2) var high: texture_storage_2d<rgba32float, write>;
                @compute @workgroup_size(8, 8, 1)
                fn split(@builtin(global_invocation_id) id: vec3u) {{
                    if any(id.xy >= textureDimensions(low)) {{ return; }}
                    let value = textureLoad(color, vec2i(id.xy), 0);
                    textureStore(low, vec2i(id.xy), value);
                    textureStore(high, vec2i(id.xy), 2.0 * value);
                }}"
            ),
        ),
        Stage::Fragment => (
            [output("low", r#""location": 0"#), output("high", r#""location": 1"#)],
            "",
            format!(
                "{read}
                struct Split {{ @location(0) low: vec4f, @location(1) high: vec4f }}
                @fragment
                fn split(@builtin(position) position: vec4f) -> Split {{
                    let value = textureLoad(color, vec2i(position.xy), 0);
                    return Split(value, 2.0 * value);
                }}"
            ),
        ),
    };
    let Fixture { manifest, .. } = super::COPY.emit(stage);
    let start = manifest.find(r#""output": "#).expect("an output");
    let end = start + manifest[start..].find("},").expect("its end") + 1;
    let manifest = format!(
        r#"{}"output": [{}]{}"#,
        &manifest[..start],
        outputs.join(", "),
        &manifest[end..]
    );
    let manifest = manifest
        .replace(r#""workgroup_size": [8, 8, 1],"#, workgroup)
        .replace("copy", "split");
    Fixture { manifest, wgsl }
}

/// The size of the input `color`, changed by an operation.
pub fn color_size(change: Option<(SizeOp, u32)>) -> SizeRule {
    let mut terms = vec![SizeTerm::Of("color".into())];
    if let Some((op, number)) = change {
        terms.extend([SizeTerm::Number([number; 2]), SizeTerm::Apply(op)]);
    }
    SizeRule(terms.into())
}

/// The size of `color`, and its half.
pub fn sizes() -> [SizeRule; 2] {
    [color_size(None), color_size(Some((SizeOp::Div, 2)))]
}

/// An `rgba32float` picture; of the caller without memory.
pub fn picture(name: &'static str, size: &SizeRule, memory: Option<u32>) -> PicturePlan {
    PicturePlan {
        name: name.into(),
        size: size.clone(),
        format: Format::Rgba32Float,
        memory,
    }
}

/// A pass that reads pairs of the name in its shader and the name in the chain.
pub fn pass(shader: &'static str, reads: &[(&'static str, &'static str)], writes: &[&'static str]) -> PassPlan {
    let read = |(name, from): &(&'static str, &'static str)| ReadPlan {
        name: (*name).into(),
        from: (*from).into(),
    };
    PassPlan {
        name: writes[0].into(),
        shader: shader.into(),
        reads: reads.iter().map(read).collect(),
        writes: writes.iter().map(|name| (*name).into()).collect(),
    }
}

/// A chain called `chain`.
pub fn plan(inputs: &[&'static str], pictures: Vec<PicturePlan>, passes: Vec<PassPlan>) -> ChainPlan {
    ChainPlan {
        schema: CHAIN_SCHEMA,
        chain: "chain".into(),
        inputs: inputs.iter().map(|name| (*name).into()).collect(),
        pictures: pictures.into(),
        passes: passes.into(),
    }
}

/// `color`, halved, and blended with itself.
pub fn glow() -> ChainPlan {
    let [full, half] = sizes();
    plan(
        &["color"],
        vec![picture("half", &half, Some(0)), picture("out", &full, None)],
        vec![
            pass("down", &[("big", "color")], &["half"]),
            pass("blend", &[("color", "color"), ("small", "half")], &["out"]),
        ],
    )
}

/// `color` and four, in four passes of one shader, with two textures for three pictures.
pub fn four() -> ChainPlan {
    let [full, _] = sizes();
    let passes = [("color", "a"), ("a", "b"), ("b", "c"), ("c", "out")];
    plan(
        &["color"],
        vec![
            picture("a", &full, Some(3)),
            picture("b", &full, Some(1)),
            picture("c", &full, Some(3)),
            picture("out", &full, None),
        ],
        passes
            .iter()
            .map(|(from, to)| pass("more", &[("color", from)], &[to]))
            .collect(),
    )
}

/// Makes a chain of shaders by the names of their passes' shaders.
pub fn make(gpu: &Gpu, plan: &ChainPlan, shaders: &[(&str, Fixture)], options: &PassOptions) -> Result<Chain, Error> {
    let read: Vec<Shader<'_>> = shaders
        .iter()
        .map(|(_, Fixture { manifest, wgsl })| Shader::from_json(manifest, wgsl).expect("a shader"))
        .collect();
    let named: Vec<(&str, &Shader<'_>)> = shaders.iter().map(|(name, _)| *name).zip(&read).collect();
    Chain::from_shaders(&gpu.device, plan, &named, options)
}

/// Makes a chain of kernels of one stage, each by its own name.
pub fn make_of(gpu: &Gpu, plan: &ChainPlan, kernels: &[&Kernel], stage: Stage) -> Result<Chain, Error> {
    let shaders: Vec<(&str, Fixture)> = kernels.iter().map(|kernel| (kernel.name, kernel.emit(stage))).collect();
    make(gpu, plan, &shaders, &PassOptions::default())
}
