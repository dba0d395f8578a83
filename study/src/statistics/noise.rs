//! Noise of a run, from shaders that are equal and were timed as different ones: A/A pairs.

use super::Interval;
use std::collections::BTreeMap;

/// Mark of a ratio that a run cannot distinguish from 1.
pub const MARK: &str = " ≈";

/// Spread of the ratios of equal shaders: the floor below which a ratio means nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Number of pairs of equal shaders.
    pub pairs: usize,
    /// Largest ratio that an interval of a pair holds, from 1 on.
    pub floor: f64,
}

impl Noise {
    /// Finds the equal shaders of a run, given the identity of each shader and the time of each of its rounds. The identity
    /// includes the group that ran in turn. Each is compared with the one before it; `None` if no two are equal.
    pub fn from_run<'a>(run: impl IntoIterator<Item = (String, &'a [f64])>) -> Option<Noise> {
        let mut last: BTreeMap<String, &[f64]> = BTreeMap::new();
        let mut noise = None;
        for (shader, rounds_ms) in run {
            let before = last.insert(shader, rounds_ms);
            if let Some(ratio) = before.and_then(|before| Interval::of_ratio(before, rounds_ms)) {
                let noise = noise.get_or_insert(Noise { pairs: 0, floor: 1.0 });
                noise.pairs += 1;
                noise.floor = noise.floor.max(ratio.high).max(1.0 / ratio.low);
            }
        }
        noise
    }

    /// Returns whether a ratio is within the noise.
    pub fn hides(&self, ratio: f64) -> bool {
        (1.0 / self.floor..=self.floor).contains(&ratio)
    }
}

/// Returns the mark of a ratio: empty if it is beyond the noise, or the noise is unknown.
pub fn mark_ratio(noise: Option<Noise>, ratio: f64) -> &'static str {
    match noise.is_some_and(|noise| noise.hides(ratio)) {
        true => MARK,
        false => "",
    }
}

/// Returns a sentence on the noise of a run.
pub fn describe_noise(noise: Option<Noise>) -> String {
    match noise {
        None => "No two shaders are equal, so the noise of this run is unknown.".to_owned(),
        Some(Noise { pairs, floor }) => {
            let pairs = match pairs {
                1 => "A pair of equal shaders has a ratio".to_owned(),
                pairs => format!("{pairs} pairs of equal shaders have ratios"),
            };
            format!(
                "{pairs} of {:.2} to {floor:.2}; ratios within that are marked{MARK}.",
                1.0 / floor
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two equal shaders of a run on a busy machine: one seemed 1.36 times as fast as the baseline, the other no faster.
    #[test]
    fn equal_shaders_are_no_longer_distinguished() {
        let (base, slow) = ([1.36, 1.36, 1.42, 1.36, 1.33], [1.38, 1.4, 1.41, 1.36, 1.34]);
        let fast = [1.0; 5];
        let run = [("base", &base), ("equal", &fast), ("equal", &slow)];
        let noise = Noise::from_run(run.map(|(shader, rounds)| (shader.to_owned(), &rounds[..]))).unwrap();
        assert_eq!(noise.pairs, 1);
        let ratio = Interval::of_ratio(&base, &fast).unwrap().median;
        assert!(
            ratio == 1.36 && noise.hides(ratio) && noise.hides(1.0 / ratio),
            "{noise:?}"
        );
        assert!(!noise.hides(1.5) && !noise.hides(0.6), "{noise:?}");
        assert_eq!(mark_ratio(Some(noise), ratio), MARK);
    }

    #[test]
    fn each_equal_shader_is_compared_with_the_one_before() {
        let noise = |shaders: &[(&str, &[f64])]| {
            let run = shaders.iter();
            Noise::from_run(run.map(|(shader, rounds)| ((*shader).to_owned(), *rounds)))
        };
        let rounds = [1.0, 1.1];
        assert_eq!(noise(&[("a", &rounds), ("b", &rounds), ("b", &[])]), None);
        assert_eq!(mark_ratio(None, 1.0), "");
        let three = noise(&[("a", &rounds), ("b", &rounds), ("a", &rounds), ("a", &rounds)]);
        assert_eq!(three, Some(Noise { pairs: 2, floor: 1.0 }));
    }
}
