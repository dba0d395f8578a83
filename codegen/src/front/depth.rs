//! Whether a text is nested too deep to be read: the parser goes down with every bracket and prefix.

use crate::diagnostic::Diagnostic;
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Deepest nesting of brackets, and most prefix operators in a row.
const DEEPEST: usize = 200;

/// Most `else` and assignments in one block, each of which nests in what stands before it.
const LONGEST_CHAIN: usize = 1000;

/// Most tokens of a file.
const MOST_TOKENS: usize = 1_000_000;

/// Refuses a text on which a parser would run out of stack. What is no list of tokens is for the parser to refuse.
pub fn check(file: u32, text: &str) -> Result<(), Box<Diagnostic>> {
    let Ok(tokens) = text.parse::<TokenStream>() else {
        return Ok(());
    };
    let refuse = |span: proc_macro2::Span, what: String| {
        Err(Box::new(
            Diagnostic::at(super::place(file, span), what)
                .label("here")
                .help("give parts of it a name with `let`, or put them into functions"),
        ))
    };
    let mut open = vec![tokens.into_iter()];
    let mut chains = vec![0usize];
    let (mut prefixes, mut count) = (0, 0);
    while let Some(tokens) = open.last_mut() {
        let Some(token) = tokens.next() else {
            open.pop();
            chains.pop();
            continue;
        };
        count += 1;
        if count > MOST_TOKENS {
            return refuse(token.span(), format!("a file of more than {MOST_TOKENS} tokens"));
        }
        let span = token.span();
        prefixes = match &token {
            TokenTree::Punct(_) => prefixes + 1,
            // `for<'a>` and the like do not nest.
            TokenTree::Ident(word) if matches!(word.to_string().as_str(), "return" | "break" | "move" | "mut") => {
                prefixes + 1
            }
            _ => 0,
        };
        if prefixes > DEEPEST {
            return refuse(span, format!("more than {DEEPEST} operators in a row"));
        }
        match token {
            TokenTree::Group(group) => {
                if open.len() > DEEPEST {
                    return refuse(span, format!("brackets are nested more than {DEEPEST} deep"));
                }
                if group.delimiter() != Delimiter::None {
                    open.push(group.stream().into_iter());
                    chains.push(0);
                }
            }
            TokenTree::Ident(word) if word == "else" => {
                let chain = chains.last_mut().expect("one for each open group");
                *chain += 1;
                if *chain > LONGEST_CHAIN {
                    return refuse(span, format!("more than {LONGEST_CHAIN} `else` in a block"));
                }
            }
            _ => {}
        }
    }
    Ok(())
}
