//! A large image in tiles has the same bits as in one go (paper §1: "the algorithm may work on tiles").

use crate::common;

use common::{bench, other_compilers, same_bits};
use std::collections::BTreeSet;
use std::path::PathBuf;
use straightline_bench::execute::crop_inputs;
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Format, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::{Error, Region};
use straightline_tests::sraa::options::options;
use straightline_tests::sraa::{Options, compiled, surfaces};

fn sets() -> Vec<Options> {
    ["layers", "superresolution", "multisampled", "split"]
        .map(|layout| options(&[("layout", layout), ("metric", "planes-normals")]))
        .into_iter()
        .chain([options(&[("metric", "depth"), ("falloff", "none"), ("mask", "select")])])
        .collect()
}

#[test]
fn tiled_and_whole_are_the_same_bits() {
    let bench = bench();
    for set in sets() {
        for (size, side) in [
            (uvec2(61, 47), 16),
            (uvec2(61, 47), 13),
            (uvec2(1, 1), 4),
            (uvec2(1, 9), 2),
            (uvec2(7, 1), 1),
            (uvec2(33, 20), 64),
        ] {
            let inputs = surfaces::inputs(&set, size, 3);
            let compiled = compiled(&set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
            for stage in [Stage::Compute, Stage::Fragment] {
                let what = format!("{set:?} {stage:?} {size} in tiles of {side}");
                let whole = bench
                    .run(&compiled, stage, &inputs)
                    .unwrap_or_else(|e| panic!("{what}: {e}"));
                let mut tiled = vec![[f32::NAN; 4]; whole.texels().len()];
                let done = bench.in_tiles(
                    (&compiled, stage),
                    size,
                    (side, 1),
                    |tile| Ok(crop_inputs(&inputs, tile)),
                    |tile, pixels| {
                        for (k, texel) in pixels.texels().iter().enumerate() {
                            let (x, y) = (k as u32 % tile.size.x, k as u32 / tile.size.x);
                            let at = tile.first + uvec2(x, y);
                            tiled[(at.y * size.x + at.x) as usize] = texel.to_array();
                        }
                    },
                );
                done.unwrap_or_else(|e| panic!("{what}: {e}"));
                let whole: Vec<[f32; 4]> = whole.texels().iter().map(|texel| texel.to_array()).collect();
                same_bits(&whole, &tiled).unwrap_or_else(|e| panic!("{what}: {e}"));
            }
        }
    }
}

/// Rectangles of one target, in one encoder: each keeps the pixels of the others.
#[test]
fn rectangles_of_one_picture_fill_it() {
    let (bench, size) = (bench(), uvec2(40, 30));
    let set = options(&[]);
    let inputs = surfaces::inputs(&set, size, 4);
    let compiled = compiled(&set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
    for stage in [Stage::Compute, Stage::Fragment] {
        let whole = bench.run(&compiled, stage, &inputs).unwrap_or_else(|e| panic!("{e}"));
        let emit = EmitOptions::new().stage(stage).format(Format::Rgba32Float).region(true);
        let (pass, manifest) = bench.emit_pass(&compiled, &emit).unwrap_or_else(|e| panic!("{e}"));
        let uploaded = bench.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{e}"));
        let target = bench.create_target(size, pass.target_format());
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let device = bench.device();
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for (first, part) in [([0, 0], [17, 30]), ([17, 0], [23, 11]), ([17, 11], [23, 19])] {
            let bound = uploaded.bind_region(&pass, &view, Region::at(first, part));
            bound.unwrap_or_else(|e| panic!("{stage:?}: {e}")).encode(&mut encoder);
        }
        bench.queue().submit([encoder.finish()]);
        let parts = bench.download(&target).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(parts, whole, "{stage:?}");

        // A region outside of the picture is refused by name.
        let refused = |region| match uploaded.bind_region(&pass, &view, region) {
            Err(error @ Error::Region { .. }) => error.to_string(),
            other => panic!("{other:?}"),
        };
        assert!(refused(Region::at([30, 0], [11, 1])).contains("leaves the inputs, which are 40x30"));
        let beyond = Region {
            first: [0, 0],
            size: [11, 1],
            place: [30, 0],
        };
        assert!(refused(beyond).contains("leaves the target"));
        assert!(refused(Region::at([0, 0], [0, 4])).contains("no pixels"));
    }
}

#[test]
fn a_shader_for_whole_images_refuses_regions() {
    let (bench, set) = (bench(), options(&[]));
    let inputs = surfaces::inputs(&set, uvec2(8, 8), 4);
    let compiled = compiled(&set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
    let (pass, manifest) = bench
        .compile_pass(&compiled, Stage::Compute)
        .unwrap_or_else(|e| panic!("{e}"));
    let uploaded = bench.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{e}"));
    let target = bench.create_target(uvec2(8, 8), pass.target_format());
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let refused = uploaded.bind_region(&pass, &view, Region::at([0, 0], [4, 4]));
    let error = refused.expect_err("it has no region").to_string();
    assert!(error.contains("generate it with `region`"), "{error}");
}

#[test]
fn shaders_for_regions_are_valid_everywhere() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("regions");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let targets: BTreeSet<Target> = Target::MODERN.into();
    let (mut glsl, mut spirv) = (Vec::new(), Vec::new());
    for (k, set) in sets().iter().enumerate() {
        let compiled = compiled(set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
        for stage in [Stage::Compute, Stage::Fragment] {
            let emit = EmitOptions::new().stage(stage).targets(targets.clone()).region(true);
            let emitted = compiled.emit(&emit).unwrap_or_else(|e| panic!("{set:?}: {e}"));
            for (name, contents) in emitted.named_files(&format!("{k}-{}", stage.name())) {
                let path = folder.join(&name);
                match path.extension().and_then(|e| e.to_str()) {
                    Some("comp" | "frag") => glsl.push(path.clone()),
                    Some("spv") => spirv.push(path.clone()),
                    _ => continue,
                }
                std::fs::write(&path, contents).expect("a shader is written");
            }
        }
    }
    other_compilers(&glsl, &spirv);
}
