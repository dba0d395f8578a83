//! A captured frame as what kernels read.

use glam::Vec4;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_study::capture::Capture;
use straightline_study::execute::Inputs;

/// The images of a frame by the names that kernels call them.
pub fn inputs(capture: &Capture) -> Inputs {
    let inputs = Inputs::new(capture.color.size())
        .image("color", capture.color.clone())
        .layers("depth", stack(&capture.depth, |d| Vec4::new(d, 0.0, 0.0, 0.0)));
    match &capture.normal {
        Some(normal) => inputs.layers("normal", stack(normal, |n| n.extend(0.0))),
        None => inputs,
    }
}

fn stack<T: Copy>(layers: &FrameLayers<T>, texel: impl Fn(T) -> Vec4) -> Vec<Frame<Vec4>> {
    let layer = |l: &Frame<T>| Frame::new(l.size(), l.texels().iter().map(|t| texel(*t)).collect());
    layers.layers().iter().map(layer).collect()
}
