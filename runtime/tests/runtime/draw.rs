//! Triangles of the caller's, drawn with an emitted fragment shader that has values interpolated.

use crate::common;

use common::{COLOR, COPY, Gpu, Kernel, ramp, view};
use straightline_runtime::{Draw, DrawOptions, Error, Pass, PassOptions, VertexShader, wgpu};
use wgpu::TextureFormat;

/// `place` and `shade` as they are interpolated, times a uniform.
const PLACES: Kernel = Kernel {
    name: "places",
    bindings: &[
        r#"{"group": 0, "binding": 4, "name": "params", "type": "uniform", "buffer_type": "uniform",
        "size": 16, "fields": [{"name": "scale", "type": "f32", "offset": 0, "size": 4, "default": 2.0}]}"#,
    ],
    declarations: "struct Params { scale: f32 }
        @group(0) @binding(4) var<uniform> params: Params;",
    result: "vec4f(place, shade, 1.0) * params.scale",
};

/// Manifest and text of [`PLACES`] with its varyings, which `emit` leaves out.
fn places() -> (String, String) {
    let plain = PLACES.emit(common::Stage::Fragment);
    let manifest = plain.manifest.replacen(
        r#""unroll""#,
        r#""varyings": [{"name": "place", "type": "vec2f", "location": 0}, {"name": "shade", "type": "f32", "location": 1}], "unroll""#,
        1,
    );
    let wgsl = plain.wgsl.replacen(
        "position: vec4f)",
        "position: vec4f, @location(0) place: vec2f, @location(1) shade: f32)",
        1,
    );
    assert!(manifest != plain.manifest && wgsl != plain.wgsl);
    (manifest, wgsl)
}

const VERTICES: &str = "
struct Corner { @builtin(position) clip: vec4f, @location(0) place: vec2f, @location(1) shade: f32 }
@group(1) @binding(0) var<uniform> shift: vec4f;
@vertex fn corner(@location(0) clip: vec4f, @location(1) shade: f32) -> Corner {
    return Corner(clip + shift * clip.w, clip.xy / clip.w, shade);
}
@vertex fn flat_corner(@location(0) clip: vec4f) -> FlatCorner { return FlatCorner(clip, clip.xy, 1.0); }
struct FlatCorner { @builtin(position) clip: vec4f, @location(0) place: vec2f, @location(1) @interpolate(flat) shade: f32 }
@fragment fn fill() -> @location(0) vec4f { return vec4f(1.0); }
";

const SIZE: [u32; 2] = [40, 30];

/// Converts a point of clip space to pixels.
fn pixel([x, y]: [f64; 2]) -> [f64; 2] {
    [
        (x + 1.0) / 2.0 * f64::from(SIZE[0]),
        (1.0 - y) / 2.0 * f64::from(SIZE[1]),
    ]
}

/// A corner: x, y, depth and w in clip space before the division, and a shade.
type Corner = [f32; 5];

/// Of a triangle at a pixel's centre, the perspective interpolation of place and shade, and the depth; `None` outside.
/// `near` where the pixel lies on an edge, as near as a driver may round.
fn defined(triangle: &[Corner; 3], at: [u32; 2]) -> Option<([f64; 4], f64, bool)> {
    let points = triangle.map(|[x, y, _, w, _]| pixel([f64::from(x / w), f64::from(y / w)]));
    let centre = at.map(|k| f64::from(k) + 0.5);
    let cross = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let area = cross(points[0], points[1], points[2]);
    let linear: [f64; 3] = std::array::from_fn(|k| cross(points[(k + 1) % 3], points[(k + 2) % 3], centre) / area);
    let near = linear.iter().any(|weight| weight.abs() < 0.02);
    if linear.iter().any(|weight| *weight < 0.0) && !near {
        return None;
    }
    let depth = (0..3)
        .map(|k| linear[k] * f64::from(triangle[k][2] / triangle[k][3]))
        .sum();
    let weights: [f64; 3] = std::array::from_fn(|k| linear[k] / f64::from(triangle[k][3]));
    let total: f64 = weights.iter().sum();
    let of = |value: &dyn Fn(&Corner) -> f32| {
        (0..3)
            .map(|k| weights[k] / total * f64::from(value(&triangle[k])))
            .sum::<f64>()
    };
    let value = [of(&|c| c[0] / c[3]), of(&|c| c[1] / c[3]), of(&|c| c[4]), 1.0];
    Some((value, depth, near))
}

