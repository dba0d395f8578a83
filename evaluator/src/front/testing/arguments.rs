//! Arguments of a property: the parameters of the closure of `for_all`, and their ranges.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::cfg::as_written;
use crate::front::token_span;
use straightline_kernels::properties::{Argument, Component, Range};
use syn::spanned::Spanned;

/// Types of arguments, with their components.
const TYPES: [(&str, Component, usize); 13] = [
    ("f32", Component::F32, 1),
    ("i32", Component::I32, 1),
    ("u32", Component::U32, 1),
    ("bool", Component::Bool, 1),
    ("Vec2", Component::F32, 2),
    ("Vec3", Component::F32, 3),
    ("Vec4", Component::F32, 4),
    ("IVec2", Component::I32, 2),
    ("IVec3", Component::I32, 3),
    ("IVec4", Component::I32, 4),
    ("UVec2", Component::U32, 2),
    ("UVec3", Component::U32, 3),
    ("UVec4", Component::U32, 4),
];

/// Longest array that is an argument.
const LONGEST: usize = 64;

/// Returns the arguments of a closure, with the ranges of `for_all_in`.
pub fn read_arguments(
    file: u32,
    closure: &syn::ExprClosure,
    ranges: Option<&syn::Expr>,
) -> Result<Vec<(String, Argument)>, Box<Diagnostic>> {
    let mut arguments = Vec::new();
    for (k, input) in closure.inputs.iter().enumerate() {
        let syn::Pat::Type(typed) = input else {
            let help = format!("write its type: `|{}: f32|`", as_written(input));
            return Err(unsupported(
                file,
                input,
                "an argument of a property without a type",
                &help,
            ));
        };
        let Some(argument) = argument_of(&typed.ty) else {
            return Err(unsupported(
                file,
                &typed.ty,
                &format!("an argument of the type `{}`", as_written(&typed.ty)),
                "take f32, i32, u32, bool, a vector of floats or integers, or an array of these, such as `[f32; 4]`",
            ));
        };
        let name = match &*typed.pat {
            syn::Pat::Ident(name) => name.ident.to_string(),
            _ => format!("argument_{k}"),
        };
        arguments.push((name, argument));
    }
    if arguments.is_empty() || arguments.len() > 6 {
        let what = format!("a property of {} arguments", arguments.len());
        return Err(unsupported(
            file,
            closure,
            &what,
            "take 1 to 6; vectors and arrays count as one",
        ));
    }
    let Some(ranges) = ranges else { return Ok(arguments) };
    let given: Vec<&syn::Expr> = match ranges {
        syn::Expr::Tuple(tuple) => tuple.elems.iter().collect(),
        one => vec![one],
    };
    if given.len() != arguments.len() {
        let what = format!("{} ranges for {} arguments", given.len(), arguments.len());
        return Err(unsupported(
            file,
            ranges,
            &what,
            "write one range an argument; `any()` is every value",
        ));
    }
    for ((_, argument), range) in arguments.iter_mut().zip(given) {
        argument.range = range_of(range).ok_or_else(|| {
            let what = "a range that is not written out";
            unsupported(
                file,
                range,
                what,
                "write `0.0..=1.0` of numbers, `unit()`, `any()` or `every_float()`",
            )
        })?;
        if let Some(error) = argument.range_error() {
            let what = "a range that the argument cannot have";
            return Err(unsupported(
                file,
                range,
                what,
                &format!("{error}: write another range, or `any()`"),
            ));
        }
    }
    Ok(arguments)
}

fn argument_of(ty: &syn::Type) -> Option<Argument> {
    match ty {
        syn::Type::Path(path) => {
            let name = path.path.segments.last()?.ident.to_string();
            let (_, component, width) = TYPES.iter().find(|(known, ..)| *known == name)?;
            Some(Argument::new(*component, *width))
        }
        syn::Type::Array(array) => {
            let of = argument_of(&array.elem)?;
            let syn::Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Int(len),
                ..
            }) = &array.len
            else {
                return None;
            };
            let len = len.base10_parse::<usize>().ok().filter(|n| (1..=LONGEST).contains(n))?;
            let plain = of.elements.is_none() && of.component != Component::Bool;
            plain.then_some(Argument {
                elements: Some(len),
                ..of
            })
        }
        _ => None,
    }
}

fn range_of(range: &syn::Expr) -> Option<Range> {
    match range {
        syn::Expr::Range(range) => Some(Range::Between {
            low: number_of(range.start.as_deref()?)?,
            high: number_of(range.end.as_deref()?)?,
            closed: matches!(range.limits, syn::RangeLimits::Closed(_)),
        }),
        syn::Expr::Call(call) if call.args.is_empty() => {
            let syn::Expr::Path(path) = &*call.func else {
                return None;
            };
            match path.path.segments.last()?.ident.to_string().as_str() {
                "any" => Some(Range::Any),
                "every_float" => Some(Range::EveryFloat),
                "unit" => Some(Range::Between {
                    low: 0.0,
                    high: 1.0,
                    closed: true,
                }),
                _ => None,
            }
        }
        _ => None,
    }
}

/// The number of a literal, as an `f32` has it if it is a float.
pub fn number_of(expr: &syn::Expr) -> Option<f64> {
    match expr {
        syn::Expr::Lit(literal) => match &literal.lit {
            syn::Lit::Float(number) => number.base10_parse::<f32>().ok().map(f64::from),
            syn::Lit::Int(number) if number.suffix() == "f32" => number.base10_parse::<f32>().ok().map(f64::from),
            syn::Lit::Int(number) => number.base10_parse::<i64>().ok().map(|n| n as f64),
            _ => None,
        },
        syn::Expr::Unary(syn::ExprUnary {
            op: syn::UnOp::Neg(_),
            expr,
            ..
        }) => number_of(expr).map(|n| -n),
        syn::Expr::Paren(inner) => number_of(&inner.expr),
        _ => None,
    }
}

/// An error about a test that no kernel can be made of.
pub fn unsupported(file: u32, at: &impl Spanned, what: &str, help: &str) -> Box<Diagnostic> {
    let error = Diagnostic::error_at(Code::NotInLanguage, token_span(file, at.span()), what)
        .label("not supported in a test that runs as a shader")
        .help(help);
    Box::new(error)
}
