//! The additive guide by definition: see the kernels `sraa_guide` and `sraa_residual`.
//!
//! > g(s) = a(s) (A + max(0, n(s)·l) v(s) L) + e(s), or as an image says; G(p) = Σₛ rₛ g(s) / Σₛ rₛ
//!
//! with the albedo a, the light A from all around, and L from the direction l, of which the share v arrives, and the emitted light e.
//! The first term is 0 where nothing is drawn. A guide with a channel beyond the largest half, or that is not a number, is 0.

use super::gbuffer::{GBuffer, Stored, find_images, find_stored, find_vector};
use super::{Definition, Estimate, Metric, OracleError, Resolved, SraaParams};
use straightline_scene::inputs::Inputs;

/// The largest half.
const BRIGHTEST: f64 = 65504.0;

/// Returns the mean of the guide over the geometry samples of each pixel, row by row from the top.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the guide needs is missing or does not fit.
pub fn guide(inputs: &Inputs, params: &SraaParams) -> Result<Vec<[f64; 3]>, OracleError> {
    let params = params_of_the_guide(params);
    let definition = Definition::new(inputs, &params)?;
    let guide = Guide::new(inputs, &params)?;
    let mean = |pixel: [i32; 2]| {
        let (mut sum, mut shares) = ([0.0; 3], 0.0);
        for (at, share) in definition.sample_shares() {
            let own = guide.at(&definition, pixel, at);
            for (sum, channel) in sum.iter_mut().zip(own) {
                *sum += share * channel;
            }
            shares += share;
        }
        sum.map(|axis| axis / shares)
    };
    Ok(pixels(inputs).map(mean).collect())
}

/// Returns the difference of each pixel's colour from the guide where it is shaded, row by row from the top.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the guide needs is missing or does not fit.
pub fn residual(inputs: &Inputs, params: &SraaParams) -> Result<Vec<[f64; 4]>, OracleError> {
    let params = params_of_the_guide(params);
    let definition = Definition::new(inputs, &params)?;
    let guide = Guide::new(inputs, &params)?;
    let color = &find_images(inputs, "color", 1)?[0];
    let difference = |(pixel, color): ([i32; 2], &glam::Vec4)| {
        let sample = definition.gbuffer.shaded_at(pixel, definition.shaded[0]);
        let [red, green, blue] = guide.at(&definition, pixel, ([0, 0], sample));
        let color = color.to_array().map(f64::from);
        [color[0] - red, color[1] - green, color[2] - blue, color[3]]
    };
    Ok(pixels(inputs).zip(color.texels()).map(difference).collect())
}

/// Returns the scale by which the guide is nearest to the colours where pixels are shaded: k = Σ w c·g / Σ w g·g from 0 to 1.5, with
/// w = 1 / (c·c + g·g + 10⁻⁴), without colours that are not finite; 0 without a guide anywhere. Up to a quarter from 1 it is 1, and
/// from a half on k, with a straight line for the share of k − 1 between.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the guide needs is missing or does not fit.
pub fn scale(inputs: &Inputs, params: &SraaParams) -> Result<f64, OracleError> {
    let params = SraaParams {
        fitted: false,
        ..params_of_the_guide(params)
    };
    let differences = residual(inputs, &params)?;
    let (mut both, mut own) = (0.0, 0.0);
    for (color, difference) in find_images(inputs, "color", 1)?[0].texels().iter().zip(differences) {
        if !color.is_finite() {
            continue;
        }
        let color = color.to_array().map(f64::from);
        let guide = [0, 1, 2].map(|axis| color[axis] - difference[axis]);
        let dot = |a: &[f64], b: &[f64]| -> f64 { (0..3).map(|axis| a[axis] * b[axis]).sum() };
        let weight = 1.0 / (dot(&color, &color) + dot(&guide, &guide) + 1.0e-4);
        both += weight * dot(&color, &guide);
        own += weight * dot(&guide, &guide);
    }
    let apart = match own > 0.0 {
        true => (both / own).clamp(0.0, 1.5) - 1.0,
        false => -1.0,
    };
    Ok(1.0 + apart * (4.0 * apart.abs() - 1.0).clamp(0.0, 1.0))
}

/// Parameters under which depth and normals are read, whatever the filter compares.
fn params_of_the_guide(params: &SraaParams) -> SraaParams {
    let metric = match params.estimate {
        Estimate::Given => params.metric,
        Estimate::Diffuse | Estimate::Emissive => Metric::PlanesNormals,
    };
    SraaParams {
        metric,
        guide: false,
        ..params.clone()
    }
}

