//! Arguments of a property.

/// Type of one component of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // named after the types of Rust
pub enum Component {
    F32,
    I32,
    U32,
    Bool,
}

/// Values that a component may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Every integer, every finite float.
    Any,
    /// Floats, infinities and NaN too.
    EveryFloat,
    /// Numbers from `low` to `high`; `high` itself only if `closed`. Every `i32`, `u32` and `f32` is an `f64`.
    Between {
        /// Least value.
        low: f64,
        /// Greatest value.
        high: f64,
        /// `true` if `high` is a value.
        closed: bool,
    },
}

/// An argument: a number, a boolean, a vector or an array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Argument {
    /// Type of its components.
    pub component: Component,
    /// Components of a vector; 1 for a number.
    pub width: usize,
    /// Elements of an array; `None` if it is none.
    pub elements: Option<usize>,
    /// Values of each component.
    pub range: Range,
}

impl Argument {
    /// A number or a vector of any values.
    pub const fn new(component: Component, width: usize) -> Argument {
        Argument {
            component,
            width,
            elements: None,
            range: Range::Any,
        }
    }

    /// Number of components, of all elements together.
    pub fn component_count(&self) -> usize {
        self.width * self.elements.unwrap_or(1)
    }

    /// Returns why the argument cannot have the range, as the end of a sentence.
    pub fn range_error(&self) -> Option<&'static str> {
        let whole = self.component != Component::F32;
        match self.range {
            Range::Any => None,
            Range::EveryFloat if whole => Some("infinities and NaN are floats"),
            Range::EveryFloat => None,
            Range::Between { .. } if self.component == Component::Bool => Some("a boolean has no range"),
            Range::Between { low, high, .. } if whole && (low.fract() != 0.0 || high.fract() != 0.0) => {
                Some("integers take a range of integers")
            }
            Range::Between { .. } if self.bounds().is_none() => Some("the range is empty"),
            Range::Between { .. } => None,
        }
    }

    /// Returns whether a component may have these bits.
    pub fn includes(&self, bits: u32) -> bool {
        let value = self.component.value(bits);
        match self.range {
            Range::EveryFloat => true,
            Range::Any => self.component != Component::F32 || value.is_finite(),
            Range::Between { low, high, closed } => value >= low && (value < high || closed && value == high),
        }
    }

    /// Least and greatest value of a component; `None` if there is none.
    pub(super) fn bounds(&self) -> Option<(f64, f64)> {
        let (least, most) = match self.component {
            Component::F32 => (f64::from(f32::MIN), f64::from(f32::MAX)),
            Component::I32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
            Component::U32 => (0.0, f64::from(u32::MAX)),
            Component::Bool => (0.0, 1.0),
        };
        let Range::Between { low, high, closed } = self.range else {
            return Some((least, most));
        };
        let high = match (closed, self.component) {
            (true, _) => high,
            (false, Component::F32) => f64::from((high as f32).next_down()),
            (false, _) => high - 1.0,
        };
        let (low, high) = (low.max(least), high.min(most));
        (low <= high).then_some((low, high))
    }
}

impl Component {
    /// The number that bits stand for.
    pub fn value(self, bits: u32) -> f64 {
        match self {
            Component::F32 => f64::from(f32::from_bits(bits)),
            Component::I32 => f64::from(bits as i32),
            Component::U32 | Component::Bool => f64::from(bits),
        }
    }

    /// The bits of a number of the type.
    pub(super) fn bits(self, value: f64) -> u32 {
        match self {
            Component::F32 => (value as f32).to_bits(),
            Component::I32 => value as i32 as u32,
            Component::U32 => value as u32,
            Component::Bool => u32::from(value != 0.0),
        }
    }
}
