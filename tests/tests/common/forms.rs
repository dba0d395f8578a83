//! Kernels of files in every form: as rustc compiles them, by the interpreter, and on a GPU.

use super::{bench, same_bits};
use std::path::{Path, PathBuf};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Branches, Compiled, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_scene::picture;

/// A kernel of a file.
pub struct Example {
    pub name: &'static str,
    pub kernel: Kernel,
}

impl Example {
    /// The kernel of `FOLDER/NAME.rs` in the repository.
    pub fn new(folder: &str, name: &'static str) -> Example {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../{folder}/{name}.rs"));
        let kernel = Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}"));
        Example { name, kernel }
    }

    pub fn compile(&self, settings: &Settings) -> Compiled {
        self.kernel.compile(settings).unwrap_or_else(|e| panic!("{e}"))
    }

    /// In every form what `native` makes of `inputs`, bit for bit, and on a GPU up to `tolerance`, but for a share of
    /// pixels, `unsure`: those on which a decision hangs on the last bit. What the GPU made of it unrolled.
    pub fn check(&self, inputs: &Inputs, tolerance: f32, unsure: f64, native: impl Fn(IVec2) -> Vec4) -> Frame<Vec4> {
        let name = self.name;
        let expected: Vec<[f32; 4]> = pixels(inputs.size).map(|at| native(at).to_array()).collect();
        let forms = [
            (Unroll::None, Branches::AsLoops),
            (Unroll::Partial(2), Branches::AsLoops),
            (Unroll::Partial(4), Branches::AsLoops),
            (Unroll::Full, Branches::Keep),
            (Unroll::Full, Branches::AsLoops),
        ];
        let gpu = bench();
        let mut last = None;
        for (unroll, branches) in forms {
            let settings = Settings::new().unroll(unroll).branches(branches);
            let compiled = self.compile(&settings);
            let found = interpret_kernel::<f32>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{name}: {e}"));
            same_bits(&expected, &found.texels).unwrap_or_else(|e| panic!("{name} {unroll}, branches {branches}: {e}"));
            let shown = gpu
                .run(&compiled, Stage::Compute, inputs)
                .unwrap_or_else(|e| panic!("{name} {unroll}: {e}"));
            let off = |(a, b): &(&Vec4, &[f32; 4])| (**a - Vec4::from_array(**b)).abs().max_element() > tolerance;
            let off = shown.texels().iter().zip(&expected).filter(off).count();
            let share = off as f64 / expected.len() as f64;
            assert!(
                share <= unsure,
                "{name} {unroll}: {off} pixels are off by more than {tolerance} on the GPU"
            );
            last = Some(shown);
        }
        last.expect("a form")
    }
}

/// Every pixel of a picture, row by row.
pub fn pixels(size: UVec2) -> impl Iterator<Item = IVec2> {
    (0..size.y as i32).flat_map(move |y| (0..size.x as i32).map(move |x| ivec2(x, y)))
}

/// An image of the inputs, by its name.
pub fn image<'a>(inputs: &'a Inputs, name: &str) -> &'a Frame<Vec4> {
    let (_, layers) = inputs
        .images
        .iter()
        .find(|(n, _)| n == name)
        .expect("an image of this name");
    &layers[0]
}

pub fn texture(inputs: &Inputs, name: &str) -> Texture<Vec4> {
    let image = image(inputs, name);
    Texture::new(image.size(), image.texels().to_vec())
}

/// The first component of an image, as `make` takes it.
pub fn first<T>(inputs: &Inputs, name: &str, make: impl Fn(UVec2, Vec<f32>) -> T) -> T {
    let image = image(inputs, name);
    make(image.size(), image.texels().iter().map(|t| t.x).collect())
}

/// Writes a kernel's inputs and picture to the folder `STRAIGHTLINE_PICTURES`, if it is set.
pub fn save(name: &str, inputs: &Inputs, shown: &Frame<Vec4>) {
    let Some(folder) = std::env::var_os("STRAIGHTLINE_PICTURES") else {
        return;
    };
    let folder = PathBuf::from(folder);
    std::fs::create_dir_all(&folder).expect("a folder for pictures");
    for (input, layers) in &inputs.images {
        picture::write_picture(&folder.join(format!("{name}-{input}.png")), &layers[0]).expect("a picture is written");
    }
    picture::write_picture(&folder.join(format!("{name}.png")), shown).expect("a picture is written");
}
