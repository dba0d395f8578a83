//! Float functions at the edges of their domains, where drivers deviate from the kernel language. Each is replaced by a
//! function in the shader that works on every driver, or by fewer operations if they suffice.
//!
//! `docs/semantics.md` has the table of these edge cases. Only operations that [`super::super::lower`] could not prove to
//! lie inside their domain arrive here.

mod body;
mod hyperbolic;
mod power;
mod remainder;
mod simple;

use super::{componentwise_function, is_leaf};
use crate::emit::ast::{Domain, Expr, Function, Module, Op, StmtKind, Ty};
use body::Body;
use straightline_evaluator::ir::{self, BinaryOp, UnaryOp};

pub use simple::rewrite_unequal;

/// Overloading of functions in a language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overloads {
    /// No overloading: the name of a vector function contains its type.
    None,
    /// Functions of several types share a name, and choices are made component by component.
    Vectors,
    /// Functions of several types share a name, and choices are made between scalars.
    Scalars,
}

/// Builds the result of a guard from its arguments.
type Value = Box<dyn Fn(&mut Body<'_, '_>, &[Expr]) -> Expr>;

/// A function to be emitted: its name, its purpose, the number of arguments, and its result.
struct Guard {
    name: String,
    comment: &'static str,
    arguments: &'static [&'static str],
    /// `true` if the function contains a loop, so that it is emitted for scalars.
    scalar: bool,
    value: Value,
}

/// Returns the expression without guarded operations: a call of a function, or another expression.
pub fn expand_guarded(module: &mut Module<'_>, expr: Expr, overloads: Overloads) -> Expr {
    let Op::Guarded(op, domain) = expr.op.clone() else {
        return expr;
    };
    let ty = expr.ty;
    if ty.half {
        // Bits are only inspected by way of `f32`, which holds every `f16`.
        let full = ty.to_full_precision();
        let args = expr.args.into_iter().map(|arg| match arg.as_constant() {
            Some(bits) => Expr::constant(full, *bits),
            None => arg.convert_to(full),
        });
        let guarded = Expr::new(Op::Guarded(op, domain), args.collect(), full);
        return expand_guarded(module, guarded, overloads).convert_to(ty);
    }
    let mut args = expr.args;
    if let Some(shorter) = simple::inline_guard(&op, domain, &args, ty) {
        return shorter;
    }
    let guard = select_guard(&op, domain, &args);
    args.truncate(guard.arguments.len());
    let called = add_guard_function(module, &guard, ty, overloads);
    Expr::new(called, args, ty)
}

/// Returns the function that implements an operation.
fn select_guard(op: &ir::Op, domain: Domain, args: &[Expr]) -> Guard {
    match op {
        ir::Op::Binary(BinaryOp::Pow) => power::power_guard(domain, args),
        ir::Op::Binary(BinaryOp::Atan2) => simple::angle_guard(),
        ir::Op::Binary(BinaryOp::Rem) => remainder::remainder_guard(domain),
        ir::Op::Unary(op @ (UnaryOp::Log | UnaryOp::Log2)) => simple::logarithm_guard(*op),
        ir::Op::Unary(op @ (UnaryOp::Sinh | UnaryOp::Cosh | UnaryOp::Tanh)) => hyperbolic::hyperbolic_guard(*op),
        ir::Op::Unary(UnaryOp::Fract) => simple::fraction_guard(),
        ir::Op::Unary(UnaryOp::Atan) => simple::arc_tangent(),
        ir::Op::Unary(UnaryOp::Cbrt) => power::cube_root(),
        other => unreachable!("{other:?} has no edges"),
    }
}

/// Adds a function for a type, with the functions that it calls.
fn add_guard_function(module: &mut Module<'_>, guard: &Guard, ty: Ty, overloads: Overloads) -> Op {
    let by_scalars = guard.scalar || overloads == Overloads::Scalars;
    if !by_scalars || ty.is_scalar() {
        let name = match overloads == Overloads::None && !ty.is_scalar() {
            true => format!("{}_{}", guard.name, ty.short_name()),
            false => guard.name.clone(),
        };
        return module.add_function(&name, ty, |module| build_function(module, guard, &name, ty));
    }
    let scalar = add_guard_function(module, guard, ty.element_of().into(), overloads);
    match overloads {
        Overloads::None => {
            let name = format!("{}_{}", guard.name, ty.short_name());
            by_component(module, guard, scalar, &name, ty)
        }
        _ => componentwise_function(module, scalar, ty),
    }
}

fn build_function<'g>(module: &mut Module<'g>, guard: &Guard, name: &str, ty: Ty) -> Function<'g> {
    let params: Vec<_> = guard
        .arguments
        .iter()
        .map(|name| module.new_variable(*name, ty))
        .collect();
    let args: Vec<Expr> = params.iter().map(|param| module.read_variable(*param)).collect();
    let mut body = Body::new(module, ty);
    let value = (guard.value)(&mut body, &args);
    let mut body = body.into_statements();
    body.push(StmtKind::Return(Some(value)).into());
    Function {
        comment: guard.comment.to_owned(),
        name: name.to_owned(),
        params,
        result: ty,
        body,
    }
}

/// Adds a function of vectors that calls a scalar function, under another name, for each component.
fn by_component<'g>(module: &mut Module<'g>, guard: &Guard, scalar: Op, name: &str, ty: Ty) -> Op {
    module.add_function(name, ty, |module: &mut Module<'g>| {
        let params: Vec<_> = guard
            .arguments
            .iter()
            .map(|name| module.new_variable(*name, ty))
            .collect();
        let component = |k: u8| {
            let part = |param| Expr::new(Op::Swizzle(vec![k]), vec![Expr::var(param, ty)], ty.element_of());
            let parts = params.iter().map(|param| part(*param)).collect();
            Expr::new(scalar.clone(), parts, ty.element_of())
        };
        let all = Expr::new(Op::Construct, (0..ty.component_count()).map(component).collect(), ty);
        Function {
            comment: guard.comment.to_owned(),
            name: name.to_owned(),
            params: params.clone(),
            result: ty,
            body: vec![StmtKind::Return(Some(all)).into()],
        }
    })
}
