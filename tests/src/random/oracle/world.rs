//! Inputs of every kernel of a batch.

#[path = "native/resources.rs"]
mod resources;

use super::given::Texel;
use crate::edges;
use crate::random::Random;
use resources::Resources;
use std::fmt::Write;
use straightline_bench::execute::{Inputs, SamplerState};
use straightline_kernels::prelude::*;

/// Width and height of the picture.
pub const SIZE: [u32; 2] = [4, 2];

/// The inputs of a batch: the same for the interpreter, for drivers and natively.
#[derive(Debug)]
pub struct World {
    /// The texture `a`, rows from the top.
    texels: Vec<[f32; 4]>,
    /// The buffer `b`.
    buffer: Vec<f32>,
    p: i32,
    q: u32,
    r: f32,
    /// Floats that all inputs are made of.
    floats: Vec<f32>,
    bits: Vec<u32>,
    resources: Resources,
}

impl World {
    /// The inputs of a seed. One float in eight is one at which functions change their ways; the others are multiples of
    /// 1/64 below 16, so that sums and products of a few are exact. World 0 has those alone.
    pub fn new(seed: u64) -> World {
        World::with(seed, if seed == 0 { &[] } else { &edges::FLOATS })
    }

    /// The inputs of a seed without what drivers may take for another number, or sum up to another.
    pub fn for_drivers(seed: u64) -> World {
        World::with(seed, &edges::of_drivers())
    }

    /// The inputs of a seed, some of them out of `edges`.
    fn with(seed: u64, edges: &[f32]) -> World {
        let mut random = Random(seed ^ 0x77_6f72_6c64);
        let mut number = || match random.below(8) {
            0 => 0.0,
            1 => random.between(-3, 3) as f32,
            2 => random.between(-5, 5) as f32 + 0.5,
            3 if !edges.is_empty() => random.pick(edges),
            _ => random.between(-1000, 1000) as f32 / 64.0,
        };
        let texels = (0..SIZE[0] * SIZE[1]).map(|_| [number(), number(), number(), number()]);
        let texels = texels.collect();
        let buffer: Vec<f32> = (0..5).map(|_| number()).collect();
        let (r, floats): (f32, Vec<f32>) = (number(), (0..61).map(|_| number()).collect());
        let (p, q) = (random.between(-40, 40) as i32, random.bits() as u32);
        let bits: Vec<u32> = (0..53)
            .map(|_| match random.below(4) {
                0 => random.below(9) as u32,
                1 => (random.between(-9, 9) as i32) as u32,
                _ => random.bits() as u32,
            })
            .collect();
        World {
            resources: Resources::new(UVec2::from_array(SIZE), &floats, &bits),
            texels,
            buffer,
            p,
            q,
            r,
            floats,
            bits,
        }
    }

