//! What a study found, as files: JSON with its circumstances, CSV beside it. `README.md` and the report cite these.

mod hard;
mod loops;
mod quality;
mod tune;

use crate::execute::Clock;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

pub use hard::{Executor, HalfVerdict, HardCase, HardRecord, HardResult};
pub use loops::{Form, FormKind, KernelForms, LoopsRecord};
pub use quality::{Family, Gap, MOST_DB, MethodErrors, QualityRecord, SceneErrors, Shares};
pub use tune::{Candidate, LeftOut, Model, Refused, TermWorth, TuneRecord};

/// Under which circumstances figures were taken: without these a figure says nothing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Circumstances {
    /// The command that takes them again.
    pub command: String,
    /// When it began: RFC 3339, UTC.
    pub date: String,
    /// Adapter, driver with its version, and backend.
    pub adapter: String,
    /// What the processor is called, and how many threads it runs: on software drivers it is the GPU.
    pub processor: String,
    /// What times were taken with.
    pub clock: Clock,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rounds of timing; each ran every shader once, in turn.
    pub rounds: u32,
    /// Whether all was measured that was asked for, or the run was interrupted.
    pub complete: bool,
}

/// A study's result that can be written as JSON and CSV, and be read again.
pub trait Record: Serialize + DeserializeOwned {
    /// Stem of its files' names.
    const STEM: &'static str;

    /// Headings of the table, and its rows.
    fn table(&self) -> (Vec<&'static str>, Vec<Vec<String>>);

    /// Writes `STEM.json` and `STEM.csv` into `folder`, which is made if it is not there. Each is whole or as it was before.
    ///
    /// # Errors
    ///
    /// [`RecordError`] names the file.
    fn write(&self, folder: &Path) -> Result<(), RecordError> {
        self.write_as(folder, Self::STEM)
    }

    /// [`write`](Self::write), with another stem: for several records of one kind in a folder.
    ///
    /// # Errors
    ///
    /// [`RecordError`] names the file.
    fn write_as(&self, folder: &Path, stem: &str) -> Result<(), RecordError> {
        std::fs::create_dir_all(folder).map_err(|source| RecordError::file("make", folder, source))?;
        let mut json = serde_json::to_vec_pretty(self).map_err(|source| RecordError::Json {
            path: folder.join(format!("{stem}.json")),
            source,
        })?;
        json.push(b'\n');
        whole(&folder.join(format!("{stem}.json")), &json)?;
        whole(&folder.join(format!("{stem}.csv")), self.csv().as_bytes())
    }

    /// Reads a record from a JSON file.
    ///
    /// # Errors
    ///
    /// [`RecordError`] names the file and what is wrong in it.
    fn read(path: &Path) -> Result<Self, RecordError> {
        let text = std::fs::read(path).map_err(|source| RecordError::file("read", path, source))?;
        serde_json::from_slice(&text).map_err(|source| RecordError::Json {
            path: path.to_owned(),
            source,
        })
    }

    /// The table as CSV (RFC 4180).
    fn csv(&self) -> String {
        let quoted = |cell: &str| match cell.contains(['"', ',', '\n']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell.to_owned(),
        };
        let (head, rows) = self.table();
        let mut text = head.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\n";
        for row in rows {
            text += &row.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",");
            text.push('\n');
        }
        text
    }
}

/// Why a record could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file system says no.
    #[error("cannot {doing} `{}`: {source}", path.display())]
    File {
        /// `read`, `write` or `make`.
        doing: &'static str,
        /// Which file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The text is no such record.
    #[error("`{}` is not a record of this study: {source}; run the study again", path.display())]
    Json {
        /// Which file.
        path: PathBuf,
        /// What and where.
        source: serde_json::Error,
    },
}

impl RecordError {
    fn file(doing: &'static str, path: &Path, source: std::io::Error) -> RecordError {
        RecordError::File {
            doing,
            path: path.to_owned(),
            source,
        }
    }
}

/// Writes a file by way of another, so that an interrupted run leaves the old one whole.
pub fn whole(path: &Path, contents: &[u8]) -> Result<(), RecordError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    std::fs::write(&part, contents)
        .and_then(|()| std::fs::rename(&part, path))
        .map_err(|source| RecordError::file("write", path, source))
}

/// Who is told how far a study is, and says whether to stop.
pub trait Watch {
    /// `steps` steps of `what` come next.
    fn begin(&mut self, what: &str, steps: usize);
    /// One of them is done.
    fn step(&mut self);
    /// Whether to stop at once, and keep what was measured.
    fn stopped(&self) -> bool;
}

/// Nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn begin(&mut self, _: &str, _: usize) {}
    fn step(&mut self) {}
    fn stopped(&self) -> bool {
        false
    }
}

/// What a value is called in JSON.
pub(crate) fn name(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(text)) => text,
        Ok(other) => other.to_string(),
        Err(_) => String::new(),
    }
}
