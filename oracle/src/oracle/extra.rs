//! Further shading samples, by definition: which pixels want one, and what the filter makes of them. See the kernel `sraa_extra`.

use super::{Definition, OracleError, Placed, SraaParams, Tap};
use straightline_scene::inputs::Inputs;

/// Returns the sample at which each pixel wants to be shaded once more, row by row from the top: the first geometry sample that
/// differs by more than `search-threshold` from the surfaces at which the nine pixels around are shaded, and, if x and y have
/// an odd sum, from those that the four pixels beside want. Else it is the number of samples.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the decision needs is missing or does not fit.
pub fn extra_samples(inputs: &Inputs, params: &SraaParams) -> Result<Vec<Placed>, OracleError> {
    let params = SraaParams {
        extra: false,
        ..params.clone()
    };
    let definition = Definition::new(inputs, &params)?;
    let (width, height) = (inputs.size.x as i32, inputs.size.y as i32);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    Ok(pixels.map(|pixel| definition.wanted_sample(pixel)).collect())
}

impl Definition<'_> {
    fn wanted_sample(&self, pixel: [i32; 2]) -> Placed {
        let mut sure = true;
        let mut sample = self.samples.len();
        for k in (0..self.samples.len()).rev() {
            let at = ([0, 0], k);
            let is_wanted = self.is_unseen(pixel, at, &mut sure)
                && ((pixel[0] + pixel[1]) % 2 == 0 || !self.is_wanted_beside(pixel, at, &mut sure));
            if is_wanted {
                sample = k;
            }
        }
        Placed { sample, sure }
    }

    /// Returns whether no nearby pixel is shaded on the surface of a geometry sample.
    fn is_unseen(&self, pixel: [i32; 2], at: ([i32; 2], usize), sure: &mut bool) -> bool {
        let around = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y]));
        let nearest = around.map(|step| {
            let away = [0, 1].map(|axis| at.0[axis] + step[axis]);
            let there = [0, 1].map(|axis| pixel[axis] + away[axis]);
            self.sample_difference(pixel, at, (away, self.gbuffer.shaded_at(there, self.shaded[0])))
        });
        self.is_apart(nearest.fold(f64::INFINITY, f64::min), sure)
    }

    /// Returns whether a pixel beside has a first unseen sample on the surface of this one.
    fn is_wanted_beside(&self, pixel: [i32; 2], at: ([i32; 2], usize), sure: &mut bool) -> bool {
        let beside = [[0, -1], [-1, 0], [1, 0], [0, 1]];
        let samples = 0..self.samples.len();
        beside.into_iter().any(|away| {
            let first = samples.clone().find(|k| self.is_unseen(pixel, (away, *k), sure));
            first.is_some_and(|first| !self.is_apart(self.sample_difference(pixel, at, (away, first)), sure))
        })
    }

    fn sample_difference(&self, pixel: [i32; 2], a: ([i32; 2], usize), b: ([i32; 2], usize)) -> f64 {
        self.difference(&self.point(pixel, a), &self.point(pixel, b))
    }

    fn is_apart(&self, difference: f64, sure: &mut bool) -> bool {
        let most = self.params.search_threshold;
        *sure &= (difference - most).abs() > 1.0e-3 * most.max(1.0e-3);
        difference > most
    }

    /// The further shading samples that a geometry sample may take its colour from.
    pub(super) fn further_taps(&self, pixel: [i32; 2], at: ([i32; 2], usize)) -> Vec<Tap> {
        let radius = self.params.search_radius().max(1);
        let pixels = (-radius..=radius).flat_map(|y| (-radius..=radius).map(move |x| [x, y]));
        let tap = |away: [i32; 2]| {
            let (sample, light) = self.gbuffer.extra_light([0, 1].map(|axis| pixel[axis] + away[axis]))?;
            let tap = (away, sample);
            let square: f64 = (0..2)
                .map(|axis| (self.sample_position(tap)[axis] - self.sample_position(at)[axis]).powi(2))
                .sum();
            Some(Tap {
                at: tap,
                falloff: (-0.5 * square).exp(),
                difference: if tap == at {
                    0.0
                } else {
                    self.sample_difference(pixel, at, tap)
                },
                color: self.repaint_tap(pixel, at, tap, light, true),
                is_earlier: false,
            })
        };
        pixels.filter_map(tap).collect()
    }
}
