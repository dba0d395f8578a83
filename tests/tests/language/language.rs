//! Every example of `docs/kernel-language.md`: as rustc compiles it, unrolled, kept and unrolled in part, and on a GPU.

use crate::common;

use common::{Texel, bench, other_compilers, same_texels};
use std::path::PathBuf;
use straightline_bench::execute::{self, SamplerState, interpret_kernel};
use straightline_codegen::ir::F16;
use straightline_codegen::{Branches, Compiled, EmitOptions, Kernel, Precision, Settings, Stage, Unroll, emit::Target};
use straightline_kernels::prelude::*;
use straightline_tests::sraa::Random;

/// Inputs of the examples, by name.
pub struct World {
    pub color: Frame<Vec4>,
    pub layers: FrameLayers<f32>,
    pub image: Texture<Vec4>,
    pub samples: Multisampled<Vec4>,
    pub shadow: DepthTexture,
    pub mips: Texture<Vec4>,
    pub volume: Texture3D<Vec4>,
    pub environment: TextureCube<Vec4>,
    pub stack: TextureArray<Vec4>,
    pub cascades: DepthTextureArray,
    pub around: DepthCube,
    pub ids: Frame<u32>,
    pub tiles: Texture<IVec2>,
    pub linear: Sampler,
    pub less: ComparisonSampler,
    pub weights: Buffer<f32>,
    /// Numbers of which a page's lights are made.
    pub lights: Vec<Vec4>,
    pub grade: Mat3,
    pub strength: f32,
    pub tint: Vec4,
    pub palette: [Vec3; 4],
    pub taps: i32,
    pub resolution: UVec2,
}

pub struct Example {
    pub name: &'static str,
    pub source: &'static str,
    /// Values of a pixel, a texel for each target.
    pub native: fn(&World, IVec2) -> Vec<[f64; 4]>,
}

include!(concat!(env!("OUT_DIR"), "/examples.rs"));

const SIZE: UVec2 = uvec2(13, 9);

/// The texels of a texture of so many texels and of its three smaller levels.
fn levels(size: UVec3, image: &mut impl FnMut(UVec2) -> Vec<Vec4>) -> Vec<Vec<Vec4>> {
    let half = |side: u32, level: u32| (side >> level).max(1);
    let mut of_level = |k| image(uvec2(half(size.x, k), half(size.y, k) * half(size.z, k)));
    let last = size.max_element().ilog2();
    (0..=last).map(&mut of_level).collect()
}

/// The number of an object, with bits that no float holds.
fn id(texel: Vec4) -> u32 {
    let object = (texel.x * 3.0) as u32;
    object << 24 | 0x00a5_c3f0 | object
}

/// Textures as the layers of each level.
fn stacked(layers: &[&Texture<Vec4>]) -> Vec<Vec<Frame<Vec4>>> {
    let level = |k| {
        let of = |t: &&Texture<Vec4>| Frame::new(t.size_of_level(k), t.texels_of_level(k).to_vec());
        layers.iter().map(of).collect()
    };
    (0..layers[0].levels()).map(level).collect()
}

/// A volume as the slices of each level.
fn slices(volume: &Texture3D<Vec4>) -> Vec<Vec<Frame<Vec4>>> {
    let level = |k: usize| {
        let size = volume.size();
        let size = uvec2((size.x >> k).max(1), (size.y >> k).max(1));
        let texels = volume.texels_of_level(k).chunks((size.x * size.y) as usize);
        texels.map(|slice| Frame::new(size, slice.to_vec())).collect()
    };
    (0..volume.levels()).map(level).collect()
}

