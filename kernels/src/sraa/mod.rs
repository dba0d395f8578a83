//! Subpixel Reconstruction Antialiasing (Chajdas, McGuire and Luebke 2011).
//!
//! Shading is known once a pixel or a little more often, geometry at several samples a pixel. Each geometry sample borrows
//! its colour from the shading samples around it, most from those on the same surface; the pixel is the mean of its
//! geometry samples. The code follows the paper's listing, with its errors corrected and its suggestions implemented.

mod colors;
mod demodulate;
mod extra;
mod fit;
mod gbuffer;
mod guide;
mod history;
mod lobes;
mod mask;
mod metric;
mod options;
mod pattern;
mod placed;
mod search;
mod view;

use crate::prelude::*;
use colors::color;
use demodulate::{may_count, paint, weighed};
use gbuffer::surface;
use guide::guided;
use history::{own_tap, remembered, shift};
use lobes::within_range;
use mask::masked;
use metric::{FAR, Sample, distance};
use pattern::{Place, tent};
use placed::shaded_place;
use search::{Searched, Sum, searched};

pub use colors::Colors;
pub use demodulate::Demodulate;
pub use extra::sraa_extra;
pub use fit::{FitSums, sraa_fit, sraa_fit_rows, sraa_fit_sums};
pub use gbuffer::{Depth, GBuffer, Layout, Normals, Surface};
pub use guide::{Estimate, Guide, Guiding, sraa_guide, sraa_residual};
pub use history::History;
pub use metric::{Difference, Metric, Plane};
pub use options::{Falloff, Guards, Mask, NonFinite, Normalisation, Resolve, Search, Sraa, Turn, Variation};
pub use pattern::{Pattern, Shading};
pub use placed::sraa_place;
pub use view::{Projection, View};

/// Inputs of the filter at a pixel.
struct Inputs<'a> {
    gbuffer: &'a GBuffer,
    view: &'a View,
    colors: &'a Colors,
    history: &'a History,
    pixel: IVec2,
}

/// Antialiased colour of `pixel`: each geometry sample takes its colour from the shading samples around it,
/// weighted by how close their surfaces are.
pub fn sraa(cfg: &Sraa, gbuffer: &GBuffer, view: &View, colors: &Colors, history: &History, pixel: IVec2) -> Vec4 {
    cfg.check();
    let inputs = Inputs {
        gbuffer,
        view,
        colors,
        history,
        pixel,
    };
    let filtered = match (cfg.side(), cfg.shading_samples()) {
        (3, 1) => masked::<9, 3>(cfg, &inputs),
        (3, 2) => masked::<18, 3>(cfg, &inputs),
        (3, _) => masked::<36, 3>(cfg, &inputs),
        (5, 1) => masked::<25, 5>(cfg, &inputs),
        (5, 2) => masked::<50, 5>(cfg, &inputs),
        (5, _) => masked::<100, 5>(cfg, &inputs),
        (_, 1) => masked::<49, 7>(cfg, &inputs),
        (_, 2) => masked::<98, 7>(cfg, &inputs),
        (_, _) => masked::<196, 7>(cfg, &inputs),
    };
    guided(cfg, &inputs, filtered)
}

/// Colour of the pixel from the `TAPS` shading samples of the `SIDE` × `SIDE` pixels around it.
fn filtered<const TAPS: usize, const SIDE: usize>(cfg: &Sraa, inputs: &Inputs) -> Vec4 {
    match cfg.guards {
        Guards::Inline | Guards::None => reconstructed::<TAPS, SIDE>(cfg, inputs),
        Guards::Fallback => {
            let color = reconstructed::<TAPS, SIDE>(cfg, inputs);
            #[cfg_attr(false, branch)]
            if (color.x + color.y + color.z + color.w).abs() < TOO_LARGE {
                color
            } else {
                again::<TAPS, SIDE>(cfg, inputs)
            }
        }
    }
}

/// Filters the pixel again with every test. Few pixels reach this, so its loops are left in the shader.
#[cfg_attr(false, unroll(none))]
fn again<const TAPS: usize, const SIDE: usize>(cfg: &Sraa, inputs: &Inputs) -> Vec4 {
    let guarded = Sraa {
        guards: Guards::Inline,
        ..*cfg
    };
    reconstructed::<TAPS, SIDE>(&guarded, inputs)
}

