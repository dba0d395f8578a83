//! The tree evaluator: what a kernel means, without a graph.

use super::ast::*;
use super::ops;
use super::real::Real;
use super::value::Value;

/// Why a tree has no meaning: only trees that were changed while made smaller have none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Invalid(pub &'static str);

/// What a kernel reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// Rows from the top.
    pub texels: Vec<[f32; 4]>,
}

/// A pixel, and what was decided on the way to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The colour.
    pub color: [f32; 4],
    /// A hash of every condition and every conversion of a float to an integer, in order.
    pub decisions: u64,
}

/// The colour of a pixel, with `R` for `f32`.
pub fn evaluate<R: Real>(program: &Program, picture: &Picture, pixel: [i32; 2]) -> Result<Outcome, Invalid> {
    let mut e = Evaluator::<R> {
        program,
        picture,
        pixel,
        env: Vec::new(),
        fuel: 400_000,
        calls: 0,
        decisions: 0,
    };
    let value = match e.block(&program.body) {
        Ok(value) | Err(Exit::Return(value)) => value,
        Err(Exit::Invalid(why)) => return Err(why),
        Err(Exit::Break | Exit::Continue) => return Err(Invalid("leaves no loop")),
    };
    match value {
        Value::Vec(lanes, 4) => Ok(Outcome {
            color: lanes.map(R::value),
            decisions: e.decisions,
        }),
        _ => Err(Invalid("not a Vec4")),
    }
}

enum Exit<R> {
    Break,
    Continue,
    Return(Value<R>),
    Invalid(Invalid),
}

type Eval<R, T = Value<R>> = Result<T, Exit<R>>;

fn invalid<R, T>(why: &'static str) -> Eval<R, T> {
    Err(Exit::Invalid(Invalid(why)))
}

struct Evaluator<'a, R> {
    program: &'a Program,
    picture: &'a Picture,
    pixel: [i32; 2],
    env: Vec<(Var, Value<R>)>,
    fuel: u32,
    calls: u32,
    decisions: u64,
}

