//! Results and writes of a kernel.

use straightline_bench::execute::{self, Written};
use straightline_codegen::Compiled;
use straightline_codegen::ir::Real;

use super::World;

/// Texel of a target, or element of a buffer; in targets missing components are 0 and the fourth is 1, in buffers all are 0.
pub type Texel = [f64; 4];

/// Values of a kernel for each pixel, and the final contents of the buffers that it writes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// Of each pixel, row by row, the texel of each target; `None` where rustc's program panics, so that Rust says nothing.
    pub pixels: Vec<Option<Vec<Texel>>>,
    /// Each buffer, and each picture that is written at any place, by its name.
    pub buffers: Vec<(String, Vec<Texel>)>,
}

/// Position of a value that a kernel computes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A pixel, and the number of the target.
    Pixel([u32; 2], usize),
    /// A buffer, and the number of the element.
    Buffer(String, usize),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Pixel(pixel, 0) => write!(f, "pixel {pixel:?}"),
            Place::Pixel(pixel, target) => write!(f, "pixel {pixel:?}, target {target}"),
            Place::Buffer(name, index) => write!(f, "`{name}[{index}]`"),
        }
    }
}

/// A value as rustc's program has it, and as something else does.
pub type Pair = (Place, Texel, Texel);

impl Given {
    /// Of what was run for every pixel: what its targets and other pictures hold, and what was written.
    pub fn of_run(compiled: &Compiled, pictures: &[Written], mut buffers: Vec<(String, Vec<Texel>)>) -> Given {
        let (targets, images) = pictures.split_at(compiled.graph.targets.len());
        let pixels =
            (0..World::pixels().count()).map(|k| Some(targets.iter().map(|target| target.texels[k]).collect()));
        buffers.extend(images.iter().map(|image| (image.name.clone(), image.texels.clone())));
        Given {
            pixels: pixels.collect(),
            buffers,
        }
    }

    /// Returns whether rustc's program panics at a pixel, so that nothing is known of its writes.
    pub fn panics(&self) -> bool {
        self.pixels.iter().any(Option::is_none)
    }

    /// Every value of this, which rustc's program gave, with that of another run. A buffer that the other one does not have is
    /// compared with what it holds before: nothing writes it.
    ///
    /// # Errors
    ///
    /// The other one has not as many values.
    pub fn pairs(&self, other: &Given, world: &World) -> Result<Vec<Pair>, String> {
        let mut pairs = Vec::new();
        for ((pixel, own), other) in World::pixels().zip(&self.pixels).zip(&other.pixels) {
            let (Some(own), Some(other)) = (own, other) else {
                continue;
            };
            if own.len() != other.len() {
                return Err(format!("{} targets, where rustc has {}", other.len(), own.len()));
            }
            let both = own.iter().zip(other).enumerate();
            pairs.extend(both.map(|(k, (own, other))| (Place::Pixel(pixel, k), *own, *other)));
        }
        for (name, own) in self.buffers.iter().filter(|_| !self.panics()) {
            let found = other.buffers.iter().find(|(other, _)| other == name);
            let untouched = || world.initial(name);
            let other = found.map_or_else(untouched, |(_, elements)| elements.clone());
            if own.len() != other.len() {
                return Err(format!(
                    "`{name}` has {} elements, where rustc has {}",
                    other.len(),
                    own.len()
                ));
            }
            let both = own.iter().zip(other).enumerate();
            pairs.extend(both.map(|(k, (own, other))| (Place::Buffer(name.clone(), k), *own, other)));
        }
        Ok(pairs)
    }
}

/// Runs a compiled kernel in a precision.
///
/// # Errors
///
/// What the kernel reads is not bound, or threads of a workgroup race.
pub fn computed<R: Real>(compiled: &Compiled, world: &World) -> Result<Given, String> {
    let found = execute::interpret_kernel::<R>(compiled, &world.inputs(), false).map_err(|e| e.to_string())?;
    Ok(Given::of_run(compiled, &found.targets, found.buffers))
}
