//! Combinations of option values, for a set of shaders of one kernel.

use std::fmt::Display;
use straightline_kernels::OptionText;

/// Options of a kernel with several values each. A shader is generated for every combination.
#[derive(Clone, Debug, Default)]
pub struct Variants {
    axes: Vec<Axis>,
}

/// An option with its values.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub option: String,
    pub values: Vec<String>,
}

impl Variants {
    /// Greatest number of combinations: their shaders have to be kept, read and compiled by somebody.
    pub(crate) const MOST: usize = 1024;

    /// Generates the shaders for each of these values of an option.
    ///
    /// ```
    /// # use straightline_codegen::Config;
    /// let shaders = Config::new().kernel("sraa", |k| {
    ///     k.variants(|v| v.set("pattern", ["latin4", "latin16"]).set("mask", ["none", "branch"]))
    /// });
    /// ```
    #[must_use]
    pub fn set(mut self, option: &str, values: impl IntoIterator<Item = impl Display>) -> Self {
        self.axes.push(Axis {
            option: option.to_owned(),
            values: values.into_iter().map(|value| value.to_string()).collect(),
        });
        self
    }

    pub(crate) fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// Refuses sets that do not say what they contain; `set` has the options that all shaders share.
    pub(crate) fn check(&self, set: &[OptionText]) -> Result<(), String> {
        for (k, Axis { option, values }) in self.axes.iter().enumerate() {
            if values.is_empty() {
                return Err(format!("the option `{option}` has no values"));
            }
            if let Some(twice) = (1..values.len()).find(|n| values[..*n].contains(&values[*n])) {
                return Err(format!("the option `{option}` has the value `{}` twice", values[twice]));
            }
            if self.axes[..k].iter().any(|axis| axis.option == *option) {
                return Err(format!(
                    "the option `{option}` is varied twice: give all its values at once"
                ));
            }
            if let Some((_, value)) = set.iter().find(|(name, _)| name == option) {
                return Err(format!(
                    "the option `{option}` is varied, and set to `{value}` for all: leave one out"
                ));
            }
        }
        let count = self
            .axes
            .iter()
            .try_fold(1usize, |n, axis| n.checked_mul(axis.values.len()));
        match count.filter(|n| *n <= Self::MOST) {
            Some(_) => Ok(()),
            None => Err(format!(
                "there are more than {} combinations: vary fewer options, or make some values `uniform`",
                Self::MOST
            )),
        }
    }

    /// Returns every combination, in the order of the values; the last option varies fastest.
    pub(crate) fn combinations(&self) -> Vec<Vec<OptionText>> {
        self.axes.iter().fold(vec![Vec::new()], |all, axis| {
            let with = |rest: &Vec<OptionText>, value: &String| {
                let mut one = rest.clone();
                one.push((axis.option.clone(), value.clone()));
                one
            };
            all.iter()
                .flat_map(|rest| axis.values.iter().map(move |value| with(rest, value)))
                .collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Variants;

    #[test]
    fn the_last_option_varies_fastest() {
        let variants = Variants::default().set("a", [1, 2]).set("b", ["x", "y"]);
        let all: Vec<String> = variants
            .combinations()
            .iter()
            .map(|one| one.iter().map(|(_, value)| value.as_str()).collect())
            .collect();
        assert_eq!(all, ["1x", "1y", "2x", "2y"]);
    }

    #[test]
    fn sets_that_say_nothing_are_refused() {
        let said = |variants: Variants| variants.check(&[("c".into(), "1".into())]).expect_err("a refusal");
        let none: [&str; 0] = [];
        assert!(said(Variants::default().set("a", none)).contains("no values"));
        assert!(said(Variants::default().set("a", [1, 1])).contains("`1` twice"));
        assert!(said(Variants::default().set("a", [1]).set("a", [2])).contains("varied twice"));
        assert!(said(Variants::default().set("c", [1])).contains("set to `1` for all"));
        let many = (0..7).fold(Variants::default(), |v, k| v.set(&format!("o{k}"), 0..8));
        assert!(said(many).contains("more than 1024 combinations"));
    }
}
