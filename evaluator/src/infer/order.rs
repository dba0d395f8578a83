//! Methods of `Ord` and `PartialOrd` of structures, enums, tuples, arrays and booleans.

use super::Checker;
use super::types::Ty;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Expr;

impl<'l> Checker<'l> {
    /// The type of `receiver.max(other)` and its like; `None` for other methods, and for types that have these of their own.
    pub fn infer_order_method(&mut self, receiver: &Ty, name: &str, args: &'l [Expr], span: Span) -> Option<Ty> {
        let (bare, reference) = self.peel_refs(receiver);
        let compares = matches!(name, "cmp" | "partial_cmp");
        let whole = match &bare {
            Ty::Struct(..) | Ty::Enum(..) | Ty::Tuple(_) | Ty::Array(_) => true,
            Ty::Bool => compares,
            _ => false,
        };
        let wanted = match name {
            "max" | "min" | "cmp" | "partial_cmp" => 1,
            "clamp" => 2,
            _ => return None,
        };
        if !whole || args.len() != wanted {
            return None;
        }
        self.check_order(&bare, if name == "partial_cmp" { "PartialOrd" } else { "Ord" }, span);
        if compares {
            let ordering = Ty::Enum("Ordering".to_owned(), Vec::new());
            let result = match name {
                "cmp" => ordering,
                _ => Ty::Enum("Option".to_owned(), vec![ordering]),
            };
            return Some(self.check_arguments(args, &[bare.into_shared_ref()], result));
        }
        // rustc finds `Ord` of a reference before that of its referent.
        let own = if reference.is_some() { receiver.clone() } else { bare };
        Some(self.check_arguments(args, &vec![own.clone(); wanted], own))
    }

    /// The type of `std::cmp::max(a, b)`.
    pub fn infer_larger(&mut self, a: &'l Expr, b: &'l Expr, span: Span) -> Ty {
        let ty = self.infer_expr(a, None);
        self.check_expr(b, &ty);
        let bare = self.peel_refs(&ty).0;
        let bare = self.table.resolve_deep(&bare);
        self.check_order(&bare, "Ord", span);
        ty
    }

    fn check_order(&mut self, ty: &Ty, of: &str, span: Span) {
        let Some(lacking) = self.lacks_trait(ty, of) else {
            return;
        };
        let message = format!("the trait bound `{lacking}: {of}` is not satisfied");
        let error = Diagnostic::error_at(Code::TraitBound, span, message)
            .label(format!("`{of}` is not implemented for `{lacking}`"));
        let help = match (lacking.as_str(), of) {
            ("f32", "Ord") => "compare floats with `<`, or with `total_cmp`".to_owned(),
            (name, "Ord") => format!("write `#[derive(PartialEq, Eq, PartialOrd, Ord)]` before `{name}`, or an `impl`"),
            (name, _) => format!("write `#[derive(PartialEq, PartialOrd)]` before `{name}`, or an `impl`"),
        };
        self.errors.push(error.help(help));
    }
}
