//! The forms that every kernel is compiled to.

use std::fmt;
use straightline_codegen::diagnostic::{Code, Errors};
use straightline_codegen::{Branches, ReadOrder, Settings, Unroll};

/// Policies for loops and branches; kernels are made for the first, which must accept all of them.
pub const FORMS: &[PolicyForm] = &[
    PolicyForm(Unroll::Full, Branches::AsLoops),
    PolicyForm(Unroll::None, Branches::AsLoops),
    PolicyForm(Unroll::Partial(2), Branches::AsLoops),
    PolicyForm(Unroll::Partial(3), Branches::Select),
    PolicyForm(Unroll::Full, Branches::Keep),
];

/// Policies for loops, and for branches on runtime values. If branches do not follow loops, reads come row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PolicyForm(pub Unroll, pub Branches);

impl PolicyForm {
    /// The settings that compile a kernel to this form.
    pub fn settings(self) -> Settings {
        Settings::new().unroll(self.0).branches(self.1).reads(match self.1 {
            Branches::AsLoops => ReadOrder::Source,
            Branches::Keep | Branches::Select => ReadOrder::Rows,
        })
    }
}

impl fmt::Display for PolicyForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "loops {}, branches {}", self.0, self.1)
    }
}

/// Returns whether two texels are equal bit for bit, where any NaN equals any other.
pub fn same(a: [f64; 4], b: [f64; 4]) -> bool {
    a.iter()
        .zip(b)
        .all(|(x, y)| x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan()))
}

/// Tells if one of the errors is the generator's own: a broken rule, or a panic.
pub fn is_internal(errors: &Errors) -> bool {
    errors
        .diagnostics
        .iter()
        .any(|error| error.code() == Some(Code::Internal))
}
