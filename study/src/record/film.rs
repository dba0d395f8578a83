//! Record of a filmed pan.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;
use straightline_table::{Cell, Table};

/// Record of a film: errors of the change between frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilmRecord {
    /// Time, place and method of the run; nothing is timed.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// The scene.
    pub scene: String,
    /// Pixels by which the picture moves from frame to frame, y down.
    pub step: [f32; 2],
    /// The methods, row by row, followed in each frame by the reference of 64 samples a pixel.
    pub methods: Vec<FilmedMethod>,
}

/// A method that was filmed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilmedMethod {
    /// Display name.
    pub method: String,
    /// Options of its kernel that differ from their defaults.
    pub options: Vec<OptionText>,
    /// For each frame after the first: the root mean squared error of the change since the previous frame, in colours of
    /// 0..=1.
    pub errors: Vec<f64>,
}

impl FilmedMethod {
    /// Returns the root mean square over all frames.
    pub fn rms_error(&self) -> f64 {
        let squares: f64 = self.errors.iter().map(|error| error * error).sum();
        (squares / self.errors.len().max(1) as f64).sqrt()
    }
}

impl Record for FilmRecord {
    const STEM: &'static str = "film";

    fn to_table(&self) -> Table {
        let errors = |method: &'_ FilmedMethod| method.errors.clone().into_iter().enumerate();
        let rows = self.methods.iter();
        let rows = rows.flat_map(|method| errors(method).map(move |(k, error)| (method, k + 1, error)));
        Table::of(rows)
            .column("method", |(method, ..)| &method.method)
            .column("frame", |(_, frame, _)| *frame)
            .fixed("error", 4, |(.., error)| *error)
            .finish()
    }
}

impl FilmRecord {
    /// Returns a table with a row for each method.
    pub fn summarise(&self) -> Table {
        let extreme = |method: &FilmedMethod, pick: fn(f64, f64) -> f64| method.errors.iter().copied().reduce(pick);
        let error = |error: Option<f64>| error.map(|error| Cell::fixed(error, 4));
        Table::of(&self.methods)
            .column("method", |method| &method.method)
            .column("error of what changes", |method| error(Some(method.rms_error())))
            .column("least", |method| error(extreme(method, f64::min)))
            .column("most", |method| error(extreme(method, f64::max)))
            .finish()
    }
}
