//! Patterns that bind names to the parts of a value.

use super::Evaluator;
use super::value::{Eval, Exit, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Pattern;
use std::rc::Rc;

impl Evaluator<'_> {
    /// Binds the names of an irrefutable pattern to the parts of a value.
    pub fn bind_pattern(&mut self, pattern: &Pattern, value: Value, span: Span) -> Eval<()> {
        self.bind_parts(pattern, value, false, span)
    }

    /// Binds the names of a pattern that has matched a value.
    pub fn bind_matched(&mut self, pattern: &Pattern, value: Value, span: Span) -> Eval<()> {
        self.bind_parts(pattern, value, true, span)
    }

    fn bind_parts(&mut self, pattern: &Pattern, value: Value, matched: bool, span: Span) -> Eval<()> {
        match pattern {
            Pattern::Wild | Pattern::Rest => Ok(()),
            // The comparison has been made already. Names under a `|` are bound separately for each alternative.
            Pattern::Value(_) | Pattern::Range(..) | Pattern::Or(_) if matched => Ok(()),
            Pattern::At(name, _, inner, at) => {
                self.name_value(&value, name, *at);
                self.scope.bind(name, value.clone());
                self.bind_parts(inner, value, matched, span)
            }
            Pattern::Name(name, _, at) => {
                self.name_value(&value, name, *at);
                self.scope.bind(name, value);
                Ok(())
            }
            Pattern::Ref(inner, at) => {
                let value = self.deref_value(value, *at)?;
                self.bind_parts(inner, value, matched, span)
            }
            Pattern::Tuple(parts, at) => match self.taken_apart(value, parts, *at)? {
                Value::Tuple(values) if Pattern::part_ranges(parts, values.len()).is_some() => {
                    self.each_bound(parts, &values, matched, span)
                }
                Value::Poison => parts
                    .iter()
                    .try_for_each(|part| self.bind_parts(part, Value::Poison, matched, span)),
                other => Err(Diagnostic::error_at(
                    Code::Pattern,
                    *at,
                    format!("a pattern of {} parts for {}", parts.len(), other.describe()),
                )
                .into()),
            },
            Pattern::Array(parts, at) => {
                let elements = self.elements_of_pattern(value, parts, *at)?;
                self.each_bound(parts, &elements, matched, span)
            }
            Pattern::Struct(path, fields, at) => {
                let variant = self.library.find_variant(path).map(|(_, k, _)| k);
                for (name, pattern) in fields {
                    let step = match variant {
                        Some(k) => Step::VariantField(k, name.clone()),
                        None => Step::Field(name.clone()),
                    };
                    let part = match &value {
                        Value::Poison => Value::Poison,
                        value => self.part_of_value(value, step, *at)?,
                    };
                    self.bind_parts(pattern, part, matched, span)?;
                }
                Ok(())
            }
            Pattern::Range(..) => Err(
                Diagnostic::error_at(Code::RefutablePattern, span, "a `let` cannot compare")
                    .help("use `match`")
                    .into(),
            ),
            Pattern::Value(expr) => {
                Err(
                    Diagnostic::error_at(Code::RefutablePattern, expr.span, "a `let` cannot compare")
                        .help("use `match`")
                        .into(),
                )
            }
            Pattern::Or(_) => Err(
                Diagnostic::error_at(Code::RefutablePattern, span, "a `let` cannot choose")
                    .help("use `match`")
                    .into(),
            ),
        }
    }

    /// Binds patterns to the parts of a tuple or an array, and `name @ ..` to an array of the remaining parts.
    fn each_bound(&mut self, patterns: &[Pattern], parts: &[Value], matched: bool, span: Span) -> Eval<()> {
        for (pattern, taken) in Pattern::part_ranges(patterns, parts.len()).into_iter().flatten() {
            match pattern {
                Pattern::At(name, _, _, at) if pattern.is_rest() => {
                    let rest = &parts[taken];
                    if rest.is_empty() || matches!(rest[0], Value::Ref(_)) {
                        let what = if rest.is_empty() {
                            "no part"
                        } else {
                            "parts of what is borrowed mutably"
                        };
                        return Err(
                            Diagnostic::error_at(Code::Pattern, *at, format!("`{name} @ ..` of {what}"))
                                .label("not supported")
                                .help("give each part a name, or leave the name of `..` out")
                                .into(),
                        );
                    }
                    self.scope.bind(name, Value::array(rest.to_vec()));
                }
                Pattern::Rest => {}
                _ => self.bind_parts(pattern, parts[taken.start].clone(), matched, span)?,
            }
        }
        Ok(())
    }

    /// Returns the elements of an array that patterns destructure.
    pub fn elements_of_pattern(&mut self, value: Value, patterns: &[Pattern], at: Span) -> Eval<Vec<Value>> {
        let value = self.taken_apart(value, patterns, at)?;
        let len = self.length_for(&value, patterns);
        self.array_elements(&value, len, at)
    }

    /// Returns the number of parts that a value needs so that the patterns can destructure it.
    fn length_for(&self, value: &Value, patterns: &[Pattern]) -> usize {
        let has = self.array_len(value).unwrap_or(0);
        match Pattern::part_ranges(patterns, has) {
            Some(_) => has,
            None => patterns.iter().filter(|pattern| !pattern.is_rest()).count(),
        }
    }

    /// Returns a part of a value; through a mutable reference, a reference to the part.
    pub fn part_of_value(&mut self, value: &Value, step: Step, span: Span) -> Eval {
        match (value, &step) {
            (Value::Ref(place), _) => {
                let place = self.follow_references((**place).clone(), span)?.with_step(step);
                self.read_place(&place, span)?;
                Ok(Value::Ref(Rc::new(place)))
            }
            (value, Step::Field(name)) => self.value_field(value, name, span),
            (value, Step::Index(index)) => self.array_element(value, index, span),
            (value, Step::Slice { from, len }) => self.array_slice(value, *from, *len, span),
            (value, Step::VariantField(k, name)) => self.variant_field(value, *k, name, span),
        }
    }

    /// Returns a field of a possible variant of a value.
    pub fn variant_field(&mut self, value: &Value, variant: usize, name: &str, span: Span) -> Eval {
        let Value::Enum(choice) = value else {
            return match value {
                Value::Poison => Err(Exit::Noted),
                other => Err(Diagnostic::error_at(
                    Code::Pattern,
                    span,
                    format!("a pattern of an enum for {}", other.describe()),
                )
                .into()),
            };
        };
        let fields = choice.variant_fields(variant).unwrap_or_default();
        match fields.iter().find(|(field, _)| field == name) {
            Some((_, value)) => Ok(value.clone()),
            None => Err(Diagnostic::error_at(
                Code::Pattern,
                span,
                format!(
                    "`{}` is not this variant, or the variant has no field `{name}`",
                    choice.ty
                ),
            )
            .into()),
        }
    }

    /// Returns the value that patterns destructure: for a reference to a tuple or an array, references to its parts.
    pub fn taken_apart(&mut self, value: Value, patterns: &[Pattern], span: Span) -> Eval {
        let Value::Ref(place) = &value else {
            return Ok(value);
        };
        let place = self.follow_references((**place).clone(), span)?;
        let step = |tuple: bool, k: usize| match tuple {
            true => Step::Field(k.to_string().into()),
            false => Step::Index(Value::Int(k as i64)),
        };
        let whole = self.read_place(&place, span)?;
        let tuple = matches!(whole, Value::Tuple(_));
        let count = match &whole {
            Value::Tuple(parts) => parts.len(),
            other => self
                .array_elements(other, self.length_for(other, patterns), span)?
                .len(),
        };
        let parts = (0..count)
            .map(|k| Value::Ref(Rc::new(place.with_step(step(tuple, k)))))
            .collect();
        Ok(if tuple {
            Value::Tuple(parts)
        } else {
            Value::array(parts)
        })
    }
}
