//! Shading samples of earlier frames, each where it has moved to.

use super::gbuffer::{DEEPEST, Point};
use super::{Definition, Demodulate, Metric, OracleError, Shading, SraaParams, Tap};
use straightline_kernels::prelude::{Frame, Vec4};
use straightline_scene::inputs::Inputs;

/// No surface moves farther, by definition of the filter.
const FARTHEST: f64 = 16384.0;

/// Inputs of earlier frames.
pub(super) struct History<'a> {
    /// Position in its pixel at which this frame is shaded.
    pub(super) jitter: [f64; 2],
    frames: Vec<Earlier<'a>>,
}

/// An earlier frame.
struct Earlier<'a> {
    color: &'a Frame<Vec4>,
    /// Part of the colour that does not follow the albedo, where that is known.
    rest: Option<&'a Frame<Vec4>>,
    surface: &'a Frame<Vec4>,
    motion: &'a Frame<Vec4>,
    /// Position of each sample from where its pixel is shaded unless geometry moves it, where planes need it.
    place: Option<&'a Frame<Vec4>>,
}

impl<'a> History<'a> {
    pub(super) fn new(inputs: &'a Inputs, params: &SraaParams) -> Result<Self, OracleError> {
        if params.history == 0 {
            return Ok(History {
                jitter: [0.0; 2],
                frames: Vec::new(),
            });
        }
        let missing = |name: &str, needed: &str| OracleError::Input {
            name: name.to_owned(),
            needed: needed.to_owned(),
        };
        let layers = |name: &str| {
            let found = inputs.images.iter().rev().find(|(known, _)| known == name);
            let layers = found.map(|(_, layers)| layers.as_slice()).unwrap_or_default();
            match layers.len() >= params.history {
                true => Ok(layers),
                false => Err(missing(name, "an image for each earlier frame")),
            }
        };
        let [color, surface, motion] = [
            layers("history_color")?,
            layers("history_surface")?,
            layers("history_motion")?,
        ];
        let rest = match params.demodulate {
            Demodulate::Albedo | Demodulate::AlbedoShadow if params.rest => Some(layers("history_rest")?),
            _ => None,
        };
        let place = match (params.shading, params.metric) {
            (Shading::Placed, Metric::PlanesNormals) => Some(layers("history_place")?),
            _ => None,
        };
        let jitter = inputs.uniforms.iter().rev().find(|(known, _)| known == "jitter");
        let jitter = jitter.and_then(|(_, numbers)| numbers.as_slice().try_into().ok());
        let frame = |k: usize| Earlier {
            color: &color[k],
            rest: rest.map(|rest| &rest[k]),
            surface: &surface[k],
            motion: &motion[k],
            place: place.map(|place| &place[k]),
        };
        Ok(History {
            jitter: jitter.ok_or_else(|| missing("jitter", "two numbers"))?,
            frames: (0..params.history).map(frame).collect(),
        })
    }
}

impl Definition<'_> {
    /// Shading samples of earlier frames that have come within `reach` pixels of the one that is filtered, and near enough
    /// to its sample `at` for a `falloff`.
    pub(super) fn earlier_taps(
        &self,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        reach: f64,
        falloff: impl Fn([f64; 2]) -> f64,
    ) -> Vec<Tap> {
        let centre = self.point(pixel, at);
        let place = self.sample_position(at);
        let mut taps = Vec::new();
        for frame in &self.history.frames {
            let [x, y, deeper, _] = texel(frame.motion, pixel);
            if !(x.abs() < FARTHEST && y.abs() < FARTHEST) {
                continue;
            }
            let size = frame.color.size().as_ivec2();
            for row in 0..size.y {
                for column in 0..size.x {
                    // The sample's present place, from the centre of the pixel.
                    let now = [f64::from(column - pixel[0]) - x, f64::from(row - pixel[1]) - y];
                    let falloff = falloff([now[0] - place[0], now[1] - place[1]]);
                    if !(now.iter().all(|axis| *axis > -reach && *axis <= reach) && falloff > 0.0) {
                        continue;
                    }
                    let [nx, ny, nz, depth] = texel(frame.surface, [column, row]);
                    // The sky is as deep as the far plane.
                    let depth = (depth - deeper).min(self.gbuffer.deepest_depth());
                    let moved = frame.place.map_or([0.0; 4], |place| texel(place, [column, row]));
                    let [base, ray] = self
                        .gbuffer
                        .ray([0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + now[axis] + moved[axis]));
                    let seen = Point {
                        depth: if depth.abs() < DEEPEST { depth } else { DEEPEST },
                        normal: self.gbuffer.compared_normal([nx, ny, nz]),
                        base,
                        ray,
                    };
                    taps.push(Tap {
                        at: ([column - pixel[0], row - pixel[1]], usize::MAX),
                        falloff,
                        difference: self.difference(&centre, &seen).max(0.0),
                        color: self.repaint_earlier(frame, (pixel, at), [column, row]),
                        is_earlier: true,
                    });
                }
            }
        }
        taps
    }

    /// The colour of an earlier frame's shading sample, which is light where paint is known, on the paint of the geometry
    /// sample `at`.
    fn repaint_earlier(
        &self,
        frame: &Earlier,
        (pixel, at): ([i32; 2], ([i32; 2], usize)),
        there: [i32; 2],
    ) -> [f64; 4] {
        let color = texel(frame.color, there);
        let own = [pixel[0] + at.0[0], pixel[1] + at.0[1]];
        let Some((albedo, _)) = self.gbuffer.surface_paint(own, at.1) else {
            return color;
        };
        let rest = frame.rest.map_or([0.0; 4], |rest| texel(rest, there));
        let channel = |axis: usize| albedo[axis] * color[axis] + rest[axis];
        [channel(0), channel(1), channel(2), color[3]]
    }
}

fn texel(frame: &Frame<Vec4>, at: [i32; 2]) -> [f64; 4] {
    let texel = frame.texels()[at[1] as usize * frame.size().x as usize + at[0] as usize];
    texel.to_array().map(f64::from)
}
