//! Values of a test that are written out in it: names of files, sizes, tolerances and samplers.

use super::arguments::number_of;
use crate::diagnostic::Span;
use crate::front::token_span;
use crate::interp::{Address, SamplerState};
use proc_macro2::Ident;
use straightline_kernels::pictures::Likeness;
use syn::spanned::Spanned;

/// Name of the function that is called.
pub fn called(call: &syn::ExprCall) -> Option<&Ident> {
    match &*call.func {
        syn::Expr::Path(path) => Some(&path.path.segments.last()?.ident),
        _ => None,
    }
}

/// A text literal with its place.
pub fn text_of(file: u32, expr: &syn::Expr) -> Option<(String, Span)> {
    match expr {
        syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Str(text),
            ..
        }) => Some((text.value(), token_span(file, expr.span()))),
        _ => None,
    }
}

/// The numbers of `uvec2(64, 36)`, or of a variable with these.
pub fn size_of(function: &syn::ItemFn, expr: &syn::Expr) -> Option<[u32; 2]> {
    if let syn::Expr::Path(path) = expr {
        let name = path.path.get_ident()?;
        let values = function.block.stmts.iter().filter_map(|statement| match statement {
            syn::Stmt::Local(local) if matches!(&local.pat, syn::Pat::Ident(own) if own.ident == *name) => {
                Some(&*local.init.as_ref()?.expr)
            }
            _ => None,
        });
        let values: Vec<&syn::Expr> = values.collect();
        return match values[..] {
            [value @ syn::Expr::Call(_)] => size_of(function, value),
            _ => None,
        };
    }
    let syn::Expr::Call(call) = expr else { return None };
    if !matches!(&*call.func, syn::Expr::Path(path) if path.path.segments.last()?.ident == "uvec2" || is_new(path)) {
        return None;
    }
    let numbers = call
        .args
        .iter()
        .map(|arg| Some(number_of(arg)?).filter(|n| (0.0..=65536.0).contains(n)));
    let numbers: Vec<u32> = numbers.map(|n| n.map(|n| n as u32)).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// Returns whether a path is `UVec2::new`.
fn is_new(path: &syn::ExprPath) -> bool {
    let words: Vec<String> = path
        .path
        .segments
        .iter()
        .map(|segment| segment.ident.to_string())
        .collect();
    matches!(&words[..], [.., of, new] if of == "UVec2" && new == "new")
}

/// The tolerance of `psnr(50.0)`, `absolute(0.01)` or `exactly()`.
pub fn likeness_of(expr: &syn::Expr) -> Option<Likeness> {
    let syn::Expr::Call(call) = expr else { return None };
    let number = || {
        let number = match call.args.first()? {
            syn::Expr::Binary(syn::ExprBinary {
                left,
                op: syn::BinOp::Div(_),
                right,
                ..
            }) => number_of(left)? as f32 / number_of(right)? as f32,
            one => number_of(one)? as f32,
        };
        Some(number).filter(|number| number.is_finite() && *number >= 0.0 && call.args.len() == 1)
    };
    match called(call)?.to_string().as_str() {
        "exactly" if call.args.is_empty() => Some(Likeness::Exact),
        "absolute" => number().map(Likeness::Absolute),
        "psnr" => number().map(Likeness::Psnr),
        _ => None,
    }
}

/// The state of `Sampler::default()` or of a structure with fields that are written out.
pub fn sampler_of(expr: &syn::Expr) -> Option<SamplerState> {
    let last = |expr: &syn::Expr| match expr {
        syn::Expr::Path(path) => Some(path.path.segments.last()?.ident.to_string()),
        _ => None,
    };
    match expr {
        syn::Expr::Call(call) => {
            let is_default = call.args.is_empty() && last(&call.func)? == "default";
            is_default.then(SamplerState::default)
        }
        syn::Expr::Struct(structure) => {
            let mut state = match &structure.rest {
                Some(rest) => sampler_of(rest)?,
                None => SamplerState::default(),
            };
            for field in &structure.fields {
                let syn::Member::Named(name) = &field.member else {
                    return None;
                };
                let value = last(&field.expr)?;
                let linear = match value.as_str() {
                    "Linear" => Some(true),
                    "Nearest" => Some(false),
                    _ => None,
                };
                match name.to_string().as_str() {
                    "filter" => state.linear = linear?,
                    "mip" => state.linear_mip = linear?,
                    "address" => {
                        state.address = match value.as_str() {
                            "Clamp" => Address::Clamp,
                            "Repeat" => Address::Repeat,
                            "Mirror" => Address::Mirror,
                            _ => return None,
                        }
                    }
                    _ => return None,
                }
            }
            Some(state)
        }
        _ => None,
    }
}
