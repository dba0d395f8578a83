//! Renders an engine's templates. Nothing of the generator is needed for that.

use crate::engine::Engine;
use crate::error::EngineError;
use crate::{builtin, filters};
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Component, Path};
use tera::Tera;

/// Bytes that one rendered file may have: naga's limits are far below.
const LONGEST: usize = 32 << 20;

/// Templates with the files that they make, and their context.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    /// Template and the name of its file, as of `engine.toml`.
    pub files: BTreeMap<String, String>,
    pub context: Value,
}

impl Engine {
    /// The files that the templates make of what [`Engine::context`] returns, as JSON; by name.
    ///
    /// # Errors
    ///
    /// A template fails, makes more than 32 MiB or, of a user's folder, takes longer than 10 s; two templates make one
    /// file; a file would lie outside of the folder that is written.
    pub fn render(&self, context: Value) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        let files = self.description.files.clone();
        self.render_sheets(vec![Sheet { files, context }])
    }

    /// As [`Engine::render`], of several contexts.
    pub(crate) fn render_sheets(&self, sheets: Vec<Sheet>) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        match self.templates {
            Some(_) => self.render_within_time(sheets),
            None => self.render_now(&sheets),
        }
    }

    pub(crate) fn render_now(&self, sheets: &[Sheet]) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        let mut made = BTreeMap::new();
        for sheet in sheets {
            self.render_sheet(sheet, &mut made)?;
        }
        Ok(made)
    }

    fn render_sheet(&self, sheet: &Sheet, made: &mut BTreeMap<String, Vec<u8>>) -> Result<(), EngineError> {
        let context = tera::Context::from_serialize(&sheet.context);
        let context = context.map_err(|e| self.description_error(e.to_string()))?;
        let mut tera = Tera::default();
        filters::register_filters(&mut tera);
        tera.autoescape_on(Vec::<&str>::new());
        for (template, file) in &sheet.files {
            let failed = |error: tera::Error| EngineError::Template {
                engine: self.name.clone(),
                template: template.clone(),
                message: describe_error(&error),
            };
            let source = self.template(template);
            let source = source.ok_or_else(|| self.description_error(format!("there is no template `{template}`")))?;
            tera.add_raw_template(template, source).map_err(failed)?;
            let (mut text, mut name) = (Bounded::default(), Bounded::default());
            tera.render_to(template, &context, &mut text).map_err(failed)?;
            tera.render_str_to(file, &context, false, &mut name).map_err(failed)?;
            let name = String::from_utf8_lossy(&name.0).into_owned();
            if !is_plain(&name) {
                return Err(
                    self.description_error(format!("`{name}` is no name of a file in the folder that is written"))
                );
            }
            // Some file systems take no notice of case.
            if let Some(other) = made
                .keys()
                .find(|other: &&String| other.to_lowercase() == name.to_lowercase())
            {
                return Err(self.description_error(format!("two templates make one file: `{other}` and `{name}`")));
            }
            made.insert(name, text.0);
        }
        Ok(())
    }

    fn template(&self, name: &str) -> Option<&str> {
        if let Some(templates) = &self.templates {
            return templates.get(name).map(String::as_str);
        }
        let (_, sources) = builtin::TEMPLATES.iter().find(|(known, _)| *known == self.name)?;
        sources.iter().find(|(file, _)| *file == name).map(|(_, text)| *text)
    }
}

/// Text of at most [`LONGEST`] bytes.
#[derive(Default)]
struct Bounded(Vec<u8>);

impl Write for Bounded {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0.len() + bytes.len() > LONGEST {
            return Err(io::Error::other(format!("it makes more than {LONGEST} bytes")));
        }
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Returns whether a name stays in its folder on every system: relative, of plain parts, without backslashes or the colons of
/// drives and streams.
pub(crate) fn is_plain(file: &str) -> bool {
    let mut parts = Path::new(file).components();
    let portable = !file.contains(['\\', ':']) && !file.chars().any(char::is_control);
    !file.is_empty() && portable && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// Formats an error of tera, with its place in the template and its cause.
fn describe_error(error: &tera::Error) -> String {
    let said = error.to_string();
    let mut text = said.strip_prefix("error: ").unwrap_or(&said).trim_end().to_owned();
    let mut next = std::error::Error::source(error);
    while let Some(cause) = next {
        text += &format!(": {cause}");
        next = cause.source();
    }
    text
}