    /// Everything that any kernel reads or writes, by its name.
    pub fn inputs(&self) -> Inputs {
        let (w, size) = (&self.resources, UVec2::from_array(SIZE));
        let float = |k: usize| f64::from(w.float(k));
        let texels = self.texels.iter().map(|t| Vec4::from_array(*t)).collect();
        let whole = |k: usize| f64::from(w.bit(k) as i32);
        let inputs = Inputs::new(size)
            .with_image("a", Frame::new(size, texels))
            .with_buffer("b", self.buffer.iter().map(|x| one(f64::from(*x))).collect())
            .with_uniform("p", &[f64::from(self.p)])
            .with_uniform("q", &[f64::from(self.q)])
            .with_uniform("r", &[f64::from(self.r)])
            .with_buffer("bu", w.bu.elements().iter().map(|x| one(f64::from(*x))).collect())
            .with_buffer("bi", w.bi.elements().iter().map(|x| one(f64::from(*x))).collect())
            .with_buffer("table", w.bi.elements().iter().map(|x| one(f64::from(*x))).collect())
            .with_buffer(
                "bv",
                w.bv.elements().iter().map(|v| v.to_array().map(f64::from)).collect(),
            )
            .with_buffer(
                "bw",
                w.bw.elements()
                    .iter()
                    .map(|v| [f64::from(v.x), f64::from(v.y), 0.0, 0.0])
                    .collect(),
            )
            .with_buffer("bs", self.records())
            .with_uniform("un", &[50, 51, 52].map(float))
            .with_uniform("tint", &[3, 6, 9].map(float));
        let inputs = ["x_axis", "y_axis", "z_axis"]
            .iter()
            .enumerate()
            .fold(inputs, |inputs, (k, axis)| {
                inputs.with_uniform(&format!("um_{axis}"), &[40, 41, 42].map(|at| float(at + 3 * k)))
            });
        let inputs = (0..4).fold(inputs, |inputs, k| {
            let inputs = inputs.with_uniform(&format!("ua_{k}"), &[float(k + 20), float(k + 27)]);
            let inputs = inputs.with_uniform(&format!("ui_{k}"), &[whole(k + 30)]);
            inputs.with_uniform(&format!("steps_{k}"), &[f64::from(w.bit(k + 11))])
        });
        let inputs = [2, 8].iter().enumerate().fold(inputs, |inputs, (k, from)| {
            let inputs = inputs.with_uniform(&format!("up_{k}_scale"), &[float(*from)]);
            (0..3).fold(inputs, |inputs, n| {
                inputs.with_uniform(&format!("up_{k}_powers_{n}"), &[float(from + 1 + n)])
            })
        });
        let inputs = ["wf", "wv", "wi", "xu", "xi"]
            .iter()
            .fold(inputs, |inputs, name| inputs.with_buffer(name, self.initial(name)));
        self.images(inputs)
    }

    /// The further images.
    fn images(&self, inputs: Inputs) -> Inputs {
        let w = &self.resources;
        let layers = |texture: &Texture<Vec4>| {
            let level = |k| Frame::new(texture.size_of_level(k), texture.texels_of_level(k).to_vec());
            (0..texture.levels()).map(level).collect::<Vec<_>>()
        };
        // Of several textures with levels the levels, each with all layers.
        let levels = |all: &[&Texture<Vec4>]| {
            let all: Vec<Vec<Frame<Vec4>>> = all.iter().map(|texture| layers(texture)).collect();
            let level = |k: usize| all.iter().map(|texture| texture[k].clone()).collect::<Vec<_>>();
            (0..all[0].len()).map(level).collect::<Vec<_>>()
        };
        let slices = |level: usize, size: UVec3| -> Vec<Frame<Vec4>> {
            let slice = (size.x * size.y) as usize;
            let texels = w.tv.texels_of_level(level).chunks(slice);
            texels
                .map(|texels| Frame::new(size.truncate(), texels.to_vec()))
                .collect()
        };
        let depths = |texture: &DepthTexture| {
            let texels = texture.texels().iter().map(|x| vec4(*x, 0.0, 0.0, 1.0));
            Frame::new(texture.size(), texels.collect())
        };
        let shade = frame(&w.ff, |x| vec4(*x, 0.0, 0.0, 1.0));
        let ti = w.ti.texels().iter().map(|v| v.as_uvec4()).collect();
        inputs
            .with_integers("fu", vec![frame(&w.fu, |x| uvec4(*x, 0, 0, 1))])
            .with_integers("fi", vec![frame(&w.fi, |v| v.as_uvec2().extend(0).extend(1))])
            .with_integers("fw", vec![w.fw.clone()])
            .with_integers("ti", vec![Frame::new(w.ti.size(), ti)])
            .with_image("ff", shade.clone())
            .with_image("shade", shade)
            .with_image("fv", frame(&w.fv, |v| v.extend(1.0)))
            .with_layers(
                "fl",
                w.fl.layers()
                    .iter()
                    .map(|layer| frame(layer, |v| v.extend(0.0).extend(1.0)))
                    .collect(),
            )
            .with_levels("tm", levels(&[&w.tm]))
            .with_levels("ta", levels(&[0, 1, 2].map(|k| w.ta.layer(k))))
            .with_levels("tv", vec![slices(0, uvec3(3, 2, 2)), slices(1, UVec3::ONE)])
            .with_levels("tc", levels(&w.tc.faces().each_ref()))
            .with_layers(
                "ts",
                w.ts.samples()
                    .iter()
                    .map(|t| Frame::new(t.size(), t.texels().to_vec()))
                    .collect(),
            )
            .with_image("td", depths(&w.td))
            .with_layers("tda", (0..2).map(|k| depths(w.tda.layer(k))).collect())
            .with_layers("tdc", w.tdc.faces().iter().map(depths).collect())
            .with_sampler("s", state(w.s.filter, w.s.address, w.s.mip))
            .with_sampler("sc", state(w.sc.filter, Address::default(), Filter::default()))
    }

