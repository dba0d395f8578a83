//! Cost of frames, summed from their passes.

use super::measure::Measured;
use crate::failure::Failure;
use serde::Serialize;
use straightline_scene::render::{FramePass, Samples};
use straightline_study::statistics::{CONFIDENCE, Interval};

/// A way to antialias a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// Shaded once a pixel, without antialiasing.
    None,
    /// The main G-buffer, and this many samples in one pass each.
    Sraa(Samples),
    /// The main G-buffer, and four further samples in one multisampled pass.
    SraaMultisampled,
    /// Deferred shading of every sample, and their mean.
    Supersampling(Samples),
    /// Forward rendering with four samples.
    Multisampling,
}

/// Columns of the table.
const METHODS: [Method; 8] = [
    Method::None,
    Method::Sraa(Samples::Three),
    Method::Sraa(Samples::Four),
    Method::SraaMultisampled,
    Method::Sraa(Samples::Sixteen),
    Method::Supersampling(Samples::Four),
    Method::Supersampling(Samples::Sixteen),
    Method::Multisampling,
];

/// Cost of a frame, in milliseconds: a column of the paper's table 2.
#[derive(Clone, Debug, Serialize)]
pub struct FrameCost {
    pub method: String,
    /// `null` if geometry and shading are one pass.
    pub geometry_ms: Option<Interval>,
    pub shading_ms: Interval,
    /// `null` without a filter, or if it is not a separate pass.
    pub filter_ms: Option<Interval>,
    /// Sum of the above, round by round.
    pub net_ms: Interval,
}

/// SRAA compared with another method, over rounds in which both ran.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    pub method: String,
    pub over: String,
    /// Speedup of a frame.
    pub speedup: Interval,
    /// Milliseconds of shading once a pixel above which SRAA is cheaper, if each further sample costs as much to shade.
    /// `null` if the other method shades no further samples. Negative if SRAA is cheaper at any shading cost.
    pub break_even_ms: Option<Interval>,
}

/// Parts of a frame, round by round.
struct Parts {
    geometry: Option<Vec<f64>>,
    shading: Vec<f64>,
    filter: Option<Vec<f64>>,
}

impl Method {
    fn name(self) -> String {
        match self {
            Method::None => "1x".to_owned(),
            Method::Sraa(Samples::Three) => "SRAA 4, sample0".to_owned(),
            Method::Sraa(samples) => format!("SRAA {}", samples.count()),
            Method::SraaMultisampled => "SRAA 4, MSAA pass".to_owned(),
            Method::Supersampling(samples) => format!("{}x shading", samples.count()),
            Method::Multisampling => "MSAA 4".to_owned(),
        }
    }

    fn frame_parts(self, measured: &Measured) -> Result<Parts, Failure> {
        let pass = |pass| measured.pass_time(pass).map(|timed| timed.rounds_ms.clone());
        let main = || pass(FramePass::Geometry(Samples::One));
        let (geometry, shading, filter) = match self {
            Method::None => (Some(main()?), FramePass::Shading(Samples::One), None),
            Method::Sraa(samples) => (
                Some(add_rounds(&main()?, &pass(FramePass::Auxiliary(samples))?)),
                FramePass::Shading(Samples::One),
                Some(measured.default_filter(samples)?.rounds_ms.clone()),
            ),
            Method::SraaMultisampled => (
                Some(add_rounds(&main()?, &pass(FramePass::AuxiliaryMultisampled)?)),
                FramePass::Shading(Samples::One),
                Some(measured.default_filter(Samples::Four)?.rounds_ms.clone()),
            ),
            Method::Supersampling(samples) => (
                Some(pass(FramePass::Geometry(samples))?),
                FramePass::Shading(samples),
                Some(pass(FramePass::Resolve(samples))?),
            ),
            Method::Multisampling => (None, FramePass::Forward, None),
        };
        Ok(Parts {
            geometry,
            shading: pass(shading)?,
            filter,
        })
    }
}

