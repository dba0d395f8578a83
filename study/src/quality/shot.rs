//! Everything that methods read of one picture.

use super::methods::{Kind, Method};
use super::{QualityError, check};
use crate::progress::Progress;
use glam::{DVec4, UVec2, Vec2, Vec4};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use straightline_kernels::prelude::Frame;
use straightline_scene::capture::{Capture, ShadingSample, mean};
use straightline_scene::gbuffer;
use straightline_scene::render::{self, Aggregated, Extra, Renderer};

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
            if let Entry::Vacant(vacant) = shot.captures.entry(method.reads()) {
                check(progress)?;
                let samples = gbuffer::samples(method.pattern()).unwrap_or_default();
                vacant.insert(match method.shading() {
                    ShadingSample::Placed => render::capture_placed(renderer, &samples, method.placed_by())?,
                    shading => render::capture(renderer, &samples, shading)?,
                });
            }
            if let Some(capture) = shot.captures.get_mut(&method.reads())
                && method.reads_albedo()
                && capture.albedo.is_none()
            {
                check(progress)?;
                render::add_albedo(capture, renderer)?;
            }
            if let Some(capture) = shot.captures.get_mut(&method.reads())
                && method.reads_guide()
                && capture.guide.is_none()
            {
                check(progress)?;
                render::add_guide(capture, renderer)?;
            }
            if let Some(capture) = shot.captures.get(&method.reads())
                && method.has_extra()
                && !shot.extra.contains_key(&method.reads())
            {
                check(progress)?;
                let pixels = (capture.size.x * capture.size.y) as usize;
                let further = render::extra(renderer, capture, pixels / BUDGET)?;
                shot.extra.insert(method.reads(), further);
            }
            if method.kind == Kind::Aggregated {
                check(progress)?;
                let samples = gbuffer::samples(method.pattern()).unwrap_or_default();
                let shaded = render::aggregated(renderer, &samples)?;
                shot.aggregated.insert(method.pattern().to_owned(), shaded);
            }
            let several = match method.kind {
                Kind::Multisampled | Kind::Directional | Kind::Classified => 4,
                Kind::Covered => 16,
                Kind::Supersampled(several) => several,
                _ => continue,
            };
            if let Entry::Vacant(vacant) = shot.shaded.entry(several) {
                check(progress)?;
                let samples = gbuffer::samples(method.pattern()).unwrap_or_default();
                let shaded = samples.iter().map(|offset| renderer.shaded(*offset));
                vacant.insert(shaded.collect::<Result<_, _>>()?);
            }
        }
        Ok(shot)
    }

    /// Of someone else's capture, which every pattern then stands for.
    pub fn of(capture: Capture) -> Shot {
        Shot {
            captures: BTreeMap::from([(String::new(), capture)]),
            shaded: BTreeMap::new(),
            extra: BTreeMap::new(),
            aggregated: BTreeMap::new(),
        }
    }

    /// The capture for a method.
    pub fn capture(&self, method: &Method) -> Result<&Capture, QualityError> {
        let found = self.captures.get(&method.reads()).or_else(|| self.captures.get(""));
        found.ok_or_else(|| QualityError::NotDrawn(method.name.clone()))
    }

    /// Returns the pixels that are shaded once more for a method, if it wants that.
    pub fn extra(&self, method: &Method) -> Option<&Extra> {
        self.extra.get(&method.reads()).filter(|_| method.has_extra())
    }

    /// Any capture that is shaded at the pixels' centres, or else any: all of those have the same picture.
    pub fn any(&self) -> Result<&Capture, QualityError> {
        let mut captures = self.captures.values();
        let centred = captures
            .clone()
            .find(|capture| capture.shading == ShadingSample::Centre);
        let first = centred.or_else(|| captures.next());
        first.ok_or_else(|| QualityError::NotDrawn("1x".to_owned()))
    }

    /// The picture shaded by aggregates, for a method.
    pub fn aggregated(&self, method: &Method) -> Result<&Aggregated, QualityError> {
        let found = self.aggregated.get(method.pattern());
        found.ok_or_else(|| QualityError::NotDrawn(method.name.clone()))
    }

    /// The picture shaded at each of `samples` samples.
    pub fn shaded(&self, samples: usize) -> Result<&[Frame<Vec4>], QualityError> {
        let found = self.shaded.get(&samples).map(Vec::as_slice);
        found.ok_or_else(|| QualityError::NotDrawn(format!("{samples}x")))
    }

    /// The mean of those.
    pub fn supersampled(&self, samples: usize) -> Result<Frame<Vec4>, QualityError> {
        mean(self.shaded(samples)?).ok_or_else(|| QualityError::NotDrawn(format!("{samples}x")))
    }
}

/// The mean of pictures shaded at `side` x `side` places around `shift`, as [`render::reference`], a step of the progress for
/// each row; ends early on request.
pub fn supersampled(
    renderer: &dyn Renderer,
    side: u32,
    shift: Vec2,
    progress: &mut dyn Progress,
) -> Result<Frame<Vec4>, QualityError> {
    let size: UVec2 = renderer.size();
    let mut sums = vec![DVec4::ZERO; (size.x * size.y) as usize];
    for row in render::grid(side).chunks(side.max(1) as usize) {
        check(progress)?;
        let places: Vec<Vec2> = row.iter().map(|offset| *offset + shift).collect();
        let mean = renderer.mean(&places)?;
        for (sum, texel) in sums.iter_mut().zip(mean.texels()) {
            *sum += texel.as_dvec4();
        }
        progress.step();
    }
    let share = 1.0 / f64::from(side.max(1));
    let texels = sums.into_iter().map(|sum| (sum * share).as_vec4()).collect();
    Ok(Frame::new(size, texels))
}
