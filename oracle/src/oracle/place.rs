//! Placement of each pixel's shading, by definition: see the kernel `sraa_place`.

use super::{Definition, OracleError, Shading, SraaParams};
use straightline_scene::inputs::Inputs;

/// Placement of a pixel's shading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    /// The number of a geometry sample, or the number of samples for the pixel's centre.
    pub sample: usize,
    /// True if 32 bits decide as 64 do: no difference that was compared is all but `unseen`.
    pub sure: bool,
}

/// Returns the placement of each pixel's shading, row by row from the top: at the first geometry sample that differs by more
/// than `unseen` from what lies at the nine pixels' centres around, if x and y have an even sum, and one of the four
/// neighbours' centres does not differ by more from the pixel's own; else at the pixel's centre.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the decision needs is missing or does not fit.
pub fn place_shading(inputs: &Inputs, params: &SraaParams) -> Result<Vec<Placed>, OracleError> {
    let params = SraaParams {
        shading: Shading::Centre,
        ..params.clone()
    };
    let definition = Definition::new(inputs, &params)?;
    let (width, height) = (inputs.size.x as i32, inputs.size.y as i32);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    Ok(pixels.map(|pixel| definition.place_pixel(pixel)).collect())
}

impl Definition<'_> {
    fn place_pixel(&self, pixel: [i32; 2]) -> Placed {
        let samples = self.samples.len();
        let mut placed = Placed {
            sample: samples,
            sure: true,
        };
        if (pixel[0] + pixel[1]) % 2 != 0 {
            return placed;
        }
        let unseen = self.params.unseen;
        let mut is_beyond = |difference: f64| {
            placed.sure &= (difference - unseen).abs() > 1.0e-3 * unseen.max(1.0e-3);
            difference > unseen
        };
        let own = ([0, 0], samples);
        let apart = |a, b| self.difference(&self.point(pixel, a), &self.point(pixel, b));
        let farthest = (0..samples).map(|k| apart(own, ([0, 0], k))).fold(0.0, f64::max);
        if !is_beyond(farthest) {
            return placed;
        }
        let beside = [[0, -1], [-1, 0], [1, 0], [0, 1]].map(|at| apart(own, (at, samples)));
        if is_beyond(beside.into_iter().fold(f64::INFINITY, f64::min)) {
            return placed;
        }
        for sample in 0..samples {
            let around = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y]));
            let nearest = around.map(|at| apart(([0, 0], sample), (at, samples)));
            if is_beyond(nearest.fold(f64::INFINITY, f64::min)) {
                placed.sample = sample;
                return placed;
            }
        }
        placed
    }
}