impl World {
    fn new() -> World {
        let mut random = Random(7);
        // Multiples of 1/64 are kept by half precision, which multisampled textures have.
        let mut lane = || (random.unit() * 64.0).floor() / 64.0;
        let mut image = |size: UVec2| -> Vec<Vec4> {
            (0..size.x * size.y)
                .map(|_| vec4(lane(), lane(), lane(), lane()))
                .collect()
        };
        let small = uvec2(5, 4);
        let depths = |texels: Vec<Vec4>| texels.iter().map(|t| t.x).collect::<Vec<f32>>();
        World {
            color: Frame::new(SIZE, image(SIZE)),
            layers: FrameLayers::new((0..2).map(|_| Frame::new(SIZE, depths(image(SIZE)))).collect()),
            image: Texture::new(small, image(small)),
            samples: Multisampled::new((0..4).map(|_| Texture::new(SIZE, image(SIZE))).collect()),
            shadow: DepthTexture::new(small, depths(image(small))),
            mips: Texture::with_levels(uvec2(8, 5), levels(uvec3(8, 5, 1), &mut image)),
            volume: Texture3D::with_levels(uvec3(4, 4, 3), levels(uvec3(4, 4, 3), &mut image)),
            environment: TextureCube::new(std::array::from_fn(|_| {
                Texture::with_levels(uvec2(4, 4), levels(uvec3(4, 4, 1), &mut image))
            })),
            stack: TextureArray::new(
                (0..3)
                    .map(|_| Texture::with_levels(uvec2(6, 4), levels(uvec3(6, 4, 1), &mut image)))
                    .collect(),
            ),
            cascades: DepthTextureArray::new((0..2).map(|_| DepthTexture::new(small, depths(image(small)))).collect()),
            around: DepthCube::new(std::array::from_fn(|_| {
                DepthTexture::new(uvec2(3, 3), depths(image(uvec2(3, 3))))
            })),
            ids: Frame::new(SIZE, image(SIZE).iter().map(|t| id(*t)).collect()),
            tiles: Texture::new(
                small,
                image(small).iter().map(|t| (t.xy() * 8.0).as_ivec2() - 4).collect(),
            ),
            linear: Sampler::default(),
            less: ComparisonSampler::default(),
            lights: image(uvec2(3, 1))
                .iter()
                .map(|t| *t * vec4(1.0, 1.0, 1.0, 3.0))
                .collect(),
            weights: Buffer::new(vec![0.25, 0.5, 0.25]),
            grade: Mat3::from_cols(vec3(0.9, 0.1, 0.0), vec3(0.0, 0.8, 0.1), vec3(0.2, 0.0, 0.7)),
            strength: 1.5,
            tint: vec4(0.5, 0.6, 0.7, 1.0),
            palette: [0.125, 0.25, 0.5, 0.75].map(|x| vec3(x, 1.0 - x, x * 0.5)),
            taps: 5,
            resolution: SIZE,
        }
    }

    /// A page's light of such numbers, all that is in it one after the other.
    fn light(&self, l: Vec4) -> Vec<[f64; 4]> {
        let one = |x: f32| [f64::from(x), 0.0, 0.0, 0.0];
        let three = |v: Vec3| v.extend(0.0).to_array().map(f64::from);
        let falloff = [8.0 + l.x, l.y, l.z, 0.5].map(one);
        let columns = [self.grade.x_axis, self.grade.y_axis, self.grade.z_axis].map(three);
        let tints = [three(l.yxz()), three(l.zzy())];
        let first = [three(l.xyz()), one(l.w.floor())];
        let two = |v: Vec2| v.extend(0.0).extend(0.0).to_array().map(f64::from);
        let spots = [two(l.xy()), one(l.z), two(l.zy()), one(l.x)];
        [&first[..], &falloff[..], &columns[..], &tints[..], &spots[..]].concat()
    }

