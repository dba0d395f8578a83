//! Running a compiled kernel on the CPU: the graph that is emitted, interpreted, a row of pixels a task.

use crate::failure::Failure;
use crate::resolve::Inputs;
use glam::Vec4;
use rayon::prelude::*;
use straightline_codegen::Compiled;
use straightline_codegen::ir::interp::{Image, Interpreter, Texels};
use straightline_kernels::prelude::{Frame, FrameLayers};

/// Images of a frame as the interpreter reads them.
pub struct Bound {
    images: Vec<(&'static str, Image)>,
    size: [u32; 2],
}

impl Bound {
    /// Converts a frame's images.
    pub fn new(inputs: &Inputs<'_>) -> Result<Bound, Failure> {
        let size = inputs.color.size().to_array();
        let color = inputs.color.texels().iter().map(|c| c.to_array()).collect();
        let mut layers = vec![
            ("color", vec![color]),
            ("depth", stack(inputs.depth, |d| [d, 0.0, 0.0, 0.0])),
        ];
        if let Some(normal) = inputs.normal {
            layers.push(("normal", stack(normal, |n| n.extend(0.0).to_array())));
        }
        let mut images = Vec::new();
        for (name, layers) in layers {
            let image =
                Image::new(size, layers).ok_or_else(|| Failure::of(format!("`{name}` is not of the frame's size")))?;
            images.push((name, image));
        }
        Ok(Bound { images, size })
    }

    /// Every pixel of `compiled`.
    pub fn run(&self, compiled: &Compiled) -> Result<Frame<Vec4>, Failure> {
        let bound: Vec<(&str, &dyn Texels)> = self
            .images
            .iter()
            .map(|(name, image)| (*name, image as &dyn Texels))
            .collect();
        let interpreter =
            Interpreter::new(&compiled.graph, &compiled.schedule, self.size, &bound, &[]).map_err(Failure::of)?;
        let [width, height] = self.size;
        let row = |scratch: &mut _, y: u32| -> Vec<Vec4> {
            (0..width)
                .map(|x| Vec4::from_array(interpreter.pixel(x, y, scratch)))
                .collect()
        };
        let rows: Vec<Vec<Vec4>> = (0..height)
            .into_par_iter()
            .map_init(|| interpreter.scratch(), row)
            .collect();
        Ok(Frame::new(inputs_size(self.size), rows.concat()))
    }
}

fn inputs_size(size: [u32; 2]) -> glam::UVec2 {
    glam::UVec2::from_array(size)
}

fn stack<T: Copy>(layers: &FrameLayers<T>, texel: impl Fn(T) -> [f32; 4]) -> Vec<Vec<[f32; 4]>> {
    layers
        .layers()
        .iter()
        .map(|layer| layer.texels().iter().map(|t| texel(*t)).collect())
        .collect()
}
