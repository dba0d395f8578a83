//! The plan of a chain: passes that run one after another, with the pictures between them.
//!
//! As a [`Plan`](crate::plan::Plan), it is made of constants, or read from JSON.

mod check;

use crate::Format;
use crate::plan::{List, Text};
#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};
use std::fmt;

pub use check::BadChain;

/// Version of the layout of a chain's JSON. A reader refuses a chain whose schema it does not know.
pub const CHAIN_SCHEMA: u32 = 1;

/// Most terms of a rule for a size.
const MOST_TERMS: usize = 256;

/// Passes in order, with the pictures that they write and read. [`check`](Self::check) looks for contradictions.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct ChainPlan {
    /// Layout version, [`CHAIN_SCHEMA`].
    pub schema: u32,
    /// Name of the function that describes the chain.
    pub chain: Text,
    /// Textures, samplers and buffers of the caller, by name.
    pub inputs: List<Text>,
    /// Pictures in the order in which they are written. Their names differ from those of inputs.
    pub pictures: List<PicturePlan>,
    /// Passes in the order in which they run.
    pub passes: List<PassPlan>,
}

/// A picture that a pass writes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct PicturePlan {
    /// Name: that of the variable that holds it, with a number where several have it.
    pub name: Text,
    /// Width and height.
    pub size: SizeRule,
    /// Format of its texels.
    pub format: Format,
    /// Number of the texture that holds it. Pictures of one number have one size and format, and are never needed at
    /// the same time. `None` for a result of the chain, which the caller owns.
    #[cfg_attr(feature = "json", serde(default, skip_serializing_if = "Option::is_none"))]
    pub memory: Option<u32>,
}

/// A pass.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct PassPlan {
    /// Name: that of the first picture that it writes.
    pub name: Text,
    /// Name of its shader, which several passes may have.
    pub shader: Text,
    /// Inputs of the shader with what each reads.
    pub reads: List<ReadPlan>,
    /// Names of the pictures that it writes, in the order of the shader's outputs.
    pub writes: List<Text>,
}

/// An input of a pass.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct ReadPlan {
    /// Name in the shader.
    pub name: Text,
    /// Name of the input of the chain, or of the picture.
    pub from: Text,
}

/// The size of a picture, computed from those of inputs: terms in postfix order, on a stack of sizes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(transparent))]
pub struct SizeRule(pub List<SizeTerm>);

/// A term of a [`SizeRule`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "lowercase"))]
pub enum SizeTerm {
    /// Pushes the size of an input of the chain, by name.
    Of(Text),
    /// Pushes a width and a height.
    Number([u32; 2]),
    /// Takes two sizes off the stack and pushes what the operation makes of them, for width and height.
    Apply(SizeOp),
}

/// An operation on two widths, or two heights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "lowercase"))]
#[allow(missing_docs)] // named as in Rust
pub enum SizeOp {
    Add,
    Sub,
    Mul,
    /// Rounded down; by 0, the dividend.
    Div,
    Max,
    Min,
}

impl SizeOp {
    /// Computes the operation. Results that a `u32` cannot hold are its nearest value.
    pub fn apply(self, a: u32, b: u32) -> u32 {
        match self {
            SizeOp::Add => a.saturating_add(b),
            SizeOp::Sub => a.saturating_sub(b),
            SizeOp::Mul => a.saturating_mul(b),
            SizeOp::Div => a.checked_div(b).unwrap_or(a),
            SizeOp::Max => a.max(b),
            SizeOp::Min => a.min(b),
        }
    }
}

/// A rule that yields no size: what is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadRule(pub String);

impl fmt::Display for BadRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadRule {}

impl SizeRule {
    /// The size of an input.
    pub fn of_input(name: &str) -> SizeRule {
        SizeRule(vec![SizeTerm::Of(name.to_owned().into())].into())
    }

