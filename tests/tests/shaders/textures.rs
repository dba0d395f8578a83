//! Textures of every kind through every sampler: as rustc compiles their reads, as the interpreter runs them, on a GPU, and
//! with rows from below.

use crate::common;

use common::{bench, same_bits};
use straightline_bench::execute::{Inputs, SamplerState, interpret_kernel};
use straightline_codegen::{Compiled, Kernel, Origin, Settings, Stage};
use straightline_kernels::prelude::*;
use straightline_tests::sraa::Random;

/// Kernels for rustc, and their text for the generator.
macro_rules! kernels {
    ($($text:tt)*) => {
        $($text)*
        const TEXT: &str = stringify!($($text)*);
    };
}

kernels! {
    /// All directions, more of them at edges and corners.
    pub fn around(cube: &TextureCube<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        cube.sample(linear, direction(pixel, resolution))
    }

    pub fn around_level(cube: &TextureCube<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        cube.sample_level(linear, direction(pixel, resolution), pixel.x as f32 * 0.0625 - 0.46875)
    }

    pub fn lamp(depths: &DepthCube, less: &ComparisonSampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        Vec4::splat(depths.compare(less, direction(pixel, resolution), 0.4))
    }

    fn direction(pixel: IVec2, resolution: UVec2) -> Vec3 {
        let u = (pixel.x as f32 + 0.5) / resolution.x as f32 * 2.5 - 1.25;
        let v = ((pixel.y / 6) as f32 + 0.5) / (resolution.y / 6) as f32 * 2.5 - 1.25;
        match pixel.y % 6 {
            0 => vec3(1.0, u, v),
            1 => vec3(-1.0, v, u),
            2 => vec3(u, 1.0, v),
            3 => vec3(v, -1.0, u),
            4 => vec3(u, v, 1.0),
            _ => vec3(v, u, -1.0),
        }
    }

    pub fn mipped(mips: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2() * 1.5 - 0.25;
        mips.sample_level(linear, uv, pixel.x as f32 * 0.0625 - 0.46875)
    }

    /// Steps of which every measure is the same: along one axis, by powers of two.
    pub fn stepped(mips: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
        let texels = if pixel.x % 2 == 0 { 1.0 } else { 4.0 };
        mips.sample_grad(linear, uv, vec2(texels / 16.0, 0.0), vec2(0.0, 0.5 / 12.0))
    }

    pub fn texels(mips: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
        let level = (pixel.x / 3) as usize;
        mips.load_level(pixel - 2, level) + mips.size_of_level(level).as_vec2().xyxy()
    }

    pub fn cloud(volume: &Texture3D<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2() * 1.5 - 0.25;
        volume.sample(linear, uv.extend(uv.x * 2.0 - 0.5)) + volume.sample_level(linear, uv.extend(0.4), uv.y)
            + volume.load(ivec3(pixel.x - 2, pixel.y - 2, pixel.x / 4 - 1)) + volume.size().as_vec3().extend(0.0)
    }

    pub fn piled(stack: &TextureArray<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
        let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2() * 1.5 - 0.25;
        let layer = (pixel.x / 5) as usize;
        stack.sample(linear, uv, layer) + stack.sample_level(linear, uv, layer + 1, uv.y * 2.0)
            + stack.load(pixel - 3, layer) + stack.layers() as f32
    }

    /// Every bit of an integer, in numbers that floats hold.
    pub fn whole(ids: &Texture<UVec2>, signed: &TextureArray<i32>, blocks: &Texture3D<u32>, pixel: IVec2) -> Vec4 {
        let id = ids.load(pixel - 1);
        let deep = blocks.load(pixel.extend(pixel.x - pixel.y)) ^ 0x0f0f_0f0f;
        let own = signed.load(pixel, (pixel.x / 2) as usize);
        vec4((id.x & 0xffff) as f32, (id.y >> 16) as f32, (deep >> 8 & 0xffff) as f32, (own >> 12) as f32)
    }
}

const SIZE: UVec2 = uvec2(41, 48);

struct World {
    cube: TextureCube<Vec4>,
    depths: DepthCube,
    mips: Texture<Vec4>,
    volume: Texture3D<Vec4>,
    stack: TextureArray<Vec4>,
    ids: Texture<UVec2>,
    signed: TextureArray<i32>,
    blocks: Texture3D<u32>,
    sampler: Sampler,
    less: ComparisonSampler,
}

type Native = fn(&World, IVec2) -> Vec4;

const KERNELS: [(&str, Native); 9] = [
    ("around", |w, at| around(&w.cube, &w.sampler, SIZE, at)),
    ("around_level", |w, at| around_level(&w.cube, &w.sampler, SIZE, at)),
    ("lamp", |w, at| lamp(&w.depths, &w.less, SIZE, at)),
    ("mipped", |w, at| mipped(&w.mips, &w.sampler, SIZE, at)),
    ("stepped", |w, at| stepped(&w.mips, &w.sampler, SIZE, at)),
    ("texels", |w, at| texels(&w.mips, at)),
    ("cloud", |w, at| cloud(&w.volume, &w.sampler, SIZE, at)),
    ("piled", |w, at| piled(&w.stack, &w.sampler, SIZE, at)),
    ("whole", |w, at| whole(&w.ids, &w.signed, &w.blocks, at)),
];

