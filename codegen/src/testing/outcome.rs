//! Outcome of a case.

use straightline_evaluator::front::testing::{Kind, Recorded, Site, SiteKind};
use straightline_kernels::properties::float_text;

/// Outcome of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All assertions hold.
    Held,
    /// `assume` passed over the case.
    PassedOver,
    /// An assertion fails.
    Failed(Violation),
}

/// An assertion that fails, the first of its case.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Number of the assertion.
    pub site: usize,
    /// Values of the assertion, left and right, if they are numbers.
    pub values: [Option<Recording>; 2],
}

/// A number, vector or boolean that an assertion compares.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    kind: Kind,
    /// The components; of floats in the precision of the runner.
    pub components: Vec<f64>,
}

impl Outcome {
    /// Reads the outcome of an invocation from its elements of the buffers.
    pub(super) fn decode(sites: &[Site], state: [f64; 2], floats: [[f64; 4]; 2], words: [[f64; 4]; 2]) -> Outcome {
        let recorded = match Recorded::decode(state[1] as u32) {
            Some(recorded) if state[0] > 0.0 => recorded,
            _ => return Outcome::Held,
        };
        let site = recorded.site as usize;
        if sites.get(site).is_some_and(|site| site.kind == SiteKind::Assume) {
            return Outcome::PassedOver;
        }
        let values = [0, 1].map(|side| {
            let (kind, width) = recorded.of[side]?;
            let number = |word: f64| match kind {
                Kind::I32 => f64::from(word as u32 as i32),
                _ => word,
            };
            let all = match kind {
                Kind::F32 => floats[side],
                _ => words[side].map(number),
            };
            Some(Recording {
                kind,
                components: all[..usize::from(width).min(4)].to_vec(),
            })
        });
        Outcome::Failed(Violation { site, values })
    }

    /// The assertion that fails.
    pub fn violation(&self) -> Option<&Violation> {
        match self {
            Outcome::Failed(violation) => Some(violation),
            _ => None,
        }
    }
}

impl Violation {
    /// Returns whether another one is of the same assertion and has the same values, as texts.
    pub fn is_alike(&self, other: &Violation) -> bool {
        let texts = |of: &Violation| of.values.each_ref().map(|value| value.as_ref().map(Recording::text));
        self.site == other.site && texts(self) == texts(other)
    }
}

impl Recording {
    /// The value as Rust text.
    pub fn text(&self) -> String {
        let number = |value: &f64| match self.kind {
            // The bits of a NaN differ between machines.
            Kind::F32 if value.is_nan() => "NaN".to_owned(),
            Kind::F32 if f64::from(*value as f32) == *value => float_text(*value as f32),
            Kind::F32 => format!("{value:?}"),
            Kind::Bool => (*value != 0.0).to_string(),
            _ => value.to_string(),
        };
        let numbers: Vec<String> = self.components.iter().map(number).collect();
        match (numbers.as_slice(), self.kind) {
            ([one], _) => one.clone(),
            (all, Kind::F32) => format!("vec{}({})", all.len(), all.join(", ")),
            (all, Kind::I32) => format!("ivec{}({})", all.len(), all.join(", ")),
            (all, Kind::U32) => format!("uvec{}({})", all.len(), all.join(", ")),
            (all, Kind::Bool) => format!("bvec{}({})", all.len(), all.join(", ")),
        }
    }

    /// Greatest distance of two floats' components in units of the last place; `None` of other values and of NaN.
    pub fn ulps_to(&self, other: &Recording) -> Option<u32> {
        let floats = self.kind == Kind::F32 && other.kind == Kind::F32;
        if !floats || self.components.len() != other.components.len() {
            return None;
        }
        let ordinal = |x: f64| {
            let bits = (x as f32).to_bits();
            let size = (bits & 0x7fff_ffff) as i32;
            if bits >> 31 == 1 { -size } else { size }
        };
        let pairs = self.components.iter().zip(&other.components);
        let distances = pairs.map(|(a, b)| (!a.is_nan() && !b.is_nan()).then(|| ordinal(*a).abs_diff(ordinal(*b))));
        distances.collect::<Option<Vec<u32>>>()?.into_iter().max()
    }
}
