//! Record of antialiasing methods against references.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Times;
use straightline_kernels::OptionText;

pub use straightline_oracle::metrics::MOST_DB;

/// Kind of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// The shaded picture with one shading sample a pixel, unfiltered.
    None,
    /// Subpixel reconstruction.
    Sraa,
    /// The filters of S.T.A.L.K.E.R. and Tabula Rasa, which look for edges in the G-buffer.
    Edge,
    /// FXAA, SMAA and MLAA, which look for edges in the picture.
    Picture,
    /// More shading samples, or as many coverage samples.
    Supersampling,
    /// A kernel of the user's.
    Own,
}

/// Errors of a method on a scene, against 256 samples a pixel, both as displayed: at 8 bits of sRGB. PSNR over linear RGB
/// clamped to 0..=1, in dB, at most [`MOST_DB`]; `None` for a class without pixels in the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodErrors {
    /// Display name, the same in all scenes.
    pub method: String,
    /// Kind of the method.
    pub family: Family,
    /// Options of its kernel that differ from their defaults.
    pub options: Vec<OptionText>,
    /// PSNR over all pixels.
    pub psnr: f64,
    /// Structural similarity, 1 for equal pictures.
    pub ssim: f64,
    /// Mean FLIP, 0 for equal pictures.
    pub flip: f64,
    /// PSNR over pixels with an edge of geometry.
    pub psnr_geometry: Option<f64>,
    /// PSNR over pixels with an edge of shading but none of geometry.
    pub psnr_shading: Option<f64>,
    /// PSNR over all other pixels.
    pub psnr_flat: Option<f64>,
    /// Error that one pixel in a thousand exceeds: the root mean square over red, green and blue, 0 to 1. `None` in records
    /// from before it was introduced.
    #[serde(default)]
    pub worst: Option<f64>,
    /// Share of the gap between no antialiasing and 16x supersampling, in dB, that the method closes: 0 to 1, more if it is
    /// better than 16x; `None` for a capture, which has no 16x.
    pub gap_closed: Option<f64>,
    /// Root mean squared error of frame differences, over a slow pan; `None` if it was not measured.
    pub temporal: Option<f64>,
    /// Time of the filter alone, without drawing its inputs; `None` for a method that is not a filter.
    pub time: Option<Times>,
    /// Bytes that the method reads and writes: G-buffer, picture and target.
    pub bytes: u64,
    /// Share of the pixels that were shaded once more, 0 to 1; `None` if the method never does that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extra: Option<f64>,
    /// Number of pixels that are not finite.
    pub non_finite: usize,
    /// Picture beside the record, if one was written.
    pub picture: Option<String>,
}

/// Shares of a scene's pixels by class, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shares {
    /// Pixels with an edge of geometry.
    pub geometry: f64,
    /// Pixels with an edge of shading but none of geometry.
    pub shading: f64,
    /// Pixels with neither.
    pub flat: f64,
    /// Pixels with a surface that no shading sample around them saw.
    pub unseen: f64,
}

/// Gap between SRAA and supersampling at the same positions, and its causes. All in dB, at most [`MOST_DB`].
///
/// The ideal reconstruction gives each geometry sample its true colour if one of the 3 x 3 shading samples around saw its
/// surface, and else the colour of the nearest of them. So `bound - ideal` is the price of surfaces that no shading sample
/// saw, and `ideal - psnr` the price of colours borrowed from other points of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// `SRAA 4` or `SRAA 16`.
    pub method: String,
    /// `4x` or `16x`.
    pub bound: String,
    /// PSNR of SRAA.
    pub psnr: f64,
    /// PSNR of the ideal reconstruction.
    pub ideal_psnr: f64,
    /// PSNR of supersampling.
    pub bound_psnr: f64,
    /// PSNR of SRAA over pixels without unseen surfaces; `None` if there are none.
    pub psnr_seen: Option<f64>,
    /// PSNR of supersampling over the same pixels.
    pub bound_psnr_seen: Option<f64>,
    /// Share of SRAA's squared error in pixels with an unseen surface.
    pub error_unseen: f64,
}

/// All methods on a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneErrors {
    /// Name of the scene, or the path of a model or capture.
    pub scene: String,
    /// Purpose of the scene.
    pub purpose: String,
    /// Classes of its pixels.
    pub shares: Shares,
    /// Picture of the reference, if one was written.
    pub reference: Option<String>,
    /// Methods of the scene.
    pub methods: Vec<MethodErrors>,
    /// Missing methods, with the reasons.
    pub absent: Vec<(String, String)>,
    /// Gaps between SRAA and supersampling; empty for a capture.
    pub gaps: Vec<Gap>,
}

/// Record of speed against error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QualityRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Scene on which filters were timed, in turn. A method has the same time in all scenes with the same methods.
    pub timed_on: Vec<String>,
    /// Frames of the pan.
    pub pan_frames: u32,
    /// All scenes.
    pub scenes: Vec<SceneErrors>,
}

impl Record for QualityRecord {
    const STEM: &'static str = "error";

    fn to_table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
        let head = vec![
            "scene",
            "method",
            "family",
            "psnr_db",
            "ssim",
            "flip",
            "psnr_geometry_db",
            "psnr_shading_db",
            "psnr_flat_db",
            "worst",
            "gap_closed",
            "temporal",
            "median_ms",
            "bytes",
            "non_finite",
        ];
        let optional = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.4}"));
        let rows = self.scenes.iter().flat_map(|scene| {
            scene.methods.iter().map(move |m| {
                vec![
                    scene.scene.clone(),
                    m.method.clone(),
                    super::json_name(&m.family),
                    format!("{:.4}", m.psnr),
                    format!("{:.6}", m.ssim),
                    format!("{:.6}", m.flip),
                    optional(m.psnr_geometry),
                    optional(m.psnr_shading),
                    optional(m.psnr_flat),
                    optional(m.worst),
                    optional(m.gap_closed),
                    m.temporal.map_or(String::new(), |v| format!("{v:.4e}")),
                    optional(m.time.map(|t| t.median_ms)),
                    m.bytes.to_string(),
                    m.non_finite.to_string(),
                ]
            })
        });
        (head, rows.collect())
    }
}
