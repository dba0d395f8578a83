//! Variables of a chain that a pass mentions.

use super::syntax::identifier;
use super::value::Value;
use proc_macro2::{Delimiter, Ident, Literal, TokenStream, TokenTree};
use std::collections::BTreeMap;

/// Looks up what the tokens of a pass mention.
pub trait Lookup {
    /// Value of a variable of the chain.
    fn variable(&self, name: &str) -> Option<Value>;

    /// Value of an expression that is an index.
    fn index(&self, tokens: TokenStream) -> Option<i64>;
}

/// Tokens of a pass, with the variables of the chain that they mention.
#[derive(Clone, Default)]
pub struct Captured {
    /// The tokens: an element of a list of pictures is a variable of its own in them.
    pub tokens: TokenStream,
    /// Values by the names that the tokens have for them.
    pub values: BTreeMap<String, Value>,
}

/// A mention of a list of pictures that is no element of it.
pub struct WholeList(pub Ident);

/// Finds the variables that `tokens` mention.
///
/// # Errors
///
/// A list of pictures that is not indexed by a constant.
pub fn capture(tokens: TokenStream, lookup: &dyn Lookup) -> Result<Captured, WholeList> {
    let mut elements = Elements::default();
    let mut captured = Captured::default();
    captured.tokens = capture_into(tokens, lookup, &mut captured.values, &mut elements)?;
    Ok(captured)
}

/// Elements of lists that were named, by list and index.
#[derive(Default)]
struct Elements(BTreeMap<(String, i64), String>);

impl Elements {
    /// Name of an element: that of the list for the first one, so that passes over unlike elements have the same text.
    fn name(&mut self, list: &str, index: i64) -> String {
        let known = self.0.keys().filter(|(of, _)| of == list).count();
        let fresh = || match known {
            0 => list.to_owned(),
            k => format!("{list}_{}", k + 1),
        };
        self.0.entry((list.to_owned(), index)).or_insert_with(fresh).clone()
    }
}

fn capture_into(
    tokens: TokenStream,
    lookup: &dyn Lookup,
    values: &mut BTreeMap<String, Value>,
    elements: &mut Elements,
) -> Result<TokenStream, WholeList> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut made: Vec<TokenTree> = Vec::new();
    let mut k = 0;
    while let Some(token) = tokens.get(k) {
        k += 1;
        match token {
            TokenTree::Group(group) => {
                let inner = capture_into(group.stream(), lookup, values, elements)?;
                let mut group_made = proc_macro2::Group::new(group.delimiter(), inner);
                group_made.set_span(group.span());
                made.push(TokenTree::Group(group_made));
            }
            TokenTree::Ident(ident) if is_variable(&tokens, k - 1) => {
                let name = ident.to_string();
                match lookup.variable(&name) {
                    Some(Value::Images(images)) => {
                        let (element, after) = element_of(&tokens, k, images.len() as i64, lookup);
                        k = after;
                        match element {
                            Some(Element::Index(index)) if (0..images.len() as i64).contains(&index) => {
                                let element = elements.name(&name, index);
                                made.push(TokenTree::Ident(identifier(&element, ident.span())));
                                values.insert(element, Value::Image(images[index as usize].clone()));
                            }
                            Some(Element::Length) => {
                                made.push(TokenTree::Literal(Literal::usize_unsuffixed(images.len())));
                            }
                            _ => return Err(WholeList(ident.clone())),
                        }
                    }
                    Some(value) => {
                        values.insert(name, value);
                        made.push(token.clone());
                    }
                    None => made.push(token.clone()),
                }
            }
            other => made.push(other.clone()),
        }
    }
    Ok(made.into_iter().collect())
}

enum Element {
    Index(i64),
    Length,
}

/// Element that is named after a list, by `[index]`, `.len()` or `.last().unwrap()`, with the position after it.
fn element_of(tokens: &[TokenTree], at: usize, len: i64, lookup: &dyn Lookup) -> (Option<Element>, usize) {
    if let Some(TokenTree::Group(group)) = tokens.get(at)
        && group.delimiter() == Delimiter::Bracket
    {
        return (lookup.index(group.stream()).map(Element::Index), at + 1);
    }
    let method = |at: usize| match (tokens.get(at), tokens.get(at + 1), tokens.get(at + 2)) {
        (Some(TokenTree::Punct(dot)), Some(TokenTree::Ident(name)), Some(TokenTree::Group(arguments)))
            if dot.as_char() == '.' && arguments.stream().is_empty() =>
        {
            Some(name.to_string())
        }
        _ => None,
    };
    match (method(at).as_deref(), method(at + 3).as_deref()) {
        (Some("len"), _) => (Some(Element::Length), at + 3),
        (Some("last"), Some("unwrap")) => (Some(Element::Index(len - 1)), at + 6),
        (Some("first"), Some("unwrap")) => (Some(Element::Index(0)), at + 6),
        _ => (None, at),
    }
}

/// Returns whether the name at a position may be a variable: no field, method or part of a path.
fn is_variable(tokens: &[TokenTree], at: usize) -> bool {
    let punct = |at: Option<usize>, c: char| match at.and_then(|at| tokens.get(at)) {
        Some(TokenTree::Punct(punct)) => punct.as_char() == c,
        _ => false,
    };
    let (before, two_before) = (at.checked_sub(1), at.checked_sub(2));
    let is_field = punct(before, '.') && !punct(two_before, '.');
    let in_path =
        (punct(before, ':') && punct(two_before, ':')) || (punct(Some(at + 1), ':') && punct(Some(at + 2), ':'));
    !is_field && !in_path
}
