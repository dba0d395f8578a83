//! Unroll against loop.

use super::markdown;
use straightline_bench::execute::Ratio;
use straightline_study::record::{FormKind, FormRecord, KernelForms, LoopsRecord};

/// Gain from unrolling every kernel, in the fewest columns.
pub fn in_short(record: &LoopsRecord) -> String {
    let head = [
        "kernel",
        "looped",
        "without its bound",
        "hand-optimised",
        "both",
        "**unrolled**",
        "2×2 pixels",
        "floor",
        "off f64 by",
    ];
    let row = |kernel: &KernelForms| {
        let full = kernel.form(FormKind::Full);
        vec![
            kernel.kernel.clone(),
            time(kernel),
            ratio(kernel, FormKind::LoopedUnchecked),
            ratio(kernel, FormKind::LoopedByHand),
            ratio(kernel, FormKind::LoopedByHandUnchecked),
            full.map_or("–".to_owned(), |form| {
                format!("**{:.2}**, {:.1} ms", form.ratio.median, form.time.median_ms)
            }),
            ratio(kernel, FormKind::FullBlock),
            ratio(kernel, FormKind::Floor),
            off(full),
        ]
    };
    markdown(&head, record.kernels.iter().map(row).collect())
}

/// Every kernel: the speedup of each form over its loop.
pub fn in_full(record: &LoopsRecord) -> String {
    let head = [
        "kernel",
        "statements",
        "reads",
        "looped",
        "unbounded",
        "hand-optimised",
        "both",
        "partial(2), (4)",
        "not shared",
        "**unrolled**",
        "2×2 pixels",
        "floor",
        "off f64 by",
        "f16",
        "off f64 by",
    ];
    let row = |kernel: &KernelForms| {
        let full = kernel.form(FormKind::Full);
        vec![
            kernel.kernel.clone(),
            change(kernel, |form| form.statements),
            change(kernel, |form| form.reads),
            time(kernel),
            ratio(kernel, FormKind::LoopedUnchecked),
            ratio(kernel, FormKind::LoopedByHand),
            ratio(kernel, FormKind::LoopedByHandUnchecked),
            format!(
                "{}, {}",
                ratio(kernel, FormKind::Partial2),
                ratio(kernel, FormKind::Partial4)
            ),
            ratio(kernel, FormKind::FullUnshared),
            full.map_or("–".to_owned(), |form| {
                format!(
                    "**{:.2}** ({:.2} to {:.2})",
                    form.ratio.median, form.ratio.low, form.ratio.high
                )
            }),
            ratio(kernel, FormKind::FullBlock),
            ratio(kernel, FormKind::Floor),
            off(full),
            ratio(kernel, FormKind::FullHalf),
            off(kernel.form(FormKind::FullHalf)),
        ]
    };
    markdown(&head, record.kernels.iter().map(row).collect())
}

/// Agreement of two runs of one study.
///
/// # Errors
///
/// If they are not of the same kernels and forms.
pub fn agreement(once: &LoopsRecord, again: &LoopsRecord) -> Result<String, String> {
    let all = |record: &LoopsRecord| -> Vec<(String, FormKind, Ratio)> {
        let kernels = record.kernels.iter();
        let forms = kernels.flat_map(|kernel| kernel.forms.iter().map(|form| (kernel.kernel.clone(), form)));
        let compared = forms.filter(|(_, form)| form.kind != FormKind::Looped);
        compared.map(|(kernel, form)| (kernel, form.kind, form.ratio)).collect()
    };
    let (once, again) = (all(once), all(again));
    let named = |all: &[(String, FormKind, Ratio)]| -> Vec<(String, FormKind)> {
        all.iter().map(|(kernel, kind, _)| (kernel.clone(), *kind)).collect()
    };
    if named(&once) != named(&again) {
        return Err("the two runs are not of the same kernels and forms".to_owned());
    }
    let pairs: Vec<(Ratio, Ratio)> = once.iter().zip(&again).map(|(a, b)| (a.2, b.2)).collect();
    let within = |span: &Ratio, value: f64| span.low <= value && value <= span.high;
    let count = |holds: &dyn Fn(&Ratio, &Ratio) -> bool| pairs.iter().filter(|(a, b)| holds(a, b)).count().to_string();
    let mut changes: Vec<f64> = pairs.iter().map(|(a, b)| (a.median / b.median - 1.0).abs()).collect();
    changes.sort_by(f64::total_cmp);
    let percent = |change: Option<&f64>| change.map_or("–".to_owned(), |change| format!("{:.0} %", 100.0 * change));
    let row = vec![
        pairs.len().to_string(),
        count(&|a, b| a.low <= b.high && b.low <= a.high),
        count(&|a, b| within(a, b.median) || within(b, a.median)),
        count(&|a, b| within(a, b.median) && within(b, a.median)),
        percent(changes.get(changes.len() / 2)),
        percent(changes.last()),
    ];
    let head = [
        "ratios",
        "spans overlap",
        "one's median in the other's span",
        "both medians",
        "change of a median, typical",
        "largest",
    ];
    Ok(markdown(&head, vec![row]))
}

fn time(kernel: &KernelForms) -> String {
    let looped = kernel.form(FormKind::Looped);
    looped.map_or("–".to_owned(), |form| format!("{:.1} ms", form.time.median_ms))
}

fn ratio(kernel: &KernelForms, kind: FormKind) -> String {
    let form = kernel.form(kind);
    form.map_or("–".to_owned(), |form| format!("{:.2}", form.ratio.median))
}

/// Change of a count by unrolling.
fn change(kernel: &KernelForms, count: fn(&FormRecord) -> u32) -> String {
    match (kernel.form(FormKind::Looped), kernel.form(FormKind::Full)) {
        (Some(looped), Some(full)) if count(looped) == count(full) => count(full).to_string(),
        (Some(looped), Some(full)) => format!("{} → {}", count(looped), count(full)),
        _ => "–".to_owned(),
    }
}

fn off(form: Option<&FormRecord>) -> String {
    match form.and_then(|form| form.difference_999) {
        None => "–".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) => format!("{value:.0e}"),
    }
}
