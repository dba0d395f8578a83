//! Quads at the edges of triangles, at the border, and with lanes that are discarded.

use super::*;
use straightline_bench::execute::Corner;
use straightline_codegen::Form;
use straightline_codegen::emit::{Emitted, Target};
use straightline_manifest::Manifest;

const PLACES: &str = "
/// Position of the pixel on its triangle, and of the three others of its quad.
pub fn places(place: Quad<Vec2>) -> Quad<Vec4> {
    let [own, beside, below, across] = place.gather();
    Quad::from_xy(own.x() + own.y() * 4096.0, beside.x() + beside.y() * 4096.0)
        .extend(below.x() + below.y() * 4096.0)
        .extend(across.x() + across.y() * 4096.0)
}
";

/// Two slanted triangles and a sliver. Each says of its pixels where they are, in pixels, and of which triangle.
fn triangles(size: UVec2) -> Vec<Corner> {
    let points = [
        [vec2(-0.95, -0.9), vec2(0.4, -0.7), vec2(-0.7, 0.8)],
        [vec2(0.4, -0.7), vec2(0.9, 0.95), vec2(-0.7, 0.8)],
        [vec2(0.5, -0.9), vec2(1.4, -0.85), vec2(0.97, 0.3)],
    ];
    let corner = |(k, at): (usize, &Vec2)| {
        let pixel = vec2(at.x * 0.5 + 0.5, 0.5 - at.y * 0.5) * size.as_vec2();
        Corner {
            position: vec4(at.x, at.y, 0.5, 1.0),
            varyings: vec![vec4(pixel.x, pixel.y + 100.0 * (k + 1) as f32, 0.0, 0.0)],
        }
    };
    points
        .iter()
        .enumerate()
        .flat_map(|(k, three)| three.iter().map(move |at| corner((k, at))).collect::<Vec<_>>())
        .collect()
}

/// Text of the emitted shader, and its manifest without the hash, so that another text can be drawn by it.
fn text_of(emitted: &Emitted) -> (Manifest, String) {
    let mut manifest = emitted.manifest.clone();
    manifest.hashes.clear();
    (
        manifest,
        String::from_utf8_lossy(&emitted.files[&Target::Wgsl]).into_owned(),
    )
}

/// The kernel as a function, and a shader that calls it and then discards fragments where `condition` holds of `pixel`: after the
/// last message, where a lane that goes takes nothing from the others.
fn discarding(gpu: &Bench, compiled: &Compiled, condition: &str) -> (Manifest, String) {
    let options = gpu.emit_options(Stage::Fragment);
    let whole = compiled.emit(&options).expect("it is emitted");
    let function = compiled
        .emit(&options.form(Form::Function))
        .expect("it is emitted as a function");
    let (_, function) = text_of(&function);
    let (mut manifest, _) = text_of(&whole);
    manifest.entry_point = "discarding".to_owned();
    let text = format!(
        "{function}
@fragment
fn discarding(@builtin(position) position: vec4f, @location(0) place: vec2f) -> @location(0) vec4f {{
    let pixel = vec2i(position.xy);
    let colour = places(position.xy, place);
    if {condition} {{
        discard;
    }}
    return colour;
}}
"
    );
    (manifest, text)
}

