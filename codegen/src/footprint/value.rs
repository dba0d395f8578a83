//! Values while a footprint is found: known in every probe, a sum of taps, or unknown.

use super::facts::Causes;
use std::rc::Rc;
use straightline_evaluator::ir::arith::{Cells, apply_op};
use straightline_evaluator::ir::{BinaryOp, Op, Type, UnaryOp};

/// Number of pixels, frames and threads for which every value is computed. A value that is equal in all of them counts as
/// constant.
pub const PROBES: usize = 3;

/// Maximum number of terms of a sum. Longer sums become unknown.
const MOST_TERMS: usize = 4096;

/// A component.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// Bits by probe, of an `f64` for floats; and the runtime values that were assumed for them, if any.
    Known([u64; PROBES], Causes),
    /// A constant plus taps times constants.
    Sum(Rc<Sum>),
    /// Anything else, with what it depends on.
    Unknown(Causes),
}

/// A linear combination of taps.
#[derive(Clone, Debug, PartialEq)]
pub struct Sum {
    /// Summand without a tap.
    pub constant: f64,
    /// Tap with its component, and its factor; ordered.
    pub terms: Vec<((u32, u8), f64)>,
    /// `true` if a selection or a clamp may replace a term.
    pub tested: bool,
}

/// A value: components, elements of an array, or results of a region.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A scalar or vector.
    Vector(Vec<Part>),
    /// An array, or results.
    List(Vec<Value>),
}

impl Value {
    /// A value of a type, of which every part is unknown.
    pub fn unknown(ty: Type, causes: Causes) -> Value {
        let vector = Value::Vector(vec![Part::Unknown(causes); usize::from(ty.component_count())]);
        match ty {
            Type::Array { len, .. } => Value::List(vec![vector; len as usize]),
            _ => vector,
        }
    }

    /// A vector of numbers that differ from probe to probe.
    pub fn from_cells(count: usize, cells: [Cells; PROBES]) -> Value {
        Value::assumed(count, cells, Causes::default())
    }

    /// A vector of numbers that were assumed for runtime values.
    pub fn assumed(count: usize, cells: [Cells; PROBES], causes: Causes) -> Value {
        Value::Vector((0..count).map(|k| Part::Known(cells.map(|c| c[k]), causes)).collect())
    }

    /// Components of a scalar or vector; empty for others.
    pub fn parts(&self) -> &[Part] {
        match self {
            Value::Vector(parts) => parts,
            Value::List(_) => &[],
        }
    }

    /// Element of an array, or result; unknown if there is none.
    pub fn element(&self, k: usize, ty: Type) -> Value {
        match self {
            Value::List(all) if !all.is_empty() => all[k.min(all.len() - 1)].clone(),
            _ => Value::unknown(ty, self.causes()),
        }
    }

    /// Everything that the value depends on.
    pub fn causes(&self) -> Causes {
        match self {
            Value::Vector(parts) => parts
                .iter()
                .fold(Causes::default(), |all, part| all.with(part.causes())),
            Value::List(all) => all.iter().fold(Causes::default(), |sum, v| sum.with(v.causes())),
        }
    }

    /// Bits of a scalar that is equal in all probes.
    pub fn constant_cell(&self) -> Option<u64> {
        self.parts().first()?.constant_cell()
    }
}

impl Part {
    /// Bits, if they are equal in all probes, and none was assumed.
    pub fn constant_cell(&self) -> Option<u64> {
        match self {
            Part::Known(cells, causes) if *causes == Causes::default() => {
                cells.iter().all(|cell| *cell == cells[0]).then_some(cells[0])
            }
            _ => None,
        }
    }

    /// Everything that the component depends on.
    pub fn causes(&self) -> Causes {
        match self {
            Part::Known(..) if self.constant_cell().is_some() => Causes::default(),
            Part::Known(_, causes) => causes.with(Causes::POSITION),
            Part::Sum(_) => Causes::READS,
            Part::Unknown(causes) => *causes,
        }
    }

    /// A sum that is one tap.
    pub fn tap(tap: u32, component: u8) -> Part {
        Part::Sum(Rc::new(Sum {
            constant: 0.0,
            terms: vec![((tap, component), 1.0)],
            tested: false,
        }))
    }

    fn to_sum(&self) -> Option<Rc<Sum>> {
        match self {
            Part::Sum(sum) => Some(Rc::clone(sum)),
            _ => self.constant_cell().map(|cell| {
                Rc::new(Sum {
                    constant: f64::from_bits(cell),
                    terms: Vec::new(),
                    tested: false,
                })
            }),
        }
    }

    fn tested(&self) -> Part {
        match self {
            Part::Sum(sum) => Part::Sum(Rc::new(Sum {
                tested: true,
                ..Sum::clone(sum)
            })),
            other => other.clone(),
        }
    }
}

