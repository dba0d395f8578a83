//! Shadow filters: the definition, and the range in which roundings may move its result.
//!
//! A comparison is 0 or 1, and the compared texels change abruptly where a position passes from texel to texel. The
//! definition is therefore evaluated at the coordinates that were read, and with each of them slightly smaller and slightly
//! larger. Every outcome of those decisions lies between these results, since all have the same error.

use super::{Expected, input_picture, number_or, pixel_positions};
use crate::hard::form::{self, Family, choice_or};
use straightline_bench::execute::Inputs;
use straightline_kernels::OptionValues;
use straightline_oracle::oracle::bound::Rounding;
use straightline_oracle::oracle::quads::{self, Counted, Shadow};

/// Returns the expected result of a form with `options` for coordinates and a shadow map.
pub fn expected_shadow(family: Family, options: &OptionValues, inputs: &Inputs) -> Expected {
    let coord = input_picture(inputs, "coord", |t| t);
    let depths = input_picture(inputs, "shadow", |t| t);
    let filter = Filter::new(
        family,
        options,
        depths.size,
        depths.texels.iter().map(|t| t[0]).collect(),
    );
    let (mut colors, mut bounds, mut device_bounds) = (Vec::new(), Vec::new(), Vec::new());
    for [x, y] in pixel_positions(inputs) {
        let lanes = [0, 1, 2, 3].map(|k| {
            let [x, y, z, _] = coord.texel_at(x / 2 * 2 + k % 2, y / 2 * 2 + k / 2);
            quads::counted_coordinates([x, y, z], filter.map.size, filter.reach)
        });
        let own = lanes[(x % 2 + 2 * (y % 2)) as usize];
        let (value, off, by_device) = filter.light_with_bounds(own, quads::mean_coordinates(&lanes));
        colors.push([value; 4]);
        bounds.push(off);
        device_bounds.push(by_device);
    }
    Expected {
        colors,
        bounds,
        device_bounds,
        half_bounds: None,
        lanes: 4,
    }
}

/// A shadow filter.
struct Filter<'a> {
    options: &'a OptionValues,
    family: Family,
    map: Shadow,
    texels: i64,
    /// Greatest distance of a comparison from the pixel's position, in texels, as the kernel uses it.
    reach: f64,
    /// Maximum error of the weights in a table.
    table: f64,
}

impl<'a> Filter<'a> {
    fn new(family: Family, options: &'a OptionValues, size: [i64; 2], depths: Vec<f64>) -> Filter<'a> {
        let texels = form::shadow_filter_width(options);
        let is_lookup = choice_or(options, "weights", "box") == "lookup";
        let is_gathered = choice_or(options, "method", "quad") == "gather";
        let map = Shadow {
            size,
            depths,
            // The table holds a cubic B-spline.
            weights: match is_lookup {
                true => "cubic".to_owned(),
                false => choice_or(options, "weights", "box").to_owned(),
            },
            half: if is_gathered { 3.0 } else { texels as f64 / 2.0 },
        };
        let reach = match family {
            Family::Pcss => 0.375 * number_or(options, "search", 16.0).max(number_or(options, "widest", 24.0)) + 2.0,
            _ => texels as f64 / 2.0 + 2.0,
        };
        Filter {
            options,
            family,
            map,
            texels,
            reach,
            table: if is_lookup { 1.0e-4 } else { 0.0 },
        }
    }

    /// Returns the light of a pixel, and the maximum errors of an interpreter and a device.
    fn light_with_bounds(&self, own: Counted, mean: [f64; 3]) -> (f64, f64, f64) {
        let unit = Rounding::SINGLE.unit;
        let (value, slant) = self.light_and_slope(own.coord, mean);
        let blockers = match self.family {
            Family::Pcss => self.blockers(own.coord, mean),
            _ => Vec::new(),
        };
        let mut off = 0.0f64;
        let place_off = |axis: usize| {
            let largest = own.coord[axis].abs().max(mean[axis].abs());
            64.0 * unit * (largest + (self.reach + 1.0) / self.map.size[axis] as f64)
        };
        for corner in 0..8 {
            let moved = |coord: [f64; 3]| {
                std::array::from_fn(|k| {
                    let by = match k {
                        2 => 16.0 * unit * own.coord[2].abs().max(mean[2].abs()) + Rounding::SINGLE.smallest,
                        axis => place_off(axis),
                    };
                    coord[k] + if corner >> k & 1 == 1 { by } else { -by }
                })
            };
            let (own_there, mean_there) = (moved(own.coord), moved(mean));
            off = off.max((self.light_and_slope(own_there, mean_there).0 - value).abs());
            // Each depth of a search may differ on its own, and then the penumbra can be anything.
            if self.family == Family::Pcss && self.blockers(own_there, mean_there) != blockers {
                off = 1.0;
            }
        }
        let rounded = (256.0 * unit + self.table) * (1.0 + slant);
        // A device interpolates texels in steps of 1/256 on each axis, in each comparison.
        (value, off + rounded, off + rounded + (1.0 + slant) / 128.0)
    }

    /// Returns the result of the search for blockers.
    fn blockers(&self, own: [f64; 3], mean: [f64; 3]) -> Vec<f64> {
        let from = match choice_or(self.options, "sharing", "quad") {
            "quad" => mean,
            _ => own,
        };
        let place = [0, 1].map(|axis| from[axis] * self.map.size[axis] as f64);
        quads::find_blockers(&self.map, place, from[2], number_or(self.options, "search", 16.0))
    }

    /// Returns the light of a pixel at `own` in a quad at `mean`, and the factor by which a common error of all comparisons
    /// enters through its slope.
    fn light_and_slope(&self, own: [f64; 3], mean: [f64; 3]) -> (f64, f64) {
        let of = |c: [f64; 3]| [0, 1].map(|axis| c[axis] * self.map.size[axis] as f64);
        let (own_place, place) = (of(own), of(mean));
        let value = |name: &str, default| choice_or(self.options, name, default);
        if self.family == Family::Pcss {
            let numbers = [("search", 16.0), ("light", 400.0), ("narrowest", 2.0), ("widest", 24.0)];
            let numbers = numbers.map(|(name, default)| number_or(self.options, name, default));
            let (place, depth) = match value("sharing", "quad") {
                "quad" => (place, mean[2]),
                _ => (own_place, own[2]),
            };
            return (quads::pcss(&self.map, place, depth, numbers), 0.0);
        }
        match value("method", "quad") {
            "naive" | "bilinear" => {
                let light = quads::pcf_around(&self.map, self.texels, own_place, own_place, own[2]);
                return (light, 0.0);
            }
            "gather" => {
                let near = [0, 1].map(|axis| place[axis] + (own_place[axis] - place[axis]).clamp(-1.0, 1.0));
                return (quads::pcf_around(&self.map, self.texels, place, near, mean[2]), 0.0);
            }
            _ => {}
        }
        let light = quads::pcf_around(&self.map, self.texels, place, place, mean[2]);
        let slope = match value("gradient", "none") {
            "prewitt" => quads::slope_prewitt(&self.map, self.texels, place, mean[2]),
            "fitted" => quads::slope_fitted(&self.map, self.texels, place, mean[2]),
            _ => return (light, 0.0),
        };
        let away = [0, 1]
            .map(|axis| own_place[axis] - place[axis] - quads::weighted_middle(&self.map, self.texels, place[axis]));
        let light = light + slope[0] * away[0] + slope[1] * away[1];
        (light.clamp(0.0, 1.0), away[0].abs() + away[1].abs())
    }
}
