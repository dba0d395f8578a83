//! Patterns, types and paths.

use super::Check;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

impl Check {
    /// A pattern. Those that have no meaning in a kernel are refused by the lowering.
    pub fn check_pattern(&mut self, pattern: &mut syn::Pat) {
        use syn::Pat as P;
        if let Some(attrs) = pattern_attributes(pattern) {
            let mut taken = std::mem::take(attrs);
            self.lower.keeps_always(&mut taken, super::Carrier::Other);
        }
        match pattern {
            P::Lit(_) | P::Wild(_) => {}
            P::Ident(p) => p.subpat.iter_mut().for_each(|(_, p)| self.check_pattern(p)),
            P::Guard(p) => {
                self.check_pattern(&mut p.pat);
                self.check_expr(&mut p.guard);
            }
            P::Or(p) => p.cases.iter_mut().for_each(|p| self.check_pattern(p)),
            P::Paren(p) => self.check_pattern(&mut p.pat),
            P::Path(p) => {
                if let Some(qself) = &p.qself {
                    self.refuse(qself.span(), "a type in `<>`", "name the constant by its path");
                }
                self.check_path(&mut p.path, false);
            }
            P::Range(p) => [&mut p.start, &mut p.end]
                .into_iter()
                .flatten()
                .for_each(|end| self.check_expr(end)),
            P::Reference(p) => self.check_pattern(&mut p.pat),
            P::Slice(p) => p.elems.iter_mut().for_each(|p| self.check_pattern(p)),
            P::Tuple(p) => p.elems.iter_mut().for_each(|p| self.check_pattern(p)),
            P::Struct(p) => {
                if let Some(qself) = &p.qself {
                    self.refuse(qself.span(), "a type in `<>`", "name the structure alone");
                }
                self.check_path(&mut p.path, false);
                let mut kept = Punctuated::new();
                for mut field in std::mem::take(&mut p.fields) {
                    if self.keeps(&mut field.attrs) {
                        self.check_pattern(&mut field.pat);
                        kept.push(field);
                    }
                }
                p.fields = kept;
            }
            P::TupleStruct(p) => {
                if let Some(qself) = &p.qself {
                    self.refuse(qself.span(), "a type in `<>`", "name the structure alone");
                }
                self.check_path(&mut p.path, false);
                p.elems.iter_mut().for_each(|p| self.check_pattern(p));
            }
            // The lowering refuses these.
            P::Const(_) | P::Macro(_) | P::Rest(_) | P::Type(_) | P::Verbatim(_) => {}
            // And whatever else syn may come to know.
            _ => {}
        }
    }

    /// A type. Those that have no meaning in a kernel are refused by the lowering.
    pub fn check_type(&mut self, ty: &mut syn::Type) {
        use syn::Type as T;
        match ty {
            T::Array(t) => {
                self.check_type(&mut t.elem);
                self.check_expr(&mut t.len);
            }
            T::Group(t) => self.check_type(&mut t.elem),
            T::Paren(t) => self.check_type(&mut t.elem),
            T::Reference(t) => self.check_type(&mut t.elem),
            T::Slice(t) => self.check_type(&mut t.elem),
            T::Tuple(t) => t.elems.iter_mut().for_each(|t| self.check_type(t)),
            T::FnPtr(t) => {
                t.inputs.iter_mut().for_each(|input| self.check_type(&mut input.ty));
                if let syn::ReturnType::Type(_, ty) = &mut t.output {
                    self.check_type(ty);
                }
            }
            T::Path(t) if t.qself.is_none() => {
                self.check_number_type(&t.path);
                self.check_path(&mut t.path, true);
            }
            // The lowering refuses these.
            T::ImplTrait(_)
            | T::Infer(_)
            | T::Macro(_)
            | T::Never(_)
            | T::Path(_)
            | T::Ptr(_)
            | T::TraitObject(_)
            | T::Verbatim(_) => {}
            // And whatever else syn may come to know.
            _ => {}
        }
    }

    /// Refuses types of numbers that shaders do not have, where a value is said to be of one. Conversions to them are refused
    /// where they are evaluated.
    fn check_number_type(&mut self, path: &syn::Path) {
        let Some(name) = path.segments.last().map(|s| s.ident.to_string()) else {
            return;
        };
        let instead = match name.as_str() {
            "f16" | "f64" | "f128" => "use f32",
            "i64" | "i128" => "use i32",
            "u64" | "u128" => "use u32",
            _ => return,
        };
        self.refuse(path.span(), &format!("the type `{name}`"), instead);
    }

    /// A path, of which the last two segments count; `last` tells whether the last may have generic arguments. A type may.
    pub fn check_path(&mut self, path: &mut syn::Path, last: bool) {
        let count = path.segments.len();
        let name = path.segments.last().map(|last| last.ident.to_string());
        let is_constant = name.is_some_and(|name| !name.contains(char::is_lowercase));
        for (k, segment) in path.segments.iter_mut().enumerate() {
            let list = match &mut segment.arguments {
                syn::PathArguments::None => continue,
                syn::PathArguments::AngleBracketed(list) => list,
                syn::PathArguments::Parenthesized(list) => {
                    let span = list.span();
                    self.refuse(span, "a type of functions", "write a function and call it by its name");
                    continue;
                }
            };
            let of_type = segment.ident.to_string().starts_with(char::is_uppercase);
            // A structure without fields is a value: `Window::<3>`, and a constant: `Window::<3>::SIZE`.
            let is_value = of_type && (k + 1 == count || is_constant && k + 2 == count);
            if !(last || is_value) || k + 2 < count || (k + 1 < count && !of_type) {
                let shown = super::super::cfg::as_written(list);
                let shown = shown.trim_start_matches("::").to_owned();
                let span = list.span();
                self.refuse(
                    span,
                    &format!("`{shown}` here"),
                    "leave it out; a function that is called takes constants after its own name: `power::<3>(x)`",
                );
                continue;
            }
            self.generic_arguments(list);
        }
    }

    /// Arguments in `<>`: types and constants.
    pub fn generic_arguments(&mut self, list: &mut syn::AngleBracketedGenericArguments) {
        for argument in &mut list.args {
            match argument {
                syn::GenericArgument::Lifetime(_) => {}
                syn::GenericArgument::Type(ty) => self.check_type(ty),
                syn::GenericArgument::Const(value) => self.check_expr(value),
                other => {
                    let span = other.span();
                    self.refuse(span, "this generic argument", "give types and constants alone");
                }
            }
        }
    }
}

fn pattern_attributes(pattern: &mut syn::Pat) -> Option<&mut Vec<syn::Attribute>> {
    macro_rules! each {
        ($($variant:ident)*) => {
            match pattern {
                $(syn::Pat::$variant(p) => Some(&mut p.attrs),)*
                _ => None,
            }
        };
    }
    each!(
        Const Guard Ident Lit Macro Or Paren Path Range Reference Rest Slice Struct Tuple TupleStruct Type Wild
    )
}
