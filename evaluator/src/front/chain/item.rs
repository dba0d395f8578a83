//! Passes as kernels.

use super::rule::{as_rust, inputs_of};
use super::signature::{ParamKind, param_kind, param_name};
use super::state::Let;
use super::syntax::identifier;
use super::value::Value;
use super::{Source, signature};
use crate::front::{raw_name, unraw};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote, quote_spanned};
use std::collections::{BTreeMap, BTreeSet};

/// The parameter of a kernel for its pixel.
const PIXEL: &str = "pixel";

/// A kernel that takes the options of a chain, and whose result does not matter.
pub fn options_only(chain: &syn::ItemFn) -> syn::ItemFn {
    let options = chain
        .sig
        .inputs
        .iter()
        .filter(|input| param_name(input).is_some_and(|(_, ty)| param_kind(ty) == ParamKind::Options));
    let name = &chain.sig.ident;
    let pixel = Ident::new(PIXEL, name.span());
    let tokens = quote_spanned!(name.span()=> pub fn #name(#(#options,)* #pixel: IVec2) -> Vec4 { Vec4::ZERO });
    syn::parse2(tokens).expect("a function of parsed parameters")
}

/// Parts of a pass.
pub struct PassParts<'a> {
    /// Name of the kernel.
    pub entry: Ident,
    /// Pattern of the closure's parameter.
    pub pixel: syn::Pat,
    /// Body of the closure.
    pub body: TokenStream,
    /// Type of a texel.
    pub texel: TokenStream,
    /// Values by the names that the body has for them.
    pub values: BTreeMap<String, Value>,
    /// All `let`s of values that passes compute for themselves.
    pub lets: &'a [Let],
    /// Parameters of the chain, by name.
    pub params: &'a BTreeMap<String, syn::FnArg>,
}

/// A pass as a kernel.
pub struct Made {
    /// The kernel.
    pub kernel: syn::ItemFn,
    /// Parameters that are resources, with what each reads.
    pub reads: Vec<(String, Source)>,
    /// `true` if it takes the options.
    pub has_options: bool,
}

/// A name that would stand for two values in a pass.
pub struct TwoValues(pub String);

