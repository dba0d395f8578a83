//! Methods of antialiasing against references.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Times;
use straightline_kernels::OptionText;

pub use straightline_oracle::metrics::MOST_DB;

/// Kind of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// The shaded picture, one shading sample a pixel, as it is.
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

/// Errors of a method on a scene, against 256 samples a pixel, both as a display shows them: at 8 bits of sRGB. PSNR over linear RGB clamped to 0..=1, in dB, at most
/// [`MOST_DB`]; a class of pixels that the scene has none of has `None`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodErrors {
    /// A name for people, the same in all scenes.
    pub method: String,
    /// Kind of the method.
    pub family: Family,
    /// Options of its kernel that are not the default.
    pub options: Vec<OptionText>,
    /// All pixels.
    pub psnr: f64,
    /// Structural similarity, 1 for equal pictures.
    pub ssim: f64,
    /// Mean FLIP, 0 for equal pictures.
    pub flip: f64,
    /// Pixels with an edge of geometry in them.
    pub psnr_geometry: Option<f64>,
    /// Pixels with an edge of shading and none of geometry.
    pub psnr_shading: Option<f64>,
    /// All others.
    pub psnr_flat: Option<f64>,
    /// The error that one pixel in a thousand exceeds: the root of the mean square of what red, green and blue are off, 0 to 1. Records of before
    /// it was taken have `None`.
    #[serde(default)]
    pub worst: Option<f64>,
    /// Share of the gap between no antialiasing and 16x supersampling, in dB, that it closes: 0 to 1, more if it is better;
    /// `None` of a capture, which has no 16x.
    pub gap_closed: Option<f64>,
    /// Root of the mean squared error of frame differences, over a slow pan; `None` where it was not taken.
    pub temporal: Option<f64>,
    /// Time of the filter alone, without what it reads being drawn; `None` for what is not a filter.
    pub time: Option<Times>,
    /// Bytes of what it reads and writes: G-buffer, picture and target.
    pub bytes: u64,
    /// Share of the pixels that were shaded once more, 0 to 1; `None` where none may be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extra: Option<f64>,
    /// Pixels that are not finite.
    pub non_finite: usize,
    /// Picture beside the record, if one was written.
    pub picture: Option<String>,
}

/// Shares of a scene's pixels, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shares {
    /// With an edge of geometry in them.
    pub geometry: f64,
    /// With an edge of shading and none of geometry.
    pub shading: f64,
    /// With neither.
    pub flat: f64,
    /// With a surface in them that no shading sample around them saw.
    pub unseen: f64,
}

/// Gap between SRAA and supersampling at the same places, and its causes. All in dB, at most [`MOST_DB`].
///
/// The ideal reconstruction gives each geometry sample its true colour if one of the 3 x 3 shading samples around saw its
/// surface, and else the colour of the nearest of them. So `bound - ideal` is the price of surfaces that no shading sample
/// saw, and `ideal - psnr` the price of colours that are borrowed from other places of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// `SRAA 4` or `SRAA 16`.
    pub method: String,
    /// `4x` or `16x`.
    pub bound: String,
    /// Of SRAA.
    pub psnr: f64,
    /// Of the ideal reconstruction.
    pub ideal_psnr: f64,
    /// Of supersampling.
    pub bound_psnr: f64,
    /// Of SRAA, without the pixels of which a surface was not seen; `None` if that leaves none.
    pub psnr_seen: Option<f64>,
    /// Of supersampling, without them.
    pub bound_psnr_seen: Option<f64>,
    /// Share of SRAA's squared error that is in pixels of which a surface was not seen.
    pub error_unseen: f64,
}

/// All methods on a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneErrors {
    /// Name of the scene, or the path of a model or capture.
    pub scene: String,
    /// Purpose of the scene.
    pub purpose: String,
    /// Kinds of its pixels.
    pub shares: Shares,
    /// Picture of the reference, if one was written.
    pub reference: Option<String>,
    /// Methods of the scene.
    pub methods: Vec<MethodErrors>,
    /// Methods that it has not, and why.
    pub absent: Vec<(String, String)>,
    /// Gaps between SRAA and supersampling; none of a capture.
    pub gaps: Vec<Gap>,
}

/// Speed against error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QualityRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// The scene that filters were timed on, in turn; a method has the same time in all scenes of the same methods.
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