fn image(random: &mut Random, count: u32) -> Vec<Vec4> {
    let mut lane = || (random.unit() * 64.0).floor() / 64.0;
    (0..count).map(|_| vec4(lane(), lane(), lane(), lane())).collect()
}

/// An image with all its smaller levels.
fn mipmap(random: &mut Random, size: UVec2) -> Texture<Vec4> {
    let sides = |k: u32| (size.x >> k).max(1) * (size.y >> k).max(1);
    let levels = (0..=size.max_element().ilog2()).map(|k| image(random, sides(k)));
    Texture::with_levels(size, levels.collect())
}

/// Bits of every kind.
fn bits(random: &mut Random) -> u32 {
    let low = (random.unit() * 65536.0) as u32;
    low ^ ((random.unit() * 65536.0) as u32) << 16
}

impl World {
    fn new(side: u32, sampler: Sampler) -> World {
        let mut random = Random(11);
        let r = &mut random;
        let depths = |r: &mut Random| image(r, side * side).iter().map(|t| t.x).collect();
        World {
            cube: TextureCube::new(std::array::from_fn(|_| mipmap(r, UVec2::splat(side)))),
            depths: DepthCube::new(std::array::from_fn(|_| {
                DepthTexture::new(UVec2::splat(side), depths(r))
            })),
            mips: mipmap(r, uvec2(16, 12)),
            volume: Texture3D::with_levels(uvec3(5, 4, 3), vec![image(r, 60), image(r, 4), image(r, 1)]),
            stack: TextureArray::new((0..3).map(|_| mipmap(r, uvec2(6, 5))).collect()),
            ids: Texture::new(uvec2(7, 5), (0..35).map(|_| uvec2(bits(r), bits(r))).collect()),
            signed: TextureArray::new(
                (0..4)
                    .map(|_| Texture::new(uvec2(3, 2), (0..6).map(|_| bits(r) as i32).collect()))
                    .collect(),
            ),
            blocks: Texture3D::new(uvec3(3, 4, 5), (0..60).map(|_| bits(r)).collect()),
            sampler,
            less: ComparisonSampler {
                filter: sampler.filter,
                comparison: Comparison::Less,
            },
        }
    }

    fn inputs(&self) -> Inputs {
        let linear = |filter| filter == Filter::Linear;
        let state = SamplerState {
            linear: linear(self.sampler.filter),
            linear_mip: linear(self.sampler.mip),
            address: self.sampler.address,
            comparison: Comparison::Less,
        };
        let level = |t: &Texture<Vec4>, k| Frame::new(t.size_of_level(k), t.texels_of_level(k).to_vec());
        let levels = |layers: &[&Texture<Vec4>]| -> Vec<Vec<Frame<Vec4>>> {
            let of = |k| layers.iter().map(|t| level(t, k)).collect();
            (0..layers[0].levels()).map(of).collect()
        };
        let slices = |k: usize| -> Vec<Frame<Vec4>> {
            let size = uvec2((5 >> k).max(1), (4 >> k).max(1));
            let texels = self.volume.texels_of_level(k).chunks((size.x * size.y) as usize);
            texels.map(|slice| Frame::new(size, slice.to_vec())).collect()
        };
        let depth = |d: &DepthTexture| Frame::new(d.size(), d.texels().iter().map(|d| Vec4::splat(*d)).collect());
        let one = |bits: u32| uvec4(bits, 0, 0, 0);
        let signed = |k| {
            let texels = self.signed.layer(k).texels().iter();
            Frame::new(self.signed.size(), texels.map(|v| one(*v as u32)).collect())
        };
        let block = |slice: &[u32]| Frame::new(uvec2(3, 4), slice.iter().map(|v| one(*v)).collect());
        let pair = |v: &UVec2| uvec4(v.x, v.y, 0, 0);
        Inputs::new(SIZE)
            .with_levels("cube", levels(&self.cube.faces().each_ref()))
            .with_layers("depths", self.depths.faces().iter().map(depth).collect())
            .with_levels("mips", levels(&[&self.mips]))
            .with_levels("volume", (0..3).map(slices).collect())
            .with_levels("stack", levels(&[0, 1, 2].map(|k| self.stack.layer(k))))
            .with_integers(
                "ids",
                vec![Frame::new(
                    self.ids.size(),
                    self.ids.texels().iter().map(pair).collect(),
                )],
            )
            .with_integers("signed", (0..4).map(signed).collect())
            .with_integers("blocks", self.blocks.texels_of_level(0).chunks(12).map(block).collect())
            .with_sampler("linear", state)
            .with_sampler("less", state)
    }
}

