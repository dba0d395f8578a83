//! Printing of expressions common to all languages.

use super::Language;
use crate::emit::ast::{Expr, Op, Ty};
use crate::emit::literals::decimal_digits;
use crate::emit::text::{Binds, Text};
use straightline_evaluator::ir::{self, BinaryOp, Bits, Scalar, Type, UnaryOp};

/// Prints an expression whose arguments have been printed.
pub fn print(l: &dyn Language, expr: &Expr, args: &[Text]) -> Text {
    let all: Vec<&Text> = args.iter().collect();
    match &expr.op {
        Op::Ir(op) => print_operation(l, op, expr, args),
        Op::Division(op, _) => print_infix(l, *op, Scalar::I32, args),
        Op::Guarded(..) => unreachable!("guards are functions"),
        Op::Convert { .. } => match (&expr.args[0].op, expr.ty.shape) {
            (Op::Ir(ir::Op::BufferLen(buffer)), Type::U32) => l.unsigned_length(*buffer),
            _ => Text::call(&l.type_spelling(expr.ty), &all),
        },
        Op::Construct => l.construct(expr.ty, &all),
        Op::Swizzle(components) => {
            let letters: String = components.iter().map(|k| char::from(b"xyzw"[*k as usize])).collect();
            Text::member(&args[0], &letters)
        }
        Op::Index { .. } => Text::index(&args[0], &args[1]),
        Op::Builtin(builtin) => l.builtin_value(*builtin),
        // The assigned variable carries the qualifier.
        Op::Exact { .. } => args[0].clone(),
        Op::Any => Text::call("any", &all),
        Op::All => Text::call("all", &all),
        Op::Choose => l.component_select(&args[0], &args[1], &args[2]),
        Op::Hex(bits) => match expr.ty.component_count() {
            1 => Text::name(l.hex_literal(*bits)),
            _ => Text::call(&l.type_spelling(expr.ty), &[&Text::name(l.hex_literal(*bits))]),
        },
        Op::Call(name) => Text::call(name, &all),
        Op::Function(name) => Text::call(name, &all),
        Op::Var(_) => unreachable!("variables are printed by their names"),
    }
}

fn print_operation(l: &dyn Language, op: &ir::Op, expr: &Expr, args: &[Text]) -> Text {
    let all: Vec<&Text> = args.iter().collect();
    let kind = |k: usize| expr.args[k].ty.scalar_kind().unwrap_or(Scalar::F32);
    match op {
        ir::Op::Const(bits) => print_constant(l, expr.ty, bits),
        ir::Op::Unary(UnaryOp::Neg) => Text::prefix("-", &args[0]),
        ir::Op::Unary(UnaryOp::Not) => Text::prefix("!", &args[0]),
        ir::Op::Unary(UnaryOp::BitNot) => Text::prefix("~", &args[0]),
        ir::Op::Binary(BinaryOp::Min | BinaryOp::Max | BinaryOp::Pow | BinaryOp::Atan2) => {
            Text::call(l.function_name(op), &all)
        }
        ir::Op::Binary(op) => print_infix(l, *op, kind(0), args),
        ir::Op::Unary(_) => Text::call(l.function_name(op), &all),
        ir::Op::Dot => Text::call("dot", &all),
        ir::Op::Cross => Text::call("cross", &all),
        ir::Op::Clamp => Text::call("clamp", &all),
        ir::Op::Select => l.scalar_select(expr.ty, &args[0], &args[1], &args[2]),
        ir::Op::Bitcast => l.bitcast(expr.ty, &args[0]),
        read => l.resource_read(read, args),
    }
}

fn print_infix(l: &dyn Language, op: BinaryOp, kind: Scalar, args: &[Text]) -> Text {
    let (spelled, binds) = spell_operator(l, op, kind);
    Text::infix(&args[0], spelled, &args[1], binds)
}

