//! The kernels that resolve samples of renderers that shade more than once a pixel make what their definitions make, which share
//! no code with them.

use crate::common;

use straightline_bench::execute::{Bench, Inputs, Written, interpret_kernel};
use straightline_codegen::{Compiled, Settings, Stage};
use straightline_kernels::prelude::*;
use straightline_scene::render::{Aggregate, CpuRenderer, Surface};
use straightline_scene::scene::{SKY_DEPTH, Scene};
use straightline_study::progress::Silent;
use straightline_study::quality::resolves;
use straightline_study::quality::{Method, MethodKind, Shot, list_methods};

const SIZE: UVec2 = UVec2::new(96, 54);

/// Methods that a kernel resolves, and the inputs of each from a scene.
fn shots(scene: &str) -> (Vec<Method>, Shot) {
    let resolved: Vec<Method> = list_methods(true)
        .into_iter()
        .filter(|method| !resolves::resolve_kernels(method).is_empty())
        .collect();
    let renderer = CpuRenderer::new(&Scene::from_name(scene).expect("a scene"), SIZE).expect("a renderer");
    let listed: Vec<&Method> = resolved.iter().collect();
    let shot = Shot::draw(&renderer, &listed, &mut Silent).expect("drawn");
    (resolved, shot)
}

/// Results of a kernel on the device, and by the interpreter in `f32` and `f64`.
fn made(bench: &Bench, compiled: &Compiled, inputs: &Inputs) -> [Vec<Written>; 3] {
    [
        bench.run_targets(compiled, Stage::Compute, inputs).expect("it runs"),
        interpret_kernel::<f32>(compiled, inputs, false)
            .expect("it runs")
            .targets,
        interpret_kernel::<f64>(compiled, inputs, false)
            .expect("it runs")
            .targets,
    ]
}

#[test]
fn pictures_are_those_of_the_definitions() {
    let bench = common::bench();
    let mut edges = 0;
    for scene in ["creases", "railings", "emissive"] {
        let (methods, shot) = shots(scene);
        for method in &methods {
            let defined = resolves::resolve_picture(method, &shot).expect("a picture");
            let plain = shot.any_capture().expect("a capture").color.texels();
            edges += defined.texels().iter().zip(plain).filter(|(a, b)| a != b).count();
            let kernels = resolves::resolve_kernels(method);
            let inputs = resolves::resolve_inputs(method, &shot).expect("inputs");
            assert_eq!(kernels.len(), inputs.len(), "{}", method.name);
            let (kernel, inputs) = (&kernels[kernels.len() - 1], &inputs[inputs.len() - 1]);
            let compiled = kernel.compile(&Settings::default()).expect("it compiles");
            for (by, targets) in ["device", "f32", "f64"].iter().zip(made(&bench, &compiled, inputs)) {
                let texels = defined.texels().iter().zip(&targets[0].texels);
                let off =
                    |(a, b): (&Vec4, &[f64; 4])| (0..4).map(|c| (f64::from(a[c]) - b[c]).abs()).fold(0.0, f64::max);
                let mut off: Vec<f64> = texels.map(off).collect();
                off.sort_by(f64::total_cmp);
                // A threshold between the two values resolves the pixel in another way.
                let beyond = off.iter().filter(|off| **off > 2.0e-5).count();
                println!(
                    "{scene}, {}, {by}: {beyond} pixels, {:.1e} at most",
                    method.name,
                    off[off.len() - 1]
                );
                assert!(beyond <= 2, "{scene}, {}, {by}: {beyond} pixels are off", method.name);
            }
        }
    }
    assert!(edges > 10_000, "{edges}");
}

#[test]
fn aggregates_are_those_of_the_definition() {
    let bench = common::bench();
    for scene in ["creases", "railings", "emissive"] {
        let (methods, shot) = shots(scene);
        for method in methods.iter().filter(|method| method.kind == MethodKind::Aggregated) {
            let aggregated = shot.aggregated_for(method).expect("drawn");
            let compiled = resolves::resolve_kernels(method)[0]
                .compile(&Settings::default())
                .expect("it compiles");
            let inputs = resolves::resolve_inputs(method, &shot).expect("inputs");
            for (by, targets) in ["device", "f32", "f64"].iter().zip(made(&bench, &compiled, &inputs[0])) {
                let mut beyond = 0;
                for (k, pixel) in aggregated.pixels.iter().enumerate() {
                    let found = [0, 1].map(|which| {
                        let texels = |name: &str| {
                            let name = format!("{name}_{which}");
                            targets
                                .iter()
                                .find(|target| target.name == name)
                                .expect("a target")
                                .texels[k]
                        };
                        read(texels("geometry"), texels("paint"))
                    });
                    // The order of the two is free; samples that are as near to one as to the other go either way.
                    let same = (0..2).all(|which| is_near(&found[which], &pixel[which]));
                    beyond += usize::from(!same);
                }
                println!("{scene}, {}, {by}: {beyond} pixels", method.name);
                assert!(beyond <= 3, "{scene}, {}, {by}: {beyond} pixels are off", method.name);
            }
        }
    }
}

/// An aggregate of two texels as the kernel packs them.
fn read(geometry: [f64; 4], paint: [f64; 4]) -> Aggregate {
    let [x, y, depth, members] = geometry;
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let normal = glam::DVec3::new(x - fold.copysign(x), y - fold.copysign(y), z).normalize();
    let packed = paint[3] as u64;
    let at = |bits: u64| (bits & 255) as f32 / 255.0 - 0.5;
    Aggregate {
        members: members as usize,
        place: Vec2::new(at(packed >> 4), at(packed >> 12)),
        surface: Surface {
            normal: normal.as_vec3(),
            depth: depth as f32,
            color: Vec3::new(paint[0] as f32, paint[1] as f32, paint[2] as f32),
            material: (packed & 15) as f32,
        },
        color: Vec3::ZERO,
    }
}

fn is_near(found: &Aggregate, expected: &Aggregate) -> bool {
    if found.members != expected.members || expected.members == 0 {
        return found.members == expected.members;
    }
    let (a, b) = (&found.surface, &expected.surface);
    let is_sky = b.depth >= SKY_DEPTH;
    (found.place - expected.place).abs().max_element() <= 0.51 / 255.0
        && (a.depth - b.depth).abs() <= 1.0e-5 * b.depth
        && (is_sky || a.material == b.material)
        && (is_sky || (a.color - b.color).abs().max_element() <= 1.0e-5)
        && (is_sky || (a.normal - b.normal).abs().max_element() <= 1.0e-4)
}
