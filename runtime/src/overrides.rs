//! Options that are set when the pipeline is created.

use crate::PassOptions;
use crate::error::Error;
use crate::plan::{OverridePlan, OverrideType, Plan};
use std::fmt;

/// A value for an option that the shader takes when the pipeline is created, made by `From` of `f32`, `i32`, `u32` and
/// `bool`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverrideValue {
    ty: OverrideType,
    value: f64,
}

macro_rules! values {
    ($($number:ident: $ty:ident),*) => {$(
        impl From<$number> for OverrideValue {
            fn from(value: $number) -> Self {
                OverrideValue { ty: OverrideType::$ty, value: value.into() }
            }
        }
    )*};
}

values!(f32: F32, i32: I32, u32: U32, bool: Bool);

/// As in Rust: `2.0`, `true`.
impl fmt::Display for OverrideValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ty {
            OverrideType::F32 => write!(f, "{:?}", self.value as f32),
            OverrideType::I32 | OverrideType::U32 => self.value.fmt(f),
            OverrideType::Bool => (self.value != 0.0).fmt(f),
        }
    }
}

/// Overrides that the caller sets, by their numbers, each with a value that it may have. The last value of a name
/// counts.
pub(crate) fn chosen_overrides<'p>(
    plan: &'p Plan,
    options: &PassOptions,
) -> Result<Vec<(&'p OverridePlan, f64)>, Error> {
    let mut chosen: Vec<(&OverridePlan, f64)> = Vec::new();
    for (name, value) in &options.overrides {
        let of = find_override(plan.overrides.iter(), &plan.kernel, name)?;
        check_value(of, &plan.kernel, *value)?;
        chosen.retain(|(other, _)| other.id != of.id);
        chosen.push((of, value.value));
    }
    Ok(chosen)
}

/// The override of a kernel or chain by its name.
pub(crate) fn find_override<'p>(
    all: impl IntoIterator<Item = &'p OverridePlan> + Clone,
    kernel: &str,
    name: &str,
) -> Result<&'p OverridePlan, Error> {
    let found = all.clone().into_iter().find(|of| of.name == name);
    found.ok_or_else(|| Error::UnknownOverride {
        kernel: kernel.to_owned(),
        name: name.to_owned(),
        known: all.into_iter().map(|of| of.name.as_ref()).collect(),
    })
}

fn check_value(of: &OverridePlan, kernel: &str, value: OverrideValue) -> Result<(), Error> {
    let (kernel, name) = (kernel.to_owned(), of.name.to_string());
    if value.ty != of.ty {
        return Err(Error::OverrideType {
            kernel,
            name,
            needed: of.ty,
            given: value.ty,
        });
    }
    let allowed = match of.range {
        _ if !of.ty.holds(value.value) => "finite numbers".to_owned(),
        Some([low, high]) if !of.allows(value.value) => format!("{low} to {high}"),
        _ => return Ok(()),
    };
    Err(Error::OverrideValue {
        kernel,
        name,
        value,
        allowed,
    })
}

/// Numbers and values as wgpu takes them.
pub(crate) fn pipeline_constants(chosen: &[(&OverridePlan, f64)]) -> Vec<(String, f64)> {
    chosen.iter().map(|(of, value)| (of.id.to_string(), *value)).collect()
}

/// Borrows the texts of [`pipeline_constants`].
pub(crate) fn borrow_constants(constants: &[(String, f64)]) -> Vec<(&str, f64)> {
    constants.iter().map(|(id, value)| (id.as_str(), *value)).collect()
}
