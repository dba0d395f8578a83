//! Checks that the arms of a `match` cover every value, as rustc demands.

use super::Checker;
use super::operators::integer_literal;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::{Arm, Expr, ExprKind, IntType, Pattern};

/// A pattern, or one that takes everything.
type Cell<'p> = Option<&'p Pattern>;

impl<'l> Checker<'l> {
    /// Notes an error if no arm takes some value of the subject's type.
    pub fn check_exhaustive(&mut self, subject: &Ty, arms: &'l [Arm], span: Span) {
        // A guard may fail.
        let arms = arms.iter().filter(|arm| arm.guard.is_none());
        let rows = arms.map(|arm| vec![Some(&arm.pattern)]).collect();
        if !self.covers_values(rows, std::slice::from_ref(subject)) {
            self.errors.push(
                Diagnostic::error_at(
                    Code::NonExhaustive,
                    span,
                    "non-exhaustive patterns: some values are taken by no arm of this `match`",
                )
                .label("not all values are taken")
                .help("add an arm `_ => ...`"),
            );
        }
    }

    /// Notes an error if a pattern of a `let`, a `for` or a parameter leaves out some value.
    pub fn check_irrefutable(&mut self, pattern: &'l Pattern, ty: &Ty, span: Span) {
        if !self.covers_values(vec![vec![Some(pattern)]], std::slice::from_ref(ty)) {
            self.errors.push(
                Diagnostic::error_at(
                    Code::RefutablePattern,
                    span,
                    "refutable pattern: it does not take every value",
                )
                .label("some values are left out")
                .help("use `if let`, or `let ... else` with what is to happen to the others"),
            );
        }
    }

    /// Returns whether the rows together cover all values of some types.
    fn covers_values(&mut self, rows: Vec<Vec<Cell<'_>>>, types: &[Ty]) -> bool {
        let Some((first, rest)) = types.split_first() else {
            return !rows.is_empty();
        };
        let rows = expand_alternatives(rows);
        // No pattern looks at this value. Taking it apart would not end for a type that holds itself, which rustc refuses.
        if rows.iter().all(|row| takes_all(row[0])) {
            return self.covers_values(matching_rows(&rows, |_| false), rest);
        }
        let ty = self.peel_refs(first).0;
        let is_integer = matches!(ty, Ty::Int(_)) || self.table.variable_kind(&ty) == Some(Kind::Integer);
        match &ty {
            Ty::Unknown | Ty::Param(_) | Ty::Never => true,
            Ty::Bool => [true, false].iter().all(|value| {
                let takes =
                    |p: &Pattern| matches!(p, Pattern::Value(e) if matches!(&e.kind, ExprKind::Bool(b) if b == value));
                self.covers_values(matching_rows(&rows, takes), rest)
            }),
            Ty::Enum(name, _) => {
                let library = self.library;
                let variants = library.enums.get(name).map_or(&[][..], |e| &e.variants);
                variants.iter().enumerate().all(|(k, variant)| {
                    let (fields, types) = self.fields_of(&ty, Some(k)).unwrap_or((&variant.fields, Vec::new()));
                    let rows = rows.iter().filter_map(|row| {
                        let cells: Vec<Cell<'_>> = match row[0].map(peel_pattern) {
                            Some(Pattern::Value(e)) if is_path_to(e, &variant.name) => vec![None; fields.len()],
                            Some(Pattern::Struct(path, patterns, _)) if path.last() == Some(&variant.name) => {
                                let of = |field: &Name| patterns.iter().find(|(name, _)| name == field);
                                fields.iter().map(|(field, ..)| of(field).map(|(_, p)| p)).collect()
                            }
                            other if takes_all(other) => vec![None; fields.len()],
                            _ => return None,
                        };
                        Some([cells, row[1..].to_vec()].concat())
                    });
                    let rows = rows.collect();
                    self.covers_values(rows, &[types, rest.to_vec()].concat())
                })
            }
            _ if is_integer => {
                // Between two ends of the arms' ranges all values are alike.
                let kind = if let Ty::Int(kind) = ty { kind } else { IntType::I32 };
                let (least, most) = (kind.range().0, kind.range().1.saturating_add(1));
                let mut ends: Vec<i64> = vec![least, most];
                let ranges = rows.iter().filter_map(|row| row[0].and_then(integer_range));
                ends.extend(ranges.flat_map(|(low, high)| [low, high.saturating_add(1)]));
                ends.retain(|n| (least..=most).contains(n));
                ends.sort_unstable();
                ends.dedup();
                ends[..ends.len() - 1].iter().all(|n| {
                    let takes = |p: &Pattern| integer_range(p).is_some_and(|(low, high)| (low..=high).contains(n));
                    self.covers_values(matching_rows(&rows, takes), rest)
                })
            }
            Ty::Tuple(parts) => {
                let rows = rows.iter().filter_map(|row| {
                    let cells: Vec<Cell<'_>> = match row[0].map(peel_pattern) {
                        Some(Pattern::Tuple(patterns, _)) => cells(patterns, parts.len())?,
                        other if takes_all(other) => vec![None; parts.len()],
                        _ => return None,
                    };
                    Some([cells, row[1..].to_vec()].concat())
                });
                self.covers_values(rows.collect(), &[parts.clone(), rest.to_vec()].concat())
            }
            Ty::Array(element) => {
                let len = rows.iter().find_map(|row| match row[0].map(peel_pattern) {
                    Some(Pattern::Array(parts, _)) if !parts.iter().any(Pattern::is_rest) => Some(parts.len()),
                    _ => None,
                });
                // If every pattern has `..`, the length is large enough that no part of the longest one is left out.
                let named = rows.iter().filter_map(|row| match row[0].map(peel_pattern) {
                    Some(Pattern::Array(parts, _)) => Some(parts.len()),
                    _ => None,
                });
                let len = len.or_else(|| named.max().map(|most| 2 * most)).unwrap_or(0);
                let rows = rows.iter().filter_map(|row| {
                    let cells: Vec<Cell<'_>> = match row[0].map(peel_pattern) {
                        Some(Pattern::Array(patterns, _)) => cells(patterns, len)?,
                        other if takes_all(other) => vec![None; len],
                        _ => return None,
                    };
                    Some([cells, row[1..].to_vec()].concat())
                });
                let parts = vec![(**element).clone(); len];
                self.covers_values(rows.collect(), &[parts, rest.to_vec()].concat())
            }
            Ty::Struct(name, _) if self.library.structs.contains_key(name) => {
                let Some((fields, parts)) = self.fields_of(&ty, None) else {
                    return true;
                };
                let rows = rows.iter().filter_map(|row| {
                    let cells: Vec<Cell<'_>> = match row[0].map(peel_pattern) {
                        Some(Pattern::Struct(_, patterns, _)) => {
                            let of = |field: &Name| patterns.iter().find(|(name, _)| name == field);
                            fields.iter().map(|(field, ..)| of(field).map(|(_, p)| p)).collect()
                        }
                        other if takes_all(other) => vec![None; fields.len()],
                        _ => return None,
                    };
                    Some([cells, row[1..].to_vec()].concat())
                });
                let rows: Vec<Vec<Cell<'_>>> = rows.collect();
                self.covers_values(rows, &[parts, rest.to_vec()].concat())
            }
            // Floats and the like: an arm that names no value of them.
            _ => self.covers_values(matching_rows(&rows, |p| !has_comparison(p)), rest),
        }
    }
}