/// Makes the kernel of a pass.
///
/// # Errors
///
/// A name of which the pass would need two values.
pub fn make_kernel(parts: PassParts<'_>) -> Result<Made, TwoValues> {
    let at = parts.entry.span();
    let mut values = parts.values;
    let lets = add_needed(&mut values, parts.lets)?;
    let (mut params, mut consts, mut reads) = (Vec::new(), Vec::new(), Vec::new());
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let mut has_options = false;
    let mut sizes: Vec<(String, TokenStream)> = Vec::new();
    for (name, value) in &values {
        let ident = identifier(name, at);
        match value {
            Value::Image(image) => {
                let ty = &image.ty.ty;
                params.push(quote_spanned!(at=> #ident: &#ty));
                reads.push((unraw(name).to_owned(), image.source.clone()));
                taken.insert(name.clone());
            }
            Value::Param(outer) | Value::Options(outer) => {
                let Some((_, ty)) = parts.params.get(outer).and_then(param_name) else {
                    continue;
                };
                if param_kind(ty) == ParamKind::Resource {
                    params.push(quote_spanned!(at=> #ident: #ty));
                    reads.push((unraw(name).to_owned(), Source::Input(outer.clone())));
                    taken.insert(name.clone());
                    continue;
                }
                has_options |= param_kind(ty) == ParamKind::Options;
                if taken.insert(outer.clone()) {
                    let outer = identifier(&raw_name(outer), at);
                    params.push(quote_spanned!(at=> #outer: #ty));
                }
                if unraw(name) != outer {
                    let outer = identifier(&raw_name(outer), at);
                    consts.push(quote_spanned!(at=> let #ident = #outer;));
                }
            }
            Value::Integer(number) => {
                let literal = Literal::i64_unsuffixed(number.abs());
                let sign = (*number < 0).then(|| quote!(-));
                consts.push(quote_spanned!(at=> let #ident = #sign #literal;));
            }
            Value::Flag(flag) => consts.push(quote_spanned!(at=> let #ident = #flag;)),
            Value::Size(rule) => sizes.push((name.clone(), rule_tokens(rule))),
            Value::Side(rule, axis) => {
                let (rule, axis) = (rule_tokens(rule), Ident::new(["x", "y"][*axis], at));
                sizes.push((name.clone(), quote_spanned!(at=> (#rule).#axis)));
            }
            _ => {}
        }
        if let Value::Size(rule) | Value::Side(rule, _) = value {
            for input in inputs_of(rule) {
                if let (true, Some(param)) = (!values.contains_key(&*raw_name(input)), parts.params.get(input))
                    && taken.insert(input.to_owned())
                {
                    params.push(param.to_token_stream());
                    reads.push((input.to_owned(), Source::Input(input.to_owned())));
                }
            }
        }
    }
    for (name, tokens) in sizes {
        let ident = identifier(&name, at);
        consts.push(quote_spanned!(at=> let #ident = #tokens;));
    }
    let pixel = Ident::new(PIXEL, at);
    let pattern = parts.pixel.to_token_stream();
    let renamed = (pattern.to_string() != PIXEL).then(|| quote_spanned!(at=> let #pattern = #pixel;));
    let (entry, texel, body) = (&parts.entry, &parts.texel, &parts.body);
    let lets = lets.iter().map(|each| &each.captured.tokens);
    let tokens = quote_spanned! {at=>
        pub fn #entry(#(#params,)* #pixel: IVec2) -> #texel { #(#consts)* #(#lets)* #renamed #body }
    };
    Ok(Made {
        kernel: syn::parse2(tokens).expect("a function of parsed parts"),
        reads,
        has_options,
    })
}

/// Adds what the `let`s need that a pass mentions, and returns these in order.
fn add_needed<'a>(values: &mut BTreeMap<String, Value>, lets: &'a [Let]) -> Result<Vec<&'a Let>, TwoValues> {
    let mut needed = BTreeSet::new();
    let mut pending: Vec<usize> = values.values().filter_map(later).collect();
    while let Some(index) = pending.pop() {
        if !needed.insert(index) {
            continue;
        }
        for (name, value) in &lets[index].captured.values {
            match values.get(name) {
                Some(known) if is_same(known, value) => {}
                // A `let` may shadow a variable that an earlier one reads.
                Some(known) if later(known).is_some() && later(value).is_some() => {}
                Some(_) => return Err(TwoValues(name.clone())),
                None => {
                    values.insert(name.clone(), value.clone());
                }
            }
            pending.extend(later(value));
        }
    }
    Ok(needed.into_iter().map(|index| &lets[index]).collect())
}

fn later(value: &Value) -> Option<usize> {
    match value {
        Value::Later(index) => Some(*index),
        _ => None,
    }
}

fn is_same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Image(a), Value::Image(b)) => a.source == b.source,
        (Value::Integer(a), Value::Integer(b)) => a == b,
        (Value::Flag(a), Value::Flag(b)) => a == b,
        (Value::Size(a), Value::Size(b)) => a == b,
        (Value::Side(a, i), Value::Side(b, j)) => a == b && i == j,
        (Value::Param(a), Value::Param(b)) | (Value::Options(a), Value::Options(b)) => a == b,
        (Value::Later(a), Value::Later(b)) => a == b,
        _ => false,
    }
}

fn rule_tokens(rule: &straightline_manifest::chain::SizeRule) -> TokenStream {
    as_rust(rule).parse().expect("Rust")
}

/// Tokens that tell kernels apart: all but the name.
pub fn text_without_name(kernel: &syn::ItemFn) -> String {
    let mut kernel = kernel.clone();
    kernel.sig.ident = Ident::new("pass", Span::call_site());
    kernel.to_token_stream().to_string()
}

/// Parameters of a chain by name, without marks of raw identifiers.
pub fn params_by_name(chain: &syn::Signature) -> BTreeMap<String, syn::FnArg> {
    let named = |input: &syn::FnArg| {
        signature::param_name(input).map(|(name, _)| (unraw(&name.to_string()).to_owned(), input.clone()))
    };
    chain.inputs.iter().filter_map(named).collect()
}
