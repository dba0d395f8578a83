//! The additive guide by definition: see the kernels `sraa_guide` and `sraa_residual`.
//!
//! > g(s) = a(s) (A + max(0, n(s)·l) v(s) L) + e(s), or as an image says; G(p) = Σₛ rₛ g(s) / Σₛ rₛ
//!
//! with the albedo a, the light A from all around, and L from the direction l, of which the share v arrives, and the emitted light e.
//! The first term is 0 where nothing is drawn. A guide with a channel beyond the largest half, or that is not a number, is 0.

use super::gbuffer::{GBuffer, Stored, find_images, find_stored, find_vector};
use super::{Definition, Estimate, Metric, OracleError, Resolved, SraaParams};
use glam::Vec4;
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
    let guides = shaded_guides(inputs, params)?;
    let colors = find_images(inputs, "color", 1)?[0].texels();
    let difference = |(color, guide): (&Vec4, [f64; 3])| {
        let [red, green, blue, alpha] = color.to_array().map(f64::from);
        [red - guide[0], green - guide[1], blue - guide[2], alpha]
    };
    Ok(colors.iter().zip(guides).map(difference).collect())
}

/// Returns the guide where each pixel is shaded.
fn shaded_guides(inputs: &Inputs, params: &SraaParams) -> Result<Vec<[f64; 3]>, OracleError> {
    let params = params_of_the_guide(params);
    let definition = Definition::new(inputs, &params)?;
    let guide = Guide::new(inputs, &params)?;
    let at = |pixel: [i32; 2]| {
        let sample = definition.gbuffer.shaded_at(pixel, definition.shaded[0]);
        guide.at(&definition, pixel, ([0, 0], sample))
    };
    Ok(pixels(inputs).map(at).collect())
}

/// Returns the scale of each channel at which the colours differ from the guide most evenly where pixels are shaded:
/// k = Σ w Δc Δg / Σ w Δg Δg from 0 to 4, with w = 1 / (Δc Δc + Δg Δg + 10⁻⁴), over the steps Δ between pixels that share an edge,
/// both with finite colours; 0 if the guide is the same everywhere.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the guide needs is missing or does not fit.
pub fn scale(inputs: &Inputs, params: &SraaParams) -> Result<[f64; 3], OracleError> {
    let params = SraaParams {
        fitted: false,
        ..params.clone()
    };
    let guides = shaded_guides(inputs, &params)?;
    let colors = find_images(inputs, "color", 1)?[0].texels();
    let (width, height) = (inputs.size.x as usize, inputs.size.y as usize);
    let beside = (0..height).flat_map(|y| (1..width).map(move |x| (y * width + x - 1, y * width + x)));
    let below = (1..height).flat_map(|y| (0..width).map(move |x| ((y - 1) * width + x, y * width + x)));
    let (mut both, mut own) = ([0.0; 3], [0.0; 3]);
    for (from, to) in beside.chain(below) {
        if !colors[from].is_finite() || !colors[to].is_finite() {
            continue;
        }
        for axis in 0..3 {
            let color = f64::from(colors[to][axis]) - f64::from(colors[from][axis]);
            let guide = guides[to][axis] - guides[from][axis];
            let weight = 1.0 / (color * color + guide * guide + 1.0e-4);
            both[axis] += weight * color * guide;
            own[axis] += weight * guide * guide;
        }
    }
    Ok([0, 1, 2].map(|axis| match own[axis] > 0.0 {
        true => (both[axis] / own[axis]).clamp(0.0, 4.0),
        false => 0.0,
    }))
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
    scale: [f64; 3],
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
                true => find_images(inputs, "guide_scale", 1)?[0].texels()[0]
                    .truncate()
                    .to_array()
                    .map(f64::from),
                false => [1.0; 3],
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
        let scaled = [self.scale[0] * red, self.scale[1] * green, self.scale[2] * blue];
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
