//! Renders an engine's templates. Nothing of the generator is needed for that.

use crate::engine::Engine;
use crate::error::EngineError;
use crate::{builtin, filters};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Component, Path};
use tera::Tera;

impl Engine {
    /// The files that the templates make of what [`Engine::context`] gives, as JSON; by name.
    ///
    /// # Errors
    ///
    /// A template fails.
    pub fn render(&self, context: Value) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        let context = tera::Context::from_serialize(&context).map_err(|e| self.wrong(e.to_string()))?;
        let mut tera = Tera::default();
        filters::register(&mut tera);
        tera.autoescape_on(Vec::<&str>::new());
        let mut made = BTreeMap::new();
        for (template, file) in &self.description.files {
            let failed = |error: tera::Error| EngineError::Template {
                engine: self.name.clone(),
                template: template.clone(),
                message: causes(&error),
            };
            let source = self.template(template);
            let source = source.ok_or_else(|| self.wrong(format!("there is no template `{template}`")))?;
            tera.add_raw_template(template, source).map_err(failed)?;
            let text = tera.render(template, &context).map_err(failed)?;
            let file = tera.render_str(file, &context, false).map_err(failed)?;
            if !is_plain(&file) {
                return Err(self.wrong(format!("`{file}` is no name of a file in the folder that is written")));
            }
            made.insert(file, text.into_bytes());
        }
        Ok(made)
    }

    fn template(&self, name: &str) -> Option<&str> {
        if let Some(templates) = &self.templates {
            return templates.get(name).map(String::as_str);
        }
        let (_, sources) = builtin::TEMPLATES.iter().find(|(known, _)| *known == self.name)?;
        sources.iter().find(|(file, _)| *file == name).map(|(_, text)| *text)
    }
}

/// Whether a name stays in its folder: relative, without `..`.
fn is_plain(file: &str) -> bool {
    let mut parts = Path::new(file).components();
    !file.is_empty() && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// An error of tera, with its place in the template, and what caused it.
fn causes(error: &tera::Error) -> String {
    let said = error.to_string();
    let mut text = said.strip_prefix("error: ").unwrap_or(&said).trim_end().to_owned();
    let mut next = std::error::Error::source(error);
    while let Some(cause) = next {
        text += &format!(": {cause}");
        next = cause.source();
    }
    text
}
