//! Rewrites constructs that a language spells differently, or leaves undefined where Rust does not.
//!
//! Each language has a rule, which is applied to every expression after its arguments and returns the replacement.
//!
//! File tests: `codegen/tests/filetests/legalise`.

mod exact;
mod glsl;
mod guards;
mod half;
mod hlsl;
mod powers;
mod wgsl;
mod zeroed;

use super::ast::{Division, Expr, Function, Module, Op, StmtKind, Ty};
use super::resources::Resources;
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type};

use guards::Overloads;

pub use exact::AS_WRITTEN;
pub use half::legalise_half;

/// Rewrites a module for WGSL. With `marks`, every exact value is marked, not only those that a compiler could contract, so
/// that they can be found in translations of the WGSL.
pub fn legalise_wgsl(module: &mut Module<'_>, marks: bool) {
    exact::insert_barriers(module, marks);
    module.rewrite(&mut |module, expr| guards::expand_guarded(module, expr, Overloads::None));
    module.rewrite(&mut |_, expr| powers::divide_by_shift(expr));
    wgsl::apply_wgsl_rules(module);
}

/// Rewrites a module for GLSL, for Vulkan or OpenGL, and for a version with or without `precise`.
pub fn legalise_glsl(module: &mut Module<'_>, resources: &Resources, vulkan: bool, precise: bool) {
    zeroed::zero_workgroup_memory(module, resources);
    match precise {
        true => exact::mark_precise(module),
        // Functions are rewritten below.
        false => exact::insert_barriers(module, false),
    }
    let overloads = match vulkan {
        true => Overloads::Vectors,
        false => Overloads::Scalars,
    };
    module.rewrite(&mut |module, expr| guards::expand_guarded(module, expr, overloads));
    module.rewrite(&mut |_, expr| powers::divide_by_shift(expr));
    let rule: Rule = if vulkan { glsl::vulkan_rule } else { glsl::opengl_rule };
    rewrite_functions(module, rule);
    module.rewrite(&mut { rule });
}

/// Rewrites a module for HLSL.
pub fn legalise_hlsl(module: &mut Module<'_>, resources: &Resources) {
    zeroed::zero_workgroup_memory(module, resources);
    exact::mark_precise(module);
    module.rewrite(&mut |module, expr| guards::expand_guarded(module, expr, Overloads::Scalars));
    module.rewrite(&mut |_, expr| powers::divide_by_shift(expr));
    hlsl::apply_hlsl_rules(module);
}

