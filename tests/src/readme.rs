//! Tables of documents, made of the records that they cite.
//!
//! A table stands between `<!-- table NAME of FILE ... -->`, files from `study/records/`, and `<!-- end -->`. What stands there
//! must be what [`filled`] makes of the records.

use serde_json::Value;
use std::path::Path;
use straightline_study::record::{FormKind, KernelForms, LoopsRecord, QualityRecord, Record, TuneRecord};

/// The document with every table made anew.
///
/// # Errors
///
/// What is wrong with a marker or a record, for people.
pub fn filled(document: &str, records: &Path) -> Result<String, String> {
    let mut out = String::new();
    let mut lines = document.lines();
    while let Some(line) = lines.next() {
        out += line;
        out.push('\n');
        let Some(marker) = line
            .strip_prefix("<!-- table ")
            .and_then(|rest| rest.strip_suffix(" -->"))
        else {
            continue;
        };
        let (name, files) = marker
            .split_once(" of ")
            .ok_or_else(|| format!("`{line}` names no record: write `<!-- table NAME of FILE -->`"))?;
        let files: Vec<_> = files.split(' ').map(|file| records.join(file)).collect();
        out += &table(name, &files.iter().map(|file| file.as_path()).collect::<Vec<_>>())?;
        if !lines.any(|line| line == "<!-- end -->") {
            return Err(format!("the table `{name}` has no `<!-- end -->`"));
        }
        out += "<!-- end -->\n";
    }
    Ok(out)
}

fn table(name: &str, files: &[&Path]) -> Result<String, String> {
    let Some(first) = files.first() else {
        return Err(format!("the table `{name}` has no record"));
    };
    let why = |error: straightline_study::record::RecordError| error.to_string();
    match name {
        "speed" => Ok(speed(&LoopsRecord::read(first).map_err(why)?)),
        "loops" => Ok(loops(&LoopsRecord::read(first).map_err(why)?)),
        "quality" => Ok(quality(&QualityRecord::read(first).map_err(why)?)),
        "gaps" => Ok(gaps(&QualityRecord::read(first).map_err(why)?)),
        "hard" => hard(files),
        "tune" => {
            let all: Result<Vec<_>, _> = files.iter().map(|file| TuneRecord::read(file)).collect();
            Ok(tune(&all.map_err(why)?))
        }
        "budget" => budget(files),
        _ => Err(format!(
            "there is no table `{name}`; there are speed, loops, quality, gaps, hard, tune and budget"
        )),
    }
}

/// What each metric costs, on each adapter.
fn budget(files: &[&Path]) -> Result<String, String> {
    let read = |path: &&Path| -> Result<Vec<Value>, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("`{}`: {error}", path.display()))?;
        let record: Value = serde_json::from_str(&text).map_err(|error| format!("`{}`: {error}", path.display()))?;
        let filters = record["filters"].as_array().cloned().unwrap_or_default();
        // The paper has these for 4 samples.
        Ok(filters
            .into_iter()
            .filter(|filter| filter["pattern"] == "latin4")
            .collect())
    };
    let records = files.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let stem = |path: &&Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut head = vec!["metric".to_owned(), "reads".to_owned()];
    head.extend(files.iter().map(|path| stem(path).replace("budget-", "ms and ratio, ")));
    head.push("ratio, paper".to_owned());
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let row = |(index, first): (usize, &Value)| {
        let mut cells = vec![
            first["metric"].as_str().unwrap_or_default().to_owned(),
            first["reads"].to_string(),
        ];
        for record in &records {
            let found = record.get(index).unwrap_or(&Value::Null);
            cells.push(format!(
                "{:.0}, {:.2}",
                number(&found["time"]["median_ms"]),
                number(&found["ratio"])
            ));
        }
        cells.push(format!("{:.2}", number(&first["paper_ratio"])));
        cells
    };
    let first = records.first().map(Vec::as_slice).unwrap_or_default();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    Ok(markdown(&head, first.iter().enumerate().map(row).collect()))
}

fn markdown(head: &[&str], rows: Vec<Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut text = line(&head.iter().map(|h| (*h).to_owned()).collect::<Vec<_>>());
    text += &format!("| --- |{}\n", " --: |".repeat(head.len() - 1));
    rows.iter().for_each(|row| text += &line(row));
    text
}

fn tiny(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value => format!("{value:.0e}"),
    }
}