fn worlds() -> Vec<World> {
    let mut all = Vec::new();
    for filter in [Filter::Linear, Filter::Nearest] {
        for (side, address) in [(4, Address::Clamp), (1, Address::Repeat), (3, Address::Mirror)] {
            for mip in [Filter::Linear, Filter::Nearest] {
                all.push(World::new(side, Sampler { filter, address, mip }));
            }
        }
    }
    all
}

fn compile(name: &str) -> Compiled {
    let text = format!("use straightline_kernels::prelude::*;\n{TEXT}");
    let kernel = Kernel::from_text("textures.rs", &text, name);
    kernel
        .compile(&Settings::default())
        .unwrap_or_else(|e| panic!("{name}:\n{e}"))
}

fn pixels() -> impl Iterator<Item = IVec2> {
    (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)))
}

#[test]
fn every_read_is_what_rustc_makes_of_it() {
    for (name, native) in KERNELS {
        let compiled = compile(name);
        for world in worlds() {
            let expected: Vec<[f32; 4]> = pixels().map(|at| native(&world, at).to_array()).collect();
            let found = interpret_kernel::<f32>(&compiled, &world.inputs(), false);
            let found = found.unwrap_or_else(|e| panic!("{name}: {e}"));
            same_bits(&expected, &found.texels).unwrap_or_else(|e| panic!("{name}, {:?}: {e}", world.sampler));
        }
    }
}

#[test]
fn every_read_is_the_same_on_a_gpu() {
    let bench = bench();
    for (name, _) in KERNELS {
        let compiled = compile(name);
        for world in worlds() {
            let inputs = world.inputs();
            let expected = interpret_kernel::<f32>(&compiled, &inputs, false).expect("ran before");
            for stage in [Stage::Compute, Stage::Fragment] {
                if stage == Stage::Fragment && name != "texels" && name != "whole" {
                    // Nothing of the output's size is bound that could tell it.
                    continue;
                }
                let found = bench.run(&compiled, stage, &inputs);
                let found = found.unwrap_or_else(|e| panic!("{name}: {e}"));
                // A GPU weighs texels and levels in steps of 1/256. Where it takes the nearest, a place between two may go to
                // either: at most a few pixels' are.
                let uploaded = 3.0 / 128.0;
                let pairs = found.texels().iter().zip(&expected.texels);
                let off = pairs.filter(|(a, b)| (**a - Vec4::from_array(**b)).abs().max_element() > uploaded);
                let exact = world.sampler.filter == Filter::Linear && world.sampler.mip == Filter::Linear;
                let allowed = if exact || name == "whole" || name == "texels" {
                    0
                } else {
                    20
                };
                assert!(
                    off.clone().count() <= allowed,
                    "{name}, {:?}: {} pixels differ, {:?}",
                    world.sampler,
                    off.clone().count(),
                    off.take(3).collect::<Vec<_>>()
                );
            }
        }
    }
}

/// A picture whose row 0 is the last.
fn turned<T: Copy>(frame: &Frame<T>) -> Frame<T> {
    let (size, texels) = (frame.size(), frame.texels());
    let rows = texels.chunks(size.x as usize).rev();
    Frame::new(size, rows.flatten().copied().collect())
}

/// Pictures are turned over; volumes and cubes are what they are.
#[test]
fn rows_from_below_are_turned() {
    let bench = bench();
    let world = World::new(4, Sampler::default());
    let inputs = world.inputs();
    let mut over = inputs.clone();
    let pictures = ["mips", "stack", "ids", "signed"];
    for (name, layers) in &mut over.images {
        if pictures.contains(&name.as_str()) {
            layers.iter_mut().for_each(|layer| *layer = turned(layer));
        }
    }
    for (name, levels) in &mut over.smaller {
        if pictures.contains(&name.as_str()) {
            let layers = levels.iter_mut().flatten();
            layers.for_each(|layer| *layer = turned(layer));
        }
    }
    for (name, layers) in &mut over.integers {
        if pictures.contains(&name.as_str()) {
            layers.iter_mut().for_each(|layer| *layer = turned(layer));
        }
    }
    for name in ["around", "mipped", "texels", "cloud", "piled", "whole"] {
        let compiled = compile(name);
        let upright = bench.run(&compiled, Stage::Compute, &inputs);
        let upright = upright.unwrap_or_else(|e| panic!("{name}: {e}"));
        let options = bench.emit_options(Stage::Compute).origin(Origin::LowerLeft);
        let below = bench.emit_pass(&compiled, &options).and_then(|(pass, manifest)| {
            let uploaded = bench.upload(&manifest, &over)?;
            bench.picture_of(&pass, &uploaded, over.size)
        });
        let below = turned(&below.unwrap_or_else(|e| panic!("{name}: {e}")));
        for (k, (a, b)) in below.texels().iter().zip(upright.texels()).enumerate() {
            let off = (*a - *b).abs().max_element();
            assert!(off <= 1.0 / 64.0, "{name}, pixel {k}: {a} and {b}");
        }
    }
}
