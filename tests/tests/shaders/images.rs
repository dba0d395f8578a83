//! Kernels that write to pictures at any place: as rustc compiles them, interpreted in every form, on GPUs in every language.

use crate::common;

use common::{Texel, bench, same_texels};
use straightline_bench::execute::{Inputs, Written, interpret_kernel};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Branches, Compiled, EmitOptions, Form, Format, Origin, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::gl::{self, Context};
use straightline_tests::texts::{compiled, texels};
use straightline_tests::{compilers, kernel, passthrough};

// No two pixels store at one place, and many store outside.
kernel!(SCATTERED, scattered, {
    pub fn scattered(
        color: &Frame<Vec4>,
        mirrored: &StorageTexture<Vec4>,
        spread: &StorageTexture<f32>,
        pixel: IVec2,
    ) -> Vec4 {
        let here = color.load(pixel);
        let last = mirrored.size().as_ivec2() - 1;
        mirrored.store(ivec2(last.x - pixel.x, pixel.y), here * 0.5);
        for k in 0..3 {
            if here.x > 0.25 {
                spread.store(ivec2(pixel.x * 3 + k - 1, pixel.y * 2 - k), here.y + k as f32);
            }
            if here.z > 0.75 {
                break;
            }
        }
        here.wzyx()
    }
});

kernel!(ALONE, alone, {
    pub fn alone(color: &Frame<Vec4>, bright: &StorageTexture<Vec3>, pixel: IVec2) {
        let here = color.load(pixel);
        if here.x < 0.25 {
            return;
        }
        bright.store(pixel, here.truncate() * 2.0);
    }
});

const SIZE: UVec2 = uvec2(13, 9);

type Native = fn(&Frame<Vec4>) -> Vec<Vec<[f64; 4]>>;

/// Name, text, and what rustc makes of it: all pictures.
const KERNELS: [(&str, &str, Native); 2] = [
    ("scattered", SCATTERED, |color| {
        let (mirrored, spread) = (StorageTexture::new(SIZE), StorageTexture::new(SIZE));
        let given = pixels().map(|at| scattered::scattered(color, &mirrored, &spread, at).texel());
        vec![given.collect(), all(&mirrored), all(&spread)]
    }),
    ("alone", ALONE, |color| {
        let bright = StorageTexture::new(SIZE);
        pixels().for_each(|at| alone::alone(color, &bright, at));
        // A texel that no pixel stores is 0 in all four components.
        let texels = all(&bright);
        let stored = |t: [f64; 4]| if t[..3] == [0.0; 3] { [0.0; 4] } else { t };
        vec![texels.into_iter().map(stored).collect()]
    }),
];

fn pixels() -> impl Iterator<Item = IVec2> {
    (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)))
}

fn all<T: Texel + Copy + Default>(picture: &StorageTexture<T>) -> Vec<[f64; 4]> {
    picture.texels().iter().map(Texel::texel).collect()
}

fn inputs() -> Inputs {
    Inputs::new(SIZE).with_image("color", texels(SIZE, 5))
}

fn settings(unroll: Unroll, branches: Branches) -> Settings {
    Settings::new().unroll(unroll).branches(branches)
}

/// A texture of one component has 0 and 1 in the missing components. In texels that were never stored, a shader reads 0.
#[track_caller]
fn same(what: &str, native: &[Vec<[f64; 4]>], found: &[Written]) {
    assert_eq!(native.len(), found.len(), "{what}");
    for (native, found) in native.iter().zip(found) {
        let lanes = if found.name == "spread" { 1 } else { 4 };
        let cut = |texels: &[[f64; 4]]| -> Vec<[f64; 4]> {
            let lane = |t: &[f64; 4], k: usize| if k < lanes { t[k] } else { 0.0 };
            texels.iter().map(|t| std::array::from_fn(|k| lane(t, k))).collect()
        };
        same_texels(&cut(native), &cut(&found.texels)).unwrap_or_else(|e| panic!("{what}, {}: {e}", found.name));
    }
}

#[test]
fn every_form_writes_what_rustc_writes() {
    for (name, text, native) in KERNELS {
        let native = native(&texels(SIZE, 5));
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
            for branches in [Branches::AsLoops, Branches::Keep, Branches::Select] {
                let what = format!("{name} {unroll} {branches}");
                let compiled = compiled(name, text, &settings(unroll, branches));
                let found =
                    interpret_kernel::<f32>(&compiled, &inputs(), false).unwrap_or_else(|e| panic!("{what}: {e}"));
                same(&what, &native, &found.targets);
            }
        }
    }
}

