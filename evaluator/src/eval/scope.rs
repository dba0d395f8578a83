//! Variables, addressed by name or by the place that a mutable reference holds.

use super::value::{Place, Value};
use crate::front::name::Name;
use crate::limits::Held;
use std::cell::Cell;
use std::rc::Rc;

/// The variables of all functions being evaluated, each function's after its caller's. Names resolve within the innermost
/// function; a mutable reference reaches the variables of its callers.
#[derive(Debug, Default)]
pub struct Scope {
    /// Outermost first; a later variable of the same name shadows an earlier one.
    variables: Vec<Variable>,
    /// Position of the innermost function's first variable.
    base: usize,
    /// Number of the next variable. Shared by all copies, so that no two variables have the same number.
    next: Rc<Cell<u32>>,
    /// Accounts for the memory of a copy.
    _held: Option<Held>,
}

impl Clone for Scope {
    fn clone(&self) -> Self {
        Scope {
            variables: self.variables.clone(),
            base: self.base,
            next: Rc::clone(&self.next),
            _held: Some(Held::new(self.variables.len() * size_of::<Variable>())),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Variable {
    name: Name,
    id: u32,
    value: Value,
    /// Form of the value that other states share, until it is assigned. Set for a branch result that this state knows as a
    /// constant.
    shared: Option<Value>,
}

impl Scope {
    /// Returns a mark for [`Scope::leave`].
    pub fn enter(&self) -> usize {
        self.variables.len()
    }

    /// Drops variables added since the mark.
    pub fn leave(&mut self, mark: usize) {
        self.variables.truncate(mark);
    }

    /// Enters a function, which sees no names of its callers. Returns the argument for [`Scope::leave_function`].
    pub fn enter_function(&mut self) -> (usize, usize) {
        let outer = (self.base, self.variables.len());
        self.base = self.variables.len();
        outer
    }

    /// Leaves a function.
    pub fn leave_function(&mut self, (base, mark): (usize, usize)) {
        self.variables.truncate(mark);
        self.base = base;
    }

    /// Adds a variable and returns its position.
    pub fn bind(&mut self, name: impl Into<Name>, value: Value) -> usize {
        let id = self.next.get();
        self.next.set(id + 1);
        self.variables.push(Variable {
            name: name.into(),
            id,
            value,
            shared: None,
        });
        self.variables.len() - 1
    }

    /// Value of a variable.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.find_slot(name).map(|slot| &self.variables[slot].value)
    }

    /// Position of the variable that a name refers to.
    pub fn find_slot(&self, name: &str) -> Option<usize> {
        let own = &self.variables[self.base..];
        own.iter().rposition(|v| &*v.name == name).map(|k| self.base + k)
    }

    /// Place of the variable at a position, for a reference to hold.
    pub fn slot_place(&self, slot: usize) -> Place {
        Place {
            slot,
            id: self.variables[slot].id,
            path: Vec::new(),
        }
    }

    /// Returns whether the variable that contains a place still exists.
    pub fn is_alive(&self, place: &Place) -> bool {
        self.variables.get(place.slot).is_some_and(|v| v.id == place.id)
    }

    /// Name and value at a position.
    pub fn name_and_value(&self, slot: usize) -> (&str, &Value) {
        let Variable { name, value, .. } = &self.variables[slot];
        (name, value)
    }

    /// Sets the value at a position and returns the old one.
    pub fn set_value(&mut self, slot: usize, value: Value) -> Value {
        self.variables[slot].shared = None;
        std::mem::replace(&mut self.variables[slot].value, value)
    }

    /// Replaces the value at a position with one whose constants are known. The old value stays as the form shared with
    /// other states.
    pub fn refine_value(&mut self, slot: usize, value: Value) {
        let variable = &mut self.variables[slot];
        let general = std::mem::replace(&mut variable.value, value);
        variable.shared = Some(general);
    }

    /// Sets a variable that has a value in only one of two states to an undefined value in the other. The states before the
    /// join still show which of them had a value.
    pub fn fill_unset(&mut self, other: &mut Scope) {
        for (a, b) in self.variables.iter_mut().zip(&mut other.variables) {
            match (&a.value, &b.value) {
                (Value::Unset, Value::Unset) => {}
                (Value::Unset, _) => a.value = Value::Undef,
                (_, Value::Unset) => b.value = Value::Undef,
                _ => {}
            }
        }
    }

    /// Drops the shared form of the value at a position.
    pub fn clear_shared(&mut self, slot: usize) {
        self.variables[slot].shared = None;
    }

    /// Shared form of the value at a position.
    pub fn shared_value(&self, slot: usize) -> Option<&Value> {
        self.variables[slot].shared.as_ref()
    }

    /// Form of the variable at a position that both states share. Each state may know it as a different constant.
    pub fn common_value<'s>(&'s self, other: &'s Scope, slot: usize) -> Option<&'s Value> {
        let theirs = other.variables[slot].value_forms();
        let mut own = self.variables[slot].value_forms().into_iter().flatten();
        own.find(|form| theirs.contains(&Some(*form)))
    }

    /// Names of the innermost function's variables, each once.
    pub fn variable_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.variables[self.base..].iter().map(|v| &*v.name).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Number of variables.
    pub fn len(&self) -> usize {
        self.variables.len()
    }
}

impl Variable {
    /// Forms of the value: as this state knows it, and as other states share it.
    fn value_forms(&self) -> [Option<&Value>; 2] {
        [self.shared.as_ref(), Some(&self.value)]
    }
}

impl PartialEq for Scope {
    fn eq(&self, other: &Self) -> bool {
        self.variables == other.variables
    }
}
