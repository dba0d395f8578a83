//! Time of a whole frame against its error.

use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::quality::{color_index, family_legend};
use super::{ReportError, format_caption};
use crate::record::{FrameMethod, FrameRecord};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Frames {
    scene: String,
    legend: Vec<(&'static str, &'static str)>,
    panels: Vec<Panel>,
    table: String,
    absent: Vec<(String, String)>,
    passes: String,
    errors: String,
}

/// The frames at one cost of shading.
#[derive(Debug, Serialize)]
struct Panel {
    title: String,
    plot: String,
}

/// Methods that all have their names beside them.
const FEW: usize = 16;

/// Errors are shown in thousandths, which have short labels.
const THOUSANDTHS: f64 = 1000.0;

pub(super) fn build_section(record: &FrameRecord) -> Result<Frames, ReportError> {
    let panels = record.shading_ms.iter().enumerate().map(|(k, ms)| {
        Ok(Panel {
            title: format!("Shading one sample of every pixel takes {} ms", format_number(*ms)),
            plot: plot_frames(record, k, (980, 440))?,
        })
    });
    Ok(Frames {
        scene: record.scene.clone(),
        legend: family_legend(|family| record.methods.iter().any(|method| method.family == family)),
        panels: panels.collect::<Result<_, ReportError>>()?,
        table: record.summarise(" ●").to_html(),
        absent: record.absent.clone(),
        passes: format_caption(&record.passes),
        errors: format_caption(&record.errors),
    })
}

/// The frames at the cost of shading number `cost`, as an SVG of so many pixels.
///
/// # Errors
///
/// [`ReportError::Plot`], if there are none.
pub fn plot_frames(record: &FrameRecord, cost: usize, size: (u32, u32)) -> Result<String, ReportError> {
    let shown: Vec<&FrameMethod> = record.methods.iter().filter(|m| m.psnr.is_finite()).collect();
    let mut front: Vec<(f64, f64)> = shown
        .iter()
        .filter(|m| m.frames[cost].is_best)
        .map(|m| (m.frames[cost].ms, THOUSANDTHS * m.error))
        .collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Of many methods those on the front and those that people know have names; others say theirs when they are pointed at.
    let is_named = |m: &FrameMethod| shown.len() <= FEW || m.frames[cost].is_best || m.options.is_empty();
    let dots = shown.iter().map(|m| Dot {
        at: (m.frames[cost].ms, THOUSANDTHS * m.error),
        spread: None,
        color: color_index(m.family),
        label: is_named(m).then(|| m.method.clone()),
        title: method_title(m, cost),
    });
    let plot = Plot {
        size,
        axes: (
            "time of the frame in ms".to_owned(),
            "RMS error in thousandths of white".to_owned(),
        ),
        scales: (Scale::Log, Scale::Log),
        across: true,
        dots: dots.collect(),
        lines: vec![Line {
            points: front,
            color: 5,
            dashed: false,
            label: None,
        }],
    };
    plot.to_svg()
}

fn method_title(method: &FrameMethod, cost: usize) -> String {
    format!(
        "{}: {} ms a frame (geometry {}, {} shading samples, filter {}), error {:.4}, {:.2} dB, {:.0} MB",
        method.method,
        format_number(method.frames[cost].ms),
        format_number(method.geometry_ms),
        method.shaded,
        format_number(method.filter_ms),
        method.error,
        method.psnr,
        method.bytes as f64 / 1e6
    )
}
