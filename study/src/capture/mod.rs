//! Captures: the exchange format with renderers that are not ours.
//!
//! A capture is a folder with `capture.json` and EXR files: one shading sample a pixel, the geometry at several
//! samples in it, and optionally what the picture should look like. `docs/captures.md` describes it for those
//! who write one with another program.

mod description;
mod error;
mod read;
mod write;

use crate::scene::Camera;
use glam::{UVec2, Vec2};
use straightline_kernels::prelude::{Frame, FrameLayers, Vec3, Vec4};

pub use description::{SCHEMA, ShadingSample};
pub use error::CaptureError;

/// Most geometry samples of a pixel.
pub const MAX_SAMPLES: usize = 64;

/// Most texels of all layers of the G-buffer together: 3840×2160 with 17 layers is about half.
pub const MAX_GEOMETRY_TEXELS: u64 = 1 << 28;

const DESCRIPTION: &str = "capture.json";
const COLOR: &str = "color.exr";
const DEPTH: &str = "depth.exr";
const NORMAL: &str = "normal.exr";
const REFERENCE: &str = "reference.exr";

/// Every file that a capture may hold.
const FILES: [&str; 5] = [DESCRIPTION, COLOR, DEPTH, NORMAL, REFERENCE];

/// A rendered picture with subpixel geometry. All images have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// Width and height in pixels.
    pub size: UVec2,
    /// Offset of each geometry sample from the pixel's centre, in pixels, y down, each axis in -0.5..=0.5.
    pub samples: Vec<Vec2>,
    /// Where in the pixel shading was sampled.
    pub shading: ShadingSample,
    /// What the scene was seen with: metrics that compare planes, and projected depths, need it.
    pub camera: Option<Camera>,
    /// Linear colour, one shading sample a pixel.
    pub color: Frame<Vec4>,
    /// Linear depth along the view direction in scene units: layer `s` at geometry sample `s`, and with shading
    /// at the pixel's centre one more layer, the last, there.
    pub depth: FrameLayers<f32>,
    /// Unit normals, in the layers that `depth` has.
    pub normal: Option<FrameLayers<Vec3>>,
    /// Linear colour that a perfect filter would give.
    pub reference: Option<Frame<Vec4>>,
}

impl Capture {
    /// Layers that `depth` and `normal` have.
    pub fn layer_count(&self) -> usize {
        layer_count(self.samples.len(), self.shading)
    }

    /// Layer of `depth` and `normal` that holds the geometry of the shading sample.
    pub fn shaded_layer(&self) -> usize {
        match self.shading {
            ShadingSample::Sample(sample) => sample,
            ShadingSample::Centre => self.samples.len(),
        }
    }

    /// Offset of the shading sample from the pixel's centre, in pixels, y down; `None` if it names a sample that
    /// there is not.
    pub fn shaded_offset(&self) -> Option<Vec2> {
        match self.shading {
            ShadingSample::Sample(sample) => self.samples.get(sample).copied(),
            ShadingSample::Centre => Some(Vec2::ZERO),
        }
    }
}

fn layer_count(samples: usize, shading: ShadingSample) -> usize {
    match shading {
        ShadingSample::Sample(_) => samples,
        ShadingSample::Centre => samples + 1,
    }
}

/// Name of a layer in `depth.exr` and `normal.exr`.
fn layer_name(layer: usize, samples: usize) -> String {
    if layer < samples {
        format!("sample{layer}")
    } else {
        "centre".to_owned()
    }
}
