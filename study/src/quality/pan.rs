//! Temporal stability: a slow pan by fractions of a pixel.

use super::QualityError;
use super::filters::Filters;
use super::methods::Method;
use super::shot::{Shifted, Shot, supersampled};
use crate::watch::Watch;
use glam::{Vec2, Vec3, Vec4, vec2};
use straightline_kernels::prelude::Frame;
use straightline_testbed::picture;
use straightline_testbed::render::Renderer;

/// Pixels from frame to frame.
pub const STEP: Vec2 = vec2(0.125, 0.0625);

/// Side of the grid of shading samples of each frame's reference: 64x.
pub const SIDE: u32 = 8;

/// For each method, the root of the mean squared error of what changes from a frame to the next, in colours clamped to
/// 0..=1 at 8 bits of sRGB, against what changes in a reference of 64 samples a pixel; `None` for methods that are not watched.
pub fn pan(
    renderer: &dyn Renderer,
    methods: &[Method],
    filters: &mut Filters<'_>,
    frames: u32,
    watch: &mut dyn Watch,
) -> Result<Vec<Option<f64>>, QualityError> {
    let panned: Vec<&Method> = methods.iter().filter(|method| method.panned).collect();
    let mut sums = vec![0.0; methods.len()];
    let mut before: Option<Vec<Option<Frame<Vec4>>>> = None;
    for frame in 0..frames {
        let (shot, reference) = moved(renderer, &panned, STEP * frame as f32, watch)?;
        // What is wrong in this frame: what changes in that is what changes wrongly.
        let mut wrong = Vec::new();
        for (k, method) in methods.iter().enumerate() {
            wrong.push(match method.panned {
                true => Some(apart(&picture::at_eight_bits(&filters.run(k, &shot)?), &reference)),
                false => None,
            });
        }
        for (sum, (now, before)) in sums.iter_mut().zip(wrong.iter().zip(before.iter().flatten())) {
            if let (Some(now), Some(before)) = (now, before) {
                *sum += mean_square(now, before);
            }
        }
        before = Some(wrong);
        watch.step();
    }
    let pairs = f64::from(frames.saturating_sub(1).max(1));
    let error = |(method, sum): (&Method, f64)| method.panned.then(|| (sum / pairs).sqrt());
    Ok(methods.iter().zip(sums).map(error).collect())
}

/// What methods need of a frame that is moved by some pixels, and the reference of it, at 8 bits.
pub(super) fn moved(
    renderer: &dyn Renderer,
    methods: &[&Method],
    by: Vec2,
    watch: &mut dyn Watch,
) -> Result<(Shot, Frame<Vec4>), QualityError> {
    let shot = Shot::draw(&Shifted { renderer, by }, methods, watch)?;
    let reference = supersampled(renderer, SIDE, by, watch)?;
    Ok((shot, picture::at_eight_bits(&reference)))
}

/// What is wrong in a picture.
pub(super) fn apart(picture: &Frame<Vec4>, reference: &Frame<Vec4>) -> Frame<Vec4> {
    let shown = |color: &Vec4| color.truncate().clamp(Vec3::ZERO, Vec3::ONE);
    let pairs = picture.texels().iter().zip(reference.texels());
    let texels = pairs.map(|(a, b)| match a.truncate().is_finite() {
        true => (shown(a) - shown(b)).extend(0.0),
        // Wrong by the whole range.
        false => Vec3::ONE.extend(0.0),
    });
    Frame::new(picture.size(), texels.collect())
}

/// Over red, green and blue.
pub(super) fn mean_square(a: &Frame<Vec4>, b: &Frame<Vec4>) -> f64 {
    let pairs = a.texels().iter().zip(b.texels());
    let sum: f64 = pairs.map(|(a, b)| (*a - *b).as_dvec4().length_squared()).sum();
    sum / (3 * a.texels().len()) as f64
}
