//! Refuses texts that are nested too deep to be parsed. A parser recurses at every bracket, but also at prefixes, closures, types of
//! functions, generic arguments and words such as `return`; and the tree of a long chain of operators is deep too. All of these are counted
//! on the tokens, before anything recursive sees them.

use crate::diagnostic::{Code, Diagnostic};
use proc_macro2::{Delimiter, Spacing, Span, TokenStream, TokenTree};

/// Deepest nesting of brackets.
const DEEPEST: usize = 200;

/// Most tokens around one place that a parser goes down with: brackets count 1, prefixes and the like too.
const MOST_NESTED: usize = 256;

/// Most operators, calls and fields that one expression has in a row, which make a deep tree though the parser reads them in
/// a loop.
const LONGEST: usize = 1500;

/// Most operators in a row.
const MOST_PREFIXES: usize = 200;

/// Most tokens of a file.
const MOST_TOKENS: usize = 1_000_000;

/// Most characters of a number.
const LONGEST_NUMBER: usize = 200;

/// Words after which a parser reads an expression, a type, a pattern or an item as a part of what the word began.
const NESTING: [&str; 26] = [
    "async", "become", "box", "break", "const", "do", "dyn", "fn", "for", "if", "impl", "in", "let", "match", "move",
    "mut", "raw", "ref", "return", "static", "unsafe", "use", "while", "where", "yeet", "yield",
];

/// Refuses a text on which a parser would run out of stack. What is no list of tokens is for the parser to refuse.
pub fn check_depth(file: u32, text: &str) -> Result<(), Box<Diagnostic>> {
    let Ok(tokens) = text.parse::<TokenStream>() else {
        return Ok(());
    };
    let refuse = |span: Span, what: String, help: &str| {
        Err(Box::new(
            Diagnostic::error_at(Code::TooDeep, super::token_span(file, span), what)
                .label("here")
                .help(help),
        ))
    };
    const SMALLER: &str = "give parts of it a name with `let`, or put them into functions";
    let mut open = vec![Level::new(tokens, false)];
    let mut count = 0;
    while let Some(level) = open.last_mut() {
        let Some(token) = level.tokens.next() else {
            open.pop();
            continue;
        };
        count += 1;
        let span = token.span();
        if count > MOST_TOKENS {
            return refuse(
                span,
                format!("a file of more than {MOST_TOKENS} tokens"),
                "keep kernels in files of their own",
            );
        }
        if let TokenTree::Literal(literal) = &token {
            let shown = literal.to_string();
            if shown.len() > LONGEST_NUMBER && shown.starts_with(|c: char| c.is_ascii_digit()) {
                return refuse(
                    span,
                    format!("a number of {} characters", shown.len()),
                    "round it: an f32 has 9 digits",
                );
            }
        }
        level.take(&token);
        if level.prefixes > MOST_PREFIXES {
            return refuse(span, format!("more than {MOST_PREFIXES} operators in a row"), SMALLER);
        }
        let nested: usize = open.iter().map(|level| 1 + level.nested + level.angles.len()).sum();
        if nested > MOST_NESTED {
            return refuse(span, format!("this is nested more than {MOST_NESTED} deep"), SMALLER);
        }
        if open.iter().map(|level| level.chained).sum::<usize>() > LONGEST {
            return refuse(
                span,
                format!("more than {LONGEST} operators in one expression"),
                SMALLER,
            );
        }
        if let TokenTree::Group(group) = token {
            if open.len() > DEEPEST {
                return refuse(span, format!("brackets are nested more than {DEEPEST} deep"), SMALLER);
            }
            if group.delimiter() != Delimiter::None {
                let import = open.last().is_some_and(|level| level.import);
                open.push(Level::new(group.stream(), import));
            }
        }
    }
    Ok(())
}

/// Tokens between two brackets, as far as they are read.
struct Level {
    tokens: proc_macro2::token_stream::IntoIter,
    before: Before,
    /// Prefixes in a row.
    prefixes: usize,
    /// Tokens since the last end of a statement, or the like, that the parser went down with.
    nested: usize,
    /// `<` without their `>`, with how far the parser had gone down before each.
    angles: Vec<usize>,
    /// Operators, calls and fields since then.
    chained: usize,
    /// Prefix operators of the operand that is being read, which the parser has gone down with: a binary operator ends it.
    prefixed: usize,
    /// `true` if the last character of an operator followed an operand.
    between: bool,
    /// `true` in a `use`, at whose path the parser recurses.
    import: bool,
}

/// The token before.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Before {
    /// None, or one that ends a statement, an element or an arm.
    Start,
    /// An operator's character, and whether the next belongs to it.
    Punct(char, bool),
    /// A word that something has to follow.
    Word,
    /// `else`.
    Else,
    /// A name, a number, or a group in parentheses or brackets: an operand.
    Operand,
    /// A group in braces, and whether generic arguments may go on after it.
    Braces,
}

impl Level {
    fn new(tokens: TokenStream, import: bool) -> Self {
        Level {
            tokens: tokens.into_iter(),
            before: Before::Start,
            prefixes: 0,
            nested: 0,
            angles: Vec::new(),
            chained: 0,
            prefixed: 0,
            between: false,
            import,
        }
    }

