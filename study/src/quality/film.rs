//! Frames of a slow pan with methods side by side, and the error of the change between frames: the comparison of the SRAA
//! paper's web page.

use super::filters::Filters;
use super::pan::{self, measure_changes};
use super::{Method, QualityError};
use crate::progress::Progress;
use glam::{UVec2, Vec2, Vec4};
use straightline_bench::execute::Bench;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;
use straightline_scene::render::GpuRenderer;
use straightline_scene::scene::Scene;

/// Setup of a film.
#[derive(Clone, Debug)]
pub struct Shooting {
    /// Width and height of each method's picture, in pixels.
    pub size: UVec2,
    /// Number of frames, 2 or more.
    pub frames: u32,
    /// Pixels by which the picture moves from frame to frame, y down.
    pub step: Vec2,
}

/// Result of filming.
#[derive(Clone, Debug)]
pub struct Film {
    /// Each frame: the methods' pictures row by row, then the reference of 64 samples a pixel, at 8 bits of sRGB.
    pub frames: Vec<Frame<Vec4>>,
    /// For each method and each frame after the first: the root mean squared error of the change since the previous frame,
    /// as [`Setup::pan_frames`](super::Setup::pan_frames) averages it.
    pub errors: Vec<Vec<f64>>,
}

/// Films a scene.
///
/// # Errors
///
/// [`QualityError`], if something cannot be drawn or run, or `progress` requests a stop.
pub fn film_scene(
    bench: &Bench,
    scene: &Scene,
    methods: &[Method],
    shooting: &Shooting,
    progress: &mut dyn Progress,
) -> Result<Film, QualityError> {
    let steps = methods.len() + shooting.frames as usize * (pan::SIDE as usize + 1);
    progress.begin("film", steps);
    let renderer = GpuRenderer::new(bench.device(), bench.queue(), scene, shooting.size)?;
    let methods: Vec<Method> = methods.iter().map(|method| method.for_camera(&scene.camera)).collect();
    let mut filters = Filters::new(bench, &methods, shooting.size, progress)?;
    let all: Vec<usize> = (0..methods.len()).collect();
    let mut frames = Vec::new();
    let mut see = |shown: &[Frame<Vec4>], reference: &Frame<Vec4>| {
        let mut panes: Vec<(&str, &Frame<Vec4>)> = Vec::new();
        panes.extend(methods.iter().map(|method| method.name.as_str()).zip(shown));
        panes.push((REFERENCE, reference));
        frames.push(tile_pictures(&panes));
    };
    let pan = (shooting.frames, shooting.step);
    let mut errors = measure_changes(&renderer, &methods, &all, &mut filters, pan, progress, &mut see)?;
    errors.iter_mut().flatten().for_each(|error| *error = error.sqrt());
    Ok(Film { frames, errors })
}

/// Arranges pictures with their names: up to three in one row, more in about as many rows as columns.
fn tile_pictures(pictures: &[(&str, &Frame<Vec4>)]) -> Frame<Vec4> {
    let columns = match pictures.len() {
        few @ 0..=3 => few.max(1),
        many => (many as f64).sqrt().ceil() as usize,
    };
    let rows: Vec<Frame<Vec4>> = pictures.chunks(columns).map(picture::compose_montage).collect();
    let width = rows.iter().map(|row| row.size().x).max().unwrap_or(1);
    let mut texels = Vec::new();
    for row in &rows {
        for line in row.texels().chunks(row.size().x as usize) {
            texels.extend_from_slice(line);
            texels.resize(texels.len() + width as usize - line.len(), Vec4::W);
        }
    }
    let height = texels.len() as u32 / width;
    Frame::new(UVec2::new(width, height), texels)
}

/// Name of the reference.
pub const REFERENCE: &str = "64x";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_stand_in_rows() {
        let picture = Frame::new(UVec2::new(40, 20), vec![Vec4::ONE; 800]);
        let panes = [("a", &picture); 5];
        let [one, three, four, five] = [1, 3, 4, 5].map(|count| tile_pictures(&panes[..count]).size());
        assert_eq!(one.y, three.y);
        assert_eq!((four.y, five.y), (2 * one.y, 2 * one.y));
        assert!(one.x < four.x && four.x < three.x && five.x == three.x);
    }
}
