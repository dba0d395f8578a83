//! Unroll against loop.

use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::{ReportError, format_caption};
use crate::record::{FormKind, KernelForms, LoopsRecord, join_options};
use crate::statistics::describe_noise;
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Loops {
    caption: String,
    /// Ratios of all kernels.
    overview: String,
    /// Ratio by form, a line for each kernel.
    curves: String,
    legend: Vec<(&'static str, &'static str)>,
    /// Sentence on the noise of the run.
    noise: String,
    kernels: Vec<Kernel>,
}

#[derive(Debug, Serialize)]
struct Kernel {
    name: String,
    options: String,
    input: String,
    table: String,
    absent: Vec<(&'static str, String)>,
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
        FormKind::FullTile | FormKind::FullGather | FormKind::FullFast | FormKind::Slang => 10,
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
        noise: describe_noise(record.noise()),
        kernels: record
            .kernels
            .iter()
            .map(|kernel| build_kernel(record, kernel))
            .collect(),
    })
}

fn plot_overview(record: &LoopsRecord) -> Result<String, ReportError> {
    let (count, noise) = (record.kernels.len(), record.noise());
    let mut dots = Vec::new();
    for (row, kernel) in record.kernels.iter().enumerate() {
        for form in kernel.forms.iter().filter(|form| form.kind != FormKind::Looped) {
            dots.push(Dot {
                at: (form.ratio.median, (count - 1 - row) as f64),
                spread: Some((form.ratio.low, form.ratio.high)),
                color: color_index(form.kind),
                label: None,
                title: format!(
                    "{}, {}: {}× as fast as looped ({} to {}){}, {} ms",
                    kernel.kernel,
                    form.kind.display_name(),
                    format_number(form.ratio.median),
                    format_number(form.ratio.low),
                    format_number(form.ratio.high),
                    form.mark(noise),
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

fn build_kernel(record: &LoopsRecord, kernel: &KernelForms) -> Kernel {
    let absent = kernel.absent.iter();
    Kernel {
        name: kernel.kernel.clone(),
        options: join_options(&kernel.options),
        input: kernel.input.clone(),
        table: record.tabulate([kernel]).without(&["kernel"]).to_html(),
        absent: absent.map(|(kind, why)| (kind.display_name(), why.clone())).collect(),
    }
}
