//! Expressions as text, with what is needed to put them into larger ones.

/// A text as it may stand in a comment of one line: without what ends a line in any language, and without backslashes, which
/// in GLSL carry a comment on to the next line.
pub fn comment(text: &str) -> String {
    let harmless = |c: char| match c {
        '\u{2028}' | '\u{2029}' => ' ',
        c if c.is_control() => ' ',
        '\\' => '/',
        c => c,
    };
    text.chars().map(harmless).collect()
}

/// How tightly an expression's outermost operator binds; larger binds tighter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Binds {
    /// `&&`, `||`, `&`, `|`, `^`, `<<`, `>>`: WGSL and readers want parentheses around and inside.
    Mixed,
    /// `==`, `<`, ...
    Comparison,
    /// `+`, `-`.
    Sum,
    /// `*`, `/`, `%`.
    Product,
    /// `-x`, `!x`, and negative literals.
    Prefix,
    /// Names, literals, calls, fields.
    Primary,
}

/// An expression as text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The text.
    pub code: String,
    /// How tightly it binds.
    pub binds: Binds,
}

impl Text {
    /// A name or literal.
    pub fn name(code: impl Into<String>) -> Text {
        Text {
            code: code.into(),
            binds: Binds::Primary,
        }
    }

    /// A number, which may be negative.
    pub fn literal(code: String, negative: bool) -> Text {
        let binds = if negative { Binds::Prefix } else { Binds::Primary };
        Text { code, binds }
    }

    /// A call of a function.
    pub fn call(function: &str, args: &[&Text]) -> Text {
        let list: Vec<&str> = args.iter().map(|a| a.code.as_str()).collect();
        Text {
            code: format!("{function}({})", list.join(", ")),
            binds: Binds::Primary,
        }
    }

    /// `left op right`.
    pub fn infix(left: &Text, op: &str, right: &Text, binds: Binds) -> Text {
        // Left to right as evaluated: a right side of the same strength keeps its parentheses, so that no rounding moves.
        let l = left.inside(binds, false);
        let r = right.inside(binds, true);
        Text {
            code: format!("{l} {op} {r}"),
            binds,
        }
    }

    /// `op x`.
    pub fn prefix(op: &str, operand: &Text) -> Text {
        let inner = if operand.binds < Binds::Primary {
            format!("({})", operand.code)
        } else {
            operand.code.clone()
        };
        Text {
            code: format!("{op}{inner}"),
            binds: Binds::Prefix,
        }
    }

    /// `x.member`.
    pub fn member(base: &Text, member: &str) -> Text {
        let inner = if base.binds < Binds::Primary {
            format!("({})", base.code)
        } else {
            base.code.clone()
        };
        Text {
            code: format!("{inner}.{member}"),
            binds: Binds::Primary,
        }
    }

    /// `base[index]`.
    pub fn index(base: &Text, index: &Text) -> Text {
        Text {
            code: format!("{}[{}]", base.code, index.code),
            binds: Binds::Primary,
        }
    }

    /// In parentheses if an operator is outermost.
    pub fn in_parentheses(&self) -> Text {
        if self.binds >= Binds::Prefix {
            return self.clone();
        }
        Text {
            code: format!("({})", self.code),
            binds: Binds::Primary,
        }
    }

    /// The text as an operand of an operator that binds so.
    fn inside(&self, outer: Binds, right: bool) -> String {
        let loose = self.binds < outer || (right && self.binds == outer);
        let mixed = (outer == Binds::Mixed || self.binds == Binds::Mixed) && self.binds < Binds::Prefix;
        let compared = outer == Binds::Comparison && self.binds == Binds::Comparison;
        if loose || mixed || compared {
            format!("({})", self.code)
        } else {
            self.code.clone()
        }
    }
}