    fn inputs(&self) -> execute::Inputs {
        let grey = |texels: &[f32]| texels.iter().map(|d| vec4(*d, 0.0, 0.0, 0.0)).collect();
        let layer = |l: &Frame<f32>| Frame::new(SIZE, grey(l.texels()));
        let depth = |d: &DepthTexture| Frame::new(d.size(), grey(d.texels()));
        let bits = |v: &IVec2| uvec4(v.x as u32, v.y as u32, 0, 0);
        let sample = |s: &Texture<Vec4>| Frame::new(s.size(), s.texels().to_vec());
        let column = |v: Vec3| v.to_array().map(f64::from);
        let mut inputs = execute::Inputs::new(SIZE);
        for (k, colour) in self.palette.iter().enumerate() {
            inputs = inputs.with_uniform(&format!("palette_{k}"), &column(*colour));
        }
        inputs
            .with_image("color", self.color.clone())
            .with_layers("layers", self.layers.layers().iter().map(layer).collect())
            .with_image("image", sample(&self.image))
            .with_layers("samples", self.samples.samples().iter().map(sample).collect())
            .with_image("shadow", depth(&self.shadow))
            .with_levels("mips", stacked(&[&self.mips]))
            .with_levels("volume", slices(&self.volume))
            .with_levels("environment", stacked(&self.environment.faces().each_ref()))
            .with_levels("stack", stacked(&[0, 1, 2].map(|k| self.stack.layer(k))))
            .with_layers("cascades", (0..2).map(|k| depth(self.cascades.layer(k))).collect())
            .with_layers("around", self.around.faces().iter().map(depth).collect())
            .with_integers(
                "ids",
                vec![Frame::new(
                    SIZE,
                    self.ids.texels().iter().map(|id| uvec4(*id, 0, 0, 0)).collect(),
                )],
            )
            .with_integers(
                "tiles",
                vec![Frame::new(
                    self.tiles.size(),
                    self.tiles.texels().iter().map(bits).collect(),
                )],
            )
            .with_sampler("linear", SamplerState::default())
            .with_sampler("less", SamplerState::default())
            .with_buffer(
                "weights",
                self.weights
                    .elements()
                    .iter()
                    .map(|w| [f64::from(*w), 0.0, 0.0, 0.0])
                    .collect(),
            )
            .with_buffer("lights", self.lights.iter().flat_map(|l| self.light(*l)).collect())
            .with_uniform("grade_x_axis", &column(self.grade.x_axis))
            .with_uniform("grade_y_axis", &column(self.grade.y_axis))
            .with_uniform("grade_z_axis", &column(self.grade.z_axis))
            .with_uniform("strength", &[f64::from(self.strength)])
            .with_uniform("tint", &self.tint.to_array().map(f64::from))
            .with_uniform("taps", &[f64::from(self.taps)])
    }
}

fn compile(example: &Example, settings: &Settings) -> Compiled {
    let text = format!("use straightline_kernels::prelude::*;\n{}", example.source);
    Kernel::from_text("kernel-language.md", &text, example.name)
        .compile(settings)
        .unwrap_or_else(|e| panic!("{}:\n{e}", example.name))
}

#[test]
fn every_example_means_the_same_in_every_form() {
    let world = World::new();
    let inputs = world.inputs();
    assert!(EXAMPLES.len() >= 30, "{} examples", EXAMPLES.len());
    for example in EXAMPLES {
        let pixels = (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)));
        let native: Vec<Vec<[f64; 4]>> = pixels.map(|at| (example.native)(&world, at)).collect();
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2), Unroll::Partial(3)] {
            for branches in [Branches::AsLoops, Branches::Keep, Branches::Select] {
                let settings = Settings::new().unroll(unroll).branches(branches);
                let compiled = compile(example, &settings);
                let result = interpret_kernel::<f32>(&compiled, &inputs, false)
                    .unwrap_or_else(|e| panic!("{}: {e}", example.name));
                for (k, target) in result.targets.iter().enumerate() {
                    let native: Vec<[f64; 4]> = native.iter().map(|texels| texels[k]).collect();
                    same_texels(&native, &target.texels).unwrap_or_else(|e| {
                        panic!(
                            "{} with {unroll}, branches {branches}, {}: {e}",
                            example.name, target.name
                        )
                    });
                }
            }
        }
    }
}

#[test]
fn every_example_is_emitted_in_every_language() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("language");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let (mut glsl, mut spirv) = (Vec::new(), Vec::new());
    for example in EXAMPLES {
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compile(example, &settings);
            for stage in [Stage::Compute, Stage::Fragment] {
                if stage == Stage::Fragment
                    && example.source.contains("resolution")
                    && !example.source.contains("Frame")
                {
                    // Nothing of the output's size is bound that could tell it.
                    continue;
                }
                let options = EmitOptions::new().stage(stage).targets(Target::MODERN);
                let emitted = compiled.emit(&options);
                let emitted = emitted.unwrap_or_else(|e| panic!("{} {unroll} {}: {e}", example.name, stage.name()));
                for (name, contents) in emitted.named_files(&format!("{}-{unroll}", example.name)) {
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
    }
    assert!(glsl.len() > 100 && spirv.len() > 100);
    other_compilers(&glsl, &spirv);
}

#[test]
fn every_example_is_the_same_picture_on_a_gpu() {
    let bench = bench();
    let world = World::new();
    let inputs = world.inputs();
    for example in EXAMPLES {
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compile(example, &settings);
            let expected = interpret_kernel::<f32>(&compiled, &inputs, false).expect("ran before");
            let found = bench
                .run_targets(&compiled, Stage::Compute, &inputs)
                .unwrap_or_else(|e| panic!("{} {unroll}: {e}", example.name));
            assert_eq!(found.len(), expected.targets.len(), "{}", example.name);
            // A GPU weighs filtered texels in steps of 1/256.
            let bound = if example.source.contains("Sampler") {
                1.0 / 128.0
            } else {
                1.0e-4
            };
            for (found, expected) in found.iter().zip(&expected.targets) {
                assert_eq!(found.name, expected.name);
                for (k, (a, b)) in found.texels.iter().zip(&expected.texels).enumerate() {
                    let off = (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max);
                    let (name, target) = (example.name, &found.name);
                    assert!(off <= bound, "{name} {unroll}, {target}, pixel {k}: {a:?} and {b:?}");
                }
            }
        }
    }
}

