//! The shaders of `examples/gallery/`: as rustc compiles them, in every form by the interpreter, on a GPU, in every
//! language, and against their definitions in f64 (`gallery/`), which share no code with them. `STRAIGHTLINE_PICTURES=DIR`
//! writes what they make.

// As a graphics programmer's crate would hold them.
mod colour;
use crate::common;
mod filters;
mod fxaa;
mod histograms;
mod light;
mod motion;
mod patterns;
mod shader;
mod shaders;
mod smaa;
mod world;

use common::forms::{first, pixels, save};
use rayon::prelude::*;
use shader::{Shader, Within};
use std::path::{Path, PathBuf};
use straightline_bench::execute::Inputs;
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::Target;
use straightline_codegen::{Branches, EmitOptions, Form, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_study::baselines;
use straightline_tests::compilers;

const SIZE: UVec2 = uvec2(96, 64);

#[test]
fn mandelbrot() {
    let shader = Shader::new("mandelbrot", SIZE)
        .vector("centre", &[-0.6, 0.0])
        .number("scale", 2.4);
    let native = |at| shaders::mandelbrot::mandelbrot(SIZE, vec2(-0.6, 0.0), shader.float("scale"), at);
    // Orbits that stay long go anywhere.
    shader.check(Within(1.0e-2, 0.02), Within(1.0e-2, 0.02), native, patterns::mandelbrot);
}

#[test]
fn sphere_tracing() {
    let shader = Shader::new("sphere_tracing", SIZE).number("angle", 0.7);
    let native = |at| shaders::sphere_tracing::sphere_tracing(SIZE, shader.float("angle"), at);
    // Rays that graze the ball or end far away.
    shader.check(
        Within(1.0e-2, 0.02),
        Within(1.0e-2, 0.03),
        native,
        patterns::sphere_tracing,
    );
}

#[test]
fn parallax_occlusion() {
    let view = vec3(0.5, 0.35, 0.8).normalize();
    let shader = Shader::new("parallax_occlusion", SIZE)
        .vector("view", &view.to_array().map(f64::from))
        .number("depth", 0.1)
        .image("height", |uv| {
            Vec4::splat(0.5 + 0.25 * (uv.x * 25.0).sin() + 0.25 * (uv.y * 19.0).cos())
        })
        .image("albedo", |uv| vec4(uv.x, uv.y, 0.5, 1.0));
    let height: Texture<f32> = first(&shader.inputs, "height", Texture::new);
    let albedo = shader.texture("albedo");
    let native = |at| {
        let linear = Sampler::default();
        shaders::parallax_occlusion::parallax_occlusion(
            &height,
            &albedo,
            &linear,
            view,
            shader.float("depth"),
            SIZE,
            at,
        )
    };
    // A layer is a share of 0.03 of the relief's depth.
    shader.check(
        Within(5.0e-3, 0.03),
        Within(5.0e-3, 0.05),
        native,
        light::parallax_occlusion,
    );
}

#[test]
fn life() {
    let shader = Shader::new("life", SIZE);
    let native = |at| shaders::life::life(shader.frame("cells"), at);
    shader.check(Within(0.0, 0.0), Within(0.0, 0.0), native, patterns::life);
}

#[test]
fn scale2x() {
    // A picture of few colours, so that there are edges and corners.
    let shader = Shader::new("scale2x", SIZE).image("image", |uv| {
        let disc = (uv - vec2(0.4, 0.5)).length() < 0.3;
        let line = (uv.x * 2.0 - uv.y).abs() < 0.05;
        vec4(f32::from(u8::from(disc)), f32::from(u8::from(line)), 0.25, 1.0)
    });
    let image = shader.texture("image");
    let native = |at| shaders::scale2x::scale2x(&image, at);
    shader.check(Within(0.0, 0.0), Within(0.0, 0.0), native, filters::scale2x);
}

#[test]
fn ordered_dither() {
    let shader = Shader::new("ordered_dither", SIZE).number("levels", 4.0);
    let native = |at| shaders::ordered_dither::ordered_dither(shader.frame("color"), 4, at);
    shader.check(
        Within(1.0e-6, 0.0),
        Within(1.0e-6, 1.0e-3),
        native,
        patterns::ordered_dither,
    );
}

#[test]
fn oklab_grade() {
    let shader = Shader::new("oklab_grade", SIZE)
        .number("turn", 0.8)
        .number("chroma", 1.2)
        .number("lightness", 0.9);
    let [turn, chroma, lightness] = ["turn", "chroma", "lightness"].map(|n| shader.float(n));
    let native = |at| shaders::oklab_grade::oklab_grade(shader.frame("color"), turn, chroma, lightness, at);
    shader.check(Within(2.0e-4, 0.0), Within(2.0e-5, 0.0), native, colour::oklab_grade);
}

#[test]
fn aces() {
    let shader = Shader::new("aces", SIZE).number("exposure", 1.5);
    let native = |at| shaders::aces::aces(shader.frame("color"), shader.float("exposure"), at);
    shader.check(Within(1.0e-4, 0.0), Within(1.0e-5, 0.0), native, colour::aces);
}

#[test]
fn lanczos() {
    let shader = Shader::new("lanczos", uvec2(112, 80));
    let shader = Shader {
        inputs: Inputs {
            size: uvec2(160, 100),
            ..shader.inputs
        },
        ..shader
    };
    let image = shader.texture("image");
    let native = |at| shaders::lanczos::lanczos(&image, shader.inputs.size, at);
    shader.check(Within(1.0e-4, 0.0), Within(1.0e-4, 0.0), native, filters::lanczos);
}

#[test]
fn nlm() {
    let shader = Shader::new("nlm", uvec2(48, 32));
    let cfg = shaders::nlm::Nlm::default();
    let native = |at| shaders::nlm::nlm(&cfg, shader.frame("color"), at);
    shader.check(Within(1.0e-4, 0.0), Within(1.0e-5, 0.0), native, filters::nlm);
}

#[test]
fn canny() {
    let shader = Shader::new("canny", SIZE).number("low", 0.2).number("high", 0.6);
    let native = |at| shaders::canny::canny(shader.frame("color"), shader.float("low"), shader.float("high"), at);
    // On a straight edge two neighbours are as strong.
    shader.check(Within(1.0e-3, 0.01), Within(1.0e-3, 0.01), native, filters::canny);
}

#[test]
fn cas() {
    let shader = Shader::new("cas", SIZE).number("sharpness", 0.6);
    let native = |at| shaders::cas::cas(shader.frame("color"), shader.float("sharpness"), at);
    shader.check(Within(1.0e-4, 0.0), Within(1.0e-4, 0.0), native, filters::cas);
}

#[test]
fn rcas() {
    let shader = Shader::new("rcas", SIZE).number("stops", 0.25);
    let native = |at| shaders::rcas::rcas(shader.frame("color"), shader.float("stops"), at);
    shader.check(Within(1.0e-3, 0.0), Within(1.0e-3, 0.0), native, filters::rcas);
}

#[test]
fn easu() {
    let shader = Shader::new("easu", SIZE);
    let image = shader.texture("image");
    let native = |at| shaders::easu::easu(&image, SIZE, at);
    shader.check(Within(1.0e-3, 0.01), Within(1.0e-4, 0.01), native, filters::easu);
}

#[test]
fn dual_kawase() {
    let shader = Shader::new("dual_kawase", SIZE);
    let shader = Shader {
        inputs: Inputs {
            size: uvec2(24, 16),
            ..shader.inputs
        },
        ..shader
    };
    let image = shader.texture("image");
    let native = |at| shaders::dual_kawase::dual_kawase(&image, &Sampler::default(), shader.inputs.size, at);
    // A GPU weighs texels in steps of 1/256.
    shader.check(Within(5.0e-3, 0.0), Within(1.0e-5, 0.0), native, filters::dual_kawase);
}

#[test]
fn lens() {
    let shader = Shader::new("lens", SIZE).number("k1", -0.12).number("k2", 0.01);
    let image = shader.texture("image");
    let (k1, k2) = (shader.float("k1"), shader.float("k2"));
    let native = |at| shaders::lens::lens(&image, &Sampler::default(), k1, k2, SIZE, at);
    shader.check(Within(1.0e-2, 0.01), Within(1.0e-3, 0.0), native, filters::lens);
}

/// Several pixels a frame, to and fro.
fn moving(shader: Shader, name: &str, pixels: f32) -> Shader {
    shader.image(name, |uv| {
        let velocity = vec2((uv.y * 9.0).sin(), (uv.x * 7.0).cos()) * pixels;
        velocity.extend(0.0).extend(0.0)
    })
}

#[test]
fn motion_blur() {
    let shader = moving(moving(Shader::new("motion_blur", SIZE), "velocities", 6.0), "most", 9.0);
    let (velocities, most, depth) = (shader.pairs("velocities"), shader.pairs("most"), shader.flat("depth"));
    let native = |at| shaders::motion_blur::motion_blur(shader.frame("color"), &velocities, &most, &depth, at);
    // The pixel that a tap falls on depends on rounding.
    shader.check(Within(5.0e-3, 0.02), Within(5.0e-3, 0.01), native, motion::motion_blur);
}

#[test]
fn taa() {
    let shader = moving(Shader::new("taa", SIZE), "velocities", 3.0).number("share", 0.1);
    let (history, velocities) = (shader.texture("history"), shader.pairs("velocities"));
    let native = |at| {
        let color = shader.frame("color");
        shaders::taa::taa(
            color,
            &history,
            &velocities,
            &Sampler::default(),
            shader.float("share"),
            SIZE,
            at,
        )
    };
    shader.check(Within(1.0e-2, 0.0), Within(1.0e-3, 0.0), native, motion::taa);
}

#[test]
fn atrous() {
    let shader = Shader::new("atrous", SIZE).number("spacing", 2.0).number("sigma", 0.3);
    let (normal, depth) = (shader.normals("normal"), shader.flat("depth"));
    let native = |at| shaders::atrous::atrous(shader.frame("color"), &normal, &depth, 2, shader.float("sigma"), at);
    shader.check(Within(1.0e-3, 0.0), Within(1.0e-4, 0.0), native, filters::atrous);
}

#[test]
fn gtao() {
    let shader = Shader::new("gtao", SIZE).number("radius", 0.8).number("focal", 80.0);
    let (depth, normal) = (shader.flat("depth"), shader.normals("normal"));
    let (radius, focal) = (shader.float("radius"), shader.float("focal"));
    let native = |at| shaders::gtao::gtao(&depth, &normal, radius, focal, at);
    // The pixel that a step falls on depends on rounding.
    shader.check(Within(1.0e-2, 0.02), Within(2.0e-3, 0.02), native, light::gtao);
}

#[test]
fn environment_prefilter() {
    let shader = Shader::new("environment_prefilter", uvec2(48, 32)).number("roughness", 0.4);
    let (image, size) = (shader.texture("image"), shader.inputs.size);
    let native = |at| {
        let roughness = shader.float("roughness");
        shaders::environment_prefilter::environment_prefilter(&image, &Sampler::default(), roughness, size, at)
    };
    shader.check(
        Within(5.0e-3, 0.01),
        Within(1.0e-3, 0.01),
        native,
        light::environment_prefilter,
    );
}

#[test]
fn perlin() {
    let shader = Shader::new("perlin", SIZE)
        .number("scale", 17.0)
        .number("depth", 0.3)
        .number("octaves", 4.0);
    let native = |at| shaders::perlin::perlin(shader.float("scale"), shader.float("depth"), 4, at);
    shader.check(Within(1.0e-5, 0.0), Within(1.0e-5, 0.0), native, patterns::perlin);
}

#[test]
fn worley() {
    let shader = Shader::new("worley", SIZE).number("size", 11.0);
    let native = |at| shaders::worley::worley(shader.float("size"), at);
    shader.check(Within(1.0e-5, 0.0), Within(1.0e-5, 0.0), native, patterns::worley);
}

#[test]
fn pcss() {
    let shader = Shader::new("pcss", SIZE).number("light", 6.0).image("shadow", |uv| {
        Vec4::splat(if (uv - vec2(0.5, 0.4)).length() < 0.2 { 0.3 } else { 1.0 })
    });
    let shadow = first(&shader.inputs, "shadow", DepthTexture::new);
    let native = |at| shaders::pcss::pcss(&shadow, &ComparisonSampler::default(), shader.float("light"), SIZE, at);
    shader.check(Within(1.0e-2, 0.02), Within(1.0e-3, 0.01), native, patterns::pcss);
}

#[test]
fn bokeh() {
    let shader = Shader::new("bokeh", SIZE).number("focus", 3.0).number("strength", 4.0);
    let depth = shader.flat("depth");
    let native = |at| {
        shaders::bokeh::bokeh(
            shader.frame("color"),
            &depth,
            shader.float("focus"),
            shader.float("strength"),
            at,
        )
    };
    shader.check(Within(1.0e-3, 0.01), Within(1.0e-3, 0.01), native, motion::bokeh);
}

#[test]
fn screen_space_reflections() {
    let shader = Shader::new("screen_space_reflections", SIZE).number("focal", 80.0);
    let (depth, normal) = (shader.flat("depth"), shader.normals("normal"));
    let native = |at| {
        let color = shader.frame("color");
        shaders::screen_space_reflections::screen_space_reflections(color, &depth, &normal, shader.float("focal"), at)
    };
    // The pixel that a step falls on, and whether it hits there, depend on rounding.
    shader.check(
        Within(1.0e-2, 0.03),
        Within(1.0e-2, 0.02),
        native,
        light::screen_space_reflections,
    );
}

#[test]
fn fxaa() {
    let shader = Shader::new("fxaa", SIZE);
    let native = |at| shaders::fxaa::fxaa(shader.frame("color"), &Sampler::default(), at);
    shader.check(Within(5.0e-3, 0.02), Within(1.0e-4, 0.01), native, motion::fxaa);

    let reference = fxaa::reference(shader.frame("color"));
    let (mut off, mut worst, mut changed) = (0, 0.0f32, 0);
    for at in pixels(SIZE) {
        let shown = |frame: &Frame<Vec4>| frame.load(at).truncate();
        let error = (native(at).truncate() - shown(&reference)).abs().max_element();
        worst = worst.max(error);
        off += usize::from(error > 1.0e-3);
        changed += usize::from((shown(shader.frame("color")) - shown(&reference)).abs().max_element() > 1.0e-2);
    }
    println!("fxaa: {changed} pixels are changed, {off} of them not as the reference has them, by at most {worst:.2e}");
    assert!(changed > 1000, "{changed} pixels are changed");
    // Pixels at which the brightness at an edge's end equals the threshold but for its last bit: in half of them the
    // definition in f64 agrees with the reference, in the other half with the kernel.
    assert!(
        off <= 20 && worst <= 0.01,
        "{off} pixels are not the reference's, by at most {worst}"
    );
}

#[test]
fn normal_from_depth() {
    let focal = 80.0;
    let shader = Shader::new("normal_from_depth", SIZE).number("focal", focal);
    let shader = shader.image("depth", |uv| {
        let at = (uv * SIZE.as_vec2()).as_dvec2();
        Vec4::splat(light::two_planes(at.x, at.y, SIZE.as_dvec2(), focal) as f32)
    });
    let depth = shader.flat("depth");
    let native = |at| shaders::normal_from_depth::normal_from_depth(&depth, shader.float("focal"), at);
    shader.check(
        Within(1.0e-3, 0.0),
        Within(1.0e-3, 0.0),
        native,
        light::normal_from_depth,
    );
}

/// Values as a texture of 8 bits stores them.
fn in_levels(texels: impl Iterator<Item = Vec4>, size: UVec2) -> Frame<Vec4> {
    let level = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() / 255.0;
    Frame::new(size, texels.map(|t| t.map(level)).collect())
}

/// Each pass by itself in every form, and all three one after the other against the reference implementation on the same driver.
#[test]
fn smaa() {
    let size = uvec2(192, 128);
    let mut edges = Shader::new("smaa_edges", size);
    let color = in_levels(edges.frame("color").texels().iter().copied(), size);
    edges.inputs = Inputs::new(size).with_image("color", color.clone());
    let native = |at| shaders::smaa_edges::smaa_edges(&color, at);
    edges.example.check(&edges.inputs, 0.0, 0.0, native);
    let found = in_levels(pixels(size).map(native), size);

    let mut weights = Shader::new("smaa_weights", size);
    let linear = Sampler::default();
    weights.inputs = Inputs::new(size).with_image("edges", found.clone());
    for name in ["area", "search"] {
        weights.inputs = weights.inputs.with_image(name, smaa::table(&format!("smaa_{name}")));
    }
    let (area, search) = (weights.texture("area"), weights.texture("search"));
    let native = |at| shaders::smaa_weights::smaa_weights(&found, &area, &search, &linear, at);
    let weighed = weights.example.check(&weights.inputs, 5.0e-3, 0.01, native);

    let mut blend = Shader::new("smaa_blend", size);
    blend.inputs = Inputs::new(size)
        .with_image("color", color.clone())
        .with_image("weights", weighed.clone());
    let native = |at| shaders::smaa_blend::smaa_blend(&color, &weighed, &linear, at);
    blend.example.check(&blend.inputs, 5.0e-3, 0.0, native);

    let bench = common::bench();
    let mut reference =
        baselines::Smaa::new(&bench, size, baselines::Transfer::Linear).unwrap_or_else(|e| panic!("{e}"));
    let reference = reference.run(&color).unwrap_or_else(|e| panic!("{e}"));
    let mut chain = smaa::Chain::new(&bench, &color);
    for (unroll, branches) in [(Unroll::None, Branches::AsLoops), (Unroll::Full, Branches::AsLoops)] {
        let shown = chain.run(unroll, branches);
        let far = |(a, b): (&Vec4, &Vec4)| (*a - *b).truncate().abs().max_element() * 255.0;
        let errors = shown.texels().iter().zip(reference.texels()).map(far);
        let changed = shown
            .texels()
            .iter()
            .zip(color.texels())
            .map(far)
            .filter(|e| *e > 2.0)
            .count();
        let worst = errors.fold(0.0, f32::max);
        println!("smaa, unroll {unroll}: {changed} pixels are changed; off by at most {worst:.3} of 255");
        assert!(changed > 1000, "{changed} pixels are changed");
        assert!(worst <= 0.5, "off by {worst} of 255");
        save("smaa_blend", &blend.inputs, &shown);
    }
}

/// Every shader in every supported language, as both stages' entry points and as a function, looped and unrolled.
#[test]
fn every_language_and_form() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/gallery");
    let files = std::fs::read_dir(&folder)
        .expect("the gallery")
        .map(|entry| entry.expect("a file").path());
    let shaders: Vec<PathBuf> = files
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect();
    assert!(shaders.len() >= 25, "{} shaders", shaders.len());
    let forms = [
        (Unroll::Full, Stage::Compute, Form::Entry),
        (Unroll::None, Stage::Compute, Form::Entry),
        (Unroll::Full, Stage::Fragment, Form::Entry),
        (Unroll::None, Stage::Fragment, Form::Entry),
        (Unroll::None, Stage::Fragment, Form::Function),
    ];
    let each = shaders
        .par_iter()
        .flat_map(|path| forms.par_iter().map(move |form| (path, *form)));
    let texts = each.map(|(path, form)| texts(path, form)).sum::<usize>();
    println!("{} shaders in {texts} texts", shaders.len());
    assert!(texts >= shaders.len() * 30, "{texts} texts");
}

