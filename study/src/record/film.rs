//! Record of a filmed pan.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;

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

    fn to_table(&self) -> (Vec<&str>, Vec<Vec<String>>) {
        let rows = self.methods.iter().flat_map(|method| {
            let errors = method.errors.iter().enumerate();
            errors.map(|(k, error)| vec![method.method.clone(), (k + 1).to_string(), error.to_string()])
        });
        (vec!["method", "frame", "error"], rows.collect())
    }
}