#[test]
fn every_example_works_in_half_precision() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("language-half");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let bench = bench().with_precision(Precision::F16);
    let inputs = World::new().inputs();
    let mut spirv = Vec::new();
    for example in EXAMPLES {
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compile(example, &settings);
            let targets = Target::MODERN.into_iter().filter(|t| *t != Target::Glsl450);
            let emitted = compiled.emit(&EmitOptions::new().precision(Precision::F16).targets(targets));
            let emitted = emitted.unwrap_or_else(|e| panic!("{} {unroll}: {e}", example.name));
            let path = folder.join(format!("{}-{unroll}.spv", example.name));
            std::fs::write(&path, &emitted.files[&Target::Spirv]).expect("a shader is written");
            spirv.push(path);
            let expected = interpret_kernel::<F16>(&compiled, &inputs, false).expect("ran before");
            let found = bench
                .run_targets(&compiled, Stage::Compute, &inputs)
                .unwrap_or_else(|e| panic!("{} {unroll}: {e}", example.name));
            for (found, expected) in found.iter().zip(&expected.targets) {
                for (k, (a, b)) in found.texels.iter().zip(&expected.texels).enumerate() {
                    // A GPU weighs filtered texels in steps of 1/256, and may truncate what comes in.
                    let off = (0..4)
                        .map(|c| (a[c] - b[c]).abs() / b[c].abs().max(1.0))
                        .fold(0.0, f64::max);
                    let (name, target) = (example.name, &found.name);
                    assert!(
                        off <= 1.0 / 64.0,
                        "{name} {unroll}, {target}, pixel {k}: {a:?} and {b:?}"
                    );
                }
            }
        }
    }
    assert!(spirv.len() > 60);
    other_compilers(&[], &spirv);
}

const BEGIN: &str = "<!-- features -->\n";
const END: &str = "<!-- end of features -->";

/// Each construct of `features/` computes the values of rustc's code, in every form, or is refused with a message. The page
/// has the table.
#[test]
fn the_page_says_which_constructs_are_taken() {
    let world = World::new();
    let inputs = world.inputs();
    let mut table = String::from("| construct | standing |\n| --- | --- |\n");
    let mut taken = 0;
    for (title, example) in FEATURES {
        let text = format!("use straightline_kernels::prelude::*;\n{}", example.source);
        let kernel = Kernel::from_text("feature.rs", &text, example.name);
        if let Err(errors) = kernel.compile(&Settings::default()) {
            let why = &errors.diagnostics[0].message;
            table += &format!("| {title} | refused: {why} |\n");
            continue;
        }
        taken += 1;
        table += &format!("| {title} | taken |\n");
        let pixels = (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)));
        let native: Vec<[f64; 4]> = pixels.map(|at| (example.native)(&world, at)[0]).collect();
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compile(example, &settings);
            let found = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{title}: {e}"));
            same_texels(&native, &found.targets[0].texels).unwrap_or_else(|e| panic!("{title} with {unroll}: {e}"));
        }
    }
    assert!(taken >= 60, "{taken} constructs are taken");
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/kernel-language.md");
    let page = std::fs::read_to_string(&path).expect("the page");
    let (before, rest) = page.split_once(BEGIN).expect("where the table begins");
    let (old, behind) = rest.split_once(END).expect("where it ends");
    let now = format!("\n{table}\n");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&path, format!("{before}{BEGIN}{now}{END}{behind}")).expect("the page is written");
    } else {
        assert_eq!(old, now, "STRAIGHTLINE_BLESS=1 writes the table anew");
    }
}
