//! Confidence interval of a median: the percentile bootstrap (Efron and Tibshirani 1993, §13) of circular blocks of rounds
//! (Politis and Romano 1992), because neighbouring rounds are alike where the machine does other work too.
//!
//! Rounds are few, and blocks fewer, so the interval is widened as Student's t is, up to the range of the rounds.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Number of resamples.
const RESAMPLES: usize = 2000;

/// Share of the intervals that hold the median.
pub const CONFIDENCE: f64 = 0.95;

/// A median of rounds, and its interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Interval {
    /// Median of the rounds.
    pub median: f64,
    /// Lower end.
    #[serde(alias = "lower")]
    pub low: f64,
    /// Upper end.
    #[serde(alias = "upper")]
    pub high: f64,
}

impl Interval {
    /// Returns the median of `values`, with the interval that holds `confidence` of the medians of resampled values. The same
    /// for the same values. `None` of no values.
    pub fn of_median(values: &[f64], confidence: f64) -> Option<Interval> {
        let median = median(&mut values.to_vec())?;
        let medians = resample_medians(values, block_length(values), 1);
        Some(widened_interval(
            median,
            medians,
            confidence,
            widening(values),
            range(values),
        ))
    }

    /// Returns the ratio of `base` to `own` with its interval, from rounds in which both ran: a speedup, where both are times.
    pub fn of_ratio(base: &[f64], own: &[f64]) -> Option<Interval> {
        Self::of_median(&ratios_by_round(base, own), CONFIDENCE)
    }

    /// Returns the quotient of the median of `values` by that of `over`, two samples that were taken separately, with the
    /// interval that holds `confidence` of the quotients if both are drawn anew. `None` if either is empty.
    pub fn of_quotient(values: &[f64], over: &[f64], confidence: f64) -> Option<Interval> {
        let quotient = median(&mut values.to_vec())? / median(&mut over.to_vec())?;
        let [upper, lower] =
            [(values, 1), (over, 2)].map(|(values, seed)| resample_medians(values, block_length(values), seed));
        let quotients = upper.into_iter().zip(lower).map(|(a, b)| a / b);
        let ([low, high], [low_over, high_over]) = (range(values), range(over));
        let factor = widening(values).max(widening(over));
        let range = [low / high_over, high / low_over];
        Some(widened_interval(
            quotient,
            quotients.collect(),
            confidence,
            factor,
            range,
        ))
    }

    /// Returns half of the interval's width, as a share of the median.
    pub fn spread(&self) -> f64 {
        (self.high - self.low) / (2.0 * self.median)
    }

    /// Returns median, lower and upper end.
    pub fn to_array(&self) -> [f64; 3] {
        [self.median, self.low, self.high]
    }

    /// Returns the interval with a function applied to all three, which must not decrease.
    pub fn map(&self, function: impl Fn(f64) -> f64) -> Interval {
        let [median, low, high] = self.to_array().map(function);
        Interval { median, low, high }
    }
}

impl fmt::Display for Interval {
    /// Formats the interval as `2.00 (1.90 to 2.10)`, and without its ends if they are equal.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([median, low, high], decimals) = (self.to_array(), f.precision().unwrap_or(2));
        match low == high {
            true => write!(f, "{median:.decimals$}"),
            false => write!(f, "{median:.decimals$} ({low:.decimals$} to {high:.decimals$})"),
        }
    }
}

/// Returns the ratios of `base` to `own`, round by round.
pub fn ratios_by_round(base: &[f64], own: &[f64]) -> Vec<f64> {
    base.iter().zip(own).map(|(base, own)| base / own.max(1e-9)).collect()
}

/// Returns the length of blocks: the square root of the number of values. Values further apart count as independent.
fn block_length(values: &[f64]) -> usize {
    (values.len() as f64).sqrt().round().max(1.0) as usize
}

/// Returns the factor by which an interval of few blocks is widened, since they vary less than independent samples would. With
/// ν + 1 = n / b blocks of b values, it is the root of n / (n - b), the bias of the variance, times ν / (ν - 2), the variance of
/// Student's t. Infinite for fewer than four blocks.
fn widening(values: &[f64]) -> f64 {
    let (n, tripled) = (values.len(), 3 * block_length(values));
    match n > tripled {
        true => (n as f64 / (n - tripled) as f64).sqrt(),
        false => f64::INFINITY,
    }
}

/// Returns the smallest and the largest value.
fn range(values: &[f64]) -> [f64; 2] {
    values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(*value), high.max(*value)]
        })
}

/// Medians of samples of as many values, drawn with repetition in blocks of neighbours; the last value has the first as its
/// neighbour.
fn resample_medians(values: &[f64], block: usize, seed: u64) -> Vec<f64> {
    let mut random = SplitMix(seed);
    let mut sample = vec![0.0; values.len()];
    let mut medians = Vec::with_capacity(RESAMPLES);
    for _ in 0..RESAMPLES {
        for part in sample.chunks_mut(block) {
            let start = random.below(values.len());
            for (k, value) in part.iter_mut().enumerate() {
                *value = values[(start + k) % values.len()];
            }
        }
        medians.extend(median(&mut sample));
    }
    medians
}