    /// Statements, items, elements and arms do not nest in what stands before them.
    fn restart(&mut self) {
        self.nested = 0;
        self.angles.clear();
        self.chained = 0;
        self.prefixes = 0;
        self.prefixed = 0;
        self.import = false;
        self.before = Before::Start;
    }

    fn take(&mut self, token: &TokenTree) {
        match token {
            TokenTree::Ident(word) => self.word(&word.to_string()),
            TokenTree::Literal(_) => {
                if self.before == Before::Braces {
                    self.restart();
                }
                self.prefixes = 0;
                self.before = Before::Operand;
            }
            TokenTree::Group(group) => self.group(group.delimiter()),
            TokenTree::Punct(p) => self.punct(p.as_char(), p.spacing() == Spacing::Joint),
        }
    }

    fn word(&mut self, word: &str) {
        // A word after braces begins anew, unless it goes on with what they end. (`if` may guard a pattern, which is at its end.)
        if self.before == Before::Braces && !matches!(word, "else" | "as" | "in" | "where") {
            self.restart();
        }
        let after_else = self.before == Before::Else;
        self.import |= word == "use";
        self.before = match word {
            "else" => {
                // Links of an `else if` chain are read in a loop.
                self.chained += 1;
                Before::Else
            }
            "if" if after_else => Before::Word,
            "as" => {
                self.chained += 1;
                Before::Word
            }
            _ if NESTING.contains(&word) => {
                self.nested += 1;
                self.prefixed = 0;
                // A loop of prefixes such as `return return` is reported as one.
                self.prefixes += 1;
                Before::Word
            }
            _ => {
                self.prefixes = 0;
                Before::Operand
            }
        };
    }

    fn group(&mut self, delimiter: Delimiter) {
        match delimiter {
            Delimiter::Brace => {
                // `a < b {`: a comparison. In `A<{3}, B>` braces follow `<`, `,` or `=`.
                if !matches!(self.before, Before::Punct('<' | ',' | '=', _)) {
                    self.angles.clear();
                }
                self.chained += 1;
                self.before = Before::Braces;
            }
            _ => {
                if matches!(self.before, Before::Operand | Before::Braces) {
                    self.chained += 1;
                }
                self.before = Before::Operand;
            }
        }
        self.prefixes = 0;
    }

    fn punct(&mut self, c: char, joint: bool) {
        let before = self.before;
        self.before = Before::Punct(c, joint);
        let joined = matches!(before, Before::Punct(_, true));
        let follows = matches!(before, Before::Operand | Before::Braces);
        let between = std::mem::replace(&mut self.between, follows);
        match c {
            ';' => return self.restart(),
            ',' => {
                // Inside of generic arguments the parser stays as deep as these are.
                self.nested = self.angles.last().copied().unwrap_or(0);
                self.chained = 0;
                self.prefixes = 0;
                if self.angles.is_empty() {
                    self.before = Before::Start;
                }
                return;
            }
            '\'' | '#' => {
                // A label or an attribute after braces begins anew.
                if before == Before::Braces {
                    self.restart();
                }
                return;
            }
            '>' => {
                match before {
                    // `->` leads to a type.
                    Before::Punct('-', true) => self.nested += 1,
                    // A pattern before `=>` is read to its end.
                    Before::Punct('=', true) => return self.restart(),
                    _ => {
                        self.angles.pop();
                        self.chained += 1;
                    }
                }
                self.prefixes = 0;
                return;
            }
            '<' => {
                self.angles.push(self.nested);
                self.prefixes += 1;
                return;
            }
            ':' => {
                if self.import && joined {
                    self.nested += 1;
                }
                return;
            }
            '@' => self.nested += 1,
            '=' => match before {
                // `==`, `<=`, `>=` and `!=` are read in a loop; assignments nest.
                Before::Punct('=', true) => self.nested = self.nested.saturating_sub(1),
                Before::Punct('<', true) => drop(self.angles.pop()),
                Before::Punct('>' | '!', true) => {}
                _ => self.nested += 1,
            },
            // `||` and `|`: between operands an operator, else a closure or the first of several patterns.
            // No generic argument goes on with them: each `<` before was a comparison or a shift.
            '|' | '&' if between && joined && before == Before::Punct(c, true) => self.angles.clear(),
            '|' if joined && before == Before::Punct('|', true) => {}
            _ => match before {
                Before::Operand | Before::Braces => {
                    self.chained += 1;
                    // Calls, fields and `?` belong to what a prefix stands before.
                    if !matches!(c, '.' | '?') {
                        self.nested -= std::mem::take(&mut self.prefixed).min(self.nested);
                    }
                    if matches!(c, '*' | '/' | '%' | '^') {
                        self.angles.clear();
                    }
                }
                Before::Start | Before::Word | Before::Else | Before::Punct(..) => {
                    self.nested += 1;
                    self.prefixed += usize::from(matches!(c, '-' | '!' | '*' | '&'));
                }
            },
        }
        self.prefixes += 1;
    }
}