fn pixels(inputs: &Inputs) -> impl Iterator<Item = [i32; 2]> {
    let (width, height) = (inputs.size.x as i32, inputs.size.y as i32);
    (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
}

/// Parts of the guide at every sample.
struct Guide<'a> {
    given: Option<Stored<'a>>,
    albedo: Option<Stored<'a>>,
    emission: Option<Stored<'a>>,
    /// Direction and colour of the light, and the light from all around.
    light: [[f64; 3]; 3],
    scale: f64,
}

impl<'a> Guide<'a> {
    fn new(inputs: &'a Inputs, params: &'a SraaParams) -> Result<Self, OracleError> {
        let samples = params.sample_offsets().len();
        let stored = |name: &str| find_stored(inputs, params, samples, name);
        let none = Guide {
            given: None,
            albedo: None,
            emission: None,
            light: [[0.0; 3]; 3],
            scale: match params.fitted {
                true => f64::from(find_images(inputs, "guide_scale", 1)?[0].texels()[0].x),
                false => 1.0,
            },
        };
        if params.estimate == Estimate::Given {
            return Ok(Guide {
                given: Some(stored("guide")?),
                ..none
            });
        }
        let emits = params.estimate == Estimate::Emissive;
        Ok(Guide {
            albedo: Some(stored("albedo")?),
            emission: emits.then(|| stored("emission")).transpose()?,
            light: [
                find_vector(inputs, "light_direction")?,
                find_vector(inputs, "light_color")?,
                find_vector(inputs, "ambient")?,
            ],
            ..none
        })
    }

    /// The guide at a geometry sample of a pixel.
    fn at(&self, definition: &Definition<'_>, pixel: [i32; 2], at: ([i32; 2], usize)) -> [f64; 3] {
        let gbuffer = &definition.gbuffer;
        let there = gbuffer.clamp_pixel([0, 1].map(|axis| pixel[axis] + at.0[axis]));
        let read = |stored: &Option<Stored<'_>>| {
            let texel = stored.as_ref().map(|stored| gbuffer.texel(stored, there, at.1));
            texel.unwrap_or([0.0; 4])
        };
        let [mut red, mut green, mut blue, _] = read(&self.given);
        if self.albedo.is_some() {
            let (albedo, emitted) = (read(&self.albedo), read(&self.emission));
            let light = self.arriving(definition, pixel, at, albedo[3]);
            let channel = |axis: usize| light.map_or(0.0, |light| albedo[axis] * light[axis]) + emitted[axis];
            [red, green, blue] = [0, 1, 2].map(channel);
        }
        let counts = |guide: &[f64; 3]| guide.iter().all(|channel| channel.abs() <= BRIGHTEST);
        let scaled = [red, green, blue].map(|channel| self.scale * channel);
        if counts(&[red, green, blue]) && counts(&scaled) {
            scaled
        } else {
            [0.0; 3]
        }
    }

    /// Light on the surface at a sample; none where nothing is drawn.
    fn arriving(
        &self,
        definition: &Definition<'_>,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        visible: f64,
    ) -> Option<[f64; 3]> {
        let point = definition.point(pixel, at);
        if !definition.gbuffer.is_drawn(&point) {
            return None;
        }
        let [direction, color, ambient] = self.light;
        let facing: f64 = (0..3).map(|axis| point.normal[axis] * direction[axis]).sum();
        let visible = if visible > 0.0 { visible.min(1.0) } else { 0.0 };
        let share = if facing > 0.0 { facing * visible } else { 0.0 };
        Some([0, 1, 2].map(|axis| ambient[axis] + share * color[axis]))
    }
}

/// Adds the mean of a pixel's guide to what is filtered; no channel of the sum is below 0.
pub(super) fn guided(gbuffer: &GBuffer<'_>, pixel: [i32; 2], filtered: Resolved) -> Resolved {
    let Some(mean) = gbuffer.guide_mean(pixel) else {
        return filtered;
    };
    let counts = mean.iter().all(|channel| channel.abs() <= BRIGHTEST);
    let mut color = filtered.color;
    for (channel, own) in color.iter_mut().zip(mean) {
        *channel += if counts { own } else { 0.0 };
        if *channel < 0.0 {
            *channel = 0.0;
        }
    }
    Resolved { color, ..filtered }
}