impl Parts {
    /// Returns the time of the frame without its shading, round by round.
    fn beside_shading(&self) -> Vec<f64> {
        let nothing = vec![0.0; self.shading.len()];
        let parts = [&self.geometry, &self.filter].map(|part| part.as_ref().unwrap_or(&nothing));
        add_rounds(parts[0], parts[1])
    }

    fn net_times(&self) -> Vec<f64> {
        add_rounds(&self.beside_shading(), &self.shading)
    }
}

fn add_rounds(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

/// Returns the median of the rounds with its interval. Fails if there are none.
pub fn find_interval(rounds: &[f64]) -> Result<Interval, Failure> {
    Interval::of_median(rounds, CONFIDENCE).ok_or_else(|| Failure::Failed("nothing was timed".to_owned()))
}

/// Computes the paper's table 2 from the measurements.
pub fn frame_costs(measured: &Measured) -> Result<Vec<FrameCost>, Failure> {
    let cost = |method: &Method| {
        let parts = method.frame_parts(measured)?;
        let of = |rounds: &Option<Vec<f64>>| rounds.as_deref().map(find_interval).transpose();
        let (geometry, shading, filter) = (of(&parts.geometry)?, find_interval(&parts.shading)?, of(&parts.filter)?);
        Ok(FrameCost {
            method: method.name(),
            geometry_ms: geometry,
            shading_ms: shading,
            filter_ms: filter,
            net_ms: find_interval(&parts.net_times())?,
        })
    };
    METHODS.iter().map(cost).collect()
}

/// Compares SRAA with every other method.
pub fn compare_methods(measured: &Measured) -> Result<Vec<Comparison>, Failure> {
    let is_sraa = |method: &&Method| matches!(method, Method::Sraa(_) | Method::SraaMultisampled);
    let mut all = Vec::new();
    for method in METHODS.iter().filter(is_sraa) {
        let own = method.frame_parts(measured)?;
        for over in METHODS.iter().filter(|method| !is_sraa(method)) {
            let other = over.frame_parts(measured)?;
            let speedups: Vec<f64> = other
                .net_times()
                .iter()
                .zip(own.net_times())
                .map(|(a, b)| a / b)
                .collect();
            let break_even_ms = match over {
                Method::Supersampling(samples) => {
                    let rounds = break_even_rounds(&own.beside_shading(), &other.beside_shading(), *samples);
                    Some(find_interval(&rounds)?)
                }
                _ => None,
            };
            all.push(Comparison {
                method: method.name(),
                over: over.name(),
                speedup: find_interval(&speedups)?,
                break_even_ms,
            });
        }
    }
    Ok(all)
}

/// Returns the break-even shading cost against shading all samples, for a filter with this many samples beside the main
/// G-buffer, each drawn in its own pass.
pub fn break_even(measured: &Measured, samples: Samples, filter: &[f64]) -> Result<Interval, Failure> {
    let pass = |pass| measured.pass_time(pass).map(|timed| timed.rounds_ms.as_slice());
    let geometry = add_rounds(
        pass(FramePass::Geometry(Samples::One))?,
        pass(FramePass::Auxiliary(samples))?,
    );
    let own = add_rounds(&geometry, filter);
    let samples = match samples {
        Samples::Three => Samples::Four,
        other => other,
    };
    let other = Method::Supersampling(samples).frame_parts(measured)?.beside_shading();
    find_interval(&break_even_rounds(&own, &other, samples))
}

/// Returns the shading cost s of one sample at which `own + s` and `other + samples * s` are equal, round by round.
fn break_even_rounds(own: &[f64], other: &[f64], samples: Samples) -> Vec<f64> {
    let further = f64::from(samples.count()) - 1.0;
    own.iter()
        .zip(other)
        .map(|(own, other)| (own - other) / further)
        .collect()
}
