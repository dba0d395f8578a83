//! HLSL: missing operators, unspecified behaviour, and arrays, which are assigned element by element.

use super::{
    Rule, below_32, by_component, clamp_index, componentwise_function, eager_bool_op, guarded_division,
    guards::rewrite_unequal, is_non_finite, is_simple, rewrite_functions, take_args, to_integer, zero_count,
};
use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, Ty};
use crate::emit::print::hlsl_type;
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// Rewrites a module for HLSL.
pub fn apply_hlsl_rules(module: &mut Module<'_>) {
    rewrite_functions(module, hlsl_rule);
    module.rewrite(&mut hlsl_rule);
    let body = std::mem::take(&mut module.body);
    module.body = {
        let body = by_element(module, body);
        chosen_before(module, body)
    };
    for k in 0..module.functions.len() {
        let body = std::mem::take(&mut module.functions[k].body);
        module.functions[k].body = chosen_before(module, body);
    }
}

/// Returns the statements with the operands of selections computed before them. Since HLSL 2021 `?:` only evaluates one
/// side, so a compiler would emit a branch.
fn chosen_before<'g>(module: &mut Module<'g>, block: Block<'g>) -> Block<'g> {
    let mut out = Vec::with_capacity(block.len());
    for mut stmt in block {
        for inner in stmt.blocks_mut() {
            *inner = chosen_before(module, std::mem::take(inner));
        }
        let source = stmt.source;
        for expr in stmt.own_mut() {
            *expr = expr.clone().rewrite(&mut |mut expr| {
                if matches!(expr.op, Op::Ir(ir::Op::Select) | Op::Choose) {
                    for (side, name) in expr.args[1..].iter_mut().zip(["if_true", "if_false"]) {
                        if !is_plain(side) {
                            let var = module.new_variable(name, side.ty);
                            let value = std::mem::replace(side, module.read_variable(var));
                            let kind = StmtKind::Let(var, value);
                            out.push(Stmt { kind, source });
                        }
                    }
                }
                expr
            });
        }
        out.push(stmt);
    }
    out
}

/// Returns whether an expression needs no computation.
fn is_plain(expr: &Expr) -> bool {
    match &expr.op {
        Op::Var(_) | Op::Ir(ir::Op::Const(_) | ir::Op::Uniform(_) | ir::Op::Override(_) | ir::Op::Varying(_)) => true,
        Op::Swizzle(_) | Op::Construct => expr.args.iter().all(is_plain),
        _ => false,
    }
}

fn hlsl_rule(module: &mut Module<'_>, mut expr: Expr) -> Expr {
    let ty = expr.ty;
    match &expr.op {
        _ if is_non_finite(&expr) => by_component(&expr, |bits| {
            let word = Expr::new(Op::Hex(bits), Vec::new(), Type::U32);
            Expr::call("asfloat", vec![word], Type::F32)
        }),
        Op::Division(op, known) => {
            let (op, known) = (*op, *known);
            let scalar = Ty::from(ty.element_of());
            if let Some(function) = guarded_division(module, op, known, scalar, hlsl_rule as Rule) {
                expr.op = componentwise_function(module, function, ty);
            }
            expr
        }
        Op::Convert { fits: false } if expr.args[0].ty.is_float() && ty.is_integer() => {
            let scalar = Ty::from(ty.element_of());
            let name = format!("to_{}", hlsl_type(scalar));
            let function = to_integer(module, &name, scalar, true, hlsl_rule as Rule);
            expr.op = componentwise_function(module, function, ty);
            expr
        }
        Op::Index { inside: false } => clamp_index(expr),
        Op::Ir(ir::Op::Unary(op)) => rewrite_unary(*op, expr),
        Op::Ir(ir::Op::Binary(op)) => rewrite_binary(*op, expr),
        Op::Ir(ir::Op::Bitcast) => {
            expr.op = Op::Call(match ty.scalar_kind() {
                Some(Scalar::F32) => "asfloat",
                Some(Scalar::I32) => "asint",
                _ => "asuint",
            });
            expr
        }
        _ => expr,
    }
}

fn rewrite_unary(op: UnaryOp, expr: Expr) -> Expr {
    let ty = expr.ty;
    match op {
        // HLSL's `sign` returns an integer.
        UnaryOp::Sign if ty.is_float() => Expr::call("sign", expr.args, ty.with_kind(Scalar::I32)).convert_to(ty),
        UnaryOp::CountOneBits => Expr::call("countbits", expr.args, ty.with_kind(Scalar::U32)).convert_to(ty),
        UnaryOp::ReverseBits if ty.scalar_kind() == Some(Scalar::I32) => {
            let [x] = take_args(expr.args);
            let bits = x.convert_to(ty.with_kind(Scalar::U32));
            Expr::call("reversebits", vec![bits], ty.with_kind(Scalar::U32)).convert_to(ty)
        }
        UnaryOp::LeadingZeros => zero_count(expr, "firstbithigh", true),
        UnaryOp::TrailingZeros => zero_count(expr, "firstbitlow", false),
        _ => expr,
    }
}

fn rewrite_binary(op: BinaryOp, mut expr: Expr) -> Expr {
    use BinaryOp::{And, Ne, Or, Rem, Shl, Shr};
    let bools = expr.ty.scalar_kind() == Some(Scalar::Bool);
    match op {
        Ne => rewrite_unequal(expr),
        Rem if expr.ty.is_float() => {
            expr.op = Op::Call("fmod");
            expr
        }
        And | Or if bools && (!expr.ty.is_scalar() || !is_simple(&expr.args[1])) => eager_bool_op(op, expr),
        Shl | Shr => {
            let [value, count] = take_args(std::mem::take(&mut expr.args));
            expr.args = vec![typed_literal(value), below_32(count)];
            expr
        }
        _ => expr,
    }
}

/// Adds a suffix to a literal that is shifted. Literals of `int` have none, and DXC leaves their width in shifts
/// unspecified.
fn typed_literal(value: Expr) -> Expr {
    let ty = value.ty;
    match ty.scalar_kind() == Some(Scalar::I32) && ty.is_scalar() && value.as_constant().is_some() {
        true => Expr::call("int", vec![value], ty),
        false => value,
    }
}

/// Returns the statements with arrays assigned element by element, because HLSL only allows a list in a declaration. A
/// value computed from the array's own elements is first stored in a separate array.
fn by_element<'g>(module: &mut Module<'g>, block: Block<'g>) -> Block<'g> {
    let mut out = Vec::with_capacity(block.len());
    for mut stmt in block {
        for inner in stmt.blocks_mut() {
            *inner = by_element(module, std::mem::take(inner));
        }
        match stmt.kind {
            StmtKind::Assign(place, None, value) if value.op == Op::Construct && value.ty.is_array() => {
                let mut own = false;
                value.visit(&mut |expr| own |= *expr == place);
                if own {
                    let next = module.new_variable("next", value.ty);
                    for kind in [
                        StmtKind::Var(next, Some(value)),
                        StmtKind::Assign(place, None, module.read_variable(next)),
                    ] {
                        out.push(Stmt {
                            kind,
                            source: stmt.source,
                        });
                    }
                    continue;
                }
                for (k, part) in value.args.into_iter().enumerate() {
                    let index = Expr::splat(Type::I32, k as u32);
                    let element = Expr::new(Op::Index { inside: true }, vec![place.clone(), index], part.ty);
                    out.push(Stmt {
                        kind: StmtKind::Assign(element, None, part),
                        source: stmt.source,
                    });
                }
            }
            _ => out.push(stmt),
        }
    }
    out
}
