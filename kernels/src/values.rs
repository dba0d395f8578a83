//! Values of a kernel's options. The generator parses text once, against the option's declaration. All later code
//! compares these values, and spells them only in its output.

use std::collections::{BTreeMap, btree_map};
use std::fmt;

/// Value of one option, in one form for every spelling of it: `0`, `0.0` and `-0` are the same number. [`fmt::Display`] writes
/// the canonical spelling, which the generator parses back to the same value.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionValue {
    /// `true` or `false`.
    Flag(bool),
    /// Variant of an enum, in kebab case: `depth-normals`.
    Choice(String),
    /// Finite number, never -0. For an `f32`: the shortest decimal that rounds to it, or all digits of a whole number, so that
    /// equal floats have equal values.
    Number(f64),
    /// List of such numbers.
    Numbers(Vec<f64>),
    /// Number that a host sets at run time.
    Uniform,
    /// Number or flag that a host may set when it creates the pipeline, with the value that it has otherwise.
    Override(Box<OptionValue>),
}

impl OptionValue {
    /// State of a flag; `None` of every other kind.
    pub fn flag(&self) -> Option<bool> {
        match self {
            OptionValue::Flag(on) => Some(*on),
            _ => None,
        }
    }

    /// Name of a choice; `None` of every other kind.
    pub fn choice(&self) -> Option<&str> {
        match self {
            OptionValue::Choice(name) => Some(name),
            _ => None,
        }
    }

    /// Number, if it is a compile-time constant; `None` of every other kind, of a uniform and of an override.
    pub fn number(&self) -> Option<f64> {
        match self {
            OptionValue::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Numbers of a list; `None` of every other kind.
    pub fn numbers(&self) -> Option<&[f64]> {
        match self {
            OptionValue::Numbers(numbers) => Some(numbers),
            _ => None,
        }
    }
}

impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OptionValue::Flag(on) => on.fmt(f),
            OptionValue::Choice(name) => f.write_str(name),
            OptionValue::Number(number) => number.fmt(f),
            OptionValue::Numbers(numbers) => {
                for (k, number) in numbers.iter().enumerate() {
                    let comma = if k > 0 { "," } else { "" };
                    write!(f, "{comma}{number}")?;
                }
                Ok(())
            }
            OptionValue::Uniform => f.write_str("uniform"),
            OptionValue::Override(default) => write!(f, "override({default})"),
        }
    }
}

/// Name of a variant as an option's value: `DepthNormals` as `depth-normals`.
pub fn kebab(name: &str) -> String {
    let mut text = String::new();
    for (k, c) in name.chars().enumerate() {
        if c.is_uppercase() && k > 0 {
            text.push('-');
        }
        text.extend(c.to_lowercase());
    }
    text
}

/// Name and value of an option as a user typed them or a file contains them. The generator parses the value against the option's
/// declaration; only [`OptionValue`]s are compared.
pub type OptionText = (String, String);

/// Values of all options of one kernel, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OptionValues(BTreeMap<String, OptionValue>);

impl OptionValues {
    /// Value of the option `name`; `None` if the kernel has no such option.
    pub fn get(&self, name: &str) -> Option<&OptionValue> {
        self.0.get(name)
    }

    /// State of the flag `name`; `None` if the kernel has no such flag.
    pub fn flag(&self, name: &str) -> Option<bool> {
        self.get(name)?.flag()
    }

    /// Chosen variant of the option `name`; `None` if the kernel has no such option, or it is not a choice.
    pub fn choice(&self, name: &str) -> Option<&str> {
        self.get(name)?.choice()
    }

    /// Number of the option `name`; `None` if the kernel has no such number, or it is set at run time.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.get(name)?.number()
    }

    /// Numbers of the option `name`; `None` if the kernel has no such list.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        self.get(name)?.numbers()
    }

    /// Sets the option `name`.
    pub fn insert(&mut self, name: String, value: OptionValue) {
        self.0.insert(name, value);
    }

    /// Removes the option `name`.
    pub fn remove(&mut self, name: &str) {
        self.0.remove(name);
    }

    /// Removes the options for which `keep` returns false.
    pub fn retain(&mut self, mut keep: impl FnMut(&str, &OptionValue) -> bool) {
        self.0.retain(|name, value| keep(name, value));
    }

    /// Options in order of their names.
    pub fn iter(&self) -> btree_map::Iter<'_, String, OptionValue> {
        self.0.iter()
    }

    /// Canonical spelling of every value, for manifests and other files.
    pub fn spelled(&self) -> BTreeMap<String, String> {
        let spelled = self.iter().map(|(name, value)| (name.clone(), value.to_string()));
        spelled.collect()
    }
}

impl<'a> IntoIterator for &'a OptionValues {
    type Item = (&'a String, &'a OptionValue);
    type IntoIter = btree_map::Iter<'a, String, OptionValue>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl FromIterator<(String, OptionValue)> for OptionValues {
    fn from_iter<I: IntoIterator<Item = (String, OptionValue)>>(values: I) -> Self {
        OptionValues(values.into_iter().collect())
    }
}
