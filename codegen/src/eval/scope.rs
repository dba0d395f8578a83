//! Variables by name.

use super::value::Value;

/// Nested scopes of one function. Calls start with a new one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scope {
    /// Name and value, outermost first; a later entry of the same name shadows an earlier one.
    variables: Vec<(String, Value)>,
}

impl Scope {
    /// A mark to return to with [`Scope::leave`].
    pub fn enter(&self) -> usize {
        self.variables.len()
    }

    /// Forgets variables made since the mark.
    pub fn leave(&mut self, mark: usize) {
        self.variables.truncate(mark);
    }

    /// A new variable.
    pub fn bind(&mut self, name: &str, value: Value) {
        self.variables.push((name.to_owned(), value));
    }

    /// The variable's value.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.slot(name).map(|slot| &self.variables[slot].1)
    }

    /// The variable's value, to be changed.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut Value> {
        let slot = self.slot(name)?;
        Some(&mut self.variables[slot].1)
    }

    /// Position of the variable that a name stands for.
    pub fn slot(&self, name: &str) -> Option<usize> {
        self.variables.iter().rposition(|(known, _)| known == name)
    }

    /// Name and value at a position.
    pub fn at(&self, slot: usize) -> (&str, &Value) {
        let (name, value) = &self.variables[slot];
        (name, value)
    }

    /// Changes the value at a position.
    pub fn set(&mut self, slot: usize, value: Value) {
        self.variables[slot].1 = value;
    }

    /// Names of all variables, each once.
    pub fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.variables.iter().map(|(name, _)| name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Number of variables.
    pub fn len(&self) -> usize {
        self.variables.len()
    }
}