/// Mean of the geometry samples, each with its colour from the taps around it.
fn reconstructed<const TAPS: usize, const SIDE: usize>(cfg: &Sraa, inputs: &Inputs) -> Vec4 {
    let steepness = steepness(cfg);
    let total = total_share(cfg);
    let mut weights = [0.0; TAPS];
    // Weights times the albedo of the samples that use a tap, and also times their shares of the direct light.
    let mut reflected = [Vec3::ZERO; TAPS];
    let mut lit = [Vec3::ZERO; TAPS];
    // Share of each tap in the samples that make up the pixel, whatever their sign.
    let mut used = [0.0; TAPS];
    let mut unseen = 0;
    let mut past = Searched::NOTHING;
    for sample in (0..cfg.reconstructed()).map(|k| cfg.visited(k)) {
        if cfg.share(sample) != 0.0 {
            let share = cfg.share(sample) / total;
            let place = cfg.place(sample);
            let centre = geometry_sample(cfg, inputs, place);
            let own = paint(cfg, inputs, place);
            let mut distances = [0.0; TAPS];
            let mut nearest = FAR;
            for tap in 0..TAPS {
                if reaches(cfg, place, cfg.tap(tap, SIDE)) {
                    let d = difference(cfg, inputs, place, &centre, own_tap(cfg, inputs, tap, SIDE));
                    distances[tap] = d;
                    // The tap's position is a runtime value, so it may still be out of reach.
                    if cfg.history == 0 || falloff(cfg, place, own_tap(cfg, inputs, tap, SIDE)) > 0.0 {
                        nearest = nearest.min(d);
                    }
                }
            }
            let mut tap_weights = [0.0; TAPS];
            let mut sum = 0.0;
            for tap in 0..TAPS {
                if reaches(cfg, place, cfg.tap(tap, SIDE)) {
                    let exponent = steepness
                        * match cfg.normalisation {
                            Normalisation::Paper | Normalisation::Epsilon => -distances[tap],
                            Normalisation::Shifted => shift(cfg, nearest) - distances[tap],
                        };
                    let w = match cfg.falloff {
                        // With runtime positions a falloff may be 0, which has no logarithm, and the difference of such a
                        // tap may be smaller than `nearest`, which covers only taps in reach.
                        _ if cfg.history > 0 => {
                            exponent.min(0.0).exp2() * falloff(cfg, place, own_tap(cfg, inputs, tap, SIDE))
                        }
                        Falloff::None => exponent.exp2(),
                        // The falloff as an exponent: added instead of multiplied.
                        _ => (exponent + falloff_exponent(cfg, place, cfg.tap(tap, SIDE))).exp2(),
                    };
                    tap_weights[tap] = w;
                    sum += w;
                }
            }
            let mut earlier = Sum::NOTHING;
            if cfg.history > 0 {
                let found = remembered(cfg, inputs, place, &centre, &own);
                earlier = found.sum;
                sum += earlier.weight;
                nearest = nearest.min(found.nearest);
            }
            let mut scale = match cfg.normalisation {
                Normalisation::Paper | Normalisation::Shifted => share / sum,
                Normalisation::Epsilon => share / sum.max(EPSILON),
            };
            if cfg.sets_apart() && nearest > cfg.search_threshold {
                unseen |= 1u32 << sample;
                scale = 0.0;
            }
            if cfg.history > 0 {
                past.color += scale * earlier.color;
                past.share += scale * earlier.kept;
            }
            for tap in 0..TAPS {
                if reaches(cfg, place, cfg.tap(tap, SIDE)) {
                    weights[tap] += tap_weights[tap] * scale;
                    if cfg.has_lobes() {
                        used[tap] += tap_weights[tap] * scale.abs();
                    }
                    if cfg.demodulate != Demodulate::None {
                        reflected[tap] += tap_weights[tap] * scale * own.albedo;
                    }
                    if cfg.demodulate == Demodulate::AlbedoShadow {
                        lit[tap] += tap_weights[tap] * scale * own.lit * own.albedo;
                    }
                }
            }
        }
    }
    let mut apart = searched(cfg, inputs, unseen);
    if cfg.history > 0 {
        apart.color += past.color;
        apart.share += past.share;
    }
    // Read with demodulation only.
    let paints = (&reflected, &lit);
    let mean = match cfg.guards {
        Guards::Inline => mean_of_kept(cfg, inputs, &weights, paints, SIDE, apart),
        Guards::Fallback | Guards::None => mean(cfg, inputs, &weights, paints, SIDE, apart),
    };
    within_range(cfg, inputs, &used, SIDE, mean)
}

/// Mean of the taps' colours that may contribute, and of those of unseen samples.
fn mean_of_kept<const TAPS: usize>(
    cfg: &Sraa,
    inputs: &Inputs,
    weights: &[f32; TAPS],
    (reflected, lit): (&[Vec3; TAPS], &[Vec3; TAPS]),
    side: usize,
    apart: Searched,
) -> Vec4 {
    let mut result = apart.color;
    let mut sum = apart.share;
    for tap in 0..TAPS {
        let shaded = color(cfg, inputs, tap, side);
        let kept = may_count(cfg, inputs, cfg.tap(tap, side), shaded);
        let w = if kept { weights[tap] } else { 0.0 };
        // 0 times an infinite colour is NaN.
        let counts = match cfg.non_finite {
            NonFinite::Skip => kept,
            NonFinite::Spread => w != 0.0,
        };
        if counts {
            result += weighed(cfg, inputs, cfg.tap(tap, side), shaded, w, (reflected[tap], lit[tap]));
        }
        sum += w;
    }
    match cfg.non_finite {
        NonFinite::Spread => result,
        NonFinite::Skip => {
            if sum > EPSILON {
                result / sum
            } else {
                Vec4::ZERO
            }
        }
    }
}