/// Rewrite rule of a language.
type Rule = fn(&mut Module<'_>, Expr) -> Expr;

/// Rewrites the functions that are already in the module.
fn rewrite_functions(module: &mut Module<'_>, rule: Rule) {
    for k in 0..module.functions.len() {
        let mut body = std::mem::take(&mut module.functions[k].body);
        for stmt in &mut body {
            stmt.rewrite(&mut |expr| rule(module, expr));
        }
        module.functions[k].body = body;
    }
}

/// Returns a component-wise selection: `yes` if the condition is `true`, else `no`.
fn component_select(condition: Expr, yes: Expr, no: Expr) -> Expr {
    let ty = yes.ty;
    Expr::new(Op::Choose, vec![condition, yes, no], ty)
}

/// Returns whether an expression is a name or a number.
fn is_leaf(expr: &Expr) -> bool {
    match &expr.op {
        Op::Var(_) | Op::Ir(ir::Op::Varying(_)) => true,
        Op::Ir(ir::Op::Const(_)) => expr.ty.is_scalar() && !is_non_finite(expr),
        _ => false,
    }
}

/// Returns whether a component of a constant is an infinity or a NaN.
fn is_non_finite(expr: &Expr) -> bool {
    let float = |bits: &u32| !f32::from_bits(*bits).is_finite();
    let lanes = expr.ty.component_count() as usize;
    expr.ty.is_float() && expr.as_constant().is_some_and(|bits| bits[..lanes].iter().any(float))
}

/// Builds a non-finite constant vector component by component.
fn by_component(expr: &Expr, mut scalar: impl FnMut(u32) -> Expr) -> Expr {
    let bits = *expr.as_constant().expect("only constants are not finite");
    let lanes = &bits[..expr.ty.component_count() as usize];
    let ty = Ty {
        shape: Type::F32,
        ..expr.ty
    };
    let mut component = |bits: u32| match f32::from_bits(bits).is_finite() {
        true => Expr::splat(ty, bits),
        false => scalar(bits),
    };
    match lanes {
        [bits] => component(*bits),
        [first, rest @ ..] if rest.iter().all(|bits| bits == first) => {
            Expr::new(Op::Construct, vec![component(*first)], expr.ty)
        }
        _ => Expr::new(
            Op::Construct,
            lanes.iter().map(|bits| component(*bits)).collect(),
            expr.ty,
        ),
    }
}

/// Returns a function that converts floats to integers as Rust does: to the nearest representable integer, and a NaN to 0.
/// With `clamped`, numbers out of range are clamped first, for languages that leave them undefined.
fn to_integer(module: &mut Module<'_>, name: &str, to: Ty, clamped: bool, rule: Rule) -> Op {
    let from = to.with_kind(Scalar::F32);
    module.add_function(name, to, |module| {
        let signed = to.scalar_kind() == Some(Scalar::I32);
        let (low, high, limit, largest): (f32, f32, f32, u32) = match signed {
            true => (-2_147_483_648.0, 2_147_483_520.0, 2_147_483_648.0, i32::MAX as u32),
            false => (0.0, 4_294_967_040.0, 4_294_967_296.0, u32::MAX),
        };
        let x = module.new_variable("x", from);
        let read = module.read_variable(x);
        let bound = |x: f32| Expr::splat(from, x.to_bits());
        let whole = match clamped {
            true => Expr::new(Op::Ir(ir::Op::Clamp), vec![read.clone(), bound(low), bound(high)], from),
            false => read.clone(),
        };
        let too_large = read.clone().binary(BinaryOp::Ge, bound(limit));
        let saturated = component_select(too_large, Expr::splat(to, largest), whole.convert_to(to));
        let bits = read.bits_as(to.with_kind(Scalar::U32));
        let word = |bits: u32| Expr::new(Op::Hex(bits), Vec::new(), to.with_kind(Scalar::U32));
        let is_nan = bits
            .binary(BinaryOp::And, word(0x7fff_ffff))
            .binary(BinaryOp::Gt, word(0x7f80_0000));
        let lets = [("is_nan", is_nan), ("saturated", saturated)].map(|(name, value)| {
            let value = value.rewrite(&mut |e| rule(module, e));
            (module.new_variable(name, value.ty), value)
        });
        let [is_nan, saturated] = [0, 1].map(|k| module.read_variable(lets[k].0));
        let chosen = component_select(is_nan, Expr::splat(to, 0), saturated).rewrite(&mut |e| rule(module, e));
        let mut body: Vec<_> = lets.map(|(var, value)| StmtKind::Let(var, value).into()).into();
        body.push(StmtKind::Return(Some(chosen)).into());
        Function {
            comment: "What is too large becomes the largest integer, NaN becomes 0.".to_owned(),
            name: name.to_owned(),
            params: vec![x],
            result: to,
            body,
        }
    })
}

/// Returns a division with WGSL's edge cases: division by zero returns the dividend with remainder 0, and the smallest
/// integer divided by -1 returns itself. Other languages leave both undefined, and also the remainder of negative numbers,
/// or give it the sign of the divisor. `None` if the operator needs no guard.
fn guarded_division(module: &mut Module<'_>, op: BinaryOp, known: Division, ty: Ty, rule: Rule) -> Option<Op> {
    let signed = ty.scalar_kind() == Some(Scalar::I32);
    let quotient = op == BinaryOp::Div;
    if known.defined && (quotient || !signed || known.positive) {
        return None;
    }
    let (name, comment) = match (quotient, signed) {
        (true, _) => ("whole_quotient", "x / y, and x where that is not defined."),
        (false, true) => (
            "whole_remainder",
            "What x / y leaves, with the sign of x, and 0 where it is not defined.",
        ),
        (false, false) => ("whole_remainder", "What x / y leaves, and 0 where it is not defined."),
    };
    let function = module.add_function(name, ty, |module| {
        let [x, y] = ["x", "y"].map(|name| module.new_variable(name, ty));
        let [dividend, by] = [x, y].map(|var| module.read_variable(var));
        let is = |value: &Expr, bits: u32| value.clone().binary(BinaryOp::Eq, Expr::splat(ty, bits));
        let one = || Expr::splat(ty, 1);
        let mut divisor = component_select(is(&by, 0), one(), by.clone());
        if signed {
            let overflows = is(&dividend, i32::MIN as u32).binary(BinaryOp::And, is(&by, -1_i32 as u32));
            divisor = component_select(overflows, one(), divisor);
        }
        let divisor = divisor.rewrite(&mut |e| rule(module, e));
        let var = module.new_variable("divisor", ty);
        let by = module.read_variable(var);
        let sure = Division {
            defined: true,
            positive: true,
        };
        let divide = |op, x: Expr| Expr::new(Op::Division(op, sure), vec![x, by.clone()], ty);
        let result = match (quotient, signed) {
            (true, _) => divide(BinaryOp::Div, dividend),
            (false, false) => divide(BinaryOp::Rem, dividend),
            (false, true) => {
                let back = by
                    .clone()
                    .binary(BinaryOp::Mul, divide(BinaryOp::Div, dividend.clone()));
                dividend.binary(BinaryOp::Sub, back)
            }
        };
        Function {
            comment: comment.to_owned(),
            name: name.to_owned(),
            params: vec![x, y],
            result: ty,
            body: vec![
                StmtKind::Let(var, divisor).into(),
                StmtKind::Return(Some(result)).into(),
            ],
        }
    });
    Some(function)
}

/// Masks a shift count to less than 32.
fn below_32(count: Expr) -> Expr {
    let ty = count.ty;
    match count.as_constant() {
        Some(bits) => Expr::constant(ty, bits.map(|bits| bits & 31)),
        None => count.binary(BinaryOp::And, Expr::splat(ty, 31)),
    }
}

fn take_args<const N: usize>(args: Vec<Expr>) -> [Expr; N] {
    args.try_into().expect("as many arguments as the operation has")
}

/// Clamps the index of an array element to the last element.
fn clamp_index(mut expr: Expr) -> Expr {
    let Type::Array { len, .. } = expr.args[0].ty.shape else {
        return expr;
    };
    let index = expr.args.pop().expect("an index").convert_to(Type::U32);
    let last = Expr::splat(Type::U32, len - 1);
    expr.args.push(Expr::call("min", vec![index, last], Type::U32));
    expr
}

/// Returns whether an expression is a leaf, or a comparison of two leaves.
fn is_simple(expr: &Expr) -> bool {
    match expr.op {
        Op::Ir(ir::Op::Binary(op)) => op.is_comparison() && expr.args.iter().all(is_leaf),
        _ => is_leaf(expr),
    }
}

/// Returns `&` or `|` of booleans without short-circuit evaluation, for languages whose operators may branch.
fn eager_bool_op(op: BinaryOp, expr: Expr) -> Expr {
    let ty = expr.ty;
    if ty.is_scalar() {
        let both = Expr::new(Op::Construct, expr.args, Type::value(Scalar::Bool, 2));
        let quantifier = if op == BinaryOp::And { Op::All } else { Op::Any };
        return Expr::new(quantifier, vec![both], Type::BOOL);
    }
    let words = ty.with_kind(Scalar::U32);
    let [x, y] = take_args(expr.args).map(|side: Expr| side.convert_to(words));
    x.binary(op, y).convert_to(ty)
}

/// Counts the zeros before the highest set bit, or after the lowest, by a function that returns bit positions from the
/// lowest, and -1 for none.
fn zero_count(expr: Expr, find: &'static str, leading: bool) -> Expr {
    let ty = expr.ty;
    let [x] = take_args(expr.args);
    let bits = match ty.scalar_kind() {
        Some(Scalar::I32) => x.convert_to(Type::U32),
        _ => x,
    };
    let number = |n: u32| Expr::splat(Type::I32, n);
    let found = Expr::call(find, vec![bits.clone()], Type::I32);
    let zeros = match leading {
        true => number(31).binary(BinaryOp::Sub, found),
        false => found,
    };
    let none = bits.binary(BinaryOp::Eq, Expr::splat(Type::U32, 0));
    component_select(none, number(32), zeros).convert_to(ty)
}

/// Returns a function of vectors that calls a scalar function of the same name for each component.
fn componentwise_function(module: &mut Module<'_>, function: Op, ty: Ty) -> Op {
    let Op::Function(name) = &function else { return function };
    let same = |f: &&Function<'_>| f.name == *name;
    if module.functions.iter().filter(same).any(|f| f.result == ty) {
        return function;
    }
    // Functions of signed and unsigned numbers share a name.
    let of_scalars = |f: &&Function<'_>| f.result.shape == ty.element_of();
    let Some(scalar) = module.functions.iter().filter(same).find(of_scalars).cloned() else {
        return function;
    };
    module.add_function(name, ty, |module| {
        let params: Vec<_> = scalar
            .params
            .iter()
            .map(|param| {
                let variable = module.variables[param.0 as usize].clone();
                let wide = ty.with_kind(variable.ty.scalar_kind().unwrap_or(Scalar::F32));
                module.new_variable(variable.name, wide)
            })
            .collect();
        let component = |k: u8| {
            let parts = params.iter().map(|param| {
                let vector = module.read_variable(*param);
                let part = Type::scalar(vector.ty.scalar_kind().unwrap_or(Scalar::F32));
                Expr::new(Op::Swizzle(vec![k]), vec![vector], part)
            });
            Expr::new(function.clone(), parts.collect(), ty.element_of())
        };
        let all = Expr::new(Op::Construct, (0..ty.component_count()).map(component).collect(), ty);
        Function {
            comment: scalar.comment.clone(),
            name: name.clone(),
            params,
            result: ty,
            body: vec![StmtKind::Return(Some(all)).into()],
        }
    })
}