    /// Computes a value of the rule, from those of inputs by name, of numbers, and of operations on two values.
    ///
    /// # Errors
    ///
    /// Errors of `of`; terms that leave no value or several on the stack, or are too many. The generator writes none such.
    pub fn fold<T>(
        &self,
        mut of: impl FnMut(&str) -> Result<T, BadRule>,
        mut number: impl FnMut([u32; 2]) -> T,
        mut apply: impl FnMut(SizeOp, T, T) -> T,
    ) -> Result<T, BadRule> {
        if self.0.len() > MOST_TERMS {
            return Err(BadRule(format!("{} terms, more than {MOST_TERMS}", self.0.len())));
        }
        let mut stack: Vec<T> = Vec::new();
        for term in self.0.iter() {
            let value = match term {
                SizeTerm::Apply(op) => match (stack.pop(), stack.pop()) {
                    (Some(b), Some(a)) => apply(*op, a, b),
                    _ => return Err(BadRule("an operation without its two sizes".to_owned())),
                },
                SizeTerm::Of(name) => of(name)?,
                SizeTerm::Number(size) => number(*size),
            };
            stack.push(value);
        }
        match (stack.pop(), stack.len()) {
            (Some(value), 0) => Ok(value),
            (last, left) => Err(BadRule(format!(
                "{} sizes, not one",
                left + usize::from(last.is_some())
            ))),
        }
    }

    /// Computes the size, at least 1 in both directions. `size_of` gives the size of an input.
    ///
    /// # Errors
    ///
    /// An input without a size, and those of [`fold`](Self::fold).
    pub fn evaluate(&self, size_of: &dyn Fn(&str) -> Option<[u32; 2]>) -> Result<[u32; 2], BadRule> {
        let of = |name: &str| size_of(name).ok_or_else(|| BadRule(format!("`{name}` has no size")));
        let apply = |op: SizeOp, a: [u32; 2], b: [u32; 2]| [0, 1].map(|axis: usize| op.apply(a[axis], b[axis]));
        let size = self.fold(of, |size| size, apply)?;
        Ok(size.map(|side| side.max(1)))
    }
}

/// In infix form, as in Rust: `color.size() / 2`.
impl fmt::Display for SizeRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Each text has `true` if it is a sum, a product or the like.
        let number = |[x, y]: [u32; 2]| match x == y {
            true => (x.to_string(), false),
            false => (format!("({x}, {y})"), false),
        };
        let grouped = |(text, is_compound): (String, bool)| match is_compound {
            true => format!("({text})"),
            false => text,
        };
        let apply = |op: SizeOp, a: (String, bool), b: (String, bool)| match op {
            SizeOp::Add => (format!("{} + {}", a.0, grouped(b)), true),
            SizeOp::Sub => (format!("{} - {}", a.0, grouped(b)), true),
            SizeOp::Mul => (format!("{} * {}", grouped(a), grouped(b)), true),
            SizeOp::Div => (format!("{} / {}", grouped(a), grouped(b)), true),
            SizeOp::Max => (format!("{}.max({})", grouped(a), b.0), false),
            SizeOp::Min => (format!("{}.min({})", grouped(a), b.0), false),
        };
        match self.fold(|name| Ok((format!("{name}.size()"), false)), number, apply) {
            Ok((text, _)) => f.write_str(&text),
            Err(bad) => write!(f, "{bad}"),
        }
    }
}

#[cfg(feature = "json")]
impl ChainPlan {
    /// Reads a chain from JSON, refusing other schemas and unknown fields. It may contradict itself: see
    /// [`check`](Self::check).
    ///
    /// # Errors
    ///
    /// [`Error::Json`](crate::Error::Json) and [`Error::ChainSchema`](crate::Error::ChainSchema).
    pub fn from_json(text: &str) -> Result<Self, crate::Error> {
        #[derive(Deserialize)]
        struct Head {
            schema: u32,
        }
        let head: Head = serde_json::from_str(text)?;
        match head.schema {
            CHAIN_SCHEMA => Ok(serde_json::from_str(text)?),
            found => Err(crate::Error::ChainSchema { found }),
        }
    }