/// Returns the spelling of an operator for a kind of operands, and its precedence.
pub fn spell_operator(l: &dyn Language, op: BinaryOp, kind: Scalar) -> (&'static str, Binds) {
    use BinaryOp::{Add, And, Atan2, Div, Eq, Ge, Gt, Le, Lt, Max, Min, Mul, Ne, Or, Pow, Rem, Shl, Shr, Sub, Xor};
    match op {
        Add => ("+", Binds::Sum),
        Sub => ("-", Binds::Sum),
        Mul => ("*", Binds::Product),
        Div => ("/", Binds::Product),
        Rem => ("%", Binds::Product),
        Eq => ("==", Binds::Comparison),
        Ne => ("!=", Binds::Comparison),
        Lt => ("<", Binds::Comparison),
        Le => ("<=", Binds::Comparison),
        Gt => (">", Binds::Comparison),
        Ge => (">=", Binds::Comparison),
        Xor if kind == Scalar::Bool => ("!=", Binds::Comparison),
        And | Or => (l.logical_operator(op, kind), Binds::Mixed),
        Xor => ("^", Binds::Mixed),
        Shl => ("<<", Binds::Mixed),
        Shr => (">>", Binds::Mixed),
        Min | Max | Pow | Atan2 => unreachable!("these are functions"),
    }
}

/// Prints a constant scalar or vector of finite numbers; a value common to all components is written once.
fn print_constant(l: &dyn Language, ty: Ty, bits: &Bits) -> Text {
    let kind = ty.scalar_kind().unwrap_or(Scalar::F32);
    let lanes = &bits[..ty.component_count() as usize];
    let parts: Vec<Text> = lanes
        .iter()
        .map(|bits| l.scalar_literal(kind, ty.half, *bits))
        .collect();
    match &parts[..] {
        [one] => one.clone(),
        [first, rest @ ..] if rest.iter().all(|part| part == first) => l.splat(ty, first),
        _ => l.construct(ty, &parts.iter().collect::<Vec<_>>()),
    }
}

/// Returns a finite float with few digits that every parser reads as the same bits.
pub fn float_literal(bits: u32) -> Text {
    let x = f32::from_bits(bits);
    Text::literal(decimal_digits(x), x.is_sign_negative())
}

/// Returns an integer literal with a suffix.
pub fn integer_literal(n: i64, suffix: &str) -> Text {
    Text::literal(format!("{n}{suffix}"), n < 0)
}

/// Returns an unsigned literal, in hexadecimal if it is a mask of many bits.
pub fn unsigned_literal(bits: u32) -> Text {
    let run = bits.checked_shr(bits.trailing_zeros()).unwrap_or_default();
    let is_mask = bits > 0xffff && run.count_ones() > 1 && run & run.wrapping_add(1) == 0;
    match is_mask {
        true => Text::name(format!("{bits:#x}u")),
        false => integer_literal(i64::from(bits), "u"),
    }
}

/// Returns the WGSL function for an operation on numbers.
pub fn wgsl_function(op: &ir::Op) -> &'static str {
    use UnaryOp::*;
    match op {
        ir::Op::Binary(BinaryOp::Min) => "min",
        ir::Op::Binary(BinaryOp::Max) => "max",
        ir::Op::Binary(BinaryOp::Pow) => "pow",
        ir::Op::Binary(BinaryOp::Atan2) => "atan2",
        ir::Op::Unary(op) => match op {
            Abs => "abs",
            Sign => "sign",
            Floor => "floor",
            Ceil => "ceil",
            Round => "round",
            Trunc => "trunc",
            Fract => "fract",
            Saturate => "saturate",
            Sqrt => "sqrt",
            InverseSqrt => "inverseSqrt",
            Cbrt => "cube_root",
            Exp => "exp",
            Exp2 => "exp2",
            Log => "log",
            Log2 => "log2",
            Sin => "sin",
            Cos => "cos",
            Tan => "tan",
            Asin => "asin",
            Acos => "acos",
            Atan => "atan",
            Sinh => "sinh",
            Cosh => "cosh",
            Tanh => "tanh",
            CountOneBits => "countOneBits",
            ReverseBits => "reverseBits",
            LeadingZeros => "countLeadingZeros",
            TrailingZeros => "countTrailingZeros",
            Neg | Not | BitNot => unreachable!("these are operators"),
        },
        other => unreachable!("{other:?} is no function"),
    }
}
