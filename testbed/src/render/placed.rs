//! Shading once a pixel, where geometry asks for it.

use super::{RenderError, Renderer};
use crate::capture::{Capture, MAX_SAMPLES};
use glam::{IVec2, Vec2, Vec3, Vec4, ivec2};
use rayon::prelude::*;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_kernels::sraa::{Difference, GBuffer, Pattern, Sraa, View, sraa_place};

/// Offsets that differ: with this metric it is only counted how many there are.
static OFFSETS: [f32; 2 * MAX_SAMPLES] = {
    let mut offsets = [0.0; 2 * MAX_SAMPLES];
    let mut k = 0;
    while k < offsets.len() {
        offsets[k] = k as f32;
        k += 1;
    }
    offsets
};

/// What the kernels that say where to shade are given of a G-buffer: surfaces of which a step of a third of the depth is between
/// unrelated ones.
pub(super) struct Surfaces {
    pub(super) cfg: Sraa,
    pub(super) gbuffer: GBuffer,
    pub(super) view: View,
}

impl Surfaces {
    pub(super) fn new(samples: &[Vec2], depth: &FrameLayers<f32>, normal: &FrameLayers<Vec3>) -> Surfaces {
        let cfg = Sraa {
            pattern: Pattern::Listed,
            offsets: &OFFSETS[..2 * samples.len().min(MAX_SAMPLES)],
            difference: Difference::Relative,
            depth_scale: 3.0,
            ..Sraa::default()
        };
        let with_fourth = |layer: &Frame<Vec3>| {
            let texels = layer.texels().iter().map(|n| n.extend(0.0));
            Frame::new(layer.size(), texels.collect())
        };
        let gbuffer = GBuffer {
            depth: depth.clone(),
            normal: FrameLayers::new(normal.layers().iter().map(with_fourth).collect()),
            ..GBuffer::unread()
        };
        let view = View {
            ray_corner: Vec3::ZERO,
            ray_right: Vec3::ZERO,
            ray_down: Vec3::ZERO,
            origin: IVec2::ZERO,
            near: 1.0,
            far: 1.0,
        };
        Surfaces { cfg, gbuffer, view }
    }
}

/// Options of the kernel `sraa_place` that say what tells surfaces apart where shading is placed here.
pub const PLACED_BY: [(&str, &str); 3] = [
    ("metric", "depth-normals"),
    ("difference", "relative"),
    ("depth-scale", "3"),
];

/// What is shaded once a pixel, where the kernel `sraa_place` says.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Of each pixel the number of the geometry sample at which it is shaded, or the number of samples for its centre.
    pub place: Frame<u32>,
    /// Linear colours there.
    pub color: Frame<Vec4>,
    /// The direct light there as it would be without a shadow, if the capture has that.
    pub direct: Option<Frame<Vec4>>,
    /// What does not follow the albedo there, if the capture has that.
    pub rest: Option<Frame<Vec4>>,
}

/// What `renderer` drew for a capture that is shaded at the pixels' centres, shaded where the kernel `sraa_place` says instead, with
/// the options [`PLACED_BY`]. `None` of a capture without normals.
///
/// # Errors
///
/// What the renderer refuses.
pub fn placed(capture: &Capture, renderer: &dyn Renderer) -> Result<Option<Placed>, RenderError> {
    let Some(normal) = &capture.normal else {
        return Ok(None);
    };
    let place = choose(&capture.samples, &capture.depth, normal);
    let mut places = capture.samples.clone();
    places.push(Vec2::ZERO);
    let moved = |centred: &Frame<Vec4>, drawn: &dyn Fn(Vec2) -> Result<Frame<Vec4>, RenderError>| {
        gathered(&places, &place, centred.clone(), drawn)
    };
    let color = moved(&capture.color, &|offset| renderer.shaded(offset))?;
    let direct = capture.direct.as_ref();
    let direct = direct.map(|centred| moved(centred, &|offset| renderer.sunlight(offset)));
    let rest = capture.rest.as_ref();
    let rest = rest.map(|centred| moved(centred, &|offset| renderer.unpainted(offset)));
    Ok(Some(Placed {
        color,
        direct: direct.transpose()?,
        rest: rest.transpose()?,
        place,
    }))
}

/// The layer in whose place each pixel is to be shaded: the kernel `sraa_place`, as rustc compiles it.
pub(super) fn choose(samples: &[Vec2], depth: &FrameLayers<f32>, normal: &FrameLayers<Vec3>) -> Frame<u32> {
    let Surfaces { cfg, gbuffer, view } = &Surfaces::new(samples, depth, normal);
    let size = depth.layers()[0].size();
    let rows = (0..size.y as i32).into_par_iter();
    let texels = rows.flat_map_iter(|y| (0..size.x as i32).map(move |x| sraa_place(cfg, gbuffer, view, ivec2(x, y))));
    Frame::new(size, texels.collect())
}

/// The picture with each pixel drawn in the place of the layer that `chosen` names, of those at `places`; `centred` is drawn in the
/// last place.
pub(crate) fn gathered(
    places: &[Vec2],
    chosen: &Frame<u32>,
    centred: Frame<Vec4>,
    drawn: impl Fn(Vec2) -> Result<Frame<Vec4>, RenderError>,
) -> Result<Frame<Vec4>, RenderError> {
    let mut texels = centred.texels().to_vec();
    for (layer, place) in places.iter().enumerate().take(places.len() - 1) {
        let here = |chosen: &u32| *chosen as usize == layer;
        if chosen.texels().iter().any(here) {
            let shaded = drawn(*place)?;
            for ((texel, own), chosen) in texels.iter_mut().zip(shaded.texels()).zip(chosen.texels()) {
                if here(chosen) {
                    *texel = *own;
                }
            }
        }
    }
    Ok(Frame::new(centred.size(), texels))
}
