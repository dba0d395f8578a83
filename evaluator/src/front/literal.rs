//! Literals.

use super::expr::Lower;
use super::tree::{Expr, ExprKind, IntType};

impl Lower {
    /// A literal.
    pub fn lower_literal(&mut self, lit: &syn::Lit, span: proc_macro2::Span) -> Expr {
        let kind = match lit {
            syn::Lit::Int(lit) if matches!(lit.suffix(), "f32") => self.lower_float(lit.base10_digits(), true, span),
            syn::Lit::Int(lit) => {
                let ty = match lit.suffix() {
                    "" => None,
                    suffix => {
                        let known = IntType::from_name(suffix);
                        if known.is_none() {
                            let what = format!("the integer type `{suffix}`");
                            self.note_unsupported(span, &what, "use i32, u32 or usize");
                        }
                        known
                    }
                };
                // In a pattern the sign belongs to the literal.
                match lit.base10_parse::<i64>() {
                    Ok(value) if (i64::from(i32::MIN)..=i64::from(u32::MAX)).contains(&value) => {
                        ExprKind::Int(value, ty)
                    }
                    _ => {
                        self.note_unsupported(span, "an integer of more than 32 bits", "shaders have 32-bit integers");
                        ExprKind::Int(0, ty)
                    }
                }
            }
            syn::Lit::Float(lit) if matches!(lit.suffix(), "" | "f32") => {
                self.lower_float(lit.base10_digits(), !lit.suffix().is_empty(), span)
            }
            syn::Lit::Float(lit) => {
                self.note_unsupported(span, &format!("the type `{}`", lit.suffix()), "use f32");
                ExprKind::Float(0.0, true)
            }
            syn::Lit::Byte(lit) => ExprKind::Int(lit.value().into(), Some(IntType::U8)),
            syn::Lit::Bool(lit) => ExprKind::Bool(lit.value),
            syn::Lit::Str(lit) => ExprKind::Str(lit.value()),
            _ => {
                self.note_unsupported(span, "this literal", "use numbers and booleans");
                ExprKind::Tuple(Vec::new())
            }
        };
        Expr {
            kind,
            span: self.token_span(span),
        }
    }

    fn lower_float(&mut self, digits: &str, suffixed: bool, span: proc_macro2::Span) -> ExprKind {
        match digits.parse::<f32>() {
            Ok(value) if value.is_finite() => ExprKind::Float(value, suffixed),
            _ => {
                self.note_unsupported(span, "a number beyond the range of f32", "keep it below 3.4e38");
                ExprKind::Float(0.0, true)
            }
        }
    }
}
