//! The edge filters: in every form by the interpreter, on a GPU against their formulas in f64, and on the edges that the
//! printed code misses. `STRAIGHTLINE_PICTURES=DIR` writes what they make of the built-in scene.

use crate::common;
mod filter;
#[path = "../../../examples/toon/toon.rs"]
mod toon;
mod world;

use common::{bench, other_compilers, same_bits};
use filter::{Filter, compile};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, Stage, Unroll};
use straightline_kernels::edge::{Depth, Form, Output, Stalker, TabulaRasa};
use straightline_kernels::prelude::*;
use straightline_manifest::BindingKind;
use straightline_oracle::metrics;
use straightline_scene::picture;
use straightline_scene::render::{CpuRenderer, Renderer, render_reference};
use straightline_scene::scene::builtin_scene;
use world::{World, pixels};

#[test]
fn native_looped_and_unrolled_agree() {
    for size in [uvec2(47, 31), uvec2(1, 1), uvec2(1, 6), uvec2(5, 2)] {
        let world = World::surfaces(size);
        for filter in Filter::all() {
            let world = world.storing(filter.normals());
            let expected = filter.native(&world);
            for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
                let found = interpret_kernel::<f32>(&filter.compile(unroll), &filter.inputs(&world), false);
                let found = found.unwrap_or_else(|e| panic!("{filter:?}: {e}"));
                same_bits(&expected, &found.texels).unwrap_or_else(|e| panic!("{filter:?} {unroll}: {e}"));
            }
        }
    }
}

#[test]
fn shaders_match_the_formulas() {
    let bench = bench();
    let world = World::surfaces(uvec2(83, 59));
    let mut worst = 0.0f64;
    for filter in Filter::all() {
        let world = world.storing(filter.normals());
        let (edges, exact) = filter.exact(&world);
        let sure: Vec<bool> = edges.iter().map(|e| e.margin > 1.0e-6).collect();
        let unsure = sure.iter().filter(|s| !**s).count();
        assert!(
            unsure * 100 < sure.len(),
            "{unsure} pixels hang on the last bit, {filter:?}"
        );
        let kinds: BTreeSet<u64> = edges.iter().map(|e| e.weight.to_bits()).collect();
        assert!(kinds.len() > 1, "every pixel is the same, {filter:?}");
        for (unroll, stage) in [
            (Unroll::Full, Stage::Compute),
            (Unroll::Full, Stage::Fragment),
            (Unroll::None, Stage::Compute),
        ] {
            let shown = bench
                .run(&filter.compile(unroll), stage, &filter.inputs(&world))
                .unwrap_or_else(|e| panic!("{filter:?}: {e}"));
            for (k, (shown, exact)) in shown.texels().iter().zip(&exact).enumerate().filter(|(k, _)| sure[*k]) {
                let off = (0..4).map(|lane| (f64::from(shown[lane]) - exact[lane]).abs());
                let off = off.fold(0.0, f64::max);
                // A GPU weighs texels in steps of 1/256 on each axis.
                let bound = if filter.output() == Output::Edges {
                    0.0
                } else {
                    1.0 / 128.0
                };
                assert!(
                    off <= bound,
                    "pixel {k} is {shown}, not {exact:?}: {filter:?} {unroll} {stage:?}"
                );
                worst = worst.max(off);
            }
        }
    }
    println!("largest difference to f64: {worst:e}");
}

#[test]
fn filtered_picture_of_the_kernel_is_that_of_the_formulas() {
    let world = World::surfaces(uvec2(64, 40));
    for filter in Filter::all() {
        let world = world.storing(filter.normals());
        let (edges, exact) = filter.exact(&world);
        for (k, (found, exact)) in filter.native(&world).iter().zip(&exact).enumerate() {
            let off = (0..4).map(|lane| (f64::from(found[lane]) - exact[lane]).abs());
            let off = off.fold(0.0, f64::max);
            assert!(
                off < 2.0e-5 || edges[k].margin < 1.0e-6,
                "pixel {k}: {off:e}, {filter:?}"
            );
        }
    }
}