const TRIANGLES: [[Corner; 3]; 2] = [
    [
        [-0.9, -0.8, 0.5, 1.0, 0.1],
        [1.6, -1.4, 1.2, 2.0, 0.9],
        [-0.3, 2.4, 0.6, 3.0, 0.5],
    ],
    // In front of the first triangle at one end, and behind it at the other.
    [
        [-0.6, 0.9, 0.9, 1.0, 0.3],
        [0.9, 0.7, 0.2, 1.0, 0.7],
        [0.1, -0.9, 0.1, 1.0, 0.2],
    ],
];

struct Scene {
    vertices: wgpu::Buffer,
    group: wgpu::BindGroup,
    layout: wgpu::BindGroupLayout,
}

impl Scene {
    fn new(gpu: &Gpu) -> Self {
        let bytes: Vec<u8> = TRIANGLES
            .as_flattened()
            .as_flattened()
            .iter()
            .flat_map(|v| v.to_le_bytes())
            .collect();
        let vertices = gpu.buffer(
            bytes.len() as u64,
            wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        );
        gpu.queue.write_buffer(&vertices, 0, &bytes);
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let shift = gpu.buffer(16, wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: shift.as_entire_binding(),
            }],
        });
        Scene {
            vertices,
            group,
            layout,
        }
    }
}

const ATTRIBUTES: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32];

fn buffers() -> [Option<wgpu::VertexBufferLayout<'static>>; 1] {
    [Some(wgpu::VertexBufferLayout {
        array_stride: 20,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    })]
}

fn depth_state() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: TextureFormat::Depth32Float,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: Default::default(),
        bias: Default::default(),
    }
}

#[test]
fn triangles_are_interpolated_in_perspective_behind_one_another() {
    let gpu = Gpu::new();
    let scene = Scene::new(&gpu);
    let (manifest, wgsl) = places();
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(VERTICES.into()),
    });
    let vertex_shaders = [
        VertexShader::Wgsl {
            text: VERTICES,
            entry_point: "corner",
        },
        VertexShader::Module {
            module: &module,
            entry_point: "corner",
        },
    ];
    for vertex in vertex_shaders {
        let options = DrawOptions::behind(vertex)
            .buffers(&buffers())
            .group(1, &scene.layout)
            .depth_stencil(depth_state());
        let draw = Draw::from_json(&gpu.device, &manifest, &wgsl, &options).expect("it fits");
        assert_eq!((draw.kernel(), draw.inputs().len()), ("places", 0));
        assert_eq!(
            draw.targets().collect::<Vec<_>>(),
            [("output", TextureFormat::Rgba32Float)]
        );
        let bound = draw
            .bind(&[] as &[(&str, &wgpu::TextureView)])
            .expect("it reads nothing");
        for scale in [2.0, 0.5] {
            if scale != 2.0 {
                bound.write_uniform(&gpu.queue, "scale", scale).expect("a uniform");
            }
            let target = gpu.target(SIZE);
            let depth = gpu.texture(
                SIZE,
                1,
                TextureFormat::Depth32Float,
                wgpu::TextureUsages::RENDER_ATTACHMENT,
            );
            let mut encoder = gpu.encoder();
            let (colour, depth) = (view(&target), view(&depth));
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &colour,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations::default(),
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &depth,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            bound.set(&mut pass);
            pass.set_bind_group(1, &scene.group, &[]);
            pass.set_vertex_buffer(0, scene.vertices.slice(..));
            pass.draw(0..6, 0..1);
            drop(pass);
            gpu.submit(encoder);
            let found = gpu.download(&target);
            let (mut drawn, mut unsure) = ([0; 2], 0);
            for y in 0..SIZE[1] {
                for x in 0..SIZE[0] {
                    let hits = TRIANGLES.iter().enumerate();
                    let mut hits: Vec<_> = hits.filter_map(|(k, t)| Some((k, defined(t, [x, y])?))).collect();
                    hits.sort_by(|a, b| a.1.1.total_cmp(&b.1.1));
                    let close = hits.windows(2).any(|pair| (pair[0].1.1 - pair[1].1.1).abs() < 0.01);
                    if close || hits.iter().any(|(_, hit)| hit.2) {
                        unsure += 1;
                        continue;
                    }
                    let expected = hits
                        .first()
                        .map_or([0.0; 4], |(_, (value, ..))| value.map(|v| v * f64::from(scale)));
                    let texel = found[(y * SIZE[0] + x) as usize];
                    let off = (0..4)
                        .map(|k| (f64::from(texel[k]) - expected[k]).abs())
                        .fold(0.0, f64::max);
                    // Drivers place corners on a grid of 1/16 of a pixel at least as fine.
                    assert!(off < 0.02 * f64::from(scale), "{x}, {y}: {texel:?} for {expected:?}");
                    if let Some((k, _)) = hits.first() {
                        drawn[*k] += 1;
                    }
                }
            }
            assert!(
                drawn.iter().all(|count| *count > 60) && unsure < 250,
                "{drawn:?}, {unsure}"
            );
        }
    }
}