/// Every kernel: what is gained by unrolling it, in the fewest columns that say it.
fn speed(record: &LoopsRecord) -> String {
    let head = [
        "kernel",
        "looped",
        "without its bound",
        "by hand",
        "both",
        "**unrolled**",
        "2×2 pixels",
        "floor",
        "off f64 by",
    ];
    let row = |kernel: &KernelForms| {
        let form = |kind| kernel.forms.iter().find(|form| form.kind == kind);
        let ratio = |kind| form(kind).map_or("–".to_owned(), |form| format!("{:.2}", form.ratio.median));
        let full = form(FormKind::Full);
        vec![
            kernel.kernel.clone(),
            form(FormKind::Looped).map_or("–".to_owned(), |form| format!("{:.1} ms", form.time.median_ms)),
            ratio(FormKind::LoopedUnchecked),
            ratio(FormKind::LoopedByHand),
            ratio(FormKind::LoopedByHandUnchecked),
            full.map_or("–".to_owned(), |form| {
                format!("**{:.2}**, {:.1} ms", form.ratio.median, form.time.median_ms)
            }),
            ratio(FormKind::FullBlock),
            ratio(FormKind::Floor),
            full.and_then(|form| form.difference_999).map_or("–".to_owned(), tiny),
        ]
    };
    markdown(&head, record.kernels.iter().map(row).collect())
}

/// Every kernel: how many times as fast as its loop each form is.
fn loops(record: &LoopsRecord) -> String {
    let head = [
        "kernel",
        "statements",
        "reads",
        "looped",
        "unbounded",
        "by hand",
        "both",
        "partial(2), (4)",
        "not shared",
        "**unrolled**",
        "2×2 pixels",
        "floor",
        "off f64 by",
    ];
    let row = |kernel: &KernelForms| {
        let form = |kind| kernel.forms.iter().find(|form| form.kind == kind);
        let ratio = |kind| form(kind).map_or("–".to_owned(), |form| format!("{:.2}", form.ratio.median));
        let change =
            |pick: fn(&straightline_study::record::Form) -> u32| match (form(FormKind::Looped), form(FormKind::Full)) {
                (Some(looped), Some(full)) if pick(looped) == pick(full) => pick(full).to_string(),
                (Some(looped), Some(full)) => format!("{} → {}", pick(looped), pick(full)),
                _ => "–".to_owned(),
            };
        let full = form(FormKind::Full).map_or("–".to_owned(), |form| {
            format!(
                "**{:.2}** ({:.2} to {:.2})",
                form.ratio.median, form.ratio.low, form.ratio.high
            )
        });
        vec![
            kernel.kernel.clone(),
            change(|form| form.statements),
            change(|form| form.reads),
            form(FormKind::Looped).map_or("–".to_owned(), |form| format!("{:.1} ms", form.time.median_ms)),
            ratio(FormKind::LoopedUnchecked),
            ratio(FormKind::LoopedByHand),
            ratio(FormKind::LoopedByHandUnchecked),
            format!("{}, {}", ratio(FormKind::Partial2), ratio(FormKind::Partial4)),
            ratio(FormKind::FullUnshared),
            full,
            ratio(FormKind::FullBlock),
            ratio(FormKind::Floor),
            form(FormKind::Full)
                .and_then(|form| form.difference_999)
                .map_or("–".to_owned(), tiny),
        ]
    };
    markdown(&head, record.kernels.iter().map(row).collect())
}

/// Scenes whose errors are edges of geometry, for which SRAA is made.
pub const GEOMETRIC: [&str; 8] = [
    "roof", "grooves", "creases", "railings", "wires", "tubes", "sky", "terrain",
];

/// Every method: means over the geometric scenes and over the others.
fn quality(record: &QualityRecord) -> String {
    let head = [
        "method",
        "PSNR, edges of geometry",
        "FLIP",
        "gap closed",
        "PSNR, other scenes",
        "FLIP",
        "ms",
        "MB",
    ];
    let mut names: Vec<&str> = Vec::new();
    for method in record.scenes.iter().flat_map(|scene| &scene.methods) {
        if !names.contains(&method.method.as_str()) {
            names.push(&method.method);
        }
    }
    let row = |name: &&str| {
        let of = |geometric: bool| {
            let scenes = record
                .scenes
                .iter()
                .filter(move |s| GEOMETRIC.contains(&s.scene.as_str()) == geometric);
            scenes
                .filter_map(|s| s.methods.iter().find(|m| m.method == *name))
                .collect::<Vec<_>>()
        };
        let mean = |values: Vec<f64>| match values.is_empty() {
            true => None,
            false => Some(values.iter().sum::<f64>() / values.len() as f64),
        };
        let shown = |value: Option<f64>, digits: usize, unit: &str| {
            value.map_or("–".to_owned(), |value| format!("{value:.digits$}{unit}"))
        };
        let (edges, others) = (of(true), of(false));
        let all = || edges.iter().chain(&others);
        vec![
            (*name).to_owned(),
            shown(mean(edges.iter().map(|m| m.psnr).collect()), 2, " dB"),
            shown(mean(edges.iter().map(|m| m.flip).collect()), 4, ""),
            shown(
                mean(edges.iter().filter_map(|m| Some(100.0 * m.gap_closed?)).collect()),
                0,
                " %",
            ),
            shown(mean(others.iter().map(|m| m.psnr).collect()), 2, " dB"),
            shown(mean(others.iter().map(|m| m.flip).collect()), 4, ""),
            shown(mean(all().filter_map(|m| Some(m.time?.median_ms)).collect()), 1, ""),
            shown(mean(all().map(|m| m.bytes as f64 / 1e6).collect()), 1, ""),
        ]
    };
    markdown(&head, names.iter().map(row).collect())
}

