//! Making a failing kernel smaller while it fails.

use super::ast::*;
use super::walk::{Walk, children};

/// Attempts after which the kernel is left as it is.
const ATTEMPTS: usize = 6000;

/// The smallest kernel found for which `fails` still holds.
pub fn shrink(program: &Program, fails: &dyn Fn(&Program) -> bool) -> Program {
    let mut search = Search {
        best: program.clone(),
        left: ATTEMPTS,
        fails,
    };
    loop {
        let before = search.best.clone();
        search.statements();
        search.expressions();
        search.functions();
        if search.best == before || search.left == 0 {
            return search.best;
        }
    }
}

struct Search<'f> {
    best: Program,
    left: usize,
    fails: &'f dyn Fn(&Program) -> bool,
}

impl Search<'_> {
    fn attempt(&mut self, candidate: Program) -> bool {
        if self.left == 0 || candidate == self.best {
            return false;
        }
        self.left -= 1;
        let keep = (self.fails)(&candidate);
        if keep {
            self.best = candidate;
        }
        keep
    }

    /// Tries each change of each block, from the last block to the first.
    fn statements(&mut self) {
        let mut at = count(&self.best, |_| 0, |_| 1);
        while at > 0 {
            at -= 1;
            let mut k = usize::MAX;
            // Of a block that has become smaller, the next statement has the same number or less.
            loop {
                let length = statements_of(&self.best, at);
                k = k.min(length);
                if k == 0 {
                    break;
                }
                k -= 1;
                for change in 0..4 {
                    let mut candidate = self.best.clone();
                    on_block(&mut candidate, at, &mut |block| simplify(block, k, change));
                    if self.attempt(candidate) {
                        break;
                    }
                }
            }
        }
    }

    fn expressions(&mut self) {
        let mut at = 0;
        while at < count(&self.best, |_| 1, |_| 0) && self.left > 0 {
            let mut options = Vec::new();
            on_expr(&mut self.best.clone(), at, &mut |e| options = simpler(e));
            let mut changed = false;
            for option in options {
                let mut candidate = self.best.clone();
                on_expr(&mut candidate, at, &mut |e| *e = option.clone());
                if self.attempt(candidate) {
                    changed = true;
                    break;
                }
            }
            at += usize::from(!changed);
        }
    }

    /// Drops functions that nothing calls.
    fn functions(&mut self) {
        for k in (0..self.best.functions.len()).rev() {
            let called = count(
                &self.best,
                |e| usize::from(matches!(e.kind, Kind::Call(f, _) if f as usize == k)),
                |_| 0,
            );
            if called > 0 {
                continue;
            }
            let mut candidate = self.best.clone();
            candidate.functions.remove(k);
            let mut renumber = |e: &mut Expr| {
                if let Kind::Call(f, _) = &mut e.kind
                    && *f as usize > k
                {
                    *f -= 1;
                }
            };
            Walk {
                expr: &mut renumber,
                block: &mut |_| {},
            }
            .program(&mut candidate);
            self.attempt(candidate);
        }
        for unused in [true, false] {
            let mut candidate = self.best.clone();
            if unused {
                candidate.consts.pop();
            } else {
                candidate.structs.pop();
            }
            self.attempt(candidate);
        }
    }
}

fn count(program: &Program, of_expr: impl Fn(&Expr) -> usize, of_block: impl Fn(&Block) -> usize) -> usize {
    let (mut exprs, mut blocks) = (0, 0);
    Walk {
        expr: &mut |e| exprs += of_expr(e),
        block: &mut |b| blocks += of_block(b),
    }
    .program(&mut program.clone());
    exprs + blocks
}

fn on_block(program: &mut Program, at: usize, change: &mut dyn FnMut(&mut Block)) {
    let mut k = 0;
    Walk {
        expr: &mut |_| {},
        block: &mut |block| {
            if k == at {
                change(block);
            }
            k += 1;
        },
    }
    .program(program);
}

fn on_expr(program: &mut Program, at: usize, change: &mut dyn FnMut(&mut Expr)) {
    let mut k = 0;
    Walk {
        expr: &mut |e| {
            if k == at {
                change(e);
            }
            k += 1;
        },
        block: &mut |_| {},
    }
    .program(program);
}

fn statements_of(program: &Program, at: usize) -> usize {
    let mut length = 0;
    on_block(&mut program.clone(), at, &mut |block| length = block.statements.len());
    length
}

/// Change number `change` to a statement of a block.
fn simplify(block: &mut Block, k: usize, change: u32) {
    let statement = block.statements[k].clone();
    let with = match (change, statement) {
        (0, _) => Vec::new(),
        (1, Stmt::If(_, inner, _) | Stmt::For(_, _, inner) | Stmt::ForArray(_, _, _, inner) | Stmt::Block(inner)) => {
            inner.statements
        }
        (1, Stmt::Match(_, arms)) => arms.into_iter().next_back().map(|a| a.1.statements).unwrap_or_default(),
        (2, Stmt::If(_, _, inner)) => inner.statements,
        (2, Stmt::For(var, range, body)) => {
            let plain = Range {
                step: 1,
                reversed: false,
                inclusive: false,
                ..range
            };
            vec![Stmt::For(var, plain, body)]
        }
        (3, Stmt::If(condition, inner, _)) => vec![Stmt::If(condition, inner, Block::default())],
        (_, same) => vec![same],
    };
    block.statements.splice(k..=k, with);
}

/// Simpler expressions of the same type.
fn simpler(e: &mut Expr) -> Vec<Expr> {
    let ty = e.ty.clone();
    let literal = |kind| Expr { ty: ty.clone(), kind };
    let mut options = match ty {
        Ty::F32 => vec![literal(Kind::Float(0.0)), literal(Kind::Float(1.0))],
        Ty::I32 => vec![literal(Kind::Int(0)), literal(Kind::Int(1))],
        Ty::U32 => vec![literal(Kind::Uint(0)), literal(Kind::Uint(1))],
        Ty::Bool => vec![literal(Kind::Bool(false)), literal(Kind::Bool(true))],
        Ty::Vec(_) => [0.0, 1.0]
            .map(|x| {
                let x = Expr {
                    ty: Ty::F32,
                    kind: Kind::Float(x),
                };
                literal(Kind::Splat(Box::new(x)))
            })
            .to_vec(),
        _ => Vec::new(),
    };
    if let Some(known) = options.iter().position(|o| o == e) {
        options.truncate(known);
    } else {
        let parts = children(e).into_iter().filter(|child| child.ty == ty);
        options.extend(parts.map(|child| child.clone()));
    }
    options
}
