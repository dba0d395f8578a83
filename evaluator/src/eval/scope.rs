//! Variables by name, and by the place that a mutable reference holds.

use super::value::{Place, Value};
use crate::front::name::Name;
use crate::limits::Held;
use std::cell::Cell;
use std::rc::Rc;

/// The variables of all functions being evaluated, each function's after its caller's. By name a function sees its own;
/// through a mutable reference it reaches those of its callers.
#[derive(Debug, Default)]
pub struct Scope {
    /// Outermost first; a later variable of the same name shadows an earlier one.
    variables: Vec<Variable>,
    /// Where the variables of the innermost function begin.
    base: usize,
    /// Number of the next variable, shared by all copies: no two variables ever have the same.
    next: Rc<Cell<u32>>,
    /// Memory of a copy.
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
    /// The same value as other states hold it, until it is assigned: the result of a branch, of which this state knows the constant.
    shared: Option<Value>,
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

    /// Begins a function, which sees none of the names so far; gives what [`Scope::leave_function`] needs.
    pub fn enter_function(&mut self) -> (usize, usize) {
        let outer = (self.base, self.variables.len());
        self.base = self.variables.len();
        outer
    }

    /// Ends a function.
    pub fn leave_function(&mut self, (base, mark): (usize, usize)) {
        self.variables.truncate(mark);
        self.base = base;
    }

    /// A new variable; gives its position.
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

    /// The variable's value.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.find_slot(name).map(|slot| &self.variables[slot].value)
    }

    /// Position of the variable that a name stands for.
    pub fn find_slot(&self, name: &str) -> Option<usize> {
        let own = &self.variables[self.base..];
        own.iter().rposition(|v| &*v.name == name).map(|k| self.base + k)
    }

    /// The variable at a position as a place that a reference may hold.
    pub fn slot_place(&self, slot: usize) -> Place {
        Place {
            slot,
            id: self.variables[slot].id,
            path: Vec::new(),
        }
    }

    /// Whether the variable that a place is a part of is still there.
    pub fn is_alive(&self, place: &Place) -> bool {
        self.variables.get(place.slot).is_some_and(|v| v.id == place.id)
    }

    /// Name and value at a position.
    pub fn name_and_value(&self, slot: usize) -> (&str, &Value) {
        let Variable { name, value, .. } = &self.variables[slot];
        (name, value)
    }

    /// Changes the value at a position; gives the old one.
    pub fn set_value(&mut self, slot: usize, value: Value) -> Value {
        self.variables[slot].shared = None;
        std::mem::replace(&mut self.variables[slot].value, value)
    }

    /// States the constants of a value at a position. The value that was there stays the form that it is joined in.
    pub fn refine_value(&mut self, slot: usize, value: Value) {
        let variable = &mut self.variables[slot];
        let general = std::mem::replace(&mut variable.value, value);
        variable.shared = Some(general);
    }

    /// Lets a variable that has a value in one of two states have any value in the other. Which states it has a value in, the
    /// states before they are joined tell.
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

    /// Forgets the form that the value at a position shares with other states.
    pub fn clear_shared(&mut self, slot: usize) {
        self.variables[slot].shared = None;
    }

    /// The form that the value at a position shares with other states.
    pub fn shared_value(&self, slot: usize) -> Option<&Value> {
        self.variables[slot].shared.as_ref()
    }

    /// A form of the variable at a position that both states hold: each of them may know it as another constant.
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
    /// The value as other states hold it, and as this one knows it.
    fn value_forms(&self) -> [Option<&Value>; 2] {
        [self.shared.as_ref(), Some(&self.value)]
    }
}

impl PartialEq for Scope {
    fn eq(&self, other: &Self) -> bool {
        self.variables == other.variables
    }
}
