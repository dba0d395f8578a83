//! Where no tap shows a sample's surface: a search farther away.

use super::metric::FAR;
use super::options::{NonFinite, Search, Sraa};
use super::pattern::Place;
use super::{Inputs, STEEPEST, color_at, difference, falloff, geometry_sample, is_kept, least};
use crate::prelude::*;

/// What unseen samples add to the pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Searched {
    /// Sum of their colours, each by its share in the pixel.
    pub(super) color: Vec4,
    /// Sum of their shares.
    pub(super) share: f32,
}

/// The colours of the samples whose bits are set in `unseen`.
pub(super) fn searched(cfg: &Sraa, inputs: &Inputs, unseen: u32) -> Searched {
    let nothing = Searched {
        color: Vec4::ZERO,
        share: 0.0,
    };
    match cfg.search {
        Search::None => nothing,
        Search::Five | Search::Seven =>
        {
            #[cfg_attr(false, branch)]
            if unseen != 0 {
                each(cfg, inputs, unseen)
            } else {
                nothing
            }
        }
    }
}

/// Few pixels come here: its loops stay loops.
#[cfg_attr(false, unroll(none))]
fn each(cfg: &Sraa, inputs: &Inputs, unseen: u32) -> Searched {
    let side = match cfg.search {
        Search::None => 3,
        Search::Five => 5,
        Search::Seven => 7,
    };
    let mut all = Searched {
        color: Vec4::ZERO,
        share: 0.0,
    };
    for sample in 0..cfg.samples() {
        if (unseen >> sample) & 1 != 0 {
            let place = cfg.place(sample);
            let centre = geometry_sample(cfg, inputs, place);
            let mut nearest = FAR;
            let mut farther = FAR;
            for tap in 0..side * side {
                let d = difference(cfg, inputs, place, &centre, cfg.tap(tap, side));
                farther = farther.min(d);
                if falloff(cfg, place, cfg.tap(tap, side)) > least(cfg) {
                    nearest = nearest.min(d);
                }
            }
            // Only a surface that is the sample's own is taken from so far; or else what is nearby, as without a search.
            let found = farther <= cfg.unseen;
            let least_difference = if found { farther } else { nearest };
            let steepness = (cfg.tau * std::f32::consts::LOG2_E).min(STEEPEST);
            let mut color = Vec4::ZERO;
            let mut kept = 0.0;
            let mut sum = 0.0;
            for tap in 0..side * side {
                let at = cfg.tap(tap, side);
                let d = difference(cfg, inputs, place, &centre, at);
                let near = if found {
                    spread(place, at)
                } else {
                    falloff(cfg, place, at)
                };
                let w = near * (steepness * (least_difference - d).min(0.0)).exp2();
                let shaded = color_at(inputs, at);
                let counts = match cfg.non_finite {
                    NonFinite::Skip => is_kept(cfg, shaded),
                    NonFinite::Spread => w != 0.0,
                };
                if counts {
                    color += w * shaded;
                    kept += w;
                }
                sum += w;
            }
            let share = 1.0 / (sum * cfg.samples() as f32);
            all.color += share * color;
            all.share += share * kept;
        }
    }
    all
}

/// Weight of a tap that is found, by distance on the screen: a Gaussian with a standard deviation of a pixel.
fn spread(sample: Place, tap: Place) -> f32 {
    let away = tap.at - sample.at;
    (-0.5 * away.dot(away)).exp()
}