    /// The chain as indented JSON that ends in a newline. Equal chains give equal text.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a chain is plain data");
        text.push('\n');
        text
    }
}

impl ChainPlan {
    /// Returns the picture of a name.
    pub fn picture(&self, name: &str) -> Option<&PicturePlan> {
        self.pictures.iter().find(|picture| picture.name == name)
    }

    /// Pictures that the caller owns, in the order of the chain's results.
    pub fn results(&self) -> impl Iterator<Item = &PicturePlan> {
        self.pictures.iter().filter(|picture| picture.memory.is_none())
    }

    /// Names of the shaders, each once, in the order of the passes.
    pub fn shaders(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for pass in self.passes.iter() {
            if !names.contains(&&*pass.shader) {
                names.push(&pass.shader);
            }
        }
        names
    }
}

#[cfg(test)]
mod tests {
    use super::{SizeOp, SizeRule, SizeTerm};

    fn rule(terms: &[SizeTerm]) -> SizeRule {
        SizeRule(terms.to_vec().into())
    }

    #[test]
    fn sizes_are_computed_and_shown() {
        let of = || SizeTerm::Of("color".into());
        let half = rule(&[of(), SizeTerm::Number([2, 2]), SizeTerm::Apply(SizeOp::Div)]);
        let size_of = |name: &str| (name == "color").then_some([7, 1]);
        assert_eq!(half.evaluate(&size_of), Ok([3, 1]));
        assert_eq!(half.to_string(), "color.size() / 2");
        let quarter = rule(
            &[
                half.0.to_vec(),
                vec![
                    SizeTerm::Number([1, 0]),
                    SizeTerm::Apply(SizeOp::Add),
                    SizeTerm::Number([2, 2]),
                    SizeTerm::Apply(SizeOp::Div),
                ],
            ]
            .concat(),
        );
        assert_eq!(quarter.evaluate(&size_of), Ok([2, 1]));
        assert_eq!(quarter.to_string(), "(color.size() / 2 + (1, 0)) / 2");
    }

    #[cfg(feature = "json")]
    #[test]
    fn a_chain_reads_what_it_wrote() {
        use super::ChainPlan;
        let text = r#"{
  "schema": 1,
  "chain": "shrink",
  "inputs": ["color"],
  "pictures": [
    {"name": "half", "size": [{"of": "color"}, {"number": [2, 2]}, {"apply": "div"}], "format": "rgba16float"}
  ],
  "passes": [{"name": "half", "shader": "down", "reads": [{"name": "big", "from": "color"}], "writes": ["half"]}]
}"#;
        let chain = ChainPlan::from_json(text).expect("a chain");
        assert_eq!(chain.check(), Ok(()));
        assert_eq!(chain.pictures[0].size.to_string(), "color.size() / 2");
        assert_eq!(ChainPlan::from_json(&chain.to_json()).expect("a chain"), chain);
        let refused = |text: String| ChainPlan::from_json(&text).expect_err("no chain").to_string();
        let other = refused(text.replace("\"schema\": 1", "\"schema\": 2, \"new\": 0"));
        assert_eq!(
            other,
            "chain schema 2, but this reader knows schema 1: generate the chain again"
        );
        let unknown = refused(text.replace("\"chain\"", "\"new\": 0, \"chain\""));
        assert!(unknown.contains("unknown field `new`"), "{unknown}");
    }

    #[test]
    fn bad_rules_are_refused() {
        let none = |_: &str| None;
        let refused = |terms: &[SizeTerm]| rule(terms).evaluate(&none).unwrap_err().to_string();
        assert_eq!(refused(&[]), "0 sizes, not one");
        assert_eq!(refused(&[SizeTerm::Of("a".into())]), "`a` has no size");
        assert_eq!(
            refused(&[SizeTerm::Number([1, 1]), SizeTerm::Apply(SizeOp::Add)]),
            "an operation without its two sizes"
        );
        let many = vec![SizeTerm::Number([1, 1]); 300];
        assert_eq!(refused(&many), "300 terms, more than 256");
    }
}