#[test]
fn helper_lanes_answer_at_the_edges_of_triangles() {
    let gpu = bench();
    for size in [uvec2(32, 24), uvec2(33, 23)] {
        for transport in [Transport::Subgroup, Transport::Derivatives] {
            for discard in [None, Some("(pixel.x + 2 * pixel.y) % 3 == 0")] {
                let settings = Settings::new().transport(transport);
                let compiled = compile_text(PLACES, "places", &settings);
                let inputs = Inputs::new(size);
                let forward = match discard {
                    None => gpu.prepare_forward(&compiled, &inputs, &triangles(size)),
                    Some(condition) => {
                        let (manifest, text) = discarding(&gpu, &compiled, condition);
                        gpu.forward_by(&manifest, &text, &inputs, &triangles(size))
                    }
                };
                let forward = forward.unwrap_or_else(|e| panic!("{e}"));
                let found = gpu.draw_forward(&forward).expect("it is drawn");
                let (mut drawn, mut edges) = (0, 0);
                for y in 0..size.y as i32 {
                    for x in 0..size.x as i32 {
                        let texel = found.load(ivec2(x, y));
                        let gone = discard.is_some() && (x + 2 * y) % 3 == 0;
                        if texel == Vec4::ZERO {
                            continue;
                        }
                        assert!(!gone, "{x}, {y} is discarded, and drawn");
                        drawn += 1;
                        let triangle = (texel.x / 4096.0 / 100.0).floor();
                        let place = |i: i32, j: i32| {
                            let (px, py) = (x as f32 + 0.5 + i as f32, y as f32 + 0.5 + j as f32);
                            px + (py + 100.0 * triangle) * 4096.0
                        };
                        let (i, j) = (1 - 2 * (x & 1), 1 - 2 * (y & 1));
                        let expected = [place(0, 0), place(i, 0), place(0, j), place(i, j)];
                        for (m, (a, b)) in texel.to_array().iter().zip(expected).enumerate() {
                            // Of 4096 to the pixel, a sixteenth of one.
                            assert!(
                                (a - b).abs() < 256.0,
                                "{transport}, {size}, discard {discard:?}: {x}, {y} receives {a} for {b} by message {m}"
                            );
                        }
                        let neighbour = ivec2(x + i, y + j);
                        edges += usize::from(found.load(neighbour) == Vec4::ZERO);
                    }
                }
                assert!(
                    drawn > 200 && edges > 20,
                    "{drawn} pixels are drawn, {edges} beside a lane that is not"
                );
            }
        }
    }
}

/// A triangle that covers the frame.
pub fn cover() -> Vec<Corner> {
    let corner = |x, y| Corner {
        position: vec4(x, y, 0.5, 1.0),
        varyings: Vec::new(),
    };
    vec![corner(-1.0, -1.0), corner(3.0, -1.0), corner(-1.0, 3.0)]
}

/// With coarse derivatives forced on, the picture is wrong exactly where the detection says so: on SwiftShader, whose
/// coarse derivatives are coarse, not on lavapipe, whose are fine.
#[test]
fn coarse_derivatives_spoil_the_picture_and_are_refused() {
    use straightline_runtime::{DerivativeControl, DerivativeKind, Quads};
    let (device, queue) = common::device();
    let gpu = Bench::new(&device, &queue, false);
    let size = uvec2(24, 16);
    let image = noise(size, 40);
    let inputs = Inputs::new(size).with_image("image", image);
    let compiled = compile("quad_convolution", &[], Unroll::Full, Some(Transport::Derivatives));
    let expected = interpret_kernel::<f32>(&compiled, &inputs, false)
        .expect("it runs")
        .texels;
    let expected: Vec<[f64; 4]> = expected.iter().map(|t| t.map(f64::from)).collect();
    let off = |coarse: bool| {
        let emitted = compiled
            .emit(&gpu.emit_options(Stage::Fragment))
            .expect("it is emitted");
        let (manifest, mut text) = text_of(&emitted);
        if coarse {
            text = text.replace("dpdxFine", "dpdxCoarse").replace("dpdyFine", "dpdyCoarse");
        }
        let forward = gpu
            .forward_by(&manifest, &text, &inputs, &cover())
            .expect("it can be drawn");
        largest(&texels(&gpu.draw_forward(&forward).expect("it is drawn")), &expected)
    };
    assert!(off(false) < 1.0e-6);
    let quads = Quads::detect_with(&device, &queue, DerivativeControl::Coarse).expect("pixels are drawn");
    println!(
        "coarse derivatives forced: {:?}, the picture is off by {:.3}",
        quads.kind,
        off(true)
    );
    match quads.kind {
        DerivativeKind::Fine => assert!(off(true) < 1.0e-6),
        _ => {
            assert!(off(true) > 0.05, "off by {} only", off(true));
            assert!(quads.subgroup.is_some() || quads.choose().is_err());
        }
    }
}
