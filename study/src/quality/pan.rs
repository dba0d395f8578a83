//! Temporal stability: a slow pan by fractions of a pixel.

use super::QualityError;
use super::filters::Filters;
use super::methods::Method;
use super::shot::{Shot, render_supersampled};
use crate::progress::Progress;
use glam::{Vec2, Vec3, Vec4, vec2};
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;
use straightline_scene::render::{Renderer, Shifted};

/// Pixels from frame to frame.
const STEP: Vec2 = vec2(0.125, 0.0625);

/// Side of the grid of shading samples of each frame's reference: 64x.
pub const SIDE: u32 = 8;

/// Returns for each method the root mean squared error of the change between frames, compared with a reference of 64
/// samples a pixel, in colours clamped to 0..=1 at 8 bits of sRGB; `None` for methods that are not measured.
pub fn measure_pan(
    renderer: &dyn Renderer,
    methods: &[Method],
    filters: &mut Filters<'_>,
    frames: u32,
    progress: &mut dyn Progress,
) -> Result<Vec<Option<f64>>, QualityError> {
    let panned: Vec<usize> = (0..methods.len()).filter(|k| methods[*k].panned).collect();
    let changes = measure_changes(
        renderer,
        methods,
        &panned,
        filters,
        (frames, STEP),
        progress,
        &mut |_, _| {},
    )?;
    let mut errors = vec![None; methods.len()];
    for (k, squares) in panned.into_iter().zip(changes) {
        errors[k] = Some((squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt());
    }
    Ok(errors)
}

/// Callback that receives a frame's pictures, and its reference.
pub(super) type See<'a> = dyn FnMut(&[Frame<Vec4>], &Frame<Vec4>) + 'a;

/// Returns for each of the methods `listed`, and each frame after the first, the mean squared error of the change since the
/// previous frame. The picture moves by one step per frame; `see` receives each frame's pictures and its reference, at 8
/// bits.
pub(super) fn measure_changes(
    renderer: &dyn Renderer,
    methods: &[Method],
    listed: &[usize],
    filters: &mut Filters<'_>,
    (frames, step): (u32, Vec2),
    progress: &mut dyn Progress,
    see: &mut See<'_>,
) -> Result<Vec<Vec<f64>>, QualityError> {
    let needed: Vec<&Method> = listed.iter().map(|k| &methods[*k]).collect();
    let mut changes = vec![Vec::new(); listed.len()];
    let mut before: Vec<Frame<Vec4>> = Vec::new();
    for frame in 0..frames {
        let by = step * frame as f32;
        let shot = Shot::draw(&Shifted { renderer, by }, &needed, progress)?;
        let reference = picture::at_eight_bits(&render_supersampled(renderer, SIDE, by, progress)?);
        let shown = listed
            .iter()
            .map(|k| Ok(picture::at_eight_bits(&filters.filter_shot(*k, &shot)?)));
        let shown: Vec<Frame<Vec4>> = shown.collect::<Result<_, QualityError>>()?;
        // Errors of this frame; a change of the error is a wrong change.
        let wrong: Vec<Frame<Vec4>> = shown.iter().map(|picture| error_frame(picture, &reference)).collect();
        for (changes, (now, before)) in changes.iter_mut().zip(wrong.iter().zip(&before)) {
            changes.push(mean_square(now, before));
        }
        before = wrong;
        see(&shown, &reference);
        progress.step();
    }
    Ok(changes)
}

/// Returns the error of a picture.
pub(super) fn error_frame(picture: &Frame<Vec4>, reference: &Frame<Vec4>) -> Frame<Vec4> {
    let shown = |color: &Vec4| color.truncate().clamp(Vec3::ZERO, Vec3::ONE);
    let pairs = picture.texels().iter().zip(reference.texels());
    let texels = pairs.map(|(a, b)| match a.truncate().is_finite() {
        true => (shown(a) - shown(b)).extend(0.0),
        // An error of the whole range.
        false => Vec3::ONE.extend(0.0),
    });
    Frame::new(picture.size(), texels.collect())
}

/// Returns the mean squared difference over red, green and blue.
pub(super) fn mean_square(a: &Frame<Vec4>, b: &Frame<Vec4>) -> f64 {
    let pairs = a.texels().iter().zip(b.texels());
    let sum: f64 = pairs.map(|(a, b)| (*a - *b).as_dvec4().length_squared()).sum();
    sum / (3 * a.texels().len()) as f64
}
