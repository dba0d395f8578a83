//! Shading once a pixel, where geometry asks for it.

use super::{RenderError, Renderer};
use crate::capture::{Capture, MAX_SAMPLES};
use crate::gbuffer;
use glam::{IVec2, Vec2, Vec3, Vec4, ivec2};
use rayon::prelude::*;
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_kernels::sraa::{Difference, GBuffer, History, Metric, Pattern, Projection, Sraa, View, sraa_place};

/// Offsets that differ: with this metric it is only counted how many there are.
pub(crate) static OFFSETS: [f32; 2 * MAX_SAMPLES] = {
    let mut offsets = [0.0; 2 * MAX_SAMPLES];
    let mut k = 0;
    while k < offsets.len() {
        offsets[k] = k as f32;
        k += 1;
    }
    offsets
};

/// Metric by which surfaces differ where shading is placed, or done once more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlacedBy {
    /// Depths and normals. A step of a third of the depth is between unrelated surfaces.
    Depths,
    /// Planes and normals, by which ground that recedes is one surface: much less is a difference then. A step of a tenth of the depth is
    /// between unrelated surfaces.
    Planes,
}

impl PlacedBy {
    /// Returns the metric that goes with the options of a filter.
    pub fn from_options(options: &OptionValues) -> PlacedBy {
        match options.choice("metric") {
            Some("planes-normals") => PlacedBy::Planes,
            _ => PlacedBy::Depths,
        }
    }

    /// Options of the kernels `sraa_place` and `sraa_extra`, and of a filter that goes with them.
    pub const fn options(self) -> &'static [(&'static str, &'static str)] {
        match self {
            PlacedBy::Depths => &[
                ("metric", "depth-normals"),
                ("difference", "relative"),
                ("depth-scale", "3"),
            ],
            PlacedBy::Planes => &[
                ("metric", "planes-normals"),
                ("difference", "relative"),
                ("depth-scale", "10"),
                ("unseen", "0.003"),
                ("search-threshold", "0.004"),
            ],
        }
    }

    /// `options` with these in the place of their own.
    pub fn instead_of(self, options: &[(String, String)]) -> Vec<(String, String)> {
        let own = self.options();
        let others = options
            .iter()
            .filter(|(name, _)| own.iter().all(|(known, _)| known != name));
        let own = own
            .iter()
            .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        others.cloned().chain(own).collect()
    }

    /// [`options`](Self::options) for a camera with parallel rays, as [`gbuffer::in_parallel`] has them.
    fn settings_in_parallel(self, height: f32) -> Sraa {
        let settings = self.settings();
        Sraa {
            projection: Projection::Parallel,
            difference: Difference::Absolute,
            depth_scale: settings.depth_scale / height,
            ..settings
        }
    }

    /// Settings of the kernels as rustc compiles them.
    fn settings(self) -> Sraa {
        let relative = Sraa {
            difference: Difference::Relative,
            depth_scale: 3.0,
            ..Sraa::default()
        };
        match self {
            PlacedBy::Depths => relative,
            PlacedBy::Planes => Sraa {
                metric: Metric::PlanesNormals,
                depth_scale: 10.0,
                unseen: 0.003,
                search_threshold: 0.004,
                ..relative
            },
        }
    }
}

/// Inputs, from a G-buffer, of the kernels that place shading.
pub(super) struct Surfaces {
    pub(super) cfg: Sraa,
    pub(super) gbuffer: GBuffer,
    pub(super) view: View,
}

