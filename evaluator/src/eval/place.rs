//! Places: variables and their parts, which assignments write and mutable references hold.
//!
//! A mutable reference is represented by the place that it refers to: a function that takes one writes the caller's
//! variable. Rust's borrow checker ensures that no two of them overlap and none outlives its variable, so the result
//! equals that of rustc.

use super::Evaluator;
use super::value::{Captured, Eval, Exit, Place, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, ExprKind};
use std::rc::Rc;

impl Evaluator<'_> {
    /// Evaluates `&mut place`; an operand that is not a place is stored in a temporary variable first.
    pub fn borrow_mutably(&mut self, operand: &Expr) -> Eval {
        let place = match self.written_place(operand)? {
            Some(place) => place,
            None => {
                let value = self.eval_expr(operand)?;
                self.add_temporary(value)
            }
        };
        Ok(Value::Ref(Rc::new(place)))
    }

    /// Returns the place of an expression that will be written.
    pub fn written_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        let before = std::mem::replace(&mut self.writing, true);
        let place = self.eval_place(expr);
        self.writing = before;
        place
    }

    /// Adds an unnamed variable that holds a value while the enclosing block is evaluated.
    pub fn add_temporary(&mut self, value: Value) -> Place {
        let slot = self.scope.bind("", value);
        self.scope.slot_place(slot)
    }

    /// Returns the place of an expression; `None` if it is a value and not a place.
    pub fn eval_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        match &expr.kind {
            ExprKind::Path(path) => match path.as_slice() {
                [name] => Ok(self
                    .scope
                    .find_slot(name)
                    .map(|slot| match self.scope.name_and_value(slot).1 {
                        Value::Alias(place) => (**place).clone(),
                        _ => self.scope.slot_place(slot),
                    })),
                _ => Ok(None),
            },
            ExprKind::Field(base, field) => {
                let step = Step::Field(field.clone());
                Ok(self.base_place(base)?.map(|base| base.with_step(step)))
            }
            ExprKind::Index(base, index) => {
                let Some(base) = self.base_place(base)? else {
                    return Ok(None);
                };
                let writing = std::mem::take(&mut self.writing);
                let index = self.eval_expr(index);
                self.writing = writing;
                let (index, whole) = (index?, self.read_place(&base, expr.span)?);
                if let Some((from, len)) = self.range_of_index(&whole, &index, expr.span)? {
                    return Ok(Some(base.with_step(Step::Slice { from, len })));
                }
                let written = writing.then_some(&base);
                match self.index_of_trait(&whole, written, &index, expr.span)? {
                    Some(Value::Ref(place)) => self.follow_references((*place).clone(), expr.span).map(Some),
                    Some(value) => Ok(Some(self.add_temporary(value))),
                    None => Ok(Some(base.with_step(Step::Index(index)))),
                }
            }
            ExprKind::Slice(base, bounds) => {
                let Some(base) = self.base_place(base)? else {
                    return Ok(None);
                };
                let writing = std::mem::take(&mut self.writing);
                let bounds = self.eval_bounds(bounds);
                self.writing = writing;
                let (bounds, whole) = (bounds?, self.read_place(&base, expr.span)?);
                let (from, len) = self.slice_extent(&whole, &bounds, expr.span)?;
                Ok(Some(base.with_step(Step::Slice { from, len })))
            }
            ExprKind::Deref(reference) => {
                let Some(place) = self.eval_place(reference)? else {
                    return self.referenced_place(reference);
                };
                match self.read_place(&place, expr.span)? {
                    Value::Ref(target) => Ok(Some((*target).clone())),
                    // The referent of a shared reference.
                    _ => Ok(Some(place)),
                }
            }
            _ => Ok(None),
        }
    }

    /// Returns the place that contains a field or element, with references followed.
    pub fn base_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        match self.eval_place(expr)? {
            Some(place) => self.follow_references(place, expr.span).map(Some),
            None if matches!(expr.kind, ExprKind::Method(..) | ExprKind::Call(..)) => self.referenced_place(expr),
            None => Ok(None),
        }
    }

    /// Returns the place that a computed reference refers to; any other value is stored in a temporary variable.
    fn referenced_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        let place = match self.eval_expr(expr)? {
            Value::Ref(target) => (*target).clone(),
            value => self.add_temporary(value),
        };
        self.follow_references(place, expr.span).map(Some)
    }

    /// Returns a place with all references in it followed.
    pub fn follow_references(&mut self, mut place: Place, span: Span) -> Eval<Place> {
        while let Value::Ref(target) = self.read_place(&place, span)? {
            place = (*target).clone();
        }
        Ok(place)
    }

    /// Returns the value of a place.
    pub fn read_place(&mut self, place: &Place, span: Span) -> Eval {
        self.check_alive(place, span)?;
        let mut value = self.scope.name_and_value(place.slot).1.clone();
        for step in &place.path {
            value = match step {
                Step::Field(field) => self.value_field(&value, field, span)?,
                Step::Index(index) => self.array_element(&value, index, span)?,
                Step::Slice { from, len } => self.array_slice(&value, *from, *len, span)?,
                Step::VariantField(k, field) => self.variant_field(&value, *k, field, span)?,
            };
        }
        match value {
            Value::Poison => Err(Exit::Noted),
            Value::Unset => Err(self.unset_error(self.scope.name_and_value(place.slot).0, span)),
            value => Ok(value),
        }
    }

    /// Returns an error for a variable that is read before it is assigned.
    pub fn unset_error(&self, name: &str, span: Span) -> Exit {
        Diagnostic::error_at(
            Code::Unassigned,
            span,
            format!("`{name}` is used before it is given a value on every way here"),
        )
        .label("no value yet")
        .help("give it one where it is declared, or on both sides of the `if`")
        .into()
    }

    /// Assigns a value to a place.
    pub fn write_place(&mut self, place: &Place, value: Value, span: Span) -> Eval<()> {
        self.check_alive(place, span)?;
        let name = self.scope.name_and_value(place.slot).0.to_owned();
        self.name_value(&value, &name, span);
        // The old value is taken out, so that an array without other owners is changed in place.
        let old = self.scope.set_value(place.slot, Value::Poison);
        let new = self.replace_part(old, &place.path, value, span)?;
        if matches!(&new, Value::Table(_)) || matches!(&new, Value::Node(id) if self.ty(*id).is_array()) {
            self.name_value(&new, &name, span);
        }
        self.scope.set_value(place.slot, new);
        Ok(())
    }

    /// Returns a value, or the referent of a mutable reference.
    pub fn deref_value(&mut self, value: Value, span: Span) -> Eval {
        match value {
            Value::Ref(place) => {
                let place = self.follow_references((*place).clone(), span)?;
                self.read_place(&place, span)
            }
            other => Ok(other),
        }
    }

    fn check_alive(&self, place: &Place, span: Span) -> Eval<()> {
        if self.scope.is_alive(place) {
            return Ok(());
        }
        Err(Diagnostic::error_at(
            Code::MutableReference,
            span,
            "a mutable reference to a variable that is gone",
        )
        .label("used here")
        .help("let the variable live as long as the reference")
        .into())
    }

    /// Collects the positions of the variables that references in a value refer to.
    pub fn collect_ref_slots(&self, value: &Value, out: &mut Vec<usize>) {
        match value {
            Value::Ref(place) | Value::Alias(place) if self.scope.is_alive(place) && !out.contains(&place.slot) => {
                out.push(place.slot);
                self.collect_ref_slots(self.scope.name_and_value(place.slot).1, out);
            }
            Value::Closure(closed) => {
                for (_, captured) in &closed.captured {
                    match captured {
                        Captured::Value(value) => self.collect_ref_slots(value, out),
                        Captured::Place(place) => self.collect_ref_slots(&Value::Alias(Rc::clone(place)), out),
                    }
                }
            }
            Value::OneOf(_, all) => all.iter().for_each(|each| self.collect_ref_slots(each, out)),
            Value::Struct { fields, .. } => fields.iter().for_each(|(_, field)| self.collect_ref_slots(field, out)),
            Value::Tuple(parts) => parts.iter().for_each(|part| self.collect_ref_slots(part, out)),
            Value::Enum(choice) => choice
                .all_fields()
                .for_each(|(_, value)| self.collect_ref_slots(value, out)),
            Value::Array(parts)
                if matches!(
                    parts.first(),
                    Some(Value::Ref(_) | Value::Struct { .. } | Value::Tuple(_) | Value::Enum(_))
                ) =>
            {
                parts.iter().for_each(|part| self.collect_ref_slots(part, out));
            }
            _ => {}
        }
    }
}
