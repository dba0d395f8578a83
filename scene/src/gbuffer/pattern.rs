//! Patterns by name, and the options that say where a capture was sampled.

use crate::capture::{Capture, ShadingSample};
use glam::Vec2;
use straightline_kernels::sraa::{Pattern, Sraa};
use straightline_kernels::{OptionText, OptionValues};

/// Names of the patterns that have one.
pub const PATTERNS: [&str; 6] = ["ordered4", "latin4", "standard8", "ordered16", "latin16", "standard16"];

/// The pattern of a name, one of [`PATTERNS`].
fn pattern_from_name(name: &str) -> Option<Pattern> {
    Some(match name {
        "ordered4" => Pattern::Ordered4,
        "latin4" => Pattern::Latin4,
        "standard8" => Pattern::Standard8,
        "ordered16" => Pattern::Ordered16,
        "latin16" => Pattern::Latin16,
        "standard16" => Pattern::Standard16,
        _ => return None,
    })
}

/// Offsets of the geometry samples of a pattern, in pixels from the pixel's centre, y down: of one of [`PATTERNS`], or of
/// numbers separated by commas, x and y in turn. `None` for any other text, and for places outside the pixel.
pub fn pattern_offsets(pattern: &str) -> Option<Vec<Vec2>> {
    let Some(pattern) = pattern_from_name(pattern) else {
        let numbers: Option<Vec<f32>> = pattern.split(',').map(|part| part.trim().parse().ok()).collect();
        let numbers = numbers.filter(|n| n.len() % 2 == 0 && n.iter().all(|axis| axis.abs() <= 0.5))?;
        return Some(numbers.chunks_exact(2).map(Vec2::from_slice).collect());
    };
    let filter = Sraa {
        pattern,
        ..Sraa::default()
    };
    Some((0..filter.samples()).map(|sample| filter.offset(sample)).collect())
}

/// The name of the pattern of such samples, if it has one.
fn name_of(offsets: &[Vec2]) -> Option<&'static str> {
    let near = |a: &Vec2, b: &Vec2| (*a - *b).abs().max_element() < 1.0e-4;
    let is = |name: &&str| {
        let known = pattern_offsets(name).unwrap_or_default();
        known.len() == offsets.len() && known.iter().zip(offsets).all(|(a, b)| near(a, b))
    };
    PATTERNS.into_iter().find(is)
}

/// The pattern of such samples, if it has a name.
pub(crate) fn pattern_of(offsets: &[Vec2]) -> Option<Pattern> {
    name_of(offsets).and_then(pattern_from_name)
}

/// The projection of a capture's camera, by the name of its option; without a camera the default.
pub(super) fn projection_of(capture: &Capture) -> &'static str {
    match capture.camera.and_then(|camera| camera.parallel_height) {
        Some(_) => "parallel",
        None => "perspective",
    }
}

/// The options of SRAA that say where `capture` was sampled.
pub fn sampled_at(capture: &Capture) -> Vec<(String, String)> {
    let mut options = match name_of(&capture.samples) {
        Some(name) => vec![("pattern", name.to_owned())],
        None => {
            let numbers = capture.samples.iter().flat_map(|offset| offset.to_array());
            let numbers: Vec<String> = numbers.map(|axis| axis.to_string()).collect();
            vec![("pattern", "listed".to_owned()), ("offsets", numbers.join(","))]
        }
    };
    if projection_of(capture) == "parallel" {
        options.push(("projection", "parallel".to_owned()));
    }
    match &capture.shading {
        ShadingSample::Centre => options.push(("shading", "centre".to_owned())),
        ShadingSample::Placed => options.push(("shading", "placed".to_owned())),
        ShadingSample::Sample(0) => options.push(("shading", "sample0".to_owned())),
        ShadingSample::Sample(_) | ShadingSample::Samples(_) => {
            let shaded: Vec<String> = capture.shaded_layers().iter().map(usize::to_string).collect();
            options.push(("shading", "listed".to_owned()));
            options.push(("shaded", shaded.join(",")));
        }
    }
    options
        .into_iter()
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}

/// Returns options for a camera with parallel rays that sees `height` scene units from the upper to the lower edge of the picture. There is
/// no distance from an eye, so what is measured relative to depth is measured relative to that height instead. `values` are those
/// of all options, of a preset too.
pub fn in_parallel(options: &[OptionText], values: &OptionValues, height: f32) -> Vec<OptionText> {
    let mut changed = vec![("projection".to_owned(), "parallel".to_owned())];
    if values.choice("difference") == Some("relative") {
        let scale = values.number("depth-scale").unwrap_or(1.0) / f64::from(height);
        changed.push(("difference".to_owned(), "absolute".to_owned()));
        changed.push(("depth-scale".to_owned(), scale.to_string()));
    }
    let kept = options
        .iter()
        .filter(|(name, _)| changed.iter().all(|(other, _)| other != name));
    kept.cloned().chain(changed.iter().cloned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_centred_but_for_the_hardwares_sixteen() {
        for name in PATTERNS {
            let offsets = pattern_offsets(name).expect("a pattern");
            let mean = offsets.iter().sum::<Vec2>() / offsets.len() as f32;
            let expected = match name {
                "standard16" => Vec2::splat(-1.0 / 32.0),
                _ => Vec2::ZERO,
            };
            assert_eq!(mean, expected, "{name}");
        }
    }
}