fn stalker_edges(form: Form) -> Filter {
    Filter::Stalker(Stalker {
        form,
        output: Output::Edges,
        ..Stalker::default()
    })
}

fn tabula_rasa_edges(form: Form) -> Filter {
    Filter::TabulaRasa(TabulaRasa {
        form,
        output: Output::Edges,
        ..TabulaRasa::default()
    })
}

/// Printed, one direction without an edge hides those of all others: along a straight edge there is always one.
#[test]
fn a_straight_vertical_edge() {
    let step = |p: IVec2| if p.x < 8 { 0.5 } else { 0.25 };
    let depth = World::new(uvec2(16, 12), |p| (step(p), Vec3::Z, Vec4::ONE));
    let turned = World::new(uvec2(16, 12), |p| {
        (0.5, if p.x < 8 { Vec3::Z } else { Vec3::X }, Vec4::ONE)
    });
    for at in pixels(uvec2(16, 12)) {
        let beside = at.x == 7 || at.x == 8;
        // Of the four directions one is along the edge; of the four diagonals two are on this side of it.
        for (world, weight) in [(&depth, 0.75), (&turned, 0.5)] {
            let expected = if beside { weight } else { 0.0 };
            assert_eq!(stalker_edges(Form::Corrected).edge(world, at), expected, "{at}");
            assert_eq!(stalker_edges(Form::Paper).edge(world, at), 0.0, "{at}");
        }
    }
}

#[test]
fn opposite_normals_are_not_alike() {
    let world = World::new(uvec2(9, 9), |p| {
        (0.5, if (p.x + p.y) % 2 == 0 { Vec3::Z } else { Vec3::NEG_Z }, Vec4::ONE)
    });
    // Diagonal neighbours of a chequered pattern are alike; of one in columns they are not.
    let columns = World::new(uvec2(9, 9), |p| {
        (0.5, if p.x % 2 == 0 { Vec3::Z } else { Vec3::NEG_Z }, Vec4::ONE)
    });
    let at = ivec2(4, 4);
    assert_eq!(stalker_edges(Form::Corrected).edge(&world, at), 0.0);
    assert_eq!(stalker_edges(Form::Corrected).edge(&columns, at), 1.0);
    assert_eq!(stalker_edges(Form::Paper).edge(&columns, at), 0.0);
}

/// Printed, the difference of the two cosines is 0 where both sides fall away alike.
#[test]
fn a_ridge_of_one_pixel() {
    let facing = |p: IVec2| match p.x.cmp(&8) {
        std::cmp::Ordering::Less => vec3(-0.96, 0.0, 0.28),
        std::cmp::Ordering::Equal => Vec3::Z,
        std::cmp::Ordering::Greater => vec3(0.96, 0.0, 0.28),
    };
    let world = World::new(uvec2(17, 12), |p| {
        (0.5 - 0.01 * (p.x - 8).abs() as f32, facing(p), Vec4::ONE)
    });
    for y in 0..12 {
        // In all directions but along the ridge.
        assert_eq!(tabula_rasa_edges(Form::Corrected).edge(&world, ivec2(8, y)), 0.75);
        assert_eq!(tabula_rasa_edges(Form::Paper).edge(&world, ivec2(8, y)), 0.0);
        for form in [Form::Corrected, Form::Paper] {
            assert_eq!(tabula_rasa_edges(form).edge(&world, ivec2(3, y)), 0.0);
        }
    }
}

/// On an edge, half a pixel to each corner is a tent of three pixels on each axis.
#[test]
fn the_default_kernel_weighs_three_by_three() {
    let at = ivec2(4, 4);
    let world = World::new(uvec2(9, 9), |p| {
        let normal = if p.x % 2 == 0 { Vec3::Z } else { Vec3::NEG_Z };
        (0.5, normal, if p == at { Vec4::ONE } else { Vec4::ZERO })
    });
    let found = Filter::Stalker(Stalker::default()).native(&world);
    for p in pixels(uvec2(9, 9)) {
        let axis = |k: i32| [2.0, 1.0, 0.0][k.abs().min(2) as usize];
        let expected = axis(p.x - at.x) * axis(p.y - at.y) / 16.0;
        let off = (found[(p.y * 9 + p.x) as usize][0] - expected).abs();
        assert!(off < 1.0e-6, "{p}: off by {off}");
    }
}

