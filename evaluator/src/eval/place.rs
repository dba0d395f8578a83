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
                let value = self.expr(operand)?;
                self.temporary(value)
            }
        };
        Ok(Value::Ref(Rc::new(place)))
    }

    /// What a place expression stands for that is to be written.
    pub fn written_place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        let before = std::mem::replace(&mut self.writing, true);
        let place = self.place(expr);
        self.writing = before;
        place
    }

    /// A variable without a name that holds a value, for as long as the block around it is evaluated.
    pub fn temporary(&mut self, value: Value) -> Place {
        let slot = self.scope.bind("", value);
        self.scope.place(slot)
    }

    /// What a place expression stands for; `None` if it is no place but a value.
    pub fn place(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        match &expr.kind {
            ExprKind::Path(path) => match path.as_slice() {
                [name] => Ok(self.scope.slot(name).map(|slot| match self.scope.at(slot).1 {
                    Value::Alias(place) => (**place).clone(),
                    _ => self.scope.place(slot),
                })),
                _ => Ok(None),
            },
            ExprKind::Field(base, field) => {
                let step = Step::Field(field.clone());
                Ok(self.base(base)?.map(|base| base.part(step)))
            }
            ExprKind::Index(base, index) => {
                let Some(base) = self.base(base)? else {
                    return Ok(None);
                };
                let writing = std::mem::take(&mut self.writing);
                let index = self.expr(index);
                self.writing = writing;
                let (index, whole) = (index?, self.read(&base, expr.span)?);
                let written = writing.then_some(&base);
                match self.index_of_trait(&whole, written, &index, expr.span)? {
                    Some(Value::Ref(place)) => self.followed((*place).clone(), expr.span).map(Some),
                    Some(value) => Ok(Some(self.temporary(value))),
                    None => Ok(Some(base.part(Step::Index(index)))),
                }
            }
            ExprKind::Deref(reference) => {
                let Some(place) = self.place(reference)? else {
                    return self.referred(reference);
                };
                match self.read(&place, expr.span)? {
                    Value::Ref(target) => Ok(Some((*target).clone())),
                    // What a shared reference refers to.
                    _ => Ok(Some(place)),
                }
            }
            _ => Ok(None),
        }
    }

    /// The place that a field or element is a part of: references on the way are followed.
    pub fn base(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        match self.place(expr)? {
            Some(place) => self.followed(place, expr.span).map(Some),
            None if matches!(expr.kind, ExprKind::Method(..) | ExprKind::Call(..)) => self.referred(expr),
            None => Ok(None),
        }
    }

    /// The place that a computed reference holds; a value that is none is kept in a variable of its own.
    fn referred(&mut self, expr: &Expr) -> Eval<Option<Place>> {
        let place = match self.expr(expr)? {
            Value::Ref(target) => (*target).clone(),
            value => self.temporary(value),
        };
        self.followed(place, expr.span).map(Some)
    }

    /// A place, or where the references in it lead.
    pub fn followed(&mut self, mut place: Place, span: Span) -> Eval<Place> {
        while let Value::Ref(target) = self.read(&place, span)? {
            place = (*target).clone();
        }
        Ok(place)
    }

    /// What a place holds.
    pub fn read(&mut self, place: &Place, span: Span) -> Eval {
        self.alive(place, span)?;
        let mut value = self.scope.at(place.slot).1.clone();
        for step in &place.path {
            value = match step {
                Step::Field(field) => self.field(&value, field, span)?,
                Step::Index(index) => self.element(&value, index, span)?,
                Step::Held(k, field) => self.held(&value, *k, field, span)?,
            };
        }
        match value {
            Value::Poison => Err(Exit::Noted),
            Value::Unset => Err(self.unset(self.scope.at(place.slot).0, span)),
            value => Ok(value),
        }
    }

    /// A variable that is read before it is given a value.
    pub fn unset(&self, name: &str, span: Span) -> Exit {
        Diagnostic::at(
            Code::Unassigned,
            span,
            format!("`{name}` is used before it is given a value on every way here"),
        )
        .label("no value yet")
        .help("give it one where it is declared, or on both sides of the `if`")
        .into()
    }

    /// Gives a place another value.
    pub fn write(&mut self, place: &Place, value: Value, span: Span) -> Eval<()> {
        self.alive(place, span)?;
        let name = self.scope.at(place.slot).0.to_owned();
        self.name(&value, &name, span);
        // Taken out, so that an array that nothing else holds is changed where it is.
        let old = self.scope.set(place.slot, Value::Poison);
        let new = self.replace(old, &place.path, value, span)?;
        if matches!(&new, Value::Table(_)) || matches!(&new, Value::Node(id) if self.ty(*id).is_array()) {
            self.name(&new, &name, span);
        }
        self.scope.set(place.slot, new);
        Ok(())
    }

    /// A value, of a mutable reference what it refers to.
    pub fn loaded(&mut self, value: Value, span: Span) -> Eval {
        match value {
            Value::Ref(place) => {
                let place = self.followed((*place).clone(), span)?;
                self.read(&place, span)
            }
            other => Ok(other),
        }
    }

    fn alive(&self, place: &Place, span: Span) -> Eval<()> {
        if self.scope.holds(place) {
            return Ok(());
        }
        Err(Diagnostic::at(
            Code::MutableReference,
            span,
            "a mutable reference to a variable that is gone",
        )
        .label("used here")
        .help("let the variable live as long as the reference")
        .into())
    }

    /// Positions of the variables that references in a value lead to.
    pub fn targets(&self, value: &Value, out: &mut Vec<usize>) {
        match value {
            Value::Ref(place) | Value::Alias(place) if self.scope.holds(place) && !out.contains(&place.slot) => {
                out.push(place.slot);
                self.targets(self.scope.at(place.slot).1, out);
            }
            Value::Closure(closed) => {
                for (_, captured) in &closed.captured {
                    match captured {
                        Captured::Value(value) => self.targets(value, out),
                        Captured::Place(place) => self.targets(&Value::Alias(Rc::clone(place)), out),
                    }
                }
            }
            Value::OneOf(_, all) => all.iter().for_each(|each| self.targets(each, out)),
            Value::Struct { fields, .. } => fields.iter().for_each(|(_, field)| self.targets(field, out)),
            Value::Tuple(parts) => parts.iter().for_each(|part| self.targets(part, out)),
            Value::Enum(choice) => choice.all().for_each(|(_, value)| self.targets(value, out)),
            Value::Array(parts)
                if matches!(
                    parts.first(),
                    Some(Value::Ref(_) | Value::Struct { .. } | Value::Tuple(_) | Value::Enum(_))
                ) =>
            {
                parts.iter().for_each(|part| self.targets(part, out));
            }
            _ => {}
        }
    }
}