    /// The elements of `bs`, each number and vector one after the other.
    fn records(&self) -> Vec<Texel> {
        let float = |k: usize| f64::from(self.resources.float(k));
        let of = |lanes: &[usize]| std::array::from_fn(|k| lanes.get(k).map_or(0.0, |at| float(*at)));
        let record = |k: usize| {
            let mut all = vec![of(&[k, k + 1, k + 2]), one(f64::from(self.resources.bit(k)))];
            all.extend((0..4).map(|n| of(&[k + n])));
            all.extend([of(&[k, k + 1]), of(&[k + 2, k + 3])]);
            all.extend((0..2).map(|n| of(&[k + n, k + 3, 7 * n])));
            all
        };
        (0..3).flat_map(record).collect()
    }

    /// Initial contents of a buffer or a picture that kernels write.
    pub fn initial(&self, name: &str) -> Vec<Texel> {
        let w = &self.resources;
        let whole = |k: usize| f64::from(w.bit(k) as i32);
        let element = |k: usize| match name {
            "wf" => one(f64::from(w.float(k))),
            "wv" => [f64::from(w.float(k + 5)); 4],
            "wt" => [0.0; 4],
            "wi" => [whole(k), whole(k), 0.0, 0.0],
            "xu" => one(f64::from(w.bit(k))),
            _ => one(whole(k + 3)),
        };
        let len = match name {
            "wt" => World::pixels().count(),
            _ if name.starts_with('w') => 32,
            _ => 42,
        };
        (0..len).map(element).collect()
    }

    /// Coordinates of the pixels, row by row.
    pub fn pixels() -> impl Iterator<Item = [u32; 2]> {
        (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
    }

    /// Rust text that makes the inputs natively.
    pub fn native(&self) -> String {
        let float = |x: &f32| format!("f32::from_bits({:#x})", x.to_bits());
        let mut text = String::new();
        let mut floats = |name: &str, all: &[f32]| {
            let all: Vec<String> = all.iter().map(float).collect();
            let _ = writeln!(text, "const {name}: [f32; {}] = [{}];", all.len(), all.join(", "));
        };
        floats("TEXELS", self.texels.as_flattened());
        floats("BUFFER", &self.buffer);
        floats("FLOATS", &self.floats);
        let _ = writeln!(text, "const BITS: [u32; {}] = {:?};", self.bits.len(), self.bits);
        let _ = writeln!(
            text,
            "const P: i32 = {};\nconst Q: u32 = {};\nconst R: f32 = {};\nconst SIZE: [u32; 2] = [{}, {}];",
            self.p,
            self.q,
            float(&self.r),
            SIZE[0],
            SIZE[1]
        );
        text
    }
}

/// A sampler as the interpreter and drivers take it.
fn state(filter: Filter, address: Address, mip: Filter) -> SamplerState {
    SamplerState {
        linear: filter == Filter::Linear,
        address,
        linear_mip: mip == Filter::Linear,
        ..SamplerState::default()
    }
}

fn one(x: f64) -> Texel {
    [x, 0.0, 0.0, 0.0]
}

fn frame<T: Copy, U: Copy>(frame: &Frame<T>, of: impl Fn(&T) -> U) -> Frame<U> {
    Frame::new(frame.size(), frame.texels().iter().map(of).collect())
}
