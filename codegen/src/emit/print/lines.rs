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

impl PrintedStatement<'_> {
    /// Moves the statement down by some lines.
    pub fn move_down(&mut self, lines: u32) {
        self.first += lines;
        self.last += lines;
    }
}

/// Lines of text, ended by line breaks.
#[derive(Clone, Debug, Default)]
pub struct Lines<'g> {
    /// The text.
    pub text: String,
    /// Statements that have a place in the source, in order.
    pub statements: Vec<PrintedStatement<'g>>,
    count: u32,
}

impl<'g> Lines<'g> {
    /// Adds a statement, without the line break at its end.
    pub fn push(&mut self, text: &str, source: Source<'g>, name: &str) {
        let first = self.count + 1;
        self.text += text;
        self.text.push('\n');
        self.count += 1 + line_count(text);
        if let Some(place) = source.place {
            self.statements.push(PrintedStatement {
                first,
                last: self.count,
                name: name.to_owned(),
                place,
            });
        }
    }
}

/// A text with the sources of its statements.
pub struct PrintedText<'g> {
    /// The text.
    pub text: String,
    /// Statements of the entry point that have a source, in order.
    pub statements: Vec<PrintedStatement<'g>>,
}

impl PrintedText<'_> {
    /// Puts lines in front of the text.
    pub fn prepend(&mut self, lines: &str) {
        self.text.insert_str(0, lines);
        let count = line_count(lines);
        self.statements
            .iter_mut()
            .for_each(|statement| statement.move_down(count));
    }
}

/// Number of line breaks in a text.
pub fn line_count(text: &str) -> u32 {
    text.bytes().filter(|byte| *byte == b'\n').count() as u32
}