/// Evaluates an operation of values. The caller handles reads, regions and the invocation's position.
pub fn apply_values(op: &Op, operand: Type, args: &[&Value], ty: Type) -> Value {
    let all_causes = || args.iter().fold(Causes::default(), |all, v| all.with(v.causes()));
    match op {
        Op::MakeArray => Value::List(args.iter().copied().cloned().collect()),
        Op::ArrayGet => match args[1].constant_cell() {
            Some(k) => args[0].element(k as u32 as usize, ty),
            None => Value::unknown(ty, all_causes()),
        },
        Op::ArraySet => match (args[0], args[1].constant_cell()) {
            (Value::List(all), Some(k)) if !all.is_empty() => {
                let mut all = all.clone();
                let k = (k as u32 as usize).min(all.len() - 1);
                all[k] = args[2].clone();
                Value::List(all)
            }
            _ => Value::unknown(ty, all_causes()),
        },
        Op::Exact | Op::Tally(_) => args[0].clone(),
        Op::Select => match args[0].constant_cell() {
            Some(cell) => args[if cell != 0 { 1 } else { 2 }].clone(),
            // A condition that was assumed, or that depends on the position, is decided in each probe.
            None if args.iter().all(|v| is_known(v)) => apply_fully(op, operand, args, ty),
            None => merge_values(args[1], args[2], args[0].causes()),
        },
        Op::Compose => Value::Vector(args.iter().filter_map(|v| v.parts().first().cloned()).collect()),
        Op::Splat => Value::Vector(vec![args[0].parts()[0].clone(); usize::from(ty.component_count())]),
        Op::Extract(k) => Value::Vector(vec![args[0].parts()[usize::from(*k)].clone()]),
        Op::Dot => Value::Vector(vec![
            apply_dot(operand, args).unwrap_or_else(|| Part::Unknown(all_causes())),
        ]),
        Op::Cross if args.iter().all(|v| is_known(v)) => apply_fully(op, operand, args, ty),
        Op::Const(_) | Op::Unary(_) | Op::Binary(_) | Op::Clamp | Op::Convert | Op::Bitcast => {
            let known = apply_known(op, operand, args, ty);
            let each = (0..usize::from(ty.component_count())).map(|k| {
                let parts: Option<Vec<&Part>> = args.iter().map(|v| v.parts().get(k)).collect();
                let Some(parts) = parts else {
                    return Part::Unknown(all_causes());
                };
                match known {
                    Some(cells) if parts.iter().all(|p| matches!(p, Part::Known(..))) => {
                        Part::Known(cells.map(|c| c[k]), assumptions(parts.into_iter()))
                    }
                    _ => {
                        let causes = parts.iter().fold(Causes::default(), |all, p| all.with(p.causes()));
                        let linear = if ty.is_float() && operand.is_float() {
                            combine_sums(op, &parts)
                        } else {
                            None
                        };
                        linear.unwrap_or(Part::Unknown(causes))
                    }
                }
            });
            Value::Vector(each.collect())
        }
        _ => Value::unknown(ty, all_causes()),
    }
}

fn is_known(value: &Value) -> bool {
    let parts = value.parts();
    !parts.is_empty() && parts.iter().all(|part| matches!(part, Part::Known(..)))
}

/// Runtime values that were assumed for any of the components.
fn assumptions<'a>(parts: impl Iterator<Item = &'a Part>) -> Causes {
    parts.fold(Causes::default(), |all, part| match part {
        Part::Known(_, causes) => all.with(*causes),
        _ => all,
    })
}

/// Evaluates an operation whose arguments are known.
fn apply_fully(op: &Op, operand: Type, args: &[&Value], ty: Type) -> Value {
    let causes = assumptions(args.iter().flat_map(|value| value.parts()));
    match apply_known(op, operand, args, ty) {
        Some(cells) => Value::assumed(usize::from(ty.component_count()), cells, causes),
        None => Value::unknown(ty, causes),
    }
}

/// Evaluates an operation in every probe. Components that are not known count as 0.
fn apply_known(op: &Op, operand: Type, args: &[&Value], ty: Type) -> Option<[Cells; PROBES]> {
    let mut found = [[0; 4]; PROBES];
    for (probe, found) in found.iter_mut().enumerate() {
        let mut cells = Vec::with_capacity(args.len());
        for value in args {
            let mut one = [0; 4];
            for (slot, part) in one.iter_mut().zip(value.parts()) {
                if let Part::Known(known, _) = part {
                    *slot = known[probe];
                }
            }
            cells.push(one);
        }
        *found = apply_op::<f64>(op, operand, &cells, ty)?;
    }
    Some(found)
}

