//! What every kernel of a batch reads.

use crate::random::Random;
use std::fmt::Write;
use straightline_codegen::interp::{Bindings, Image};

/// Width and height of the picture.
pub const SIZE: [u32; 2] = [4, 2];

/// The inputs of a batch: the same for the interpreter, for drivers and natively.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// The texture `a`, rows from the top.
    pub texels: Vec<[f32; 4]>,
    /// The buffer `b`.
    pub buffer: Vec<f32>,
    /// The uniform `p`.
    pub p: i32,
    /// The uniform `q`.
    pub q: u32,
    /// The uniform `r`.
    pub r: f32,
    elements: Vec<[f64; 4]>,
}

impl World {
    /// The inputs of a seed. All floats are multiples of 1/64 below 16, so that sums and products of a few are exact.
    pub fn new(seed: u64) -> World {
        let mut random = Random(seed ^ 0x77_6f72_6c64);
        let mut number = || match random.below(8) {
            0 => 0.0,
            1 => random.between(-3, 3) as f32,
            2 => random.between(-5, 5) as f32 + 0.5,
            _ => random.between(-1000, 1000) as f32 / 64.0,
        };
        let texels = (0..SIZE[0] * SIZE[1]).map(|_| [number(), number(), number(), number()]);
        let texels = texels.collect();
        let buffer: Vec<f32> = (0..5).map(|_| number()).collect();
        let r = number();
        World {
            texels,
            elements: buffer.iter().map(|x| [f64::from(*x), 0.0, 0.0, 0.0]).collect(),
            buffer,
            p: random.between(-40, 40) as i32,
            q: random.bits() as u32,
            r,
        }
    }

    /// The picture for the interpreter.
    pub fn image(&self) -> Image {
        Image::new(SIZE, vec![self.texels.clone()]).expect("a whole picture")
    }

    /// What the interpreter binds.
    pub fn bindings<'a>(&'a self, image: &'a Image) -> Bindings<'a> {
        Bindings::new()
            .texture("a", image)
            .buffer("b", &self.elements)
            .uniform("p", &[f64::from(self.p)])
            .uniform("q", &[f64::from(self.q)])
            .uniform("r", &[f64::from(self.r)])
    }

    /// Coordinates of the pixels, row by row.
    pub fn pixels() -> impl Iterator<Item = [u32; 2]> {
        (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
    }

    /// Rust text of functions that make the inputs natively.
    pub fn native(&self) -> String {
        let float = |x: &f32| format!("f32::from_bits({:#x})", x.to_bits());
        let mut text = String::new();
        let floats: Vec<String> = self.texels.iter().flatten().map(float).collect();
        let _ = writeln!(text, "const TEXELS: [f32; {}] = [{}];", floats.len(), floats.join(", "));
        let buffer: Vec<String> = self.buffer.iter().map(float).collect();
        let _ = writeln!(text, "const BUFFER: [f32; {}] = [{}];", buffer.len(), buffer.join(", "));
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
