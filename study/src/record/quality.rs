//! Record of antialiasing methods against references.

use super::{Circumstances, Record, format_megabytes, join_options};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Times;
use straightline_kernels::OptionText;
use straightline_table::{Cell, Column, Table};

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

    fn to_table(&self) -> Table {
        self.tabulate(&self.scenes)
    }
}

impl QualityRecord {
    /// Returns the table of some of the scenes.
    pub fn tabulate<'r>(&self, scenes: impl IntoIterator<Item = &'r SceneErrors>) -> Table {
        let rows = scenes.into_iter();
        let rows = rows.flat_map(|scene| scene.methods.iter().map(move |method| (&scene.scene, method)));
        let share = |share: Option<f64>, decimals| share.map(|share| Cell::percent(share, decimals));
        Table::of(rows)
            .column("scene", |(scene, _)| *scene)
            .column("method", |(_, m)| &m.method)
            .column(Column::exact("family"), |(_, m)| super::json_name(&m.family))
            .column(Column::from("options").left(), |(_, m)| {
                Cell::code(join_options(&m.options))
            })
            .column(("psnr_db", "PSNR"), |(_, m)| format_decibels(m.psnr))
            .fixed(("ssim", "SSIM"), 4, |(_, m)| m.ssim)
            .fixed(("flip", "FLIP"), 4, |(_, m)| m.flip)
            .column(("psnr_geometry_db", "geometry"), |(_, m)| {
                m.psnr_geometry.map(format_decibels)
            })
            .column(("psnr_shading_db", "shading"), |(_, m)| {
                m.psnr_shading.map(format_decibels)
            })
            .column(("psnr_flat_db", "flat"), |(_, m)| m.psnr_flat.map(format_decibels))
            .fixed(Column::exact("worst"), 4, |(_, m)| m.worst)
            .column(("gap_closed", "of 16x"), |(_, m)| share(m.gap_closed, 0))
            .fixed(("temporal", "pan"), 4, |(_, m)| m.temporal)
            .column(("median_ms", "ms"), |(_, m)| {
                m.time.as_ref().map(|time| Cell::fixed(time.median_ms, 2))
            })
            .column(("bytes", "MB"), |(_, m)| format_megabytes(m.bytes, 1))
            .column(Column::exact("shaded_again"), |(_, m)| share(m.extra, 2))
            .column(("non_finite", "not finite"), |(_, m)| m.non_finite)
            .finish()
    }
}

impl MethodErrors {
    /// Returns the median milliseconds of the filter.
    pub fn median_ms(&self) -> Option<f64> {
        self.time.as_ref().map(|time| time.median_ms)
    }

    /// Returns the bytes that the method reads and writes, in millions.
    pub fn megabytes(&self) -> Option<f64> {
        Some(self.bytes as f64 / 1e6)
    }
}

/// Returns a PSNR as a cell.
pub(crate) fn format_decibels(psnr: f64) -> Cell {
    let cell = Cell::fixed(psnr, 2);
    match psnr < MOST_DB {
        true => cell,
        false => cell.shown_as("∞"),
    }
}