#[test]
fn nothing_is_bound_that_is_not_read() {
    for kernel in ["stalker", "tabula_rasa"] {
        let set = vec![("output".to_owned(), "edges".to_owned())];
        let edges = compile(kernel, set, Unroll::Full);
        let whole = compile(kernel, Vec::new(), Unroll::Full);
        let bound = |compiled: &Compiled| {
            let emitted = compiled.emit(&EmitOptions::new()).unwrap_or_else(|e| panic!("{e}"));
            let (mut names, mut thresholds) = (Vec::new(), 0);
            for binding in emitted.manifest.bindings {
                match binding.kind {
                    BindingKind::Uniform { fields, .. } => thresholds = fields.len(),
                    _ => names.push(binding.name),
                }
            }
            (names.join(" "), thresholds)
        };
        assert_eq!(bound(&edges), ("depth normal".to_owned(), 2), "{kernel}");
        assert_eq!(bound(&whole), ("depth normal color linear".to_owned(), 3), "{kernel}");
        assert_eq!((whole.counts.basic_blocks, whole.counts.loops), (1, 0), "{kernel}");
    }
}

/// Thresholds start at their defaults, and mean the same known as at run time.
#[test]
fn thresholds_known_and_at_run_time() {
    let world = World::surfaces(uvec2(40, 30));
    let run =
        |compiled: &Compiled, inputs: &Inputs| interpret_kernel::<f32>(compiled, inputs, false).expect("all is bound");
    for filter in Filter::all() {
        let (choices, numbers) = filter.options();
        let mut set: Vec<(String, String)> = choices.into_iter().map(|(k, v)| (k.to_owned(), v)).collect();
        set.extend(numbers.iter().map(|(k, v)| (k.replace('_', "-"), v.to_string())));
        let known = compile(filter.name(), set, Unroll::Full);
        assert!(known.graph.uniforms.is_empty(), "{filter:?}");
        let at_run_time = run(&filter.compile(Unroll::Full), &filter.inputs(&world));
        same_bits(&run(&known, &world.inputs()).texels, &at_run_time.texels)
            .unwrap_or_else(|e| panic!("{filter:?}: {e}"));
    }
    for filter in [
        Filter::Stalker(Stalker::default()),
        Filter::TabulaRasa(TabulaRasa::default()),
    ] {
        let untouched = run(&filter.compile(Unroll::Full), &world.inputs());
        same_bits(&filter.native(&world), &untouched.texels).unwrap_or_else(|e| panic!("{filter:?}: {e}"));
    }
}

#[test]
fn all_options_emit_in_all_languages() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("edge");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let (mut glsl, mut spirv) = (Vec::new(), Vec::new());
    for (k, filter) in Filter::all().iter().enumerate() {
        for (stage, unroll) in [(Stage::Compute, Unroll::Full), (Stage::Fragment, Unroll::None)] {
            let targets: BTreeSet<Target> = Target::MODERN.into();
            let emitted = filter
                .compile(unroll)
                .emit(&EmitOptions::new().stage(stage).targets(targets))
                .unwrap_or_else(|e| panic!("{filter:?}: {e}"));
            for (name, contents) in emitted.named_files(&format!("{k}-{}", stage.name())) {
                let path = folder.join(&name);
                std::fs::write(&path, contents).expect("a shader is written");
                match name.rsplit('.').next() {
                    Some("comp" | "frag") => glsl.push(path),
                    Some("spv") => spirv.push(path),
                    _ => {}
                }
            }
        }
    }
    let each = 2 * Filter::all().len();
    assert_eq!((glsl.len(), spirv.len()), (each, each));
    other_compilers(&glsl, &spirv);
}

