//! Unroll against loop.

use super::in_ms;
use straightline_study::record::{FormKind, FormRecord, KernelForms, LoopsRecord};
use straightline_study::statistics::{Interval, Noise};
use straightline_table::{Cell, Column, Table, TableBuilder};

/// Gain from unrolling every kernel, in the fewest columns.
pub fn in_short(record: &LoopsRecord) -> Table {
    let noise = record.noise();
    let table = Table::of(&record.kernels)
        .column("kernel", |kernel| &kernel.kernel)
        .column("looped", |kernel| time(kernel));
    let table = ratios(
        table,
        noise,
        &[
            ("without its bound", FormKind::LoopedUnchecked),
            ("hand-optimised", FormKind::LoopedByHand),
            ("both", FormKind::LoopedByHandUnchecked),
        ],
    )
    .column("**unrolled**", |kernel| {
        let form = kernel.form(FormKind::Full)?;
        Some(format!(
            "**{:.2}**{}, {} ms",
            form.ratio.median,
            form.mark(noise),
            in_ms(form.time.median_ms, 1)
        ))
    });
    ratios(
        table,
        noise,
        &[("2×2 pixels", FormKind::FullBlock), ("floor", FormKind::Floor)],
    )
    .column("off f64 by", |kernel| off(kernel, FormKind::Full))
    .finish()
}

/// Every kernel: the speedup of each form over its loop.
pub fn in_full(record: &LoopsRecord) -> Table {
    let noise = record.noise();
    let table = Table::of(&record.kernels)
        .column("kernel", |kernel| &kernel.kernel)
        .column("statements", |kernel| change(kernel, |form| form.statements))
        .column("reads", |kernel| change(kernel, |form| form.reads))
        .column("looped", |kernel| time(kernel));
    let table = ratios(
        table,
        noise,
        &[
            ("unbounded", FormKind::LoopedUnchecked),
            ("hand-optimised", FormKind::LoopedByHand),
            ("both", FormKind::LoopedByHandUnchecked),
        ],
    )
    .column("partial(2), (4)", |kernel| {
        let each = [FormKind::Partial2, FormKind::Partial4];
        each.map(|kind| ratio(kernel, kind, noise).unwrap_or_else(|| "–".to_owned()))
            .join(", ")
    });
    let table = ratios(table, noise, &[("not shared", FormKind::FullUnshared)]).column("**unrolled**", |kernel| {
        let form = kernel.form(FormKind::Full)?;
        let [median, low, high] = form.ratio.to_array();
        Some(format!("**{median:.2}** ({low:.2} to {high:.2}){}", form.mark(noise)))
    });
    let table = ratios(
        table,
        noise,
        &[("2×2 pixels", FormKind::FullBlock), ("floor", FormKind::Floor)],
    )
    .column("off f64 by", |kernel| off(kernel, FormKind::Full));
    ratios(table, noise, &[("f16", FormKind::FullHalf)])
        .column("off f64 by", |kernel| off(kernel, FormKind::FullHalf))
        .finish()
}

/// Adds a column of ratios for each form.
fn ratios<'r>(
    table: TableBuilder<&'r KernelForms>,
    noise: Option<Noise>,
    forms: &[(&str, FormKind)],
) -> TableBuilder<&'r KernelForms> {
    table.columns(
        forms,
        |(title, _)| Column::from(*title),
        |kernel, (_, kind)| ratio(kernel, *kind, noise),
    )
}

/// Agreement of two runs of one study.
///
/// # Errors
///
/// If they are not of the same kernels and forms.
pub fn agreement(once: &LoopsRecord, again: &LoopsRecord) -> Result<Table, String> {
    let all = |record: &LoopsRecord| -> Vec<(String, FormKind, Interval)> {
        let kernels = record.kernels.iter();
        let forms = kernels.flat_map(|kernel| kernel.forms.iter().map(|form| (kernel.kernel.clone(), form)));
        let compared = forms.filter(|(_, form)| form.kind != FormKind::Looped);
        compared.map(|(kernel, form)| (kernel, form.kind, form.ratio)).collect()
    };
    let (once, again) = (all(once), all(again));
    let named = |all: &[(String, FormKind, Interval)]| -> Vec<(String, FormKind)> {
        all.iter().map(|(kernel, kind, _)| (kernel.clone(), *kind)).collect()
    };
    if named(&once) != named(&again) {
        return Err("the two runs are not of the same kernels and forms".to_owned());
    }
    let pairs: Vec<(Interval, Interval)> = once.iter().zip(&again).map(|(a, b)| (a.2, b.2)).collect();
    let within = |span: &Interval, value: f64| span.low <= value && value <= span.high;
    let count = |pairs: &[(Interval, Interval)], holds: &dyn Fn(&Interval, &Interval) -> bool| {
        pairs.iter().filter(|(a, b)| holds(a, b)).count()
    };
    let mut changes: Vec<f64> = pairs.iter().map(|(a, b)| (a.median / b.median - 1.0).abs()).collect();
    changes.sort_by(f64::total_cmp);
    let percent = |change: Option<&f64>| change.map(|change| Cell::percent(*change, 0));
    Ok(Table::of([pairs])
        .column("ratios", |pairs| pairs.len())
        .column("spans overlap", |pairs| {
            count(pairs, &|a, b| a.low <= b.high && b.low <= a.high)
        })
        .column("one's median in the other's span", |pairs| {
            count(pairs, &|a, b| within(a, b.median) || within(b, a.median))
        })
        .column("both medians", |pairs| {
            count(pairs, &|a, b| within(a, b.median) && within(b, a.median))
        })
        .column("change of a median, typical", |_| {
            percent(changes.get(changes.len() / 2))
        })
        .column("largest", |_| percent(changes.last()))
        .finish())
}

fn time(kernel: &KernelForms) -> Option<Cell> {
    let looped = kernel.form(FormKind::Looped)?;
    let ms = looped.time.median_ms;
    Some(Cell::new(ms.to_string(), in_ms(ms, 1) + " ms"))
}

fn ratio(kernel: &KernelForms, kind: FormKind, noise: Option<Noise>) -> Option<String> {
    let form = kernel.form(kind)?;
    Some(format!("{:.2}{}", form.ratio.median, form.mark(noise)))
}

/// Change of a count by unrolling.
fn change(kernel: &KernelForms, count: fn(&FormRecord) -> u32) -> Option<String> {
    let [looped, full] = [kernel.form(FormKind::Looped)?, kernel.form(FormKind::Full)?].map(count);
    Some(if looped == full {
        full.to_string()
    } else {
        format!("{looped} → {full}")
    })
}

fn off(kernel: &KernelForms, kind: FormKind) -> Option<Cell> {
    Some(Cell::scientific(kernel.form(kind)?.difference_999?, 0))
}
