//! Captures: the exchange format with renderers that are not ours.
//!
//! A capture is a folder with `capture.json` and EXR files: one shading sample a pixel or a few, the geometry at several
//! samples in it, and optionally what the picture should look like. `docs/captures.md` describes it for those
//! who write one with another program.

mod description;
mod error;
mod read;
mod write;

use crate::scene::Camera;
use glam::{UVec2, Vec2};
use straightline_kernels::prelude::{Frame, FrameLayers, Vec3, Vec4};

pub use description::{NormalSpace, SCHEMA, ShadingSample};
pub use error::CaptureError;

/// Most geometry samples of a pixel.
pub const MAX_SAMPLES: usize = 64;

/// Most texels of all layers of the G-buffer together: 3840×2160 with 17 layers is about half.
pub const MAX_GEOMETRY_TEXELS: u64 = 1 << 28;

const DESCRIPTION: &str = "capture.json";
const COLOR: &str = "color.exr";
const DEPTH: &str = "depth.exr";
const NORMAL: &str = "normal.exr";
const PLACE: &str = "place.exr";
const ALBEDO: &str = "albedo.exr";
const DIRECT: &str = "direct.exr";
const REST: &str = "rest.exr";
const GUIDE: &str = "guide.exr";
const REFERENCE: &str = "reference.exr";

/// The layer of `place.exr`, and its channel.
const PLACE_LAYER: &str = "place";
const PLACE_CHANNEL: &str = "Y";

/// Every file that a capture may hold.
const FILES: [&str; 10] = [
    DESCRIPTION,
    COLOR,
    PLACE,
    DEPTH,
    NORMAL,
    ALBEDO,
    DIRECT,
    REST,
    GUIDE,
    REFERENCE,
];

/// A rendered picture with subpixel geometry. All images have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// Width and height in pixels.
    pub size: UVec2,
    /// Offset of each geometry sample from the pixel's centre, in pixels, y down, each axis in -0.5..=0.5.
    pub samples: Vec<Vec2>,
    /// Position in the pixel at which shading was sampled.
    pub shading: ShadingSample,
    /// Space of the normals; of no meaning without them.
    pub normal_space: NormalSpace,
    /// Camera that saw the scene: metrics that compare planes, and projected depths, need it.
    pub camera: Option<Camera>,
    /// Linear colour of each pixel: of its shading sample, or the mean of several.
    pub color: Frame<Vec4>,
    /// Linear colour at each shading sample, in the order of `shading`, if a pixel has several; else none.
    pub colors: Vec<Frame<Vec4>>,
    /// With [`ShadingSample::Placed`], the layer of `depth` and `normal` in whose place each pixel is shaded; else none.
    pub place: Option<Frame<u32>>,
    /// Linear depth along the view direction in scene units: layer `s` at geometry sample `s`, and with shading
    /// at the pixel's centre, or placed, one more layer, the last, there.
    pub depth: FrameLayers<f32>,
    /// Unit normals, in the layers that `depth` has.
    pub normal: Option<FrameLayers<Vec3>>,
    /// Linear RGB that surfaces reflect diffusely, in the layers that `depth` has, and in alpha the share of the direct light that
    /// no shadow keeps away: filters that take light apart from paint and shadow need it.
    pub albedo: Option<FrameLayers<Vec4>>,
    /// Linear RGB that the direct light adds to `color` where no shadow falls. Only of one shading sample a pixel.
    pub direct: Option<Frame<Vec4>>,
    /// Linear RGB of `color` that does not follow the albedo: highlights, mirror images, haze. Only of one shading sample a pixel.
    pub rest: Option<Frame<Vec4>>,
    /// Linear RGB that estimates the colour cheaply, in the layers that `depth` has: a filter with an additive guide needs it.
    pub guide: Option<FrameLayers<Vec4>>,
    /// Linear colour that a perfect filter would give.
    pub reference: Option<Frame<Vec4>>,
}

impl Capture {
    /// Layers that `depth` and `normal` have.
    pub fn layer_count(&self) -> usize {
        layer_count(self.samples.len(), &self.shading)
    }

    /// Layers of `depth` and `normal` that hold the geometry of the shading samples: one, or several in their order. Of shading
    /// that is placed that of the pixels that are shaded at their centre, as most are.
    pub fn shaded_layers(&self) -> Vec<usize> {
        match &self.shading {
            ShadingSample::Sample(sample) => vec![*sample],
            ShadingSample::Samples(samples) => samples.clone(),
            ShadingSample::Centre | ShadingSample::Placed => vec![self.samples.len()],
        }
    }

    /// Offsets of the shading samples from the pixel's centre, in pixels, y down; `None` if a sample is named that there is
    /// not.
    pub fn shaded_offsets(&self) -> Option<Vec<Vec2>> {
        let offset = |sample: &usize| self.samples.get(*sample).copied();
        match &self.shading {
            ShadingSample::Sample(sample) => offset(sample).map(|offset| vec![offset]),
            ShadingSample::Samples(samples) => samples.iter().map(offset).collect(),
            ShadingSample::Centre | ShadingSample::Placed => Some(vec![Vec2::ZERO]),
        }
    }

    /// The rays through the pixels, in the space that normals are in: from the eye to depth 1 through the picture's upper left
    /// corner, and how they change from pixel to pixel to the right and down. `None` without a camera, and of a parallel projection.
    pub fn perspective_rays(&self) -> Option<[Vec3; 3]> {
        let camera = self.camera.filter(|camera| camera.parallel_height.is_none())?;
        Some(self.normal_space.rays(&camera, self.size))
    }

    /// Of a parallel projection the way along its rays to depth 1, in the space that normals are in, and the ways from pixel to pixel to
    /// the right and down.
    pub fn parallel_rays(&self) -> Option<[Vec3; 3]> {
        let camera = self.camera.filter(|camera| camera.parallel_height.is_some())?;
        Some(self.normal_space.rays(&camera, self.size))
    }
}

/// The mean of pictures of one size; `None` of none.
pub fn mean_frame(frames: &[Frame<Vec4>]) -> Option<Frame<Vec4>> {
    let size = frames.first()?.size();
    let share = 1.0 / frames.len() as f32;
    let texel = |k: usize| frames.iter().map(|frame| frame.texels()[k]).sum::<Vec4>() * share;
    Some(Frame::new(size, (0..(size.x * size.y) as usize).map(texel).collect()))
}

fn layer_count(samples: usize, shading: &ShadingSample) -> usize {
    match shading {
        ShadingSample::Sample(_) | ShadingSample::Samples(_) => samples,
        ShadingSample::Centre | ShadingSample::Placed => samples + 1,
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
