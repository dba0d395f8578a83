//! Everything that methods read of one picture.

use super::methods::{Method, MethodKind};
use super::{QualityError, check_stopped};
use crate::progress::Progress;
use glam::{DVec4, UVec2, Vec2, Vec4};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use straightline_kernels::prelude::Frame;
use straightline_scene::capture::{Capture, ShadingSample, mean_frame};
use straightline_scene::gbuffer;
use straightline_scene::render::{self, Aggregated, Extra, GuideLight, Renderer};

/// Of so many pixels one may be shaded once more: 2 %.
pub const BUDGET: usize = 50;

/// A picture shaded once a pixel, its geometry in several patterns, and the same shaded at every sample.
pub struct Shot {
    /// By what methods read: the pattern's name, and where shading is sampled unless at the pixel's centre.
    pub captures: BTreeMap<String, Capture>,
    /// Shaded at each sample of `latin4`, and of `latin16`; none of a capture.
    pub shaded: BTreeMap<usize, Vec<Frame<Vec4>>>,
    /// Pixels of a capture that are shaded once more, by what names it.
    pub extra: BTreeMap<String, Extra>,
    /// Shaded by aggregates of the samples of a pattern.
    pub aggregated: BTreeMap<String, Aggregated>,
}

impl Shot {
    /// Draws the inputs of `methods`.
    pub fn draw(
        renderer: &dyn Renderer,
        methods: &[&Method],
        progress: &mut dyn Progress,
    ) -> Result<Shot, QualityError> {
        let mut shot = Shot {
            captures: BTreeMap::new(),
            shaded: BTreeMap::new(),
            extra: BTreeMap::new(),
            aggregated: BTreeMap::new(),
        };
        for method in methods {
            if let Entry::Vacant(vacant) = shot.captures.entry(method.capture_name()) {
                check_stopped(progress)?;
                let samples = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
                vacant.insert(match method.shading_sample() {
                    ShadingSample::Placed => render::capture_placed(renderer, &samples, method.placed_by())?,
                    shading => render::capture_scene(renderer, &samples, shading)?,
                });
            }
            if let Some(capture) = shot.captures.get_mut(&method.capture_name())
                && method.reads_albedo()
                && capture.albedo.is_none()
            {
                check_stopped(progress)?;
                render::add_albedo(capture, renderer)?;
            }
            if let Some(capture) = shot.captures.get_mut(&method.capture_name())
                && method.reads_guide()
                && capture.guide.is_none()
            {
                check_stopped(progress)?;
                render::add_guide(capture, renderer, GuideLight::default())?;
            }
            if let Some(capture) = shot.captures.get(&method.capture_name())
                && method.has_extra()
                && !shot.extra.contains_key(&method.capture_name())
            {
                check_stopped(progress)?;
                let pixels = (capture.size.x * capture.size.y) as usize;
                let further = render::shade_extra(renderer, capture, pixels / BUDGET)?;
                shot.extra.insert(method.capture_name(), further);
            }
            if method.kind == MethodKind::Aggregated {
                check_stopped(progress)?;
                let samples = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
                let shaded = render::render_aggregated(renderer, &samples)?;
                shot.aggregated.insert(method.pattern().to_owned(), shaded);
            }
            let several = match method.kind {
                MethodKind::Multisampled | MethodKind::Directional | MethodKind::Classified => 4,
                MethodKind::Covered => 16,
                MethodKind::Supersampled(several) => several,
                _ => continue,
            };
            if let Entry::Vacant(vacant) = shot.shaded.entry(several) {
                check_stopped(progress)?;
                let samples = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
                let shaded = samples.iter().map(|offset| renderer.draw_shaded(*offset));
                vacant.insert(shaded.collect::<Result<_, _>>()?);
            }
        }
        Ok(shot)
    }

    /// Of someone else's capture, which every pattern then stands for.
    pub fn from_capture(capture: Capture) -> Shot {
        Shot {
            captures: BTreeMap::from([(String::new(), capture)]),
            shaded: BTreeMap::new(),
            extra: BTreeMap::new(),
            aggregated: BTreeMap::new(),
        }
    }

    /// The capture for a method.
    pub fn capture_for(&self, method: &Method) -> Result<&Capture, QualityError> {
        let found = self
            .captures
            .get(&method.capture_name())
            .or_else(|| self.captures.get(""));
        found.ok_or_else(|| QualityError::NotDrawn(method.name.clone()))
    }

    /// Returns the pixels that are shaded once more for a method, if it wants that.
    pub fn extra_for(&self, method: &Method) -> Option<&Extra> {
        self.extra.get(&method.capture_name()).filter(|_| method.has_extra())
    }

    /// Any capture that is shaded at the pixels' centres, or else any: all of those have the same picture.
    pub fn any_capture(&self) -> Result<&Capture, QualityError> {
        let mut captures = self.captures.values();
        let centred = captures
            .clone()
            .find(|capture| capture.shading == ShadingSample::Centre);
        let first = centred.or_else(|| captures.next());
        first.ok_or_else(|| QualityError::NotDrawn("1x".to_owned()))
    }

    /// The picture shaded by aggregates, for a method.
    pub fn aggregated_for(&self, method: &Method) -> Result<&Aggregated, QualityError> {
        let found = self.aggregated.get(method.pattern());
        found.ok_or_else(|| QualityError::NotDrawn(method.name.clone()))
    }

    /// The picture shaded at each of `samples` samples.
    pub fn shaded_frames(&self, samples: usize) -> Result<&[Frame<Vec4>], QualityError> {
        let found = self.shaded.get(&samples).map(Vec::as_slice);
        found.ok_or_else(|| QualityError::NotDrawn(format!("{samples}x")))
    }

    /// The mean of those.
    pub fn supersampled_mean(&self, samples: usize) -> Result<Frame<Vec4>, QualityError> {
        mean_frame(self.shaded_frames(samples)?).ok_or_else(|| QualityError::NotDrawn(format!("{samples}x")))
    }
}

/// The mean of pictures shaded at `side` x `side` places around `shift`, as [`render::reference`], a step of the progress for
/// each row; ends early on request.
pub fn render_supersampled(
    renderer: &dyn Renderer,
    side: u32,
    shift: Vec2,
    progress: &mut dyn Progress,
) -> Result<Frame<Vec4>, QualityError> {
    let size: UVec2 = renderer.size();
    let mut sums = vec![DVec4::ZERO; (size.x * size.y) as usize];
    for row in render::grid_offsets(side).chunks(side.max(1) as usize) {
        check_stopped(progress)?;
        let places: Vec<Vec2> = row.iter().map(|offset| *offset + shift).collect();
        let mean = renderer.draw_mean(&places)?;
        for (sum, texel) in sums.iter_mut().zip(mean.texels()) {
            *sum += texel.as_dvec4();
        }
        progress.step();
    }
    let share = 1.0 / f64::from(side.max(1));
    let texels = sums.into_iter().map(|sum| (sum * share).as_vec4()).collect();
    Ok(Frame::new(size, texels))
}
