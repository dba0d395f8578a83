//! Assertions in a file's tokens, each replaced by a call that records it.

use super::{RECORD, Recorded, VALUE_NAMES};
use crate::diagnostic::Span;
use crate::front::cfg::as_written;
use crate::front::token_span;
use proc_macro2::{Delimiter, Group, Ident, Literal, TokenStream, TokenTree};
use quote::{ToTokens, quote_spanned};
use syn::parse::Parser;
use syn::punctuated::Punctuated;

/// Kind of an assertion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteKind {
    /// `assert!` of a condition without values.
    Condition,
    /// `assert!` of a comparison.
    Comparison,
    /// `assert!` of a method of a value.
    Property,
    /// `assert_eq!`.
    Equal,
    /// `assert_ne!`.
    NotEqual,
    /// `assert_close`.
    Close,
    /// `assume`, which passes over the case.
    Assume,
}

/// An assertion in a file.
#[derive(Clone, Debug)]
pub struct Site {
    /// The assertion as a whole.
    pub span: Span,
    /// Kind of the assertion.
    pub kind: SiteKind,
    /// Texts of its values, left and right; empty if there are none.
    pub values: [String; 2],
    /// Text of the tolerance of `assert_close`.
    pub tolerance: String,
}

/// Replaces the assertions in tokens and numbers them in order. `cfg(test)` becomes `cfg(true)`.
pub fn rewrite_tokens(file: u32, tokens: TokenStream, sites: &mut Vec<Site>) -> TokenStream {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut out: Vec<TokenTree> = Vec::with_capacity(tokens.len());
    let mut k = 0;
    while k < tokens.len() {
        if let TokenTree::Ident(name) = &tokens[k]
            && let Some((group, length)) = arguments_of(&tokens[k..], k.checked_sub(1).map(|before| &tokens[before]))
            && sites.len() < Recorded::MOST_SITES as usize
        {
            let inside = rewrite_tokens(file, group.stream(), sites);
            match record_call(file, name, group, inside.clone(), sites) {
                Some(call) => {
                    let mut block = Group::new(Delimiter::Brace, call);
                    block.set_span(name.span());
                    out.push(TokenTree::Group(block));
                }
                None => {
                    out.extend_from_slice(&tokens[k..k + length - 1]);
                    out.push(with_stream(group, inside));
                }
            }
            k += length;
            continue;
        }
        out.push(match &tokens[k] {
            TokenTree::Group(group) if is_cfg(group, out.last()) => with_stream(group, test_as_true(group.stream())),
            TokenTree::Group(group) => with_stream(group, rewrite_tokens(file, group.stream(), sites)),
            other => other.clone(),
        });
        k += 1;
    }
    out.into_iter().collect()
}

/// The arguments of an assertion that begins with these tokens, and the number of its tokens.
fn arguments_of<'t>(tokens: &'t [TokenTree], before: Option<&TokenTree>) -> Option<(&'t Group, usize)> {
    let [TokenTree::Ident(name), rest @ ..] = tokens else {
        return None;
    };
    let name = name.to_string();
    let is_macro = ["assert", "assert_eq", "assert_ne"].contains(&name.strip_prefix("debug_").unwrap_or(&name));
    match (before, rest) {
        (_, [TokenTree::Punct(mark), TokenTree::Group(group), ..]) if is_macro && mark.as_char() == '!' => {
            Some((group, 3))
        }
        (Some(TokenTree::Punct(mark)), _) if ".:".contains(mark.as_char()) => None,
        (Some(TokenTree::Ident(word)), _) if word == "fn" => None,
        (_, [TokenTree::Group(group), ..])
            if ["assert_close", "assume"].contains(&name.as_str()) && group.delimiter() == Delimiter::Parenthesis =>
        {
            Some((group, 2))
        }
        _ => None,
    }
}

