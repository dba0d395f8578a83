//! An engine of the user's own: a folder with an `engine.toml` and the templates that it names.
//!
//! A folder may come from anyone, so what it can make the generator do is bounded: it reads nothing outside of the folder,
//! it has a limit of bytes to read and to write, and its templates a limit of time.

use crate::description::Description;
use crate::engine::Engine;
use crate::error::EngineError;
use crate::render::{self, Sheet};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;
use straightline_codegen::files;

/// Bytes that one file of a folder may have.
const LONGEST_FILE: u64 = 1 << 20;

/// Bytes that all templates of a folder may have together.
const LONGEST_FOLDER: usize = 8 << 20;

/// Time that the templates of a folder have; those of the built-in engines take some milliseconds.
const LONGEST_TIME: Duration = Duration::from_secs(10);

impl Engine {
    /// The engine in a folder: `engine.toml`, and the templates that it names.
    pub(crate) fn from_folder(folder: &Path) -> Result<Engine, EngineError> {
        let name = folder
            .file_name()
            .map_or_else(|| "engine".into(), |name| name.to_string_lossy());
        let wrong = |message: String| EngineError::Description {
            engine: name.clone().into_owned(),
            message,
        };
        let description = read_file(folder, "engine.toml")?;
        let description = Description::from_toml(&description).map_err(wrong)?;
        let mut templates = BTreeMap::new();
        let mut bytes = 0;
        for template in description.templates() {
            if !render::is_plain(template) {
                return Err(wrong(format!("`{template}` is no name of a template in its folder")));
            }
            let text = read_file(folder, template)?;
            bytes += text.len();
            if bytes > LONGEST_FOLDER {
                return Err(wrong(format!("its templates have more than {LONGEST_FOLDER} bytes")));
            }
            templates.insert(template.clone(), text);
        }
        Ok(Engine {
            name: name.into_owned(),
            description,
            templates: Some(templates),
        })
    }

    /// Renders in a thread of its own, which is left behind when the time is over.
    pub(crate) fn render_within_time(&self, sheets: Vec<Sheet>) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        let (sender, receiver) = mpsc::channel();
        let engine = self.clone();
        let work = move || {
            // The receiver is gone where the time is over.
            let _ = sender.send(engine.render_now(&sheets));
        };
        let started = std::thread::Builder::new().name("templates".to_owned()).spawn(work);
        started.map_err(|why| self.description_error(format!("no thread can be started for its templates: {why}")))?;
        receiver.recv_timeout(LONGEST_TIME).unwrap_or_else(|end| {
            Err(match end {
                mpsc::RecvTimeoutError::Timeout => EngineError::Endless {
                    engine: self.name.clone(),
                    seconds: LONGEST_TIME.as_secs(),
                },
                mpsc::RecvTimeoutError::Disconnected => {
                    self.description_error("its templates made the renderer panic".to_owned())
                }
            })
        })
    }
}

/// Reads a file of the folder. A link that leads out of it is refused.
fn read_file(folder: &Path, file: &str) -> Result<String, EngineError> {
    let path = folder.join(file);
    let text = || {
        if !path.canonicalize()?.starts_with(folder.canonicalize()?) {
            let outside = "it is a link out of the engine's folder, which must hold all that the engine needs";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, outside));
        }
        files::read_text(&path, LONGEST_FILE)
    };
    text().map_err(|source| EngineError::Read {
        path: path.clone(),
        source,
    })
}