impl<R: Real> Evaluator<'_, R> {
    fn step(&mut self) -> Eval<R, ()> {
        self.fuel = self.fuel.saturating_sub(1);
        if self.fuel == 0 {
            invalid("does not end")
        } else {
            Ok(())
        }
    }

    fn decide(&mut self, bits: u64) {
        self.decisions = super::Random(self.decisions ^ bits).bits();
    }

    fn block(&mut self, block: &Block) -> Eval<R> {
        let mark = self.env.len();
        let result = self.statements(block);
        self.env.truncate(mark);
        result
    }

    fn statements(&mut self, block: &Block) -> Eval<R> {
        for statement in &block.statements {
            self.statement(statement)?;
        }
        match &block.value {
            Some(value) => self.expr(value),
            None => Ok(Value::Many(Vec::new())),
        }
    }

    fn statement(&mut self, statement: &Stmt) -> Eval<R, ()> {
        self.step()?;
        match statement {
            Stmt::Let { var, init, .. } => {
                let value = self.expr(init)?;
                self.env.push((*var, value));
            }
            Stmt::LetTuple(vars, init) => match self.expr(init)? {
                Value::Many(parts) if parts.len() == vars.len() => self.env.extend(vars.iter().copied().zip(parts)),
                _ => return invalid("not a tuple"),
            },
            Stmt::Assign(place, op, value) => self.assign(place, *op, value)?,
            Stmt::If(condition, then, otherwise) => {
                let side = if self.condition(condition)? { then } else { otherwise };
                self.block(side)?;
            }
            Stmt::For(var, range, body) => self.count(*var, range, body)?,
            Stmt::ForArray(var, array, _, body) => match self.expr(array)? {
                Value::Many(elements) => {
                    for element in elements {
                        if self.round(*var, element, body)? {
                            break;
                        }
                    }
                }
                _ => return invalid("not an array"),
            },
            Stmt::While(condition, body) => {
                while self.condition(condition)? {
                    self.step()?;
                    match self.block(body) {
                        Ok(_) | Err(Exit::Continue) => {}
                        Err(Exit::Break) => break,
                        Err(other) => return Err(other),
                    }
                }
            }
            Stmt::Match(subject, arms) => {
                let subject = self.int(subject)?;
                let arm = arms.iter().find(|(values, _)| takes(values, subject));
                match arm {
                    Some((_, body)) => self.block(body)?,
                    None => return invalid("no arm"),
                };
            }
            Stmt::Block(block) => {
                self.block(block)?;
            }
            Stmt::Break => return Err(Exit::Break),
            Stmt::Continue => return Err(Exit::Continue),
            Stmt::Return(value) => return Err(Exit::Return(self.expr(value)?)),
        }
        Ok(())
    }

    fn count(&mut self, var: Var, range: &Range, body: &Block) -> Eval<R, ()> {
        let (start, mut end) = (self.int(&range.start)?, self.int(&range.end)?);
        if range.inclusive {
            end = end.saturating_add(1);
        }
        if i64::from(end) - i64::from(start) > 10_000 {
            return invalid("does not end");
        }
        let mut values: Vec<i32> = (start..end).step_by(range.step.max(1) as usize).collect();
        if range.reversed {
            values.reverse();
        }
        for value in values {
            if self.round(var, Value::I32(value), body)? {
                break;
            }
        }
        Ok(())
    }

    /// A round of a loop; true if it was the last by a `break`.
    fn round(&mut self, var: Var, value: Value<R>, body: &Block) -> Eval<R, bool> {
        self.step()?;
        let mark = self.env.len();
        self.env.push((var, value));
        let outcome = self.block(body);
        self.env.truncate(mark);
        match outcome {
            Ok(_) | Err(Exit::Continue) => Ok(false),
            Err(Exit::Break) => Ok(true),
            Err(other) => Err(other),
        }
    }

    /// Where a variable lives: the last of its name, which must be the one that is meant.
    fn slot(&self, var: Var) -> Eval<R, usize> {
        match self.env.iter().rposition(|(known, _)| known.name == var.name) {
            Some(slot) if self.env[slot].0.id == var.id => Ok(slot),
            _ => invalid("a variable that is not there"),
        }
    }

    fn assign(&mut self, place: &Place, op: Option<Binary>, value: &Expr) -> Eval<R, ()> {
        let mut value = self.expr(value)?;
        let mut path = Vec::new();
        for step in &place.path {
            path.push(match step {
                Step::Lane(k) | Step::Part(k) | Step::Field(k) => *k as usize,
                Step::Index(index) => match usize::try_from(self.int(index)?) {
                    Ok(k) => k,
                    Err(_) => return invalid("a negative index"),
                },
            });
        }
        let slot = self.slot(place.var)?;
        let old = read(&self.env[slot].1, &path);
        let Some(old) = old else {
            return invalid("no such part");
        };
        if let Some(op) = op {
            value = match ops::binary(op, &old, &value) {
                Some(value) => value,
                None => return invalid("operands"),
            };
        }
        write(&mut self.env[slot].1, &path, value);
        Ok(())
    }

    fn condition(&mut self, e: &Expr) -> Eval<R, bool> {
        let Value::Bool(holds) = self.expr(e)? else {
            return invalid("not a condition");
        };
        self.decide(u64::from(holds));
        Ok(holds)
    }

    fn int(&mut self, e: &Expr) -> Eval<R, i32> {
        match self.expr(e)? {
            Value::I32(n) => Ok(n),
            Value::U32(n) => Ok(n as i32),
            _ => invalid("not an integer"),
        }
    }

    fn exprs(&mut self, all: &[Expr]) -> Eval<R, Vec<Value<R>>> {
        all.iter().map(|e| self.expr(e)).collect()
    }

    fn expr(&mut self, e: &Expr) -> Eval<R> {
        self.step()?;
        let value = match &e.kind {
            Kind::Float(x) => Some(Value::F32(R::of(*x))),
            Kind::Int(n) => Some(Value::I32(*n)),
            Kind::Uint(n) => Some(Value::U32(*n)),
            Kind::Bool(b) => Some(Value::Bool(*b)),
            Kind::Var(var) => Some(self.env[self.slot(*var)?].1.clone()),
            Kind::Const(k) => Some(self.expr(&self.program.consts[*k as usize])?),
            Kind::Pixel => Some(Value::ivec(&self.pixel)),
            Kind::Size => Some(Value::UVec([self.picture.size[0], self.picture.size[1], 0, 0], 2)),
            Kind::Load(coordinate) => match self.expr(coordinate)? {
                Value::IVec(at, 2) => Some(self.texel(at)),
                _ => None,
            },
            Kind::Unary(op, x) => ops::unary(*op, &self.expr(x)?),
            Kind::Binary(op @ (Binary::LazyAnd | Binary::LazyOr), x, y) => {
                let left = self.condition(x)?;
                Some(Value::Bool(if left == (*op == Binary::LazyOr) {
                    left
                } else {
                    self.condition(y)?
                }))
            }
            Kind::Binary(op, x, y) => {
                let (x, y) = (self.expr(x)?, self.expr(y)?);
                let result = ops::binary(*op, &x, &y);
                if let Some(Value::Bool(holds)) = result {
                    self.decide(u64::from(holds));
                }
                result
            }
            Kind::Method(method, args) => {
                let args = self.exprs(args)?;
                ops::method(*method, &args, &e.ty)
            }
            Kind::Swizzle(x, lanes) => {
                let x = self.expr(x)?;
                let lanes: Option<Vec<_>> = lanes.iter().map(|k| x.lane(*k as usize)).collect();
                lanes.and_then(|lanes| Value::gather(&lanes))
            }
            Kind::Lane(x, k) => self.expr(x)?.lane(*k as usize),
            Kind::Part(x, k) => read(&self.expr(x)?, &[*k as usize]),
            Kind::Index(array, index) => {
                let (array, index) = (self.expr(array)?, self.int(index)?);
                usize::try_from(index).ok().and_then(|k| read(&array, &[k]))
            }
            Kind::Cast(x) => {
                let x = self.expr(x)?;
                let result = ops::cast(&x, &e.ty);
                if let (Value::F32(_), Some(Value::I32(n))) = (&x, &result) {
                    self.decide(*n as u64);
                }
                result
            }
            Kind::Compose(parts) => Value::gather(&self.exprs(parts)?),
            Kind::Splat(x) => {
                let lanes = match e.ty {
                    Ty::Vec(n) | Ty::IVec(n) => n as usize,
                    _ => return invalid("not a vector"),
                };
                Value::gather(&vec![self.expr(x)?; lanes])
            }
            Kind::Many(parts) => Some(Value::Many(self.exprs(parts)?)),
            Kind::Repeat(x) => {
                let Ty::Array(_, len) = e.ty else {
                    return invalid("not an array");
                };
                Some(Value::Many(vec![self.expr(x)?; len as usize]))
            }
            Kind::Call(k, args) => Some(self.call(*k, args)?),
            Kind::If(condition, then, otherwise) => {
                let side = if self.condition(condition)? { then } else { otherwise };
                Some(self.block(side)?)
            }
            Kind::Match(subject, arms) => {
                let subject = self.int(subject)?;
                match arms.iter().find(|(values, _)| takes(values, subject)) {
                    Some((_, body)) => Some(self.expr(body)?),
                    None => None,
                }
            }
            Kind::Block(block) => Some(self.block(block)?),
        };
        value.ok_or(Exit::Invalid(Invalid("operands")))
    }

    fn texel(&self, at: [i32; 4]) -> Value<R> {
        let inside = |k: usize| at[k].min(self.picture.size[k] as i32 - 1).max(0) as usize;
        let texel = self.picture.texels[inside(1) * self.picture.size[0] as usize + inside(0)];
        Value::vec(&texel.map(R::of))
    }

    fn call(&mut self, k: u8, args: &[Expr]) -> Eval<R> {
        let program = self.program;
        let Some(function) = program.functions.get(k as usize) else {
            return invalid("no such function");
        };
        let args = self.exprs(args)?;
        if self.calls >= 20 || args.len() != function.params.len() {
            return invalid("a call");
        }
        self.calls += 1;
        let inner = function.params.iter().map(|(var, _)| *var).zip(args).collect();
        let outer = std::mem::replace(&mut self.env, inner);
        let result = self.block(&function.body);
        self.env = outer;
        self.calls -= 1;
        match result {
            Err(Exit::Return(value)) => Ok(value),
            Err(Exit::Break | Exit::Continue) => invalid("leaves no loop"),
            other => other,
        }
    }
}

fn takes(values: &[i32], subject: i32) -> bool {
    values.is_empty() || values.contains(&subject)
}

/// The part at `path`.
fn read<R: Real>(value: &Value<R>, path: &[usize]) -> Option<Value<R>> {
    match (path.split_first(), value) {
        (None, value) => Some(value.clone()),
        (Some((k, rest)), Value::Many(parts)) => read(parts.get(*k)?, rest),
        (Some((k, [])), vector) => vector.lane(*k),
        _ => None,
    }
}

/// Replaces the part at `path`, which `read` has found.
fn write<R: Real>(value: &mut Value<R>, path: &[usize], new: Value<R>) {
    match (path.split_first(), value) {
        (None, value) => *value = new,
        (Some((k, rest)), Value::Many(parts)) => write(&mut parts[*k], rest, new),
        (Some((k, _)), Value::Vec(lanes, _)) => {
            if let Value::F32(x) = new {
                lanes[*k] = x;
            }
        }
        (Some((k, _)), Value::IVec(lanes, _)) => {
            if let Value::I32(n) = new {
                lanes[*k] = n;
            }
        }
        _ => {}
    }
}
