//! The source map: where each statement of a shader comes from in the kernel's source.

use crate::Error;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// Version of the layout of a source map. A reader refuses a map whose schema it does not know.
pub const SOURCE_MAP_SCHEMA: u32 = 1;

/// Statements of a shader's texts, with the expressions of the kernel's source that they compute.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SourceMap {
    /// Layout version, [`SOURCE_MAP_SCHEMA`].
    pub schema: u32,
    /// The kernel's name.
    pub kernel: String,
    /// Paths of the source's files. Of an absolute path only the file's name is kept.
    pub files: Vec<String>,
    /// By target name (`wgsl`, `glsl450`, `hlsl`, ...), the statements of the entry point that come from the source, in
    /// the order of the text.
    pub texts: BTreeMap<String, Vec<MappedStatement>>,
}

/// A statement of a text, and its place in the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MappedStatement {
    /// First line of the statement in the text, from 1; of a loop or a branch the line of its head.
    pub first: u32,
    /// Last line of the statement in the text.
    pub last: u32,
    /// Variable that the statement sets, by its name in the text; empty if it sets none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Index into [`SourceMap::files`].
    pub file: u32,
    /// Line in the source, from 1.
    pub line: u32,
    /// Column in the source, in characters, from 1.
    pub column: u32,
    /// The expression, on one line and shortened if it is long.
    pub expression: String,
    /// Counters of the unrolled loops around the expression, outermost first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub counters: Vec<(String, i64)>,
}

impl SourceMap {
    /// Reads a source map from JSON, refusing other schemas and unknown fields.
    ///
    /// # Errors
    ///
    /// If the text is not the JSON of a source map of this schema.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        #[derive(Deserialize)]
        struct Head {
            schema: u32,
        }
        let Head { schema } = serde_json::from_str(text)?;
        if schema != SOURCE_MAP_SCHEMA {
            return Err(Error::SourceMapSchema { found: schema });
        }
        Ok(serde_json::from_str(text)?)
    }

    /// The source map as indented JSON that ends in a newline.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a source map is plain data");
        text.push('\n');
        text
    }

    /// Returns the statement at a line of a text, the line counted from 1; `None` if nothing there comes from the source.
    pub fn at_line(&self, target: &str, line: u32) -> Option<&MappedStatement> {
        let statements = self.texts.get(target)?;
        statements
            .iter()
            .find(|statement| (statement.first..=statement.last).contains(&line))
    }

    /// Returns the statements of a text that come from a line of a source file. `file` is its path or the end of it, such
    /// as `sraa.rs`.
    pub fn from_source(&self, target: &str, file: &str, line: u32) -> impl Iterator<Item = &MappedStatement> {
        let statements = self.texts.get(target).map(Vec::as_slice).unwrap_or_default();
        statements.iter().filter(move |statement| {
            let path = self.file_of(statement);
            let rest = path.strip_suffix(file);
            statement.line == line && rest.is_some_and(|rest| rest.is_empty() || rest.ends_with('/'))
        })
    }

    /// Path of the file that a statement comes from.
    pub fn file_of(&self, statement: &MappedStatement) -> &str {
        self.files.get(statement.file as usize).map_or("", String::as_str)
    }

    /// Describes the source of a statement: `blur.rs:12:9, tap 3: weight * color`.
    pub fn describe(&self, statement: &MappedStatement) -> impl fmt::Display {
        let MappedStatement {
            line,
            column,
            expression,
            ..
        } = statement;
        let counters: String = statement
            .counters
            .iter()
            .map(|(name, value)| format!(", {name} {value}"))
            .collect();
        format!("{}:{line}:{column}{counters}: {expression}", self.file_of(statement))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> SourceMap {
        let statement = |first, last, line| MappedStatement {
            first,
            last,
            name: "sum".to_owned(),
            file: 0,
            line,
            column: 5,
            expression: "sum + texel".to_owned(),
            counters: vec![("tap".to_owned(), 3)],
        };
        SourceMap {
            schema: SOURCE_MAP_SCHEMA,
            kernel: "blur".to_owned(),
            files: vec!["kernels/blur.rs".to_owned()],
            texts: BTreeMap::from([("wgsl".to_owned(), vec![statement(10, 11, 4), statement(12, 12, 4)])]),
        }
    }

    #[test]
    fn finds_statements_by_either_line() {
        let map = map();
        assert_eq!(map.at_line("wgsl", 11).map(|statement| statement.first), Some(10));
        assert_eq!(map.at_line("wgsl", 9), None);
        assert_eq!(map.at_line("hlsl", 11), None);
        for (file, found) in [("blur.rs", 2), ("kernels/blur.rs", 2), ("lur.rs", 0)] {
            assert_eq!(map.from_source("wgsl", file, 4).count(), found, "{file}");
        }
        let described = map.describe(&map.texts["wgsl"][0]).to_string();
        assert_eq!(described, "kernels/blur.rs:4:5, tap 3: sum + texel");
    }

    #[test]
    fn is_read_as_it_was_written() {
        assert_eq!(SourceMap::from_json(&map().to_json()).ok(), Some(map()));
        let other = map().to_json().replace("\"schema\": 1", "\"schema\": 9");
        let error = SourceMap::from_json(&other).map_err(|error| error.to_string());
        assert!(error.is_err_and(|why| why.contains("schema 9")));
    }
}