fn each_form(mut check: impl FnMut(&str, &Compiled, &[Vec<[f64; 4]>])) {
    for (name, text, native) in KERNELS {
        let native = native(&texels(SIZE, 5));
        for unroll in [Unroll::Full, Unroll::None] {
            let compiled = compiled(name, text, &settings(unroll, Branches::AsLoops));
            check(&format!("{name} {unroll}"), &compiled, &native);
        }
    }
}

#[test]
fn gpus_write_the_same() {
    let bench = bench();
    each_form(|what, compiled, native| {
        let found = bench.run_targets(compiled, Stage::Compute, &inputs());
        same(what, native, &found.unwrap_or_else(|e| panic!("{what}: {e}")));
    });
}

#[test]
fn glsl_hlsl_and_spirv_write_the_same_through_vulkan() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    each_form(|what, compiled, native| {
        for language in [Target::Glsl450, Target::Hlsl, Target::Spirv] {
            let options = bench.emit_options(Stage::Compute).targets([Target::Wgsl, language]);
            let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{what}: {e}"));
            let found = passthrough::run_all(&bench, &emitted, language, &inputs());
            let found = found.unwrap_or_else(|e| panic!("{what} {language}: {e}"));
            same(&format!("{what} {language}"), native, &found);
        }
    });
}

/// Of inputs turned over, a shader whose rows count from below writes the pictures turned over.
#[test]
fn opengl_writes_the_same() {
    let over =
        |texels: &[[f64; 4]]| -> Vec<[f64; 4]> { texels.chunks(SIZE.x as usize).rev().flatten().copied().collect() };
    each_form(|what, compiled, native| {
        for (target, context) in [(Target::Glsl430, Context::desktop()), (Target::Essl310, Context::es())] {
            let context = context.unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"));
            let options = EmitOptions::new().format(Format::Rgba32Float).targets([target]);
            let run = |emitted: &Emitted, inputs: &Inputs, k: usize| {
                let found = gl::run_output(&context, emitted, target, inputs, k);
                let found = found.unwrap_or_else(|e| panic!("{what} {target}: {e}"));
                let texels = found.texels().iter().map(Texel::texel);
                texels.collect::<Vec<_>>()
            };
            let upright = compiled.emit(&options).unwrap_or_else(|e| panic!("{what}: {e}"));
            let below = compiled.emit(&options.clone().origin(Origin::LowerLeft));
            let below = below.unwrap_or_else(|e| panic!("{what}: {e}"));
            let color = texels(SIZE, 5);
            let turned = color.texels().chunks(SIZE.x as usize).rev().flatten().copied();
            let turned = Inputs::new(SIZE).with_image("color", Frame::new(SIZE, turned.collect()));
            for (k, output) in upright.manifest.outputs.iter().enumerate() {
                let written = |texels: Vec<[f64; 4]>| Written {
                    name: output.name.clone(),
                    size: SIZE,
                    texels,
                };
                let native = &native[k..=k];
                same(what, native, &[written(run(&upright, &inputs(), k))]);
                same(what, native, &[written(over(&run(&below, &turned, k)))]);
            }
        }
    });
}

#[test]
fn compilers_read_every_language() {
    each_form(|what, compiled, _| {
        let targets = Target::MODERN.into_iter().chain([Target::Glsl430, Target::Essl310]);
        let emitted = compiled.emit(&EmitOptions::new().targets(targets));
        let emitted = emitted.unwrap_or_else(|e| panic!("{what}: {e}"));
        compilers::read(&emitted).unwrap_or_else(|e| panic!("{what}: {e}"));
    });
}

#[test]
fn graphs_are_read_as_they_are_printed() {
    use straightline_codegen::ir::{parse, print, verify};
    each_form(|what, compiled, _| {
        let printed = print(&compiled.graph);
        let read = parse(&printed).unwrap_or_else(|e| panic!("{what}: {e}\n{printed}"));
        verify::verify_graph(&read).unwrap_or_else(|e| panic!("{what}: {e}\n{printed}"));
        assert_eq!(print(&read), printed);
    });
}

#[test]
fn shaders_that_know_less_than_the_frame_are_refused() {
    let (name, text, _) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    for (options, what) in [
        (EmitOptions::new().stage(Stage::Fragment), "a fragment shader"),
        (EmitOptions::new().region(true), "a shader of a region"),
        (EmitOptions::new().form(Form::Function), "a function"),
    ] {
        let said = compiled.emit(&options).expect_err(what).to_string();
        assert!(
            said.contains(&format!(
                "`scattered` writes to `mirrored` at any place, which {what} cannot"
            )),
            "{said}"
        );
    }
}
