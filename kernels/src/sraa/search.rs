//! Where no tap shows a sample's surface: a search farther away, and less light from dark surfaces.

use super::colors::is_kept;
use super::demodulate::{Paint, paint, repainted};
use super::metric::{FAR, Sample};
use super::options::{NonFinite, Search, Sraa};
use super::pattern::Place;
use super::{Inputs, difference, falloff, geometry_sample, least, steepness};
use crate::prelude::*;

/// What unseen samples add to the pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Searched {
    /// Sum of their colours, each by its share in the pixel.
    pub(super) color: Vec4,
    /// Sum of their shares.
    pub(super) share: f32,
}

/// Colours that are added up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    pub(super) color: Vec4,
    /// Of the colours that count.
    pub(super) kept: f32,
    /// Of all.
    pub(super) weight: f32,
}

impl Sum {
    pub(super) const NOTHING: Sum = Sum {
        color: Vec4::ZERO,
        kept: 0.0,
        weight: 0.0,
    };

    /// What a sum of shares in the pixel adds to it.
    pub(super) fn apart(self) -> Searched {
        Searched {
            color: self.color,
            share: self.kept,
        }
    }

    fn add(&mut self, cfg: &Sraa, shaded: Vec4, weight: f32) {
        let counts = match cfg.non_finite {
            NonFinite::Skip => is_kept(cfg, shaded),
            NonFinite::Spread => weight != 0.0,
        };
        if counts {
            self.color += weight * shaded;
            self.kept += weight;
        }
        self.weight += weight;
    }
}

/// The colours of the samples whose bits are set in `unseen`.
pub(super) fn searched(cfg: &Sraa, inputs: &Inputs, unseen: u32) -> Searched {
    let nothing = Searched {
        color: Vec4::ZERO,
        share: 0.0,
    };
    if cfg.sets_apart() {
        #[cfg_attr(false, branch)]
        if unseen != 0 {
            each(cfg, inputs, unseen)
        } else {
            nothing
        }
    } else {
        nothing
    }
}

/// Few pixels come here: its loops stay loops.
#[cfg_attr(false, unroll(none))]
fn each(cfg: &Sraa, inputs: &Inputs, unseen: u32) -> Searched {
    let mut all = Searched {
        color: Vec4::ZERO,
        share: 0.0,
    };
    for sample in 0..cfg.samples() {
        if (unseen >> sample) & 1 != 0 {
            let place = cfg.place(sample);
            let centre = geometry_sample(cfg, inputs, place);
            let own = paint(cfg, inputs, place);
            let mut sum = match cfg.search {
                Search::None => Sum::NOTHING,
                Search::Five | Search::Seven => farther(cfg, inputs, place, &centre, &own),
            };
            if sum.weight == 0.0 {
                sum = nearby(cfg, inputs, place, &centre, &own);
            }
            let share = 1.0 / (sum.weight * cfg.samples() as f32);
            all.color += share * sum.color;
            all.share += share * sum.kept;
        }
    }
    all
}

/// The colours of the taps that show the sample's own surface, if any do.
fn farther(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, own: &Paint) -> Sum {
    let side = match cfg.search {
        Search::None => 3,
        Search::Five => 5,
        Search::Seven => 7,
    };
    let mut sum = Sum::NOTHING;
    for tap in 0..side * side {
        let at = cfg.tap(tap, side);
        if difference(cfg, inputs, place, centre, at) <= cfg.search_threshold {
            sum.add(cfg, repainted(cfg, inputs, at, own, true), spread(place, at));
        }
    }
    sum
}

/// What the sample would be without a search, but that dark surfaces give less light.
fn nearby(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, own: &Paint) -> Sum {
    let side = cfg.side();
    let mut nearest = FAR;
    for tap in 0..side * side {
        let at = cfg.tap(tap, side);
        if falloff(cfg, place, at) > least(cfg) {
            nearest = nearest.min(difference(cfg, inputs, place, centre, at));
        }
    }
    let steepness = steepness(cfg);
    let mut sum = Sum::NOTHING;
    for tap in 0..side * side {
        let at = cfg.tap(tap, side);
        let near = falloff(cfg, place, at);
        if near > least(cfg) {
            let d = difference(cfg, inputs, place, centre, at);
            sum.add(
                cfg,
                repainted(cfg, inputs, at, own, false),
                near * (steepness * (nearest - d)).exp2(),
            );
        }
    }
    sum
}

/// Weight of a tap that is found, by distance on the screen: a Gaussian with a standard deviation of a pixel.
fn spread(sample: Place, tap: Place) -> f32 {
    let away = tap.at - sample.at;
    (-0.5 * away.dot(away)).exp()
}
