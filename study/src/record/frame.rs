//! Record of the time of a whole frame against its error.

use super::{Circumstances, Family, Record};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Quartiles;
use straightline_kernels::OptionText;

/// Passes of a frame of one scene, as part of the output of `budget --record`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PassTimes {
    /// Circumstances of the timing.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Name of the scene, or the path of a model.
    pub scene: String,
    /// Every timed pass.
    pub passes: Vec<TimedPass>,
}

/// A pass of a frame.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct TimedPass {
    /// Purpose of the pass: `main G-buffer`, `depth and normals`, `deferred shading`, `box filter`.
    pub name: String,
    /// Samples of each pixel.
    pub samples: u32,
    /// Time in milliseconds.
    pub ms: Quartiles,
}

/// A method with the parts of its frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameMethod {
    /// Name, as in the record of errors.
    pub method: String,
    /// Kind of method.
    pub family: Family,
    /// Options of its kernel that differ from their defaults.
    pub options: Vec<OptionText>,
    /// Median milliseconds to draw geometry, including further samples of the G-buffer.
    pub geometry_ms: f64,
    /// Shading samples a pixel.
    pub shaded: u32,
    /// Median milliseconds of the filter or the box filter; 0 without one.
    pub filter_ms: f64,
    /// Peak signal-to-noise ratio against 256 samples a pixel, in dB.
    pub psnr: f64,
    /// Root mean squared error, in colours of 0..=1.
    pub error: f64,
    /// Bytes of G-buffer, picture and target.
    pub bytes: u64,
    /// Frames at each of [`FrameRecord::shading_ms`].
    pub frames: Vec<Frame>,
}

/// A frame at one cost of shading.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Total milliseconds: the sum of the parts' medians.
    pub ms: f64,
    /// `true` on the front: no method takes as little time with a smaller error.
    pub is_best: bool,
}

/// Time of a whole frame against its error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameRecord {
    /// Command that combined this record from two others.
    pub command: String,
    /// Circumstances of the passes.
    pub passes: Circumstances,
    /// Circumstances of filters and errors.
    pub errors: Circumstances,
    /// Scene of both.
    pub scene: String,
    /// Costs of shading one sample of every pixel, in milliseconds.
    pub shading_ms: Vec<f64>,
    /// Shading cost of the passes themselves.
    pub own_shading_ms: f64,
    /// Methods, by error.
    pub methods: Vec<FrameMethod>,
    /// Omitted methods, with the reasons.
    pub absent: Vec<(String, String)>,
}

impl Record for FrameRecord {
    const STEM: &'static str = "frame";

    fn to_table(&self) -> (Vec<&str>, Vec<Vec<String>>) {
        let head = vec![
            "method",
            "options",
            "psnr_db",
            "error",
            "geometry_ms",
            "shading_samples",
            "filter_ms",
            "bytes",
            "shading_ms",
            "frame_ms",
            "best",
        ];
        let rows = self.methods.iter().flat_map(|m| {
            let options: Vec<String> = m.options.iter().map(|(k, v)| format!("{k}={v}")).collect();
            m.frames.iter().zip(&self.shading_ms).map(move |(frame, shading)| {
                vec![
                    m.method.clone(),
                    options.join(" "),
                    format!("{:.3}", m.psnr),
                    format!("{:.6}", m.error),
                    format!("{:.3}", m.geometry_ms),
                    m.shaded.to_string(),
                    format!("{:.3}", m.filter_ms),
                    m.bytes.to_string(),
                    shading.to_string(),
                    format!("{:.3}", frame.ms),
                    frame.is_best.to_string(),
                ]
            })
        });
        (head, rows.collect())
    }
}
