//! Record of the time of a whole frame against its error.

use super::{Circumstances, Family, Record, format_megabytes, join_options};
use crate::statistics::Interval;
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;
use straightline_table::{Cell, Column, Table, TableBuilder};

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
    pub ms: Interval,
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

    /// Formats a tidy table: a row for each method and cost of shading.
    fn to_table(&self) -> Table {
        let rows = self.methods.iter();
        let rows = rows.flat_map(|method| {
            method
                .frames
                .iter()
                .zip(&self.shading_ms)
                .map(move |cost| (method, cost))
        });
        let table = Table::of(rows).column("method", |(method, _)| &method.method);
        parts_of_frames(table, |(method, _)| method)
            .fixed("shading_ms", 1, |(_, (_, ms))| **ms)
            .fixed("frame_ms", 1, |(_, (frame, _))| frame.ms)
            .column("best", |(_, (frame, _))| frame.is_best)
            .finish()
    }
}

/// Adds the columns of a method that do not depend on the cost of shading.
fn parts_of_frames<R>(table: TableBuilder<R>, method: impl Fn(&R) -> &FrameMethod + Copy) -> TableBuilder<R> {
    table
        .column(Column::exact("options"), |row| join_options(&method(row).options))
        .fixed("error", 4, |row| method(row).error)
        .fixed(("psnr_db", "PSNR"), 2, |row| method(row).psnr)
        .fixed(("geometry_ms", "geometry, ms"), 1, |row| method(row).geometry_ms)
        .column(("shading_samples", "shading samples"), |row| method(row).shaded)
        .fixed(("filter_ms", "filter, ms"), 1, |row| method(row).filter_ms)
        .column(("bytes", "MB"), |row| format_megabytes(method(row).bytes, 0))
}

impl FrameRecord {
    /// Returns a table with a row for each method, and `best` beside frames that no other beats.
    pub fn summarise(&self, best: &str) -> Table {
        let table = Table::of(&self.methods).column("method", |method| &method.method);
        parts_of_frames(table, |method| method)
            .columns(
                self.shading_ms.iter().enumerate(),
                |(_, ms)| Column::shown(format!("frame at {ms} ms")),
                |method, (k, _)| {
                    let frame = method.frames[*k];
                    Cell::fixed(frame.ms, 1).suffixed(if frame.is_best { best } else { "" })
                },
            )
            .finish()
    }
}