/// The statements that record an assertion with these arguments; `None` if it has others than it takes.
fn record_call(
    file: u32,
    name: &Ident,
    group: &Group,
    arguments: TokenStream,
    sites: &mut Vec<Site>,
) -> Option<TokenStream> {
    let at = name.span();
    let parser = Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated;
    let arguments: Vec<syn::Expr> = parser.parse2(arguments).ok()?.into_iter().collect();
    let called = name.to_string();
    let called = called.strip_prefix("debug_").unwrap_or(&called);
    let [left, right] = VALUE_NAMES.map(|name| Ident::new(name, at));
    let (kind, values, condition) = match (called, arguments.as_slice()) {
        ("assert_eq", [a, b, ..]) => (SiteKind::Equal, vec![a, b], quote_spanned!(at=> #left == #right)),
        ("assert_ne", [a, b, ..]) => (SiteKind::NotEqual, vec![a, b], quote_spanned!(at=> #left != #right)),
        ("assert_close", [a, b, tolerance]) => {
            // Inference knows calls by their places: this one must not have that of the record.
            let (inside, left) = (group.span(), Ident::new(VALUE_NAMES[0], group.span()));
            let close = quote_spanned!(inside=> #left.close_to(#right, #tolerance));
            (SiteKind::Close, vec![a, b], close)
        }
        ("assume", [condition]) => (SiteKind::Assume, Vec::new(), condition.to_token_stream()),
        ("assert", [condition, ..]) => match condition {
            syn::Expr::Binary(syn::ExprBinary {
                left: a, op, right: b, ..
            }) if is_comparison(op) => (
                SiteKind::Comparison,
                vec![&**a, &**b],
                quote_spanned!(at=> #left #op #right),
            ),
            syn::Expr::MethodCall(call) if call.args.is_empty() => {
                let method = &call.method;
                (
                    SiteKind::Property,
                    vec![&*call.receiver],
                    quote_spanned!(at=> #left.#method()),
                )
            }
            other => (SiteKind::Condition, Vec::new(), other.to_token_stream()),
        },
        _ => return None,
    };
    let tolerance = match kind {
        SiteKind::Close => as_written(&arguments[2]),
        _ => String::new(),
    };
    let number = Literal::u32_suffixed(sites.len() as u32);
    let whole = at.join(group.span()).unwrap_or(at);
    let text = |k: usize| values.get(k).map(as_written).unwrap_or_default();
    sites.push(Site {
        span: token_span(file, whole),
        kind,
        values: [text(0), text(1)],
        tolerance,
    });
    let record = Ident::new(RECORD, at);
    Some(match values.as_slice() {
        [a, b] => quote_spanned!(at=> let #left = #a; let #right = #b; #record(#number, #condition, #left, #right)),
        [a] => quote_spanned!(at=> let #left = #a; #record(#number, #condition, #left, ())),
        _ => quote_spanned!(at=> #record(#number, #condition, (), ())),
    })
}

fn is_comparison(op: &syn::BinOp) -> bool {
    use syn::BinOp as B;
    matches!(op, B::Eq(_) | B::Ne(_) | B::Lt(_) | B::Le(_) | B::Gt(_) | B::Ge(_))
}

fn with_stream(group: &Group, stream: TokenStream) -> TokenTree {
    let mut other = Group::new(group.delimiter(), stream);
    other.set_span(group.span());
    TokenTree::Group(other)
}

/// Returns whether a group in brackets after `#` is a `cfg`.
fn is_cfg(group: &Group, before: Option<&TokenTree>) -> bool {
    let first = group.stream().into_iter().next();
    matches!(before, Some(TokenTree::Punct(mark)) if mark.as_char() == '#')
        && matches!(first, Some(TokenTree::Ident(word)) if word == "cfg")
}

fn test_as_true(tokens: TokenStream) -> TokenStream {
    let each = tokens.into_iter().map(|token| match token {
        TokenTree::Ident(word) if word == "test" => TokenTree::Ident(Ident::new("true", word.span())),
        TokenTree::Group(group) => with_stream(&group, test_as_true(group.stream())),
        other => other,
    });
    each.collect()
}
