//! Reference picture of a perfect filter: many shaded samples in each pixel, averaged.

use super::{RenderError, Renderer};
use glam::{DVec4, Vec2, Vec4, uvec2};
use straightline_kernels::prelude::Frame;

/// Offsets of a regular grid of `side` × `side` samples from a pixel's centre, row by row.
pub fn grid_offsets(side: u32) -> Vec<Vec2> {
    let place = |x, y| (uvec2(x, y).as_vec2() + 0.5) / side as f32 - 0.5;
    (0..side).flat_map(|y| (0..side).map(move |x| place(x, y))).collect()
}

/// The scene supersampled: each pixel the mean of `side` × `side` shaded samples on a regular grid. A side of 4 is 16×, of 16
/// is 256×. `progress` is called after each row of the grid with the number of samples done and of all samples.
///
/// # Errors
///
/// [`RenderError::NoOffsets`] for a side of 0; those of the renderer.
pub fn render_reference(
    renderer: &dyn Renderer,
    side: u32,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Frame<Vec4>, RenderError> {
    let offsets = grid_offsets(side);
    super::check_offsets(&offsets)?;
    let size = renderer.size();
    let mut sums = vec![DVec4::ZERO; (size.x * size.y) as usize];
    let mut done = 0usize;
    // A row at a time: short sums lose nothing in a GPU's 32 bits, and the long one is kept here in 64.
    for row in offsets.chunks(side.max(1) as usize) {
        let mean = renderer.draw_mean(row)?;
        for (sum, texel) in sums.iter_mut().zip(mean.texels()) {
            *sum += texel.as_dvec4() * row.len() as f64;
        }
        done += row.len();
        progress(done, offsets.len());
    }
    Ok(divide_sums(renderer, sums, offsets.len()))
}

/// The default of [`Renderer::mean`].
pub(super) fn mean_of<R: Renderer + ?Sized>(renderer: &R, offsets: &[Vec2]) -> Result<Frame<Vec4>, RenderError> {
    let size = renderer.size();
    let mut sums = vec![DVec4::ZERO; (size.x * size.y) as usize];
    for offset in offsets {
        let shaded = renderer.draw_shaded(*offset)?;
        for (sum, texel) in sums.iter_mut().zip(shaded.texels()) {
            *sum += texel.as_dvec4();
        }
    }
    Ok(divide_sums(renderer, sums, offsets.len()))
}

fn divide_sums<R: Renderer + ?Sized>(renderer: &R, sums: Vec<DVec4>, count: usize) -> Frame<Vec4> {
    let share = 1.0 / count.max(1) as f64;
    let texels = sums.into_iter().map(|sum| (sum * share).as_vec4()).collect();
    Frame::new(renderer.size(), texels)
}