/// Number of texts of a shader that its languages' compilers have read.
fn texts(path: &Path, (unroll, stage, form): (Unroll, Stage, Form)) -> usize {
    let name = path.display();
    let settings = Settings::new().unroll(unroll);
    let kernel = Kernel::from_file(path, None).unwrap_or_else(|e| panic!("{e}"));
    let compiled = kernel.compile(&settings).unwrap_or_else(|e| panic!("{e}"));
    let emit = |target: &Target| {
        let options = EmitOptions::new().stage(stage).form(form).targets([*target]);
        let emitted = match compiled.emit(&options) {
            // A kernel without values that only writes is no fragment shader and no function.
            Err(errors)
                if matches!(
                    errors.first_code(),
                    Some(Code::NotInTarget | Code::StageUnfit | Code::FunctionForm)
                ) =>
            {
                return 0;
            }
            emitted => emitted.unwrap_or_else(|e| panic!("{name} in {target}: {e}")),
        };
        // A function is no whole text; naga and the compilers read it where it is called, in the tests of bindings.
        if form == Form::Entry {
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{name} in {target}, unroll {unroll}: {e}"));
        }
        emitted.files.len()
    };
    // A language that is written as a whole shader has no function.
    let whole = |target: &&Target| matches!(target, Target::Spirv | Target::Msl);
    let targets = Target::ALL
        .iter()
        .filter(|target| form == Form::Entry || !whole(target));
    targets.map(emit).sum()
}
