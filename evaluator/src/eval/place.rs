//! Places: variables and their parts, which assignments write and mutable references hold.
//!
//! A mutable reference is the place that it refers to: a function that takes one writes the caller's variable. Rust's
//! rules see to it that no two of them overlap and none outlives its variable, so this equals what rustc compiles.

use super::Evaluator;
use super::value::{Captured, Eval, Exit, Place, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, ExprKind};
use std::rc::Rc;

impl Evaluator<'_> {
    /// `&mut place`; of what is no place, a reference to a variable of its own.
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

    /// What a place expression stands for that is to be written.
    pub fn written_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        let before = std::mem::replace(&mut self.writing, true);
        let place = self.eval_place(expr);
        self.writing = before;
        place
    }

    /// A variable without a name that holds a value, for as long as the block around it is evaluated.
    pub fn add_temporary(&mut self, value: Value) -> Place {
        let slot = self.scope.bind("", value);
        self.scope.slot_place(slot)
    }

    /// What a place expression stands for; `None` if it is no place but a value.
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
                let written = writing.then_some(&base);
                match self.index_of_trait(&whole, written, &index, expr.span)? {
                    Some(Value::Ref(place)) => self.follow_references((*place).clone(), expr.span).map(Some),
                    Some(value) => Ok(Some(self.add_temporary(value))),
                    None => Ok(Some(base.with_step(Step::Index(index)))),
                }
            }
            ExprKind::Deref(reference) => {
                let Some(place) = self.eval_place(reference)? else {
                    return self.referenced_place(reference);
                };
                match self.read_place(&place, expr.span)? {
                    Value::Ref(target) => Ok(Some((*target).clone())),
                    // What a shared reference refers to.
                    _ => Ok(Some(place)),
                }
            }
            _ => Ok(None),
        }
    }

    /// The place that a field or element is a part of: references on the way are followed.
    pub fn base_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        match self.eval_place(expr)? {
            Some(place) => self.follow_references(place, expr.span).map(Some),
            None if matches!(expr.kind, ExprKind::Method(..) | ExprKind::Call(..)) => self.referenced_place(expr),
            None => Ok(None),
        }
    }

    /// The place that a computed reference holds; a value that is none is kept in a variable of its own.
    fn referenced_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        let place = match self.eval_expr(expr)? {
            Value::Ref(target) => (*target).clone(),
            value => self.add_temporary(value),
        };
        self.follow_references(place, expr.span).map(Some)
    }

    /// A place, or where the references in it lead.
    pub fn follow_references(&mut self, mut place: Place, span: Span) -> Eval<Place> {
        while let Value::Ref(target) = self.read_place(&place, span)? {
            place = (*target).clone();
        }
        Ok(place)
    }

    /// What a place holds.
    pub fn read_place(&mut self, place: &Place, span: Span) -> Eval {
        self.check_alive(place, span)?;
        let mut value = self.scope.name_and_value(place.slot).1.clone();
        for step in &place.path {
            value = match step {
                Step::Field(field) => self.value_field(&value, field, span)?,
                Step::Index(index) => self.array_element(&value, index, span)?,
                Step::VariantField(k, field) => self.variant_field(&value, *k, field, span)?,
            };
        }
        match value {
            Value::Poison => Err(Exit::Noted),
            Value::Unset => Err(self.unset_error(self.scope.name_and_value(place.slot).0, span)),
            value => Ok(value),
        }
    }

    /// A variable that is read before it is given a value.
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

    /// Gives a place another value.
    pub fn write_place(&mut self, place: &Place, value: Value, span: Span) -> Eval<()> {
        self.check_alive(place, span)?;
        let name = self.scope.name_and_value(place.slot).0.to_owned();
        self.name_value(&value, &name, span);
        // Taken out, so that an array that nothing else holds is changed where it is.
        let old = self.scope.set_value(place.slot, Value::Poison);
        let new = self.replace_part(old, &place.path, value, span)?;
        if matches!(&new, Value::Table(_)) || matches!(&new, Value::Node(id) if self.ty(*id).is_array()) {
            self.name_value(&new, &name, span);
        }
        self.scope.set_value(place.slot, new);
        Ok(())
    }

    /// A value, of a mutable reference what it refers to.
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

    /// Positions of the variables that references in a value lead to.
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
