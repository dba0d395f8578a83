//! Results of studies as files: JSON with its circumstances, and CSV. `README.md` and the report cite these.

mod chains;
mod film;
mod form;
mod frame;
mod hard;
mod isa;
mod loops;
mod motion;
mod precision;
mod quads;
mod quality;
mod sweep;
mod tune;

use flate2::read::GzDecoder;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use straightline_bench::execute::Clock;
use straightline_codegen::files;
use straightline_kernels::OptionText;
use straightline_table::{Cell, Table};

pub use chains::{ChainForm, ChainForms, ChainsRecord};
pub use film::{FilmRecord, FilmedMethod};
pub use form::FormKind;
pub use frame::{Frame, FrameMethod, FrameRecord, PassTimes, TimedPass};
pub use hard::{Executor, HalfVerdict, HardCase, HardRecord, HardResult};
pub use isa::{Asked, IsaRecord, SpirvPath};
pub use loops::{FormRecord, KernelForms, LoopsRecord};
pub use motion::{Motion, MotionRecord, MovedMethod, MovedScene};
pub use precision::{Lowered, PrecisionRecord, Proposal};
pub use quads::{QuadWay, QuadsRecord};
pub(crate) use quality::format_decibels;
pub use quality::{Family, Gap, MOST_DB, MethodErrors, QualityRecord, SceneErrors, Shares};
pub use sweep::{Environment, MachineFigures, Measured, Shard, SweepRecord, Swept};
pub use tune::{Candidate, LeftOut, Model, Refused, TermWorth, TuneRecord};

/// Circumstances of a measurement, without which its numbers have no meaning.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Circumstances {
    /// Command that reproduces the measurement.
    pub command: String,
    /// Start of the run: RFC 3339, UTC.
    pub date: String,
    /// Adapter, driver with its version, and backend.
    pub adapter: String,
    /// Name of the processor and its number of threads. With a software driver, it is also the GPU.
    pub processor: String,
    /// Clock that took the times: `gpu-timestamps` around each pass, or the `wall-clock`.
    #[schemars(with = "String")]
    pub clock: Clock,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rounds of timing; each ran every shader once, in turn.
    pub rounds: u32,
    /// Kind of the record's intervals.
    #[serde(default)]
    pub intervals: IntervalKind,
    /// `true` if everything requested was measured, `false` if the run was interrupted.
    pub complete: bool,
}

/// Kind of the intervals of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum IntervalKind {
    /// Kinds of earlier records: of times the extremes, of ratios the span of eight rounds in ten, of frames the quartiles, of
    /// sweeps and quads 95 % by single rounds.
    #[default]
    Earlier,
    /// 95 %, by a bootstrap of blocks of rounds.
    Blocks,
}

impl IntervalKind {
    /// Name for readers.
    pub fn display_name(self) -> &'static str {
        match self {
            IntervalKind::Earlier => "intervals: eight rounds in ten, of frames the quartiles",
            IntervalKind::Blocks => "intervals: 95 %, by blocks of rounds",
        }
    }
}

/// Maximum size of a record that is read, in bytes.
const MAX_RECORD: u64 = 1 << 28;

/// A study's result that can be written as JSON and CSV, and read back.
pub trait Record: Serialize + DeserializeOwned {
    /// Stem of the files' names.
    const STEM: &'static str;

    /// Returns the results as a table.
    fn to_table(&self) -> Table;

    /// Writes `STEM.json` and `STEM.csv` into `folder`, which is created if missing. Each file is either complete or
    /// unchanged.
    ///
    /// # Errors
    ///
    /// [`RecordError`] names the file or folder.
    fn write(&self, folder: &Path) -> Result<(), RecordError> {
        self.write_as(folder, Self::STEM)
    }

    /// Writes the record as [`write`](Self::write) with another stem, for several records of one kind in a folder.
    ///
    /// # Errors
    ///
    /// [`RecordError`] names the file.
    fn write_as(&self, folder: &Path, stem: &str) -> Result<(), RecordError> {
        files::write_all(folder, &self.to_files(stem)?)?;
        Ok(())
    }

    /// Returns the files of the record by name, with a stem, for a set that is written as a whole.
    ///
    /// # Errors
    ///
    /// [`RecordError::Json`].
    fn to_files(&self, stem: &str) -> Result<BTreeMap<String, Vec<u8>>, RecordError> {
        let [json, csv] = ["json", "csv"].map(|extension| format!("{stem}.{extension}"));
        let mut text = serde_json::to_vec_pretty(self).map_err(|source| RecordError::Json {
            path: PathBuf::from(&json),
            source,
        })?;
        text.push(b'\n');
        Ok(BTreeMap::from([
            (json, text),
            (csv, self.to_table().to_csv().into_bytes()),
        ]))
    }

    /// Reads a record from a JSON file, which may be compressed ([`read_file`]).
    ///
    /// # Errors
    ///
    /// [`RecordError`] names the file and the error in it.
    fn read(path: &Path) -> Result<Self, RecordError> {
        let text = read_file(path)?;
        serde_json::from_slice(&text).map_err(|source| RecordError::Json {
            path: path.to_owned(),
            source,
        })
    }
}

/// Reason why a record could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file cannot be read.
    #[error("cannot read `{}`: {source}", path.display())]
    Read {
        /// The record's file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The record cannot be written.
    #[error(transparent)]
    Write(#[from] files::WriteError),
    /// The text is not a record of this kind.
    #[error("`{}` is not a record of this study: {source}; run the study again", path.display())]
    Json {
        /// The record's file.
        path: PathBuf,
        /// Description of the error, with its place.
        source: serde_json::Error,
    },
}

/// Reads the contents of a record's file; a `.gz` file is decompressed, as long records are stored that way.
///
/// # Errors
///
/// [`RecordError::Read`], also if the contents are longer than 256 MiB, compressed or not.
pub fn read_file(path: &Path) -> Result<Vec<u8>, RecordError> {
    let refused = |source| RecordError::Read {
        path: path.to_owned(),
        source,
    };
    let bytes = files::read_file(path, MAX_RECORD).map_err(refused)?;
    if path.extension().is_none_or(|extension| extension != "gz") {
        return Ok(bytes);
    }
    let mut text = Vec::new();
    let mut unpacked = GzDecoder::new(bytes.as_slice()).take(MAX_RECORD + 1);
    unpacked.read_to_end(&mut text).map_err(refused)?;
    match text.len() as u64 > MAX_RECORD {
        true => Err(refused(std::io::Error::other(format!(
            "it unpacks to more than {MAX_RECORD} bytes"
        )))),
        false => Ok(text),
    }
}

/// Returns the name of a value in JSON.
pub(crate) fn json_name(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(text)) => text,
        Ok(other) => other.to_string(),
        Err(_) => String::new(),
    }
}

/// Returns options as on a command line.
pub fn join_options(options: &[OptionText]) -> String {
    let words: Vec<String> = options.iter().map(|(name, value)| format!("{name}={value}")).collect();
    words.join(" ")
}

/// Returns bytes as a cell: for readers in millions, with this many decimals.
pub(crate) fn format_megabytes(bytes: u64, decimals: usize) -> Cell {
    Cell::new(bytes.to_string(), format!("{:.decimals$}", bytes as f64 / 1e6))
}
