//! Checks that a capture was sampled at the places that it states, by depths of even ground at each sample.

use crate::capture::Capture;
use crate::scene::SKY_DEPTH;
use glam::{UVec2, Vec2};

/// Convention of sample offsets that differs from that of captures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Misplaced {
    /// y points up.
    FlippedY,
    /// x points left.
    FlippedX,
    /// Both: of a projection that is shifted by the offset, not against it.
    Flipped,
    /// x and y are exchanged.
    Exchanged,
}

impl Misplaced {
    const ALL: [Misplaced; 4] = [
        Misplaced::FlippedY,
        Misplaced::FlippedX,
        Misplaced::Flipped,
        Misplaced::Exchanged,
    ];

    /// Returns the true offset of a sample whose stated offset is `offset`.
    fn true_offset(self, offset: Vec2) -> Vec2 {
        match self {
            Misplaced::FlippedY => Vec2::new(offset.x, -offset.y),
            Misplaced::FlippedX => Vec2::new(-offset.x, offset.y),
            Misplaced::Flipped => -offset,
            Misplaced::Exchanged => Vec2::new(offset.y, offset.x),
        }
    }

    /// Returns the problem and its remedy, in words.
    pub fn describe_remedy(self) -> &'static str {
        match self {
            Misplaced::FlippedY => {
                "the depths are those of samples with y upside down: offsets in `samples` count y down, so negate each y there, or shift \
                 the projection the other way"
            }
            Misplaced::FlippedX => {
                "the depths are those of samples with x the other way round: offsets in `samples` count x to the right, so negate each x \
                 there, or shift the projection the other way"
            }
            Misplaced::Flipped => {
                "the depths are those of samples on the other side of the pixel's centre: to sample at (x, y), y down, add (-2x/width, \
                 +2y/height) to positions in normalised device coordinates, y up; or negate each x and y in `samples`"
            }
            Misplaced::Exchanged => {
                "the depths are those of samples with x and y exchanged: write x first in `samples`"
            }
        }
    }
}

/// Greatest distance of values from a plane's at three pixels in a row, as a share of their change.
const BENT: f32 = 0.03;

/// Least change of values from pixel to pixel, as a share of themselves: roundings of 32 bits are far below.
const STEEP: f32 = 2.0e-5;

/// Samples that are compared at least.
const FEWEST: usize = 60;

/// Greatest distance of a sample from its plane to fit it, as a share of the plane's change from pixel to pixel.
const FITS: f32 = 0.05;

/// Share of the samples that must fit where they should not be, and how many times more than where they should.
const MANY: f32 = 0.4;
const MORE: f32 = 2.0;

/// Finds the way in which the sample offsets of a capture are stated wrongly, if the depths of even ground show it: they fit
/// planes much better in that way than as stated. `None` also where too little is even, or where nothing fits.
pub fn find_misplaced(capture: &Capture) -> Option<Misplaced> {
    let layer = *capture.shaded_layers().first()?;
    let origin = capture.samples.get(layer).copied().unwrap_or(Vec2::ZERO);
    let parallel = capture.camera.is_some_and(|camera| camera.parallel_height.is_some());
    // Of a plane, the reciprocal is linear on the screen in perspective, and depth itself of a parallel projection.
    let value = |depth: f32| if parallel { depth } else { 1.0 / depth };
    let own = capture.depth.layers()[layer].texels();
    let UVec2 { x: width, y: height } = capture.size;
    let mut counts = [Count::default(); Misplaced::ALL.len()];
    for y in 1..height.saturating_sub(1) {
        for x in 1..width.saturating_sub(1) {
            let at = (y * width + x) as usize;
            let along = |before: usize, after: usize| {
                let depths = [own[before], own[at], own[after]];
                let seen = depths
                    .iter()
                    .all(|z| z.is_finite() && *z < SKY_DEPTH && (parallel || *z > 0.0));
                let [a, b, c] = depths.map(value);
                let slope = 0.5 * (c - a);
                (seen && (a + c - 2.0 * b).abs() <= BENT * slope.abs() + 1.0e-7 * b.abs()).then_some(slope)
            };
            let (Some(right), Some(down)) = (along(at - 1, at + 1), along(at - width as usize, at + width as usize))
            else {
                continue;
            };
            let slope = Vec2::new(right, down);
            let middle = value(own[at]);
            if slope.abs().min_element() < STEEP * middle.abs() {
                continue;
            }
            for (sample, offset) in capture
                .samples
                .iter()
                .enumerate()
                .filter(|(sample, _)| *sample != layer)
            {
                let depth = capture.depth.layers()[sample].texels()[at];
                if !(depth.is_finite() && depth < SKY_DEPTH) {
                    continue;
                }
                let whole = slope.abs().element_sum();
                let expected = |place: Vec2, origin: Vec2| middle + slope.dot(place - origin);
                let fits = |expected: f32| usize::from((value(depth) - expected).abs() <= FITS * whole);
                let stated = expected(*offset, origin);
                for (count, way) in counts.iter_mut().zip(Misplaced::ALL) {
                    let other = expected(way.true_offset(*offset), way.true_offset(origin));
                    // Count only samples for which the two ways differ clearly.
                    if (other - stated).abs() > 2.5 * FITS * whole {
                        count.all += 1;
                        count.stated += fits(stated);
                        count.other += fits(other);
                    }
                }
            }
        }
    }
    let ways = counts.iter().zip(Misplaced::ALL);
    let told = ways.filter(|(count, _)| {
        count.all >= FEWEST && count.share() >= MANY && count.other as f32 >= MORE * count.stated as f32
    });
    let best = told.max_by(|(a, _), (b, _)| a.share().total_cmp(&b.share()));
    best.map(|(_, way)| way)
}

/// Samples for which two ways of stating offsets differ, and how many of them fit at the stated place, and at the other one.
#[derive(Clone, Copy, Default)]
struct Count {
    all: usize,
    stated: usize,
    other: usize,
}

impl Count {
    fn share(&self) -> f32 {
        self.other as f32 / self.all.max(1) as f32
    }
}
