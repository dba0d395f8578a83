//! Samples whose surface no tap shows: a wider search, and less light from dark surfaces.

use super::colors::is_kept;
use super::demodulate::{Paint, paint, repainted};
use super::extra::extra_tap;
use super::history::{earlier_tap, own_tap, remembered_color};
use super::metric::{FAR, Sample, distance};
use super::options::{Guards, NonFinite, Search, Sraa};
use super::pattern::{Place, neighbour};
use super::{Inputs, difference, falloff, geometry_sample, least, steepness};
use crate::prelude::*;

/// Contribution of unseen samples, or of earlier frames, to the pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Searched {
    /// Sum of their colours, each weighted by its share in the pixel.
    pub(super) color: Vec4,
    /// Sum of their shares.
    pub(super) share: f32,
}

impl Searched {
    pub(super) const NOTHING: Searched = Searched {
        color: Vec4::ZERO,
        share: 0.0,
    };
}

/// Weighted sum of colours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    pub(super) color: Vec4,
    /// Sum of the weights of the colours that count.
    pub(super) kept: f32,
    /// Sum of all weights.
    pub(super) weight: f32,
}

impl Sum {
    pub(super) const NOTHING: Sum = Sum {
        color: Vec4::ZERO,
        kept: 0.0,
        weight: 0.0,
    };

    pub(super) fn add(&mut self, cfg: &Sraa, shaded: Vec4, weight: f32) {
        match cfg.guards {
            Guards::Inline => {
                let counts = match cfg.non_finite {
                    NonFinite::Skip => is_kept(cfg, shaded),
                    NonFinite::Spread => weight != 0.0,
                };
                if counts {
                    self.color += weight * shaded;
                    self.kept += weight;
                }
            }
            Guards::Fallback | Guards::None => {
                self.color += weight * shaded;
                self.kept += weight;
            }
        }
        self.weight += weight;
    }
}

/// Returns the contribution of the samples whose bits are set in `unseen`.
pub(super) fn searched(cfg: &Sraa, inputs: &Inputs, unseen: u32) -> Searched {
    if cfg.sets_apart() {
        #[cfg_attr(false, branch)]
        if unseen != 0 {
            each(cfg, inputs, unseen)
        } else {
            Searched::NOTHING
        }
    } else {
        Searched::NOTHING
    }
}

/// Few pixels reach this, so its loops are left in the shader.
#[cfg_attr(false, unroll(none))]
fn each(cfg: &Sraa, inputs: &Inputs, unseen: u32) -> Searched {
    let mut all = Searched::NOTHING;
    for sample in 0..cfg.samples() {
        if (unseen >> sample) & 1 != 0 {
            let place = cfg.place(sample);
            let centre = geometry_sample(cfg, inputs, place);
            let own = paint(cfg, inputs, place);
            let mut sum = match cfg.search {
                Search::None if !cfg.extra => Sum::NOTHING,
                Search::None | Search::Five | Search::Seven => farther(cfg, inputs, place, &centre, &own),
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

/// Sums the colours of the taps that show the sample's own surface, if there are any.
fn farther(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, own: &Paint) -> Sum {
    let side = match cfg.search {
        Search::None => 3,
        Search::Five => 5,
        Search::Seven => 7,
    };
    let mut sum = Sum::NOTHING;
    for tap in 0..side * side {
        if cfg.extra {
            let further = extra_tap(cfg, inputs, neighbour(tap, side));
            let at = further.place;
            if further.is_there && difference(cfg, inputs, place, centre, at) <= cfg.search_threshold {
                sum.add(cfg, repainted(cfg, inputs, at, own, true), spread(place, at));
            }
        }
        if cfg.search != Search::None {
            let at = own_tap(cfg, inputs, tap, side);
            if difference(cfg, inputs, place, centre, at) <= cfg.search_threshold {
                sum.add(cfg, repainted(cfg, inputs, at, own, true), spread(place, at));
            }
        }
    }
    // Equally far around the earlier positions of the pixel's surface.
    let side = match cfg.search {
        Search::None => 0,
        Search::Five | Search::Seven => side - 1,
    };
    for frame in 0..cfg.history as usize {
        for k in 0..side * side {
            let tap = earlier_tap(cfg, inputs, place, frame, k, side);
            let apart = distance(cfg, centre, &tap.seen, tap.seen_at);
            if tap.is_there && apart <= cfg.search_threshold {
                let shaded = remembered_color(cfg, inputs, own, &tap, frame);
                sum.add(cfg, shaded, spread(place, tap.place));
            }
        }
    }
    sum
}

/// Sums the colours as if there were no search and no earlier frames, but with less light from dark surfaces.
fn nearby(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, own: &Paint) -> Sum {
    let side = cfg.side();
    let mut nearest = FAR;
    for tap in 0..side * side {
        let at = own_tap(cfg, inputs, tap, side);
        if falloff(cfg, place, at) > least(cfg) {
            nearest = nearest.min(difference(cfg, inputs, place, centre, at));
        }
    }
    let steepness = steepness(cfg);
    let mut sum = Sum::NOTHING;
    for tap in 0..side * side {
        let at = own_tap(cfg, inputs, tap, side);
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

/// Weight of a tap found by the search, by distance on the screen: a Gaussian with a standard deviation of one pixel.
fn spread(sample: Place, tap: Place) -> f32 {
    let away = tap.at - sample.at;
    (-0.5 * away.dot(away)).exp()
}