/// The message of a refusal.
fn refusal(gpu: &Gpu, (manifest, wgsl): (&str, &str), options: &DrawOptions<'_>) -> (Error, String) {
    let error = Draw::from_json(&gpu.device, manifest, wgsl, options).expect_err("a refusal");
    let message = error.to_string();
    (error, message)
}

#[test]
fn vertex_shaders_that_do_not_fit_are_named() {
    let gpu = Gpu::new();
    let scene = Scene::new(&gpu);
    let (manifest, wgsl) = places();
    let options = |text: &'static str, entry: &'static str| {
        DrawOptions::new(text, entry)
            .buffers(&buffers())
            .group(1, &scene.layout)
    };
    let of_text: [(&'static str, &'static str, &str); 3] = [
        (
            "@vertex fn corner() -> @builtin(position) vec4f { return vec4f(); }",
            "corner",
            "`places` takes `place`, vec2f at location 0, and `corner` gives nothing there: have it return `@location(0) place: vec2f`",
        ),
        (
            "struct C { @builtin(position) p: vec4f, @location(0) place: vec2f, @location(1) shade: vec2f }
            @vertex fn corner() -> C { return C(); }",
            "corner",
            "`places` takes `shade`, f32 at location 1, and `corner` gives another type there: have it return `f32`",
        ),
        (
            VERTICES,
            "flat_corner",
            "`flat_corner` has it interpolated otherwise than in perspective",
        ),
    ];
    for (text, entry, wanted) in of_text {
        let (error, message) = refusal(&gpu, (&manifest, &wgsl), &options(text, entry));
        assert!(matches!(error, Error::Varying { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
    let of_shaders: [(&'static str, &'static str, &str); 4] = [
        ("@vertex fn corner(", "corner", "expected"),
        (
            VERTICES,
            "korner",
            "no entry point `korner` of stage vertex; of that stage it has `corner` and `flat_corner`",
        ),
        (VERTICES, "fill", "no entry point `fill` of stage vertex"),
        // Parses, but outputs no position.
        (
            "struct C { @location(0) place: vec2f, @location(1) shade: f32 } @vertex fn corner() -> C { return C(); }",
            "corner",
            "corner",
        ),
    ];
    for (text, entry, wanted) in of_shaders {
        let (error, message) = refusal(&gpu, (&manifest, &wgsl), &options(text, entry));
        assert!(matches!(error, Error::VertexShader { .. }), "{message}");
        assert!(message.contains(wanted) && message.contains("`places`"), "{message}");
    }
    // A module that only wgpu looks into.
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(of_text[0].0.into()),
    });
    let behind = DrawOptions::behind(VertexShader::Module {
        module: &module,
        entry_point: "corner",
    });
    let (error, message) = refusal(&gpu, (&manifest, &wgsl), &behind);
    assert!(matches!(error, Error::Pipeline { .. }), "{message}");
    assert!(
        message.contains("of the vertex shader it takes `@location(0) place: vec2f` and `@location(1) shade: f32`"),
        "{message}"
    );
}

#[test]
fn pipelines_that_cannot_be_are_named() {
    let gpu = Gpu::new();
    let scene = Scene::new(&gpu);
    let (manifest, wgsl) = places();
    let plain = || DrawOptions::new(VERTICES, "corner").buffers(&buffers());
    let cases = [
        // The vertex shader's group is missing, is the kernel's, or is there twice; no vertices; a format without blending.
        (plain(), "pipeline of `places`"),
        (plain().group(0, &scene.layout), "bind group 0 is the kernel's own"),
        (
            plain().group(1, &scene.layout).group(1, &scene.layout),
            "bind group 1 is given twice",
        ),
        (
            DrawOptions::new(VERTICES, "corner").group(1, &scene.layout),
            "pipeline of `places`",
        ),
        (
            plain().group(1, &scene.layout).blend(wgpu::BlendState::ALPHA_BLENDING),
            "pipeline of `places`",
        ),
    ];
    for (options, wanted) in cases {
        let (error, message) = refusal(&gpu, (&manifest, &wgsl), &options);
        assert!(matches!(error, Error::Pipeline { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
    let integers = plain()
        .group(1, &scene.layout)
        .pass(PassOptions::default().target_format(TextureFormat::R32Uint));
    let (error, message) = refusal(&gpu, (&manifest, &wgsl), &integers);
    assert!(matches!(error, Error::TargetFormat { .. }), "{message}");
    // Blended into a format that can be.
    let eight = plain()
        .group(1, &scene.layout)
        .pass(PassOptions::default().target_format(TextureFormat::Rgba8Unorm));
    Draw::from_json(
        &gpu.device,
        &manifest,
        &wgsl,
        &eight.blend(wgpu::BlendState::ALPHA_BLENDING),
    )
    .expect("it fits");

    let compute = COPY.emit(common::Stage::Compute);
    let (_, message) = refusal(&gpu, (&compute.manifest, &compute.wgsl), &plain());
    assert!(message.contains("it is a compute shader"), "{message}");
    // A pass has no triangles, and names what has.
    let error = Pass::from_json(&gpu.device, &manifest, &wgsl).expect_err("a refusal");
    assert!(
        error.to_string().contains("draw your triangles with it by `Draw`"),
        "{error}"
    );
}

#[test]
fn texts_and_manifests_must_agree_on_what_is_interpolated() {
    let gpu = Gpu::new();
    let (manifest, wgsl) = places();
    let options = DrawOptions::new(VERTICES, "corner");
    for (from, to, wanted) in [
        (
            r#""location": 0}"#,
            r#""location": 3}"#,
            "it takes no `place` of type vec2f at location 3",
        ),
        (
            r#""type": "f32", "location": 1"#,
            r#""type": "vec4f", "location": 1"#,
            "no `shade` of type vec4f at location 1",
        ),
        (
            r#"{"name": "place", "type": "vec2f", "location": 0}, "#,
            "",
            "takes 2 interpolated values, and the manifest lists 1",
        ),
    ] {
        assert!(manifest.contains(from));
        let (error, message) = refusal(&gpu, (&manifest.replacen(from, to, 1), &wgsl), &options);
        assert!(matches!(error, Error::Mismatch { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
    for (from, to, wanted) in [
        (r#""name": "shade""#, r#""name": "place""#, "`place` is listed twice"),
        (r#""location": 1"#, r#""location": 0"#, "location 0 is listed twice"),
        (
            r#""type": "f32", "location""#,
            r#""type": "u32", "location""#,
            "`shade` is of type u32, and floats are interpolated",
        ),
    ] {
        let (error, message) = refusal(&gpu, (&manifest.replacen(from, to, 1), &wgsl), &options);
        assert!(matches!(error, Error::BadManifest { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
}

#[test]
fn what_a_draw_reads_is_checked_when_it_is_bound() {
    let gpu = Gpu::new();
    let copy = COPY.emit(common::Stage::Fragment);
    assert!(COPY.bindings == [COLOR]);
    let cover = "@vertex fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
        return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
    }";
    let draw = Draw::from_json(
        &gpu.device,
        &copy.manifest,
        &copy.wgsl,
        &DrawOptions::new(cover, "cover"),
    );
    let draw = draw.expect("a kernel without varyings is drawn too");
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    assert!(matches!(
        draw.bind(&[("colour", &color)]),
        Err(Error::UnknownInput { .. })
    ));
    assert!(matches!(
        draw.bind(&[] as &[(&str, &wgpu::TextureView)]),
        Err(Error::MissingInput { .. })
    ));
    let bound = draw.bind(&[("color", &color)]).expect("it fits");
    assert!(matches!(
        bound.write_uniform(&gpu.queue, "scale", 1.0),
        Err(Error::UnknownUniform { .. })
    ));
    // The target has another size than the triangle: a scissor of the caller's.
    let target = gpu.target(SIZE);
    let colour = view(&target);
    let mut encoder = gpu.encoder();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &colour,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    });
    bound.set(&mut pass);
    pass.set_scissor_rect(0, 0, SIZE[0], 10);
    pass.draw(0..3, 0..1);
    drop(pass);
    gpu.submit(encoder);
    let (found, expected) = (gpu.download(&target), ramp(SIZE, 1));
    let filled = (SIZE[0] * 10) as usize;
    assert_eq!(found[..filled], expected[..filled]);
    assert!(found[filled..].iter().all(|texel| *texel == [0.0; 4]));
}