impl Surfaces {
    /// Of a capture; `None` if it has no normals, or no camera to know planes by.
    pub(super) fn new(capture: &Capture, by: PlacedBy) -> Option<Surfaces> {
        let (depth, normal) = (&capture.depth, capture.normal.as_ref()?);
        let pattern = gbuffer::pattern_of(&capture.samples);
        let cfg = Sraa {
            pattern: pattern.unwrap_or(Pattern::Listed),
            offsets: match pattern {
                Some(_) => &[],
                None => &OFFSETS[..2 * capture.samples.len().min(MAX_SAMPLES)],
            },
            ..match capture.camera.and_then(|camera| camera.parallel_height) {
                Some(height) => by.settings_in_parallel(height),
                None => by.settings(),
            }
        };
        // Rays through the picture's corner and straight ahead, of which one projection each has use, and their steps.
        let [corner, ahead, right, down] = match (by, capture.perspective_rays(), capture.parallel_rays()) {
            (PlacedBy::Depths, ..) => [Vec3::ZERO; 4],
            // Of a pattern without a name it is not known where a sample lies.
            (PlacedBy::Planes, ..) if pattern.is_none() => return None,
            (PlacedBy::Planes, Some([corner, right, down]), _) => [corner, Vec3::ZERO, right, down],
            (PlacedBy::Planes, None, Some([ahead, right, down])) => [Vec3::ZERO, ahead, right, down],
            (PlacedBy::Planes, None, None) => return None,
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
            ray_corner: corner,
            ray_right: right,
            ray_down: down,
            ray_forward: ahead,
            origin: IVec2::ZERO,
            near: 1.0,
            far: 1.0,
        };
        Some(Surfaces { cfg, gbuffer, view })
    }
}

/// Pixels shaded once, where the kernel `sraa_place` places them.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Of each pixel the number of the geometry sample at which it is shaded, or the number of samples for its centre.
    pub place: Frame<u32>,
    /// Linear colours there.
    pub color: Frame<Vec4>,
    /// The direct light there as it would be without a shadow, if the capture has that.
    pub direct: Option<Frame<Vec4>>,
    /// Part of the colour there that does not follow the albedo, if the capture has that.
    pub rest: Option<Frame<Vec4>>,
}

/// Shades the pixels of a capture that `renderer` drew, and that is shaded at their centres, where the kernel `sraa_place` says
/// instead. `None` of a capture without normals, and by planes of one without a camera or of samples that lie at no pattern
/// that has a name.
///
/// # Errors
///
/// What the renderer refuses.
pub fn shade_placed(capture: &Capture, renderer: &dyn Renderer, by: PlacedBy) -> Result<Option<Placed>, RenderError> {
    shade_placed_aside(capture, renderer, by, Vec2::ZERO)
}

/// [`shade_placed`] for a capture that is shaded `jitter` from the centres of its pixels. `renderer` draws the picture moved by that.
pub(crate) fn shade_placed_aside(
    capture: &Capture,
    renderer: &dyn Renderer,
    by: PlacedBy,
    jitter: Vec2,
) -> Result<Option<Placed>, RenderError> {
    let Some(place) = choose_places(capture, by, jitter) else {
        return Ok(None);
    };
    let mut places: Vec<Vec2> = capture.samples.iter().map(|at| *at - jitter).collect();
    places.push(Vec2::ZERO);
    let moved = |centred: &Frame<Vec4>, drawn: &dyn Fn(Vec2) -> Result<Frame<Vec4>, RenderError>| {
        gather_placed(&places, &place, centred.clone(), drawn)
    };
    let color = moved(&capture.color, &|offset| renderer.draw_shaded(offset))?;
    let direct = capture.direct.as_ref();
    let direct = direct.map(|centred| moved(centred, &|offset| renderer.draw_sunlight(offset)));
    let rest = capture.rest.as_ref();
    let rest = rest.map(|centred| moved(centred, &|offset| renderer.draw_unpainted(offset)));
    Ok(Some(Placed {
        color,
        direct: direct.transpose()?,
        rest: rest.transpose()?,
        place,
    }))
}

/// The layer in whose place each pixel is to be shaded: the kernel `sraa_place`, as rustc compiles it.
fn choose_places(capture: &Capture, by: PlacedBy, jitter: Vec2) -> Option<Frame<u32>> {
    let Surfaces { cfg, gbuffer, view } = &Surfaces::new(capture, by)?;
    let cfg = &Sraa {
        // Only with earlier frames is shading anywhere else than at the centre.
        history: i32::from(jitter != Vec2::ZERO),
        ..*cfg
    };
    let history = &History {
        jitter,
        ..History::unread()
    };
    let size = capture.size;
    let rows = (0..size.y as i32).into_par_iter();
    let place = |x, y| sraa_place(cfg, gbuffer, view, history, ivec2(x, y));
    let texels = rows.flat_map_iter(|y| (0..size.x as i32).map(move |x| place(x, y)));
    Some(Frame::new(size, texels.collect()))
}

/// The picture with each pixel drawn in the place of the layer that `chosen` names, of those at `places`; `centred` is drawn in the
/// last place.
pub(crate) fn gather_placed(
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
