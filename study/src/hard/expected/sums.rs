//! Definitions of convolutions and ambient occlusion.

use super::{Expected, input_picture, largest_component, number_or, pixel_positions};
use crate::hard::form::choice_or;
use straightline_bench::execute::Inputs;
use straightline_kernels::OptionValues;
use straightline_oracle::oracle::bound::Rounding;
use straightline_oracle::oracle::quads::{self, Ao, Picture};

/// Returns the expected result of a convolution. A sum of n products has an error of n + 2 roundings of the largest.
/// Bilinear taps add the error of the position between texels, and on a device steps of 1/256 on each axis.
pub fn expected_convolution(options: &OptionValues, inputs: &Inputs) -> Expected {
    let radius = number_or(options, "radius", 1.0) as i64;
    let is_bilinear = choice_or(options, "taps", "pixels") == "bilinear";
    let is_box = choice_or(options, "weights", "box") == "box";
    let raw = input_picture(inputs, "image", |t| t);
    let image = quads::bounded_image(&raw, 1.0);
    let width = (2 * radius + 1) as f64;
    let unit = Rounding::SINGLE.unit;
    let color = |at: [i64; 2]| match (is_bilinear, is_box) {
        (false, true) => quads::convolve_pixel(&image, radius, |_, _| 1.0 / (width * width), at),
        (false, false) => {
            let weight = |x: i64, y: i64| quads::binomial(radius, x) * quads::binomial(radius, y);
            quads::convolve_pixel(&image, radius, weight, at)
        }
        (true, _) => {
            let n = 2 * radius + 1;
            let weight = |k: i64| match is_box {
                true => 1.0 / (n + 1) as f64,
                false => quads::pascal(n, radius + 1 + k),
            };
            quads::fit_plane(&raw, radius, weight, at)
        }
    };
    let colors: Vec<_> = pixel_positions(inputs).map(color).collect();
    let side = raw.size[0].max(raw.size[1]) as f64;
    let (mut bounds, mut device_bounds) = (Vec::new(), Vec::new());
    for at in pixel_positions(inputs) {
        let brightest = brightest_around(&image, radius + 1, at);
        let rounded = (width * width + 16.0) * unit * brightest + 64.0 * Rounding::SINGLE.smallest;
        let [placed, by_device] = match is_bilinear {
            // The absolute weights of a tap for all lanes sum to at most 4, and colours differ by at most twice the
            // brightest.
            true => [8.0 * unit * side, 1.0 / 128.0].map(|share| 8.0 * share * brightest),
            false => [0.0; 2],
        };
        bounds.push(4.0 * rounded + placed);
        device_bounds.push(4.0 * rounded + placed.max(by_device));
    }
    Expected {
        colors,
        bounds,
        device_bounds,
        half_bounds: None,
        lanes: 4,
    }
}

fn brightest_around(image: &Picture, radius: i64, [x, y]: [i64; 2]) -> f64 {
    let around = (-radius..=radius).flat_map(|j| (-radius..=radius).map(move |i| [x + i, y + j]));
    around
        .map(|[x, y]| largest_component(&image.texel_at(x, y)))
        .fold(0.0, f64::max)
}

/// Returns the expected ambient occlusion, between the least and the greatest result of rounding each tap and its position.
pub fn expected_occlusion(options: &OptionValues, inputs: &Inputs) -> Expected {
    // Options are numbers of 32 bits.
    let option = |name: &str, default: f64| f64::from(number_or(options, name, default) as f32);
    let ao = Ao {
        taps: number_or(options, "taps", 4.0) as usize,
        radius: option("radius", 0.5),
        bias: option("bias", 0.05),
        strength: option("strength", 2.0),
        pixel_angle: option("pixel-angle", 0.005),
        depth_sigma: option("depth-sigma", 0.2),
    };
    let (depth, normal) = (
        input_picture(inputs, "depth", |t| t),
        input_picture(inputs, "normal", |t| t),
    );
    let is_shared = choice_or(options, "sharing", "quad") == "quad";
    let light = pixel_positions(inputs).map(|at| quads::ssao_between(&ao, &depth, &normal, is_shared, at));
    let (colors, bounds): (Vec<_>, Vec<f64>) = light
        .map(|light| {
            (
                [light.value; 4],
                (light.high - light.value).max(light.value - light.low),
            )
        })
        .unzip();
    Expected {
        colors,
        device_bounds: bounds.clone(),
        bounds,
        half_bounds: None,
        lanes: 4,
    }
}