/// Bound on the sum of a colour's components. A sum with infinities is larger, and one with NaN fails the comparison. Very
/// large colours may exceed it too; their pixels are filtered again needlessly.
const TOO_LARGE: f32 = 1.0e38;

/// Returns whether a tap may have weight for a sample. With earlier frames, positions are runtime values, so every tap may.
fn reaches(cfg: &Sraa, sample: Place, tap: Place) -> bool {
    cfg.history > 0 || falloff(cfg, sample, tap) > least(cfg)
}

/// Rate at which weights fall with the difference, as an exponent of 2.
fn steepness(cfg: &Sraa) -> f32 {
    (cfg.tau * std::f32::consts::LOG2_E).min(STEEPEST)
}

/// Smaller than any sum of weights that counts.
const EPSILON: f32 = 1.0e-30;

/// Steepness of the largest tau. An infinite runtime tau would make the nearest surface's exponent 0 times infinity, a NaN.
const STEEPEST: f32 = 1.0e7;

/// Sum of the shares of all reconstructed samples.
fn total_share(cfg: &Sraa) -> f32 {
    let mut total = 0.0;
    for sample in 0..cfg.reconstructed() {
        total += cfg.share(sample);
    }
    total
}

/// Surface at a geometry sample, ready to compare taps with.
fn geometry_sample(cfg: &Sraa, inputs: &Inputs, place: Place) -> Sample {
    let seen = surface(cfg, inputs.gbuffer, inputs.view, inputs.pixel, place);
    Sample::new(cfg, inputs.view, seen, inputs.pixel, place.at)
}

/// Difference between the surface at a tap and that at a geometry sample; 0 if both are the same sample.
fn difference(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, tap: Place) -> f32 {
    let tap = shaded_place(cfg, &inputs.colors.place, inputs.pixel, tap);
    if place.sample == tap.sample && place.pixel == tap.pixel {
        0.0
    } else {
        let shaded = surface(cfg, inputs.gbuffer, inputs.view, inputs.pixel, tap);
        distance(cfg, centre, &shaded, tap.at)
    }
}

/// Weight of a tap for a geometry sample by distance on the screen alone; 0 beyond the radius.
fn falloff(cfg: &Sraa, sample: Place, tap: Place) -> f32 {
    let away = tap.at - sample.at;
    let near = away.x.abs() <= cfg.radius && away.y.abs() <= cfg.radius;
    match cfg.falloff {
        Falloff::None => {
            if near {
                1.0
            } else {
                0.0
            }
        }
        Falloff::Tent if cfg.sharpness == 1.0 => tent(away / cfg.radius),
        Falloff::Tent => tent(away / cfg.radius).powf(cfg.sharpness),
        Falloff::Gaussian => {
            if near {
                (-away.dot(away) / (2.0 * cfg.sigma * cfg.sigma)).exp()
            } else {
                0.0
            }
        }
    }
}

/// Weight up to which a tap is ignored. A tent is 0 at positions where taps may lie; rounding would leave a tiny weight there.
fn least(cfg: &Sraa) -> f32 {
    match cfg.falloff {
        Falloff::Tent if cfg.history == 0 => 1.0e-6f32.powf(cfg.sharpness),
        Falloff::None | Falloff::Tent | Falloff::Gaussian => 0.0,
    }
}

/// Weighted mean of the taps' colours and of those of unseen samples.
fn mean<const TAPS: usize>(
    cfg: &Sraa,
    inputs: &Inputs,
    weights: &[f32; TAPS],
    (reflected, lit): (&[Vec3; TAPS], &[Vec3; TAPS]),
    side: usize,
    apart: Searched,
) -> Vec4 {
    let mut result = apart.color;
    for tap in 0..TAPS {
        let shaded = color(cfg, inputs, tap, side);
        result += weighed(
            cfg,
            inputs,
            cfg.tap(tap, side),
            shaded,
            weights[tap],
            (reflected[tap], lit[tap]),
        );
    }
    result
}

/// Logarithm of the falloff of a tap in reach. The lower bound on it lets the shader compiler infer that the result is finite.
fn falloff_exponent(cfg: &Sraa, sample: Place, tap: Place) -> f32 {
    falloff(cfg, sample, tap).max(least(cfg).max(f32::MIN_POSITIVE)).log2()
}