/// The example that draws outlines where the detector alone finds edges.
#[test]
fn outlines_in_every_form() {
    let world = World::surfaces(uvec2(47, 31));
    let found = stalker_edges(Form::Corrected).native(&world);
    let edges = Frame::new(uvec2(47, 31), found.into_iter().map(Vec4::from_array).collect());
    let inputs = world.inputs().with_image("edges", edges.clone());
    let kernel = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/toon/toon.rs");
    for ink in [0.0, 1.0] {
        let cfg = toon::Toon {
            ink,
            ..toon::Toon::default()
        };
        let native = pixels(uvec2(47, 31)).map(|at| toon::toon(&cfg, &world.color, &edges, at).to_array());
        let native: Vec<_> = native.collect();
        assert_eq!(ink == 1.0, native.iter().any(|texel| texel[..3] == [0.0; 3]));
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().set("ink", ink).unroll(unroll);
            let compiled = Kernel::from_file(&kernel, None).and_then(|k| k.compile(&settings));
            let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
            let found = interpret_kernel::<f32>(&compiled, &inputs, false).expect("all is bound");
            same_bits(&native, &found.texels).unwrap_or_else(|e| panic!("{unroll}: {e}"));
        }
    }
}

/// On the built-in scene each finds edges, and comes closer to the reference than no filter does.
#[test]
fn on_the_scene() {
    let size = uvec2(320, 180);
    let renderer = CpuRenderer::new(&builtin_scene(), size).expect("the scene is drawn");
    let (depth, normal) = renderer.draw_geometry(Vec2::ZERO).expect("geometry");
    let color = renderer.draw_shaded(Vec2::ZERO).expect("a picture");
    let world = World {
        depth,
        stored: normal.clone(),
        normal,
        color,
    };
    let exact = render_reference(&renderer, 4, &mut |_, _| {}).expect("supersampled");
    let plain = metrics::psnr(&world.color, &exact);
    save("scene", &world.color);
    let mut columns = vec![("1x", world.color.clone())];
    let stalker = Stalker {
        depth: Depth::Linear,
        depth_barrier: 2.0e-3,
        ..Stalker::default()
    };
    for form in [Form::Paper, Form::Corrected] {
        for output in [Output::Edges, Output::Antialias] {
            for filter in [
                Filter::Stalker(Stalker {
                    form,
                    output,
                    ..stalker
                }),
                Filter::TabulaRasa(TabulaRasa {
                    form,
                    output,
                    weight: 0.5,
                    ..TabulaRasa::default()
                }),
            ] {
                let found = filter.native(&world);
                let shown = Frame::new(size, found.into_iter().map(Vec4::from_array).collect());
                if form == Form::Corrected {
                    let title = if output == Output::Edges {
                        "edges"
                    } else {
                        filter.title()
                    };
                    columns.push((title, shown.clone()));
                }
                let name = format!("{}-{form:?}-{output:?}", filter.name()).to_lowercase();
                save(&name, &shown);
                if output == Output::Edges {
                    let edges = shown.texels().iter().filter(|c| c.x > 0.0).count() as f64;
                    println!(
                        "{name}: {:.1} % edges",
                        100.0 * edges / f64::from(size.element_product())
                    );
                    continue;
                }
                let filtered = metrics::psnr(&shown, &exact);
                println!("{name}: {filtered:.2} dB, unfiltered {plain:.2} dB");
                assert!(
                    form == Form::Paper || filtered > plain,
                    "{name}: {filtered} dB, {plain} dB"
                );
            }
        }
    }
    columns.push(("reference", exact));
    let [plain, edges_s, edges_t, s, t, exact] = columns.try_into().expect("six pictures");
    let columns = [plain, edges_s, s, edges_t, t, exact];
    let details: Vec<_> = columns
        .iter()
        .map(|(title, frame)| (*title, picture::enlarge_detail(frame, 176, 74, 44, 44, 6)))
        .collect();
    let details: Vec<_> = details.iter().map(|(title, frame)| (*title, frame)).collect();
    save("details", &picture::compose_montage(&details));
}

fn save(name: &str, shown: &Frame<Vec4>) {
    let Some(folder) = std::env::var_os("STRAIGHTLINE_PICTURES") else {
        return;
    };
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder).expect("a folder for pictures");
    picture::write_picture(&folder.join(format!("edge-{name}.png")), shown).expect("a picture is written");
}