/// Returns the interval around `median` by the resampled `medians`, widened by `factor`, and within a range.
fn widened_interval(median: f64, mut medians: Vec<f64>, confidence: f64, factor: f64, range: [f64; 2]) -> Interval {
    medians.sort_by(f64::total_cmp);
    let tail = (1.0 - confidence) / 2.0;
    let end = |share: f64| {
        let end = medians[(share * (medians.len() - 1) as f64).round() as usize];
        // Nothing is widened where all medians are equal.
        let distance = if end == median { 0.0 } else { factor * (end - median) };
        (median + distance).max(range[0]).min(range[1])
    };
    let [low, high] = if factor.is_finite() {
        [tail, 1.0 - tail].map(end)
    } else {
        range
    };
    Interval { median, low, high }
}

pub(crate) fn median(values: &mut [f64]) -> Option<f64> {
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    if values.is_empty() {
        return None;
    }
    let (below, upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp);
    Some(match lower {
        Some(lower) if even => (lower + *upper) / 2.0,
        _ => *upper,
    })
}

/// SplitMix64 (Steele, Lea and Flood 2014).
pub(super) struct SplitMix(pub u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to `end`, without it.
    fn below(&mut self, end: usize) -> usize {
        ((u128::from(self.next()) * end as u128) >> 64) as usize
    }

    /// A number of the uniform distribution from 0 to 1.
    #[cfg(test)]
    pub fn share(&mut self) -> f64 {
        self.below(1 << 30) as f64 / f64::from(1 << 30)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of 400 samples of which the 95 % interval holds `truth`: by blocks, and by single rounds.
    fn count_covered(truth: f64, mut sample: impl FnMut() -> Vec<f64>) -> [usize; 2] {
        let mut covered = [0, 0];
        for _ in 0..400 {
            let values = sample();
            let middle = median(&mut values.clone()).unwrap();
            let single = resample_medians(&values, 1, 1);
            let blocks = Interval::of_median(&values, CONFIDENCE).unwrap();
            let single = widened_interval(middle, single, CONFIDENCE, 1.0, range(&values));
            for (interval, covered) in [blocks, single].iter().zip(&mut covered) {
                *covered += usize::from((interval.low..=interval.high).contains(&truth));
            }
        }
        covered
    }

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(median(&mut [7.0]), Some(7.0));
        assert_eq!(median(&mut []), None);
        assert_eq!(Interval::of_median(&[], CONFIDENCE), None);
        let same = Interval::of_median(&[5.0; 9], CONFIDENCE).unwrap();
        assert_eq!(same.to_array(), [5.0; 3]);
    }

    #[test]
    fn ratios_are_taken_round_by_round() {
        // The second round was slow for both: their ratio is not.
        let ratio = Interval::of_ratio(&[40.0, 400.0, 44.0], &[10.0, 100.0, 10.0]).unwrap();
        assert_eq!((ratio.median, ratio.low), (4.0, 4.0));
        assert_eq!(Interval::of_ratio(&[], &[]), None);
    }

    /// About 95 in a hundred samples of independent rounds have an interval that holds the known median.
    #[test]
    fn intervals_of_independent_rounds_hold_the_median() {
        let mut random = SplitMix(7);
        let [blocks, single] = count_covered(std::f64::consts::LN_2, || {
            (0..21).map(|_| -(1.0 - random.share()).ln()).collect()
        });
        assert!(
            (368..=396).contains(&blocks) && (368..=396).contains(&single),
            "{blocks} and {single} of 400"
        );
    }

    /// Times of rounds under a load that comes and goes: each has this share of the deviation of the one before.
    fn drifting_rounds(count: usize, share: f64, random: &mut SplitMix) -> Vec<f64> {
        let mut drift = 0.0;
        let rounds = (0..count + 20).map(|_| {
            drift = share * drift + 0.05 * (random.share() - 0.5);
            1.0 + drift
        });
        rounds.skip(20).collect()
    }

    /// The table of `docs/study-method.md`: where the load drifts, blocks hold the median, and single rounds do not.
    #[test]
    fn blocks_hold_the_median_as_often_as_the_document_says() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/study-method.md");
        let document = std::fs::read_to_string(path).unwrap();
        for count in [11, 21, 31, 60] {
            let mut row = format!("| {count} |");
            for share in [0.0, 0.6] {
                let mut random = SplitMix(11);
                let [blocks, single] = count_covered(1.0, || drifting_rounds(count, share, &mut random));
                assert!(
                    blocks >= 350 && (share == 0.0 || single <= 310),
                    "{count}: {blocks}, {single}"
                );
                row += &[blocks, single]
                    .map(|held| format!(" {:.0} % |", held as f64 / 4.0))
                    .concat();
            }
            assert!(document.contains(&row), "docs/study-method.md does not have {row}");
        }
    }

    #[test]
    fn intervals_of_few_rounds_are_their_range() {
        let few = Interval::of_median(&[3.0, 1.0, 2.0, 9.0], CONFIDENCE).unwrap();
        assert_eq!(few.to_string(), "2.50 (1.00 to 9.00)");
    }

    #[test]
    fn quotients_tell_samples_apart() {
        let sample = |scale: f64| {
            (0..31)
                .map(|k| scale * (1.0 + 0.001 * f64::from(k % 7)))
                .collect::<Vec<_>>()
        };
        let same = Interval::of_quotient(&sample(2.0), &sample(2.0), CONFIDENCE).unwrap();
        assert!(same.low <= 1.0 && 1.0 <= same.high, "{same:?}");
        let slower = Interval::of_quotient(&sample(2.2), &sample(2.0), CONFIDENCE).unwrap();
        assert!(slower.low > 1.05 && (slower.median - 1.1).abs() < 1e-9, "{slower:?}");
    }
}
