//! Frames of a pan.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;

/// Record of a film: errors in the changes from a frame to the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilmRecord {
    /// When, where and how it was made; nothing is timed.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// The scene.
    pub scene: String,
    /// Pixels that the picture moves from a frame to the next, y down.
    pub step: [f32; 2],
    /// The methods, row by row; behind them in each frame is the reference of 64 samples a pixel.
    pub methods: Vec<FilmedMethod>,
}

/// A method that was filmed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilmedMethod {
    /// A name for people.
    pub method: String,
    /// Options of its kernel that are not the default.
    pub options: Vec<OptionText>,
    /// For each frame after the first: the root of the mean squared error of what changed since the last, in colours of 0..=1.
    pub errors: Vec<f64>,
}

impl FilmedMethod {
    /// Over all frames: the root of their mean square.
    pub fn rms_error(&self) -> f64 {
        let squares: f64 = self.errors.iter().map(|error| error * error).sum();
        (squares / self.errors.len().max(1) as f64).sqrt()
    }
}

impl Record for FilmRecord {
    const STEM: &'static str = "film";

    fn to_table(&self) -> (Vec<&str>, Vec<Vec<String>>) {
        let rows = self.methods.iter().flat_map(|method| {
            let errors = method.errors.iter().enumerate();
            errors.map(|(k, error)| vec![method.method.clone(), (k + 1).to_string(), error.to_string()])
        });
        (vec!["method", "frame", "error"], rows.collect())
    }
}
