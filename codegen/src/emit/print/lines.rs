//! Lines of a text, with the source of each statement.

use crate::emit::ast::Source;
use straightline_evaluator::ir::Place;

/// A statement of a text, and the expression of the source that it computes.
#[derive(Clone, Debug)]
pub struct PrintedStatement<'g> {
    /// First line, from 1; of a loop or branch the line of its head.
    pub first: u32,
    /// Last line.
    pub last: u32,
    /// Name of the variable that the statement sets; empty if it sets none.
    pub name: String,
    /// Place in the source.
    pub place: &'g Place,
}

/// A text with the sources of its statements.
#[derive(Clone, Debug, Default)]
pub struct PrintedText<'g> {
    /// The text.
    pub text: String,
    /// Statements that have a place in the source, in order.
    pub statements: Vec<PrintedStatement<'g>>,
    /// Number of line breaks in the text.
    lines: u32,
}

impl<'g> PrintedText<'g> {
    /// Adds text that comes from no statement.
    pub fn push_text(&mut self, text: &str) {
        self.text += text;
        self.lines += text.bytes().filter(|byte| *byte == b'\n').count() as u32;
    }

    /// Adds a statement in lines of its own.
    pub fn push_statement(&mut self, text: &str, source: Source<'g>, name: &str) {
        let first = self.lines + 1;
        self.push_text(text);
        self.push_text("\n");
        if let Some(place) = source.place {
            self.statements.push(PrintedStatement {
                first,
                last: self.lines,
                name: name.to_owned(),
                place,
            });
        }
    }

    /// Adds whole lines.
    pub fn append(&mut self, lines: &PrintedText<'g>) {
        let before = self.lines;
        self.push_text(&lines.text);
        self.statements
            .extend(lines.statements.iter().map(|statement| PrintedStatement {
                first: statement.first + before,
                last: statement.last + before,
                ..statement.clone()
            }));
    }
}