/// How far SRAA is from supersampling on every scene that has gaps, and what that is made of.
fn gaps(record: &QualityRecord) -> String {
    let mut head = vec!["scene".to_owned()];
    let first = record.scenes.iter().find(|scene| !scene.gaps.is_empty());
    for gap in first.map(|scene| scene.gaps.as_slice()).unwrap_or_default() {
        head.push(format!("{} − {}", gap.method, gap.bound));
        head.extend(["unseen surfaces", "borrowed colours"].map(str::to_owned));
    }
    let rows = record
        .scenes
        .iter()
        .filter(|scene| !scene.gaps.is_empty())
        .map(|scene| {
            let figures = scene.gaps.iter().flat_map(|gap| {
                let parts = [
                    gap.psnr - gap.bound_psnr,
                    gap.ideal_psnr - gap.bound_psnr,
                    gap.psnr - gap.ideal_psnr,
                ];
                parts.map(|part| format!("{part:+.2}"))
            });
            std::iter::once(scene.scene.clone()).chain(figures).collect()
        });
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    markdown(&head, rows.collect())
}

/// Every kernel of the hard cases on all adapters: how often it was not finite, or beyond its bound. From CSV: the JSON of thousands
/// of results is too long to be kept.
fn hard(files: &[&Path]) -> Result<String, String> {
    let head = ["kernel", "precision", "results", "not finite", "beyond their bound"];
    let mut rows: Vec<((String, String), [usize; 3])> = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(file).map_err(|error| format!("`{}`: {error}", file.display()))?;
        let mut lines = text.lines();
        let columns: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let column = |name: &str| {
            let found = columns.iter().position(|column| *column == name);
            found.ok_or_else(|| format!("`{}` has no column `{name}`", file.display()))
        };
        let [kernel, precision, executor, non_finite, difference, kept] =
            ["kernel", "precision", "executor", "non_finite", "difference", "kept"].map(column);
        let (kernel, precision, executor) = (kernel?, precision?, executor?);
        let (non_finite, difference, kept) = (non_finite?, difference?, kept?);
        for line in lines {
            // Only the last columns, which are not needed here, hold text with commas.
            let cells: Vec<&str> = line.split(',').collect();
            let cell = |k: usize| cells.get(k).copied().unwrap_or_default();
            let bad = cell(non_finite) != "0";
            // In half precision the device that is as inexact as WGSL allows decides nothing.
            if (cell(difference).is_empty() && !bad)
                || (cell(precision) == "f16" && cell(executor) == "interpreter-loose")
            {
                continue;
            }
            let key = (cell(kernel).to_owned(), cell(precision).to_owned());
            let index = rows.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
                rows.push((key, [0; 3]));
                rows.len() - 1
            });
            let counts = &mut rows[index].1;
            counts[0] += 1;
            counts[1] += usize::from(bad);
            counts[2] += usize::from(!bad && cell(kept) == "false");
        }
    }
    rows.sort_by_key(|((_, precision), _)| precision != "f32");
    let row = |((kernel, precision), counts): ((String, String), [usize; 3])| {
        let mut cells = vec![kernel, precision];
        cells.extend(counts.map(|count| count.to_string()));
        cells
    };
    Ok(markdown(&head, rows.into_iter().map(row).collect()))
}

/// Every scene: what was chosen.
fn tune(records: &[TuneRecord]) -> String {
    let head = [
        "scene",
        "budget",
        "chosen",
        "lost",
        "ms",
        "times as fast as the most general",
        "model off by",
    ];
    let row = |record: &TuneRecord| {
        let chosen = record.chosen.and_then(|index| record.candidates.get(index));
        let unit = if record.metric == "flip" { "" } else { " dB" };
        let cell = |text: Option<String>| text.unwrap_or("–".to_owned());
        vec![
            record.scene.clone(),
            format!("{}{unit}", record.max_error),
            cell(chosen.map(|c| {
                let mut words: Vec<String> = c
                    .options
                    .iter()
                    .map(|(name, value)| format!("{name}={value}"))
                    .collect();
                words.extend((c.precision != "f32").then(|| c.precision.clone()));
                words.extend((c.block != [1, 1]).then(|| format!("block {}x{}", c.block[0], c.block[1])));
                format!("`{}`", words.join(" "))
            })),
            cell(chosen.map(|c| format!("{:.3}{unit}", (c.error - record.best).abs()))),
            cell(chosen.and_then(|c| c.time).map(|t| format!("{:.1}", t.median_ms))),
            cell(
                chosen
                    .and_then(|c| c.ratio)
                    .map(|r| format!("{:.2} ({:.2} to {:.2})", r.median, r.low, r.high)),
            ),
            format!("{:.0} %", 100.0 * record.model.mean_error),
        ]
    };
    markdown(&head, records.iter().map(row).collect())
}
