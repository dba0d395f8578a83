//! Slices: the elements of an array from one index to another, of which both are compile-time constants.
//!
//! A shared slice is an array of its own, as its elements cannot change while it lives. A mutable slice is a place, so
//! that writes through it change the array.

use super::Evaluator;
use super::expr::out_of_range;
use super::value::{Eval, Range, Step, Table, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Bounds, Expr};
use crate::ir::{BinaryOp, Op, Type};
use std::rc::Rc;

/// Ends of a slice, each with its place, and `true` if the end is included.
pub struct SliceEnds {
    start: Option<(Value, Span)>,
    end: Option<(Value, Span)>,
    inclusive: bool,
}

impl Evaluator<'_> {
    /// Evaluates `array[a..b]`.
    pub fn eval_slice(&mut self, base: &Expr, bounds: &Bounds, span: Span) -> Eval {
        let place = self.base_place(base)?;
        let value = match &place {
            Some(_) => None,
            None => Some(self.eval_value(base)?),
        };
        let ends = self.eval_bounds(bounds)?;
        // As of an element, the array is read after its index is evaluated.
        let whole = match (place, value) {
            (Some(place), _) => self.read_place(&place, span)?,
            (None, value) => value.unwrap_or(Value::Poison),
        };
        let (from, len) = self.slice_extent(&whole, &ends, span)?;
        self.array_slice(&whole, from, len, span)
    }

    /// Evaluates the ends of a slice.
    pub fn eval_bounds(&mut self, bounds: &Bounds) -> Eval<SliceEnds> {
        let mut end = |of: &Option<Box<Expr>>| match of {
            Some(end) => self.eval_value(end).map(|value| Some((value, end.span))),
            None => Ok(None),
        };
        Ok(SliceEnds {
            start: end(&bounds.start)?,
            end: end(&bounds.end)?,
            inclusive: bounds.inclusive,
        })
    }

    /// Evaluates an index that is not of one element: a range, or what an `Index` of the kernel's own takes.
    pub fn other_index(&mut self, base: &Value, index: &Value, span: Span) -> Eval<Option<Value>> {
        match self.range_of_index(base, index, span)? {
            Some((from, len)) => self.array_slice(base, from, len, span).map(Some),
            None => self.index_of_trait(base, None, index, span),
        }
    }

    /// Returns the first element and the length of a slice of an array whose index is a range, such as a variable.
    pub fn range_of_index(&mut self, array: &Value, index: &Value, span: Span) -> Eval<Option<(usize, usize)>> {
        let Value::Range(range) = index else {
            return Ok(None);
        };
        let Range {
            start, end, inclusive, ..
        } = range;
        let ends = SliceEnds {
            start: Some(((**start).clone(), span)),
            end: Some(((**end).clone(), span)),
            inclusive: *inclusive,
        };
        self.slice_extent(array, &ends, span).map(Some)
    }

    /// Returns the first element and the length of a slice. Refuses ends that are runtime values or out of bounds.
    pub fn slice_extent(&mut self, array: &Value, ends: &SliceEnds, span: Span) -> Eval<(usize, usize)> {
        if matches!(array, Value::Poison) {
            return Err(super::Exit::Noted);
        }
        let Some(len) = self.array_len(array) else {
            return Err(Diagnostic::error_at(
                Code::IndexType,
                span,
                format!("{} cannot be indexed by a range", array.describe()),
            )
            .label("not an array")
            .help("a range takes a part of an array: `&array[1..3]`")
            .into());
        };
        let from = self.known_end(ends.start.as_ref())?.unwrap_or(0);
        let to = match self.known_end(ends.end.as_ref())? {
            Some(to) if ends.inclusive => to + 1,
            Some(to) => to,
            None => len as i64,
        };
        match (usize::try_from(from), usize::try_from(to)) {
            (Ok(from), Ok(to)) if from <= to && to <= len => Ok((from, to - from)),
            _ => Err(outside(from, to, len, span).into()),
        }
    }

    /// Returns an end of a slice, which has to be a compile-time constant.
    fn known_end(&mut self, end: Option<&(Value, Span)>) -> Eval<Option<i64>> {
        let Some((value, span)) = end else {
            return Ok(None);
        };
        match self.known_int(value) {
            Some(n) => Ok(Some(n)),
            None => {
                let error = Diagnostic::error_at(
                    Code::RuntimeValue,
                    *span,
                    "the ends of a slice must be compile-time constants",
                )
                .label("a runtime value")
                .help(
                    "use a constant, an option or a loop counter, or index the array: `for k in from..to { array[k] }`",
                );
                Err(self.demand_of(&[value], error))
            }
        }
    }

    /// Returns a slice of an array.
    pub fn array_slice(&mut self, array: &Value, from: usize, len: usize, span: Span) -> Eval {
        match array {
            _ if len == 0 => Ok(Value::array(Vec::new())),
            _ if from == 0 && self.array_len(array) == Some(len) => Ok(array.clone()),
            Value::Array(elements) => {
                self.count_copy(len, span)?;
                Ok(Value::array(elements[from..from + len].to_vec()))
            }
            // An array of the shader: the slice reads its rows.
            Value::Table(table) => {
                let own = self.integer_constant(from as u32, Type::I32);
                let first = match table.from {
                    Some(first) => self.builder.add(Op::Binary(BinaryOp::Add), [first, own], Type::I32),
                    None => own,
                };
                Ok(Value::Table(Rc::new(Table {
                    len,
                    element: table.element.clone(),
                    from: Some(first),
                })))
            }
            Value::Node(id) if self.ty(*id).is_array() => Ok(Value::Table(Rc::new(Table {
                len,
                element: array.clone(),
                from: Some(self.integer_constant(from as u32, Type::I32)),
            }))),
            _ => {
                let elements = (from..from + len).map(|k| self.array_element(array, &Value::Int(k as i64), span));
                Ok(Value::array(elements.collect::<Eval<_>>()?))
            }
        }
    }

    /// Returns an array with a part of a slice of it replaced, `slice` from its first element on and of a length.
    pub fn replace_in_slice(
        &mut self,
        mut old: Value,
        slice: (usize, usize),
        rest: &[Step],
        new: Value,
        span: Span,
    ) -> Eval {
        let (from, len) = slice;
        let index = |k: usize| Step::Index(Value::Int((from + k) as i64));
        match rest.split_first() {
            None => {
                for (k, element) in self.rows(&new, span)?.into_iter().enumerate() {
                    old = self.replace_part(old, &[index(k)], element, span)?;
                }
                Ok(old)
            }
            Some((Step::Slice { from: inner, len }, rest)) => {
                self.replace_in_slice(old, (from + inner, *len), rest, new, span)
            }
            Some((Step::Index(own), rest)) => {
                let step = match self.known_int(own) {
                    Some(k) => match usize::try_from(k).ok().filter(|k| *k < len) {
                        Some(k) => index(k),
                        None => return Err(out_of_range(k, len, span).into()),
                    },
                    None => {
                        let own = self.index_node(own, span)?;
                        Step::Index(Value::Node(self.build_integer_op(BinaryOp::Add, own, from as u32)))
                    }
                };
                let path: Vec<Step> = std::iter::once(step).chain(rest.iter().cloned()).collect();
                self.replace_part(old, &path, new, span)
            }
            Some(_) => Err(Diagnostic::error_at(Code::UnknownField, span, "a slice has elements alone").into()),
        }
    }
}

fn outside(from: i64, to: i64, len: usize, span: Span) -> Diagnostic {
    let message = match to < from {
        true => format!("a slice from {from} to {to}"),
        false => format!("the elements {from}..{to} of an array of {len}"),
    };
    Diagnostic::error_at(Code::IndexOutOfRange, span, message)
        .label("out of range")
        .help(match to < from {
            true => "write the smaller end first".to_owned(),
            false => format!("ends go from 0 to {len}"),
        })
}
