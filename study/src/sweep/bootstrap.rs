//! Confidence interval of a median: the percentile bootstrap (Efron and Tibshirani 1993, §13).

use serde::{Deserialize, Serialize};

/// Number of resamples.
const RESAMPLES: usize = 2000;

/// A median, and an interval around it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Interval {
    /// Of what was measured.
    pub median: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Half of the interval's width, in parts of the median.
    pub fn spread(&self) -> f64 {
        (self.high - self.low) / (2.0 * self.median)
    }
}

/// The median of `values`, with the interval in which the medians of `confidence` of all samples lie that are drawn from them
/// with repetition. The same for the same values. `None` of no values.
pub fn median_of(values: &[f64], confidence: f64) -> Option<Interval> {
    let median = median(&mut values.to_vec())?;
    let medians = resample_medians(values, 1);
    let [low, high] = interval_ends(medians, confidence);
    Some(Interval { median, low, high })
}

/// Quotient of the median of `of` by that of `over`, two samples that were taken apart, with the interval in which `confidence`
/// of the quotients lie if both are drawn anew. `None` if either is empty.
pub fn quotient_of(of: &[f64], over: &[f64], confidence: f64) -> Option<Interval> {
    let quotient = median(&mut of.to_vec())? / median(&mut over.to_vec())?;
    let quotients = resample_medians(of, 1).into_iter().zip(resample_medians(over, 2));
    let [low, high] = interval_ends(quotients.map(|(a, b)| a / b).collect(), confidence);
    Some(Interval {
        median: quotient,
        low,
        high,
    })
}

/// Medians of samples of as many values, drawn with repetition.
fn resample_medians(values: &[f64], seed: u64) -> Vec<f64> {
    let mut random = SplitMix(seed);
    let mut sample = vec![0.0; values.len()];
    let mut medians = Vec::with_capacity(RESAMPLES);
    for _ in 0..RESAMPLES {
        sample.fill_with(|| values[random.below(values.len())]);
        medians.extend(median(&mut sample));
    }
    medians
}

fn interval_ends(mut of: Vec<f64>, confidence: f64) -> [f64; 2] {
    of.sort_by(f64::total_cmp);
    let tail = (1.0 - confidence) / 2.0;
    [tail, 1.0 - tail].map(|share| {
        let place = share * (of.len() - 1) as f64;
        of[place.round() as usize]
    })
}

fn median(values: &mut [f64]) -> Option<f64> {
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
struct SplitMix(u64);

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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(median(&mut [7.0]), Some(7.0));
        assert_eq!(median(&mut []), None);
        assert_eq!(median_of(&[], 0.95), None);
        let same = median_of(&[5.0; 9], 0.95).unwrap();
        assert_eq!((same.low, same.median, same.high), (5.0, 5.0, 5.0));
    }

    /// Of 400 samples of 21 numbers whose median is known, about 95 in a hundred give an interval that holds it.
    #[test]
    fn intervals_hold_the_median_as_often_as_they_say() {
        let mut random = SplitMix(7);
        let mut exponential = || -(1.0 - random.below(1 << 30) as f64 / f64::from(1 << 30)).ln();
        let truth = std::f64::consts::LN_2;
        let held = (0..400).filter(|_| {
            let sample: Vec<f64> = (0..21).map(|_| exponential()).collect();
            let interval = median_of(&sample, 0.95).unwrap();
            (interval.low..=interval.high).contains(&truth)
        });
        let held = held.count();
        assert!((368..=396).contains(&held), "{held} of 400");
    }

    #[test]
    fn quotients_tell_samples_apart() {
        let sample = |scale: f64| {
            (0..31)
                .map(|k| scale * (1.0 + 0.001 * f64::from(k % 7)))
                .collect::<Vec<_>>()
        };
        let same = quotient_of(&sample(2.0), &sample(2.0), 0.95).unwrap();
        assert!(same.low <= 1.0 && 1.0 <= same.high, "{same:?}");
        let slower = quotient_of(&sample(2.2), &sample(2.0), 0.95).unwrap();
        assert!(slower.low > 1.05 && (slower.median - 1.1).abs() < 1e-9, "{slower:?}");
    }
}
