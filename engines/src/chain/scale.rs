//! Sizes of passes as factors of the pass before, which is how presets of libretro state them.

use super::size::{Extent, greatest_divisor};
use crate::fits::Misfit;
use serde::Serialize;
use straightline_codegen::chain::{ChainPlan, PassPlan, SizeRule};

/// Size of a pass in a preset, for one axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScaleContext {
    /// `source`, for a multiple of what the pass before draws, or `absolute`.
    #[serde(rename = "type")]
    pub ty: &'static str,
    /// The factor, or a number of texels.
    pub value: String,
}

/// Sizes of all passes, of each width and height, and the numbers that the picture's width and height have to be multiples of
/// for all sizes to be whole.
#[derive(Debug)]
pub struct Scales {
    pub passes: Vec<[ScaleContext; 2]>,
    pub multiple: [u32; 2],
}

impl Scales {
    /// Finds the factors for a chain whose picture is the input `picture`, if it has one.
    ///
    /// # Errors
    ///
    /// A size that is no multiple of the picture's.
    pub fn of_chain(plan: &ChainPlan, picture: Option<&str>, title: &str) -> Result<Scales, Misfit> {
        let start = Extent::Share {
            input: picture.unwrap_or_default().to_owned(),
            times: 1,
            per: 1,
        };
        let mut before = [start.clone(), start];
        let mut multiple = [1, 1];
        let mut passes = Vec::new();
        for pass in plan.passes.iter() {
            let rule = drawn_size(plan, pass);
            let mut scales = Vec::new();
            for axis in [0, 1] {
                let extent = rule.and_then(|rule| Extent::from_rule(rule, axis));
                let scale = extent.as_ref().and_then(|extent| relative(extent, &before[axis]));
                let (Some(extent), Some(scale)) = (extent, scale) else {
                    return Err(unknown_size(pass, rule, picture, title));
                };
                if let Extent::Share { per, .. } = &extent {
                    let common = greatest_divisor(multiple[axis], *per);
                    multiple[axis] = (multiple[axis] / common).saturating_mul(*per);
                }
                before[axis] = extent;
                scales.push(scale);
            }
            passes.extend(<[ScaleContext; 2]>::try_from(scales).ok());
        }
        Ok(Scales { passes, multiple })
    }
}

/// Size of what a pass draws.
pub fn drawn_size<'p>(plan: &'p ChainPlan, pass: &PassPlan) -> Option<&'p SizeRule> {
    Some(&plan.picture(pass.writes.first()?)?.size)
}

fn relative(extent: &Extent, before: &Extent) -> Option<ScaleContext> {
    match (extent, before) {
        (Extent::Texels(texels), _) => Some(ScaleContext {
            ty: "absolute",
            value: texels.to_string(),
        }),
        (Extent::Share { input, times, per }, before) => {
            let (of, before_times, before_per) = match before {
                Extent::Share { input, times, per } => (input, times, per),
                Extent::Texels(_) => return None,
            };
            let factor = f64::from(*times) * f64::from(*before_per) / (f64::from(*per) * f64::from(*before_times));
            (input == of).then(|| ScaleContext {
                ty: "source",
                value: format!("{factor:?}"),
            })
        }
    }
}

fn unknown_size(pass: &PassPlan, rule: Option<&SizeRule>, picture: Option<&str>, title: &str) -> Misfit {
    let size = rule.map_or_else(String::new, |rule| format!(", of size `{rule}`"));
    let picture = picture.unwrap_or("color");
    let why = format!(
        "draws `{}`{size}, and {title} takes multiples of what the pass before draws",
        pass.name
    );
    Misfit::new(why).help(format!(
        "draw it at `{picture}.size()`, or at a multiple such as `{picture}.size() / 2`; pictures of constant size come last"
    ))
}
