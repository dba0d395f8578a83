//! The source map of a shader's texts.

use super::print::{PrintedStatement, PrintedText};
use super::resources::Resources;
use crate::compiled::Compiled;
use crate::spec::Target;
use std::collections::BTreeMap;
use straightline_evaluator::diagnostic::File;
use straightline_evaluator::ir::Span;
use straightline_manifest::{MappedStatement, SOURCE_MAP_SCHEMA, SourceMap};

/// Number of characters after which an expression is cut.
const LONGEST: usize = 120;

/// Returns a source map without texts.
pub fn empty_map(resources: &Resources) -> SourceMap {
    SourceMap {
        schema: SOURCE_MAP_SCHEMA,
        kernel: resources.kernel.clone(),
        files: resources.files.clone(),
        texts: BTreeMap::new(),
    }
}

/// Adds the statements of a text.
pub fn add_text(map: &mut SourceMap, target: Target, text: &PrintedText<'_>, compiled: &Compiled) {
    let statements = text.statements.iter();
    let mapped = statements.map(|statement| map_statement(statement, source_text(compiled, statement.place.span)));
    map.texts.insert(target.to_string(), mapped.collect());
}

/// Returns the text of a source file. The files of a chain's passes are found by their paths.
pub fn file_text(compiled: &Compiled, file: u32) -> Option<&str> {
    let path = compiled.graph.files.get(file as usize)?;
    let is_named = |of: &&File| of.path == *path;
    Some(&compiled.places.files.iter().find(is_named)?.text)
}

fn source_text(compiled: &Compiled, span: Span) -> &str {
    let text = file_text(compiled, span.file).and_then(|text| text.get(span.start as usize..span.end as usize));
    text.unwrap_or_default()
}

fn map_statement(statement: &PrintedStatement<'_>, expression: &str) -> MappedStatement {
    let place = statement.place;
    let words: Vec<&str> = expression.split_whitespace().collect();
    let mut expression = words.join(" ");
    if let Some((cut, _)) = expression.char_indices().nth(LONGEST) {
        expression.truncate(cut);
        expression.push('…');
    }
    MappedStatement {
        first: statement.first,
        last: statement.last,
        name: statement.name.clone(),
        file: place.span.file,
        line: place.span.line,
        column: place.span.column,
        expression,
        counters: place.counters.iter().map(|c| (c.name.to_string(), c.value)).collect(),
    }
}
