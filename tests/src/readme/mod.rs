//! Tables in documents, generated from the records that they cite.
//!
//! A table is delimited by `<!-- table NAME of FILE ... -->`, with paths from `study/records/`, and `<!-- end -->`.
//! The text in between must equal the output of [`filled`].

mod alive;
mod budget;
mod chains;
mod crates;
mod encode;
mod fast;
mod frame;
mod gathers;
mod goals;
mod gpu;
mod hard;
mod isa;
mod loops;
mod motion;
mod planes;
mod precision;
mod presets;
mod quads;
mod quality;
mod rank;
mod reached;
mod sweep;
mod tiles;
mod tune;
mod vendors;

use std::path::Path;
use straightline_study::record::Record;
use straightline_table::Table;

pub use quality::GEOMETRIC;

/// Returns the document with every table regenerated.
///
/// # Errors
///
/// Describes an error in a marker or a record.
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
        let files: Vec<&Path> = files.iter().map(|file| file.as_path()).collect();
        out += &table(name, &files)?.to_markdown();
        if !lines.any(|line| line == "<!-- end -->") {
            return Err(format!("the table `{name}` has no `<!-- end -->`"));
        }
        out += "<!-- end -->\n";
    }
    Ok(out)
}

fn table(name: &str, files: &[&Path]) -> Result<Table, String> {
    match name {
        "frame" => Ok(frame::methods(&read(files, 0)?)),
        "speed" => Ok(loops::in_short(&read(files, 0)?)),
        "loops" => Ok(loops::in_full(&read(files, 0)?)),
        "agreement" => loops::agreement(&read(files, 0)?, &read(files, 1)?),
        "pictures" => Ok(quality::pictures(&read(files, 0)?)),
        "resolves" => Ok(quality::resolves(&read(files, 0)?)),
        "radii" => Ok(quality::radii(&read(files, 0)?)),
        "samplings" => Ok(quality::samplings(&read(files, 0)?)),
        "quality" => Ok(quality::in_short(&read(files, 0)?)),
        "methods" => Ok(quality::methods(&read(files, 0)?)),
        "scenes" => Ok(quality::scenes(&read(files, 0)?)),
        "planes" => Ok(planes::scenes(&read(files, 0)?)),
        "even" => Ok(planes::even(&read(files, 0)?)),
        "presets" => {
            let (timed, errors) = files.split_last().ok_or("presets need records")?;
            presets::presets(&presets::joined(read_all(errors)?)?, &read(&[timed], 0)?)
        }
        "guide" => Ok(presets::scenes(&presets::joined(read_all(files)?)?)),
        "guide-sizes" => presets::sizes(read_all(files)?),
        "guide-goals" => presets::goals(&presets::joined(read_all(files)?)?),
        "precision" => precision::proposals(&read_all(files)?),
        "demodulated" => Ok(quality::demodulated(&read(files, 0)?)),
        "motion" => Ok(motion::methods(&read(files, 0)?)),
        "temporal" => Ok(motion::temporal(&read(files, 0)?)),
        "temporal-short" => Ok(motion::in_short(&read(files, 0)?)),
        "gaps" => Ok(quality::gaps(&read(files, 0)?)),
        "hard" => hard::kernels(files),
        "rivals" => Ok(isa::rivals(&read(files, 0)?)),
        "gathers" => Ok(gathers::gathers(&read(files, 0)?)),
        "gathers-times" => gathers::times(&read_all(files)?),
        "tiles" => Ok(tiles::cycles(&read(files, 0)?)),
        "tiles-times" => Ok(tiles::times(&read(files, 0)?)),
        "isa" => Ok(isa::cycles(&read(files, 0)?)),
        "vendors" => vendors::loops(&read(files, 0)?),
        "vendors-in-short" => vendors::in_short(&read(files, 0)?),
        "vendors-rivals" => Ok(vendors::rivals(&read(files, 0)?)),
        "vendors-registers" => Ok(vendors::registers(&read(files, 0)?)),
        "fast" => Ok(fast::mathematics(&read(files, 0)?, &read(files, 1)?)),
        "goals" => goals::table(files),
        "reached" => reached::table(&read(files, 0)?, &read(files, 1)?),
        "forms" => Ok(gpu::forms(&read(files, 0)?)),
        "workgroups" => Ok(gpu::workgroups(&read(files, 0)?, &read(files, 1)?)),
        "registers" => Ok(gpu::registers(&read(files, 0)?)),
        "alive" => alive::registers(&read(files, 0)?),
        "rank" => Ok(rank::correlations(&read(files, 0)?, &read_all(&files[1..])?)),
        "tune" => Ok(tune::scenes(&read_all(files)?)),
        "budget" => budget::metrics(files),
        "table2" => budget::frames(files),
        "speedups" => budget::speedups(files),
        "quads" => Ok(quads::ways(&read(files, 0)?)),
        "chains" => Ok(chains::forms(&read_all(files)?)),
        "encode" => encode::ways(files),
        "crates" => crates::needs(files),
        "sweep" => sweep::factors(&read(files, 0)?),
        _ => Err(format!(
            "there is no table `{name}`; there are frame, speed, loops, agreement, quality, methods, scenes, planes, even, presets, guide, guide-goals, guide-sizes, precision, demodulated, motion, temporal, temporal-short, gaps, goals, reached, hard, fast, gathers, gathers-times, isa, vendors, vendors-in-short, vendors-rivals, vendors-registers, forms, workgroups, registers, alive, rank, tiles, tiles-times, tune, pictures, samplings, radii, budget, table2, speedups, quads, encode, crates and sweep"
        )),
    }
}

/// Reads the record of the file with an index.
fn read<R: Record>(files: &[&Path], index: usize) -> Result<R, String> {
    let file = files.get(index).ok_or(match index {
        0 => "the table has no record",
        1 => "the table needs two records",
        _ => "the table needs more records",
    })?;
    R::read(file).map_err(|error| error.to_string())
}

fn read_all<R: Record>(files: &[&Path]) -> Result<Vec<R>, String> {
    (0..files.len()).map(|index| read(files, index)).collect()
}

/// Milliseconds with so many decimals, and no fewer than two digits.
fn in_ms(ms: f64, decimals: usize) -> String {
    let small = match ms {
        ..0.1 => 3,
        0.1..1.0 => 2,
        1.0..10.0 => 1,
        _ => 0,
    };
    format!("{ms:.*}", decimals.max(small))
}

/// Reads a file of JSON.
fn read_json(file: &Path) -> Result<serde_json::Value, String> {
    let why = |error: &dyn std::fmt::Display| format!("`{}`: {error}", file.display());
    let text = std::fs::read_to_string(file).map_err(|error| why(&error))?;
    serde_json::from_str(&text).map_err(|error| why(&error))
}