/// Distributes the patterns of a tuple or an array over its `count` parts; `None` if they do not fit that number.
fn cells(patterns: &[Pattern], count: usize) -> Option<Vec<Cell<'_>>> {
    let mut cells = vec![None; count];
    for (pattern, taken) in Pattern::part_ranges(patterns, count)? {
        if !pattern.is_rest() {
            cells[taken.start] = Some(pattern);
        }
    }
    Some(cells)
}

/// Rows without `|` in their first cell.
fn expand_alternatives(rows: Vec<Vec<Cell<'_>>>) -> Vec<Vec<Cell<'_>>> {
    let mut out = Vec::new();
    for row in rows {
        match row[0].map(peel_pattern) {
            Some(Pattern::Or(cases)) => {
                let each = cases.iter().map(|case| [vec![Some(case)], row[1..].to_vec()].concat());
                out.extend(expand_alternatives(each.collect()));
            }
            _ => out.push(row),
        }
    }
    out
}

/// Returns the remaining cells of the rows whose first cell matches.
fn matching_rows<'p>(rows: &[Vec<Cell<'p>>], takes: impl Fn(&Pattern) -> bool) -> Vec<Vec<Cell<'p>>> {
    let taken = rows
        .iter()
        .filter(|row| takes_all(row[0]) || row[0].map(peel_pattern).is_some_and(&takes));
    taken.map(|row| row[1..].to_vec()).collect()
}

/// Returns whether an expression is a path that ends with a name.
fn is_path_to(e: &Expr, name: &String) -> bool {
    matches!(&e.kind, ExprKind::Path(path) if path.last() == Some(name))
}

fn takes_all(cell: Cell<'_>) -> bool {
    cell.is_none_or(|p| matches!(peel_pattern(p), Pattern::Name(..) | Pattern::Wild | Pattern::Rest))
}

/// A pattern without the `&` before it.
fn peel_pattern(pattern: &Pattern) -> &Pattern {
    match pattern {
        Pattern::Ref(inner, _) | Pattern::At(_, _, inner, _) => peel_pattern(inner),
        other => other,
    }
}

/// The integers that a pattern takes.
fn integer_range(pattern: &Pattern) -> Option<(i64, i64)> {
    match peel_pattern(pattern) {
        Pattern::Value(e) => integer_literal(e).map(|n| (n, n)),
        Pattern::Range(low, high, inclusive) => {
            let end = |end: &Option<Box<Expr>>, open: i64| end.as_ref().map_or(Some(open), |e| integer_literal(e));
            let past = i64::from(high.is_some() && !inclusive);
            Some((end(low, i64::MIN)?, end(high, i64::MAX)? - past))
        }
        _ => None,
    }
}

/// Returns whether a pattern compares any part with a value.
fn has_comparison(pattern: &Pattern) -> bool {
    match peel_pattern(pattern) {
        Pattern::Name(..) | Pattern::Wild | Pattern::Rest | Pattern::Ref(..) | Pattern::At(..) => false,
        Pattern::Value(_) | Pattern::Range(..) => true,
        Pattern::Tuple(parts, _) | Pattern::Array(parts, _) | Pattern::Or(parts) => parts.iter().any(has_comparison),
        Pattern::Struct(_, fields, _) => fields.iter().any(|(_, part)| has_comparison(part)),
    }
}
