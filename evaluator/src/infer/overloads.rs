//! Operators on structures and enums: the functions of their traits.

use super::Checker;
use super::types::Ty;
use crate::ir::{BinaryOp, UnaryOp};

/// The trait of an operator and its function.
pub fn trait_of(op: BinaryOp) -> Option<(&'static str, &'static str)> {
    Some(match op {
        BinaryOp::Add => ("Add", "add"),
        BinaryOp::Sub => ("Sub", "sub"),
        BinaryOp::Mul => ("Mul", "mul"),
        BinaryOp::Div => ("Div", "div"),
        BinaryOp::Rem => ("Rem", "rem"),
        BinaryOp::And => ("BitAnd", "bitand"),
        BinaryOp::Or => ("BitOr", "bitor"),
        BinaryOp::Xor => ("BitXor", "bitxor"),
        BinaryOp::Shl => ("Shl", "shl"),
        BinaryOp::Shr => ("Shr", "shr"),
        _ => return None,
    })
}

/// The operator whose function a path names, as a value: `f32::add`, `Add::add`. The type may be a trait.
pub fn operator_function(of: &str, name: &str) -> Option<BinaryOp> {
    const OPERATORS: [BinaryOp; 10] = [
        BinaryOp::Add,
        BinaryOp::Sub,
        BinaryOp::Mul,
        BinaryOp::Div,
        BinaryOp::Rem,
        BinaryOp::And,
        BinaryOp::Or,
        BinaryOp::Xor,
        BinaryOp::Shl,
        BinaryOp::Shr,
    ];
    let is_it =
        |op: &BinaryOp| trait_of(*op).is_some_and(|(own, function)| function == name && (own == of || is_number(of)));
    OPERATORS.into_iter().find(is_it)
}

/// Returns whether a type is a number, a vector or a matrix.
fn is_number(ty: &str) -> bool {
    crate::front::is_prelude_type(ty) && !crate::front::is_resource(ty)
}

impl Checker<'_> {
    /// Returns the type of the result of an operator's trait for two types; `None` if neither is a structure or an enum with that trait.
    pub fn operator_of(&mut self, (of, name): (&str, &str), left: &Ty, right: &Ty) -> Option<Ty> {
        let own = |ty: Ty| matches!(ty, Ty::Struct(..) | Ty::Enum(..));
        if !own(self.peel_refs(left).0) && !own(self.peel_refs(right).0) {
            return None;
        }
        let library = self.library;
        let keys = library.trait_keys(&self.type_name(&self.peel_refs(left).0)?, of, name);
        for key in keys {
            let function = &library.functions[key];
            let [own, other] = function.params.as_slice() else {
                continue;
            };
            let (table, errors) = (self.table.clone(), self.errors.len());
            let given = self.instantiate_function(function, &[]);
            let of_own = self.substitute_type(&own.ty, &given, own.span);
            let of_other = self.substitute_type(&other.ty, &given, other.span);
            let is_place = function.params[0].ty.is_mutable_reference();
            let taken = match is_place {
                true => self.peel_refs(left).0,
                false => left.clone(),
            };
            let of_own = if is_place { self.peel_refs(&of_own).0 } else { of_own };
            if self.table.unify(&of_own, &taken) && self.table.unify(&of_other, right) {
                return Some(self.substitute_type(&function.result, &given, own.span));
            }
            self.table = table;
            self.errors.truncate(errors);
        }
        None
    }

    /// Returns the type of `-` or `!` before a structure or an enum.
    pub fn unary_of(&mut self, op: UnaryOp, operand: &Ty) -> Option<Ty> {
        let (of, name) = match op {
            UnaryOp::Neg => ("Neg", "neg"),
            _ => ("Not", "not"),
        };
        let library = self.library;
        let (Ty::Struct(ty, _) | Ty::Enum(ty, _)) = self.table.resolve_shallow(operand) else {
            return None;
        };
        let keys = library.trait_keys(&ty, of, name);
        let (_, function) = self.select_overload(&keys, std::slice::from_ref(operand))?;
        let given = self.instantiate_function(function, &[]);
        let own = self.substitute_type(&function.params.first()?.ty, &given, function.span);
        self.table.unify(&own, operand);
        Some(self.substitute_type(&function.result, &given, function.span))
    }

    /// Returns the type of an indexed structure.
    pub fn infer_indexed(&mut self, base: &Ty, index: &Ty) -> Option<Ty> {
        let Ty::Struct(ty, _) = base else { return None };
        let library = self.library;
        let keys = library.trait_keys(ty, "Index", "index");
        let (key, function) = self.select_overload(&keys, &[base.clone(), index.clone()])?;
        let _ = key;
        let given = self.instantiate_function(function, &[]);
        for (param, found) in function.params.iter().zip([base, index]) {
            let wanted = self.substitute_type(&param.ty, &given, param.span);
            self.fits_parameter(&wanted, found);
        }
        let result = self.substitute_type(&function.result, &given, function.span);
        Some(match self.table.resolve_shallow(&result) {
            Ty::Ref(_, inner) => *inner,
            other => other,
        })
    }
}
