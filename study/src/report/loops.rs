//! Unroll against loop.

use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::{ReportError, format_caption, format_options};
use crate::record::{FormKind, FormRecord, KernelForms, LoopsRecord};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Loops {
    caption: String,
    /// Ratios of all kernels.
    overview: String,
    /// Ratio by form, a line for each kernel.
    curves: String,
    legend: Vec<(&'static str, &'static str)>,
    kernels: Vec<Kernel>,
}

#[derive(Debug, Serialize)]
struct Kernel {
    name: String,
    options: String,
    input: String,
    rows: Vec<Row>,
    absent: Vec<(&'static str, String)>,
}

#[derive(Debug, Serialize)]
struct Row {
    form: &'static str,
    time: String,
    spread: String,
    ratio: String,
    ratio_spread: String,
    pipeline: String,
    loops: u32,
    statements: u32,
    reads: u32,
    spirv: String,
    error: String,
    largest: String,
}

/// Index of a form's colour.
fn color_index(kind: FormKind) -> usize {
    match kind {
        FormKind::Full => 0,
        FormKind::LoopedByHandUnchecked => 1,
        FormKind::FullBlock => 2,
        FormKind::Partial4 => 3,
        FormKind::LoopedByHand => 4,
        FormKind::LoopedUnchecked => 5,
        FormKind::FullUnshared => 6,
        FormKind::Looped | FormKind::Floor => 7,
        FormKind::FullHalf => 8,
        FormKind::Partial2 => 9,
        FormKind::FullTile | FormKind::FullGather | FormKind::FullFast => 10,
    }
}

pub(super) fn build_section(record: &LoopsRecord) -> Result<Loops, ReportError> {
    let shown = FormKind::ALL.into_iter().filter(|kind| *kind != FormKind::Looped);
    Ok(Loops {
        caption: format_caption(&record.circumstances),
        overview: plot_overview(record)?,
        curves: plot_curves(record)?,
        legend: shown
            .map(|kind| (kind.display_name(), super::plot::COLORS[color_index(kind)]))
            .collect(),
        kernels: record.kernels.iter().map(build_kernel).collect(),
    })
}

fn plot_overview(record: &LoopsRecord) -> Result<String, ReportError> {
    let count = record.kernels.len();
    let mut dots = Vec::new();
    for (row, kernel) in record.kernels.iter().enumerate() {
        for form in kernel.forms.iter().filter(|form| form.kind != FormKind::Looped) {
            dots.push(Dot {
                at: (form.ratio.median, (count - 1 - row) as f64),
                spread: Some((form.ratio.low, form.ratio.high)),
                color: color_index(form.kind),
                label: None,
                title: format!(
                    "{}, {}: {}× as fast as looped ({} to {}), {} ms",
                    kernel.kernel,
                    form.kind.display_name(),
                    format_number(form.ratio.median),
                    format_number(form.ratio.low),
                    format_number(form.ratio.high),
                    format_number(form.time.median_ms)
                ),
            });
        }
    }
    let one = Line {
        points: vec![(1.0, -0.5), (1.0, count as f64 - 0.5)],
        color: 7,
        dashed: true,
        label: None,
    };
    let plot = Plot {
        size: (980, 70 + 34 * count as u32),
        axes: ("speedup over the loop, as wgpu compiles it".to_owned(), String::new()),
        scales: (
            Scale::Log,
            Scale::Names(record.kernels.iter().rev().map(|k| k.kernel.clone()).collect()),
        ),
        across: true,
        dots,
        lines: vec![one],
    };
    plot.to_svg()
}

fn plot_curves(record: &LoopsRecord) -> Result<String, ReportError> {
    const STEPS: [FormKind; 6] = [
        FormKind::Looped,
        FormKind::Partial2,
        FormKind::Partial4,
        FormKind::FullUnshared,
        FormKind::Full,
        FormKind::FullBlock,
    ];
    let mut lines = Vec::new();
    let mut dots = Vec::new();
    for (index, kernel) in record.kernels.iter().enumerate() {
        let place = |kind: FormKind| STEPS.iter().position(|step| *step == kind);
        let mut points: Vec<(f64, f64)> = kernel
            .forms
            .iter()
            .filter_map(|form| Some((place(form.kind)? as f64, form.ratio.median)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        for form in &kernel.forms {
            if let Some(step) = place(form.kind) {
                dots.push(Dot {
                    at: (step as f64, form.ratio.median),
                    spread: None,
                    color: index,
                    label: None,
                    title: format!(
                        "{}, {}: {}×",
                        kernel.kernel,
                        form.kind.display_name(),
                        format_number(form.ratio.median)
                    ),
                });
            }
        }
        lines.push(Line {
            points,
            color: index,
            dashed: false,
            label: Some(kernel.kernel.clone()),
        });
    }
    let plot = Plot {
        size: (980, 460),
        axes: (String::new(), "speedup over the loop".to_owned()),
        scales: (
            Scale::Names(STEPS.iter().map(|kind| kind.display_name().to_owned()).collect()),
            Scale::Log,
        ),
        across: false,
        dots,
        lines,
    };
    plot.to_svg()
}

fn build_kernel(kernel: &KernelForms) -> Kernel {
    Kernel {
        name: kernel.kernel.clone(),
        options: format_options(&kernel.options),
        input: kernel.input.clone(),
        rows: kernel.forms.iter().map(build_row).collect(),
        absent: kernel
            .absent
            .iter()
            .map(|(kind, why)| (kind.display_name(), why.clone()))
            .collect(),
    }
}

fn build_row(form: &FormRecord) -> Row {
    let error = |value: Option<f64>| value.map_or("–".to_owned(), |v| format!("{v:.0e}"));
    Row {
        form: form.kind.display_name(),
        time: format_number(form.time.median_ms),
        spread: format!(
            "{} to {}",
            format_number(form.time.min_ms),
            format_number(form.time.max_ms)
        ),
        ratio: format!("{:.2}", form.ratio.median),
        ratio_spread: format!("{:.2} to {:.2}", form.ratio.low, form.ratio.high),
        pipeline: format_number(form.pipeline_ms),
        loops: form.loops,
        statements: form.statements,
        reads: form.reads,
        spirv: format!("{:.1}", form.spirv_bytes as f64 / 1024.0),
        error: error(form.difference_999),
        largest: error(form.difference),
    }
}
