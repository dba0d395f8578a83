//! Expressions as text, with the information for nesting them in larger ones.

/// Precedence of an expression's outermost operator; larger binds tighter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Binds {
    /// `&&`, `||`, `&`, `|`, `^`, `<<`, `>>`: WGSL requires and readers expect parentheses around and inside.
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

/// Maximum width of a line, in columns.
pub const WIDEST: usize = 100;

/// Positions at which an expression may be broken into lines.
#[derive(Clone, Debug, PartialEq)]
enum Breaks {
    /// Nowhere.
    Nowhere,
    /// Between the arguments: text before, arguments, text after.
    Arguments(String, Vec<Text>, String),
    /// Before the operator: left side, operator, right side.
    Operator(Box<Text>, String, Box<Text>),
}

/// An expression as text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The text.
    pub code: String,
    /// Precedence of its outermost operator.
    pub binds: Binds,
    breaks: Breaks,
}

impl Text {
    /// A name or literal.
    pub fn name(code: impl Into<String>) -> Text {
        Text {
            code: code.into(),
            binds: Binds::Primary,
            breaks: Breaks::Nowhere,
        }
    }

    /// A number, which may be negative.
    pub fn literal(code: String, negative: bool) -> Text {
        Text {
            binds: if negative { Binds::Prefix } else { Binds::Primary },
            ..Text::name(code)
        }
    }

    /// A call of a function.
    pub fn call(function: &str, args: &[&Text]) -> Text {
        Text::list(format!("{function}("), args, ")")
    }

    /// Creates a list of arguments between `open` and `close`.
    pub fn list(open: String, args: &[&Text], close: &str) -> Text {
        let list: Vec<&str> = args.iter().map(|a| a.code.as_str()).collect();
        Text {
            code: format!("{open}{}{close}", list.join(", ")),
            binds: Binds::Primary,
            breaks: Breaks::Arguments(open, args.iter().map(|arg| (*arg).clone()).collect(), close.to_owned()),
        }
    }

    /// `left op right`.
    pub fn infix(left: &Text, op: &str, right: &Text, binds: Binds) -> Text {
        // Evaluation is from left to right: a right side of equal precedence keeps its parentheses, so that no rounding
        // changes.
        let [left, right] = [left.as_operand(binds, false), right.as_operand(binds, true)];
        Text {
            code: format!("{} {op} {}", left.code, right.code),
            binds,
            breaks: Breaks::Operator(Box::new(left), op.to_owned(), Box::new(right)),
        }
    }

    /// `(condition ? yes : no)`.
    pub fn choice(condition: &Text, yes: &Text, no: &Text) -> Text {
        let code = format!("{} ? {}", condition.code, yes.code);
        let first = Text {
            breaks: Breaks::Operator(Box::new(condition.clone()), "?".to_owned(), Box::new(yes.clone())),
            ..Text::name(code)
        };
        let whole = Text {
            breaks: Breaks::Operator(Box::new(first.clone()), ":".to_owned(), Box::new(no.clone())),
            ..Text::name(format!("{} : {}", first.code, no.code))
        };
        Text::list("(".to_owned(), &[&whole], ")")
    }

    /// `op x`.
    pub fn prefix(op: &str, operand: &Text) -> Text {
        Text {
            binds: Binds::Prefix,
            ..Text::name(format!("{op}{}", operand.as_primary().code))
        }
    }

    /// `x.member`.
    pub fn member(base: &Text, member: &str) -> Text {
        let base = base.as_primary();
        let code = format!("{}.{member}", base.code);
        match base.breaks {
            Breaks::Arguments(open, args, close) => Text {
                code,
                binds: Binds::Primary,
                breaks: Breaks::Arguments(open, args, format!("{close}.{member}")),
            },
            _ => Text::name(code),
        }
    }

    /// `base[index]`.
    pub fn index(base: &Text, index: &Text) -> Text {
        Text::name(format!("{}[{}]", base.code, index.code))
    }

    /// Adds parentheses if the outermost part is an operator.
    pub fn in_parentheses(&self) -> Text {
        match self.binds >= Binds::Prefix {
            true => self.clone(),
            false => Text::list("(".to_owned(), &[self], ")"),
        }
    }

    fn as_primary(&self) -> Text {
        match self.binds < Binds::Primary {
            true => Text::list("(".to_owned(), &[self], ")"),
            false => self.clone(),
        }
    }

    /// Returns the text as an operand of an operator with this precedence.
    fn as_operand(&self, outer: Binds, right: bool) -> Text {
        let loose = self.binds < outer || (right && self.binds == outer);
        let mixed = (outer == Binds::Mixed || self.binds == Binds::Mixed) && self.binds < Binds::Prefix;
        let compared = outer == Binds::Comparison && self.binds == Binds::Comparison;
        match loose || mixed || compared {
            true => Text::list("(".to_owned(), &[self], ")"),
            false => self.clone(),
        }
    }

    /// Wraps the text to lines of at most [`WIDEST`] columns where breaks are possible. The first line begins at column
    /// `at`; the last leaves room for `rest` columns; the others are indented by `indent`.
    pub fn wrap_lines(&self, at: usize, rest: usize, indent: usize) -> String {
        if at + self.code.len() + rest <= WIDEST {
            return self.code.clone();
        }
        let deeper = indent + 4;
        let margin = " ".repeat(deeper);
        match &self.breaks {
            Breaks::Nowhere => self.code.clone(),
            Breaks::Arguments(open, args, close) => {
                let mut lines = vec![String::new()];
                for (k, arg) in args.iter().enumerate() {
                    let comma = usize::from(k + 1 < args.len());
                    let line = lines.last_mut().expect("begins with one");
                    let fits = deeper + line.len() + 1 + arg.code.len() + comma <= WIDEST;
                    if line.is_empty() || fits {
                        if !line.is_empty() {
                            line.push(' ');
                        }
                    } else {
                        lines.push(String::new());
                    }
                    let line = lines.last_mut().expect("begins with one");
                    let broken = arg.wrap_lines(deeper + line.len(), comma, deeper);
                    *line += &broken;
                    if comma > 0 {
                        line.push(',');
                    }
                }
                let lines: Vec<String> = lines.into_iter().map(|line| format!("{margin}{line}")).collect();
                format!("{open}\n{}\n{}{close}", lines.join("\n"), " ".repeat(indent))
            }
            Breaks::Operator(left, op, right) => {
                let begin = left.wrap_lines(at, 0, indent);
                let end = right.wrap_lines(deeper + op.len() + 1, rest, deeper);
                format!("{begin}\n{margin}{op} {end}")
            }
        }
    }
}

/// Returns a comment, wrapped to lines of at most [`WIDEST`] columns.
pub fn wrapped_comment(text: &str, indent: usize) -> String {
    let margin = " ".repeat(indent);
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in text.split(' ') {
        if !line.is_empty() && indent + 3 + line.chars().count() + 1 + word.chars().count() > WIDEST {
            lines.push(format!("{margin}// {line}"));
            // An extra space of indentation sets continuation lines apart from the comment that follows.
            line = String::from(" ");
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line += word;
    }
    lines.push(format!("{margin}// {line}"));
    lines.join("\n")
}