fn apply_dot(operand: Type, args: &[&Value]) -> Option<Part> {
    if is_known(args[0]) && is_known(args[1]) {
        return apply_fully(&Op::Dot, operand, args, Type::F32).parts().first().cloned();
    }
    let products = args[0].parts().iter().zip(args[1].parts());
    let products: Option<Vec<Part>> = products
        .map(|(a, b)| combine_sums(&Op::Binary(BinaryOp::Mul), &[a, b]))
        .collect();
    let mut products = products?.into_iter();
    let first = products.next()?;
    products.try_fold(first, |sum, next| {
        combine_sums(&Op::Binary(BinaryOp::Add), &[&sum, &next])
    })
}

/// Evaluates an operation that keeps a sum a sum.
fn combine_sums(op: &Op, parts: &[&Part]) -> Option<Part> {
    let sum = |k: usize| parts[k].to_sum();
    let made = |sum: Sum| (sum.terms.len() <= MOST_TERMS).then(|| Part::Sum(Rc::new(sum)));
    match op {
        Op::Binary(BinaryOp::Add) => made(add_scaled(&*sum(0)?, &*sum(1)?, 1.0)),
        Op::Binary(BinaryOp::Sub) => made(add_scaled(&*sum(0)?, &*sum(1)?, -1.0)),
        Op::Unary(UnaryOp::Neg) => made(scale_sum(&*sum(0)?, -1.0)),
        Op::Binary(BinaryOp::Mul) => {
            let (a, b) = (sum(0)?, sum(1)?);
            match (a.terms.is_empty(), b.terms.is_empty()) {
                (true, _) => made(scale_sum(&b, a.constant)),
                (_, true) => made(scale_sum(&a, b.constant)),
                _ => None,
            }
        }
        Op::Binary(BinaryOp::Div) => {
            let (a, b) = (sum(0)?, sum(1)?);
            (b.terms.is_empty())
                .then(|| scale_sum(&a, 1.0 / b.constant))
                .and_then(made)
        }
        Op::Unary(UnaryOp::Saturate) => Some(parts[0].tested()),
        // A clamp between constants keeps the sum inside of them.
        Op::Binary(BinaryOp::Min | BinaryOp::Max) | Op::Clamp => {
            let (sums, others): (Vec<&Part>, Vec<&Part>) = parts.iter().partition(|p| matches!(p, Part::Sum(_)));
            let is_bounded = others.iter().all(|p| p.constant_cell().is_some());
            (is_bounded && sums.len() == 1).then(|| sums[0].tested())
        }
        _ => None,
    }
}

fn scale_sum(sum: &Sum, by: f64) -> Sum {
    Sum {
        constant: sum.constant * by,
        terms: sum.terms.iter().map(|(term, factor)| (*term, factor * by)).collect(),
        tested: sum.tested,
    }
}

fn add_scaled(a: &Sum, b: &Sum, by: f64) -> Sum {
    let mut terms = Vec::with_capacity(a.terms.len() + b.terms.len());
    let (mut left, mut right) = (a.terms.iter().peekable(), b.terms.iter().peekable());
    loop {
        let next = match (left.peek(), right.peek()) {
            (Some((x, f)), Some((y, g))) if x == y => {
                let both = (*x, f + g * by);
                left.next();
                right.next();
                both
            }
            (Some((x, f)), Some((y, _))) if x < y => {
                let one = (*x, *f);
                left.next();
                one
            }
            (_, Some((y, g))) => {
                let one = (*y, g * by);
                right.next();
                one
            }
            (Some((x, f)), None) => {
                let one = (*x, *f);
                left.next();
                one
            }
            (None, None) => break,
        };
        // An exact 0 is a term that cancels, as in a message by derivatives.
        if next.1 != 0.0 {
            terms.push(next);
        }
    }
    Sum {
        constant: a.constant + b.constant * by,
        terms,
        tested: a.tested || b.tested,
    }
}

/// Merges the two sides of a runtime condition. A sum that a constant may replace stays a sum, marked as tested.
pub fn merge_values(yes: &Value, no: &Value, causes: Causes) -> Value {
    if yes == no {
        return yes.clone();
    }
    match (yes, no) {
        (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => {
            let parts = a.iter().zip(b).map(|pair| match pair {
                (a, b) if a == b => a.clone(),
                (sum @ Part::Sum(_), other) | (other, sum @ Part::Sum(_)) if other.constant_cell().is_some() => {
                    sum.tested()
                }
                (a, b) => Part::Unknown(causes.with(a.causes()).with(b.causes())),
            });
            Value::Vector(parts.collect())
        }
        (Value::List(a), Value::List(b)) if a.len() == b.len() => {
            Value::List(a.iter().zip(b).map(|(a, b)| merge_values(a, b, causes)).collect())
        }
        _ => yes.clone(),
    }
}
