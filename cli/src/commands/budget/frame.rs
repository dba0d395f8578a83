//! Cost of frames, from the passes that they consist of.

use super::measure::Measured;
use crate::failure::Failure;
use serde::Serialize;
use straightline_bench::execute::Quartiles;
use straightline_scene::render::{FramePass, Samples};

/// A way to antialias a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// Shaded once a pixel.
    None,
    /// The main G-buffer, and so many samples in a pass for each.
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

/// Cost of a frame: a column of the paper's table 2, in milliseconds.
#[derive(Clone, Debug, Serialize)]
pub struct FrameCost {
    pub method: String,
    /// `null` where it is drawn and shaded in one pass.
    pub geometry_ms: Option<Quartiles>,
    pub shading_ms: Quartiles,
    /// `null` where there is none, or none apart.
    pub filter_ms: Option<Quartiles>,
    /// The sum of the above: each quartile is the sum of the parts'.
    pub net_ms: Quartiles,
}

/// SRAA beside another method, from rounds in which both ran.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    pub method: String,
    pub over: String,
    /// Speedup of a frame.
    pub speedup: Quartiles,
    /// Milliseconds of shading once a pixel from which SRAA is cheaper, if each further sample's shading costs as much; `null`
    /// where the other method does not shade further samples. Below 0: whatever shading costs.
    pub break_even_ms: Option<Quartiles>,
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
    /// All of a frame but its shading.
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

/// Of at least one round.
pub fn find_quartiles(rounds: &[f64]) -> Result<Quartiles, Failure> {
    Quartiles::from_values(rounds).ok_or_else(|| Failure::Failed("nothing was timed".to_owned()))
}

/// The paper's table 2, of what was timed.
pub fn frame_costs(measured: &Measured) -> Result<Vec<FrameCost>, Failure> {
    let cost = |method: &Method| {
        let parts = method.frame_parts(measured)?;
        let of = |rounds: &Option<Vec<f64>>| rounds.as_deref().map(find_quartiles).transpose();
        let (geometry, shading, filter) = (
            of(&parts.geometry)?,
            find_quartiles(&parts.shading)?,
            of(&parts.filter)?,
        );
        Ok(FrameCost {
            method: method.name(),
            geometry_ms: geometry,
            shading_ms: shading,
            filter_ms: filter,
            net_ms: Quartiles::sum([geometry, Some(shading), filter].into_iter().flatten()),
        })
    };
    METHODS.iter().map(cost).collect()
}

/// SRAA beside everything else.
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
                    Some(find_quartiles(&rounds)?)
                }
                _ => None,
            };
            all.push(Comparison {
                method: method.name(),
                over: over.name(),
                speedup: find_quartiles(&speedups)?,
                break_even_ms,
            });
        }
    }
    Ok(all)
}

/// Break-even shading cost of a filter with so many samples beside the main G-buffer, drawn in a pass each, against shading all
/// samples.
pub fn break_even(measured: &Measured, samples: Samples, filter: &[f64]) -> Result<Quartiles, Failure> {
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
    find_quartiles(&break_even_rounds(&own, &other, samples))
}

/// Shading s of one sample, with which `own + s` and `other + samples * s` are equal, round by round.
fn break_even_rounds(own: &[f64], other: &[f64], samples: Samples) -> Vec<f64> {
    let further = f64::from(samples.count()) - 1.0;
    own.iter()
        .zip(other)
        .map(|(own, other)| (own - other) / further)
        .collect()
}
