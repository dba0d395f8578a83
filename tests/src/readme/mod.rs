//! Tables in documents, generated from the records that they cite.
//!
//! A table is delimited by `<!-- table NAME of FILE ... -->`, with paths from `study/records/`, and `<!-- end -->`.
//! The text in between must equal the output of [`filled`].

mod alive;
mod budget;
mod crates;
mod encode;
mod fast;
mod frame;
mod gathers;
mod goals;
mod hard;
mod isa;
mod loops;
mod motion;
mod planes;
mod presets;
mod quads;
mod quality;
mod rank;
mod reached;
mod sweep;
mod tiles;
mod tune;

use std::path::Path;
use straightline_study::record::{
    FrameRecord, IsaRecord, LoopsRecord, MotionRecord, QuadsRecord, QualityRecord, Record, RecordError, SweepRecord,
    TuneRecord,
};

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
    let why = |error: RecordError| error.to_string();
    match name {
        "frame" => Ok(frame::methods(&FrameRecord::read(first).map_err(why)?)),
        "speed" => Ok(loops::in_short(&LoopsRecord::read(first).map_err(why)?)),
        "loops" => Ok(loops::in_full(&LoopsRecord::read(first).map_err(why)?)),
        "agreement" => {
            let again = files
                .get(1)
                .ok_or_else(|| format!("the table `{name}` needs two records"))?;
            loops::agreement(
                &LoopsRecord::read(first).map_err(why)?,
                &LoopsRecord::read(again).map_err(why)?,
            )
        }
        "pictures" => Ok(quality::pictures(&QualityRecord::read(first).map_err(why)?)),
        "resolves" => Ok(quality::resolves(&QualityRecord::read(first).map_err(why)?)),
        "radii" => Ok(quality::radii(&QualityRecord::read(first).map_err(why)?)),
        "samplings" => Ok(quality::samplings(&QualityRecord::read(first).map_err(why)?)),
        "quality" => Ok(quality::in_short(&QualityRecord::read(first).map_err(why)?)),
        "methods" => Ok(quality::methods(&QualityRecord::read(first).map_err(why)?)),
        "scenes" => Ok(quality::scenes(&QualityRecord::read(first).map_err(why)?)),
        "planes" => Ok(planes::scenes(&QualityRecord::read(first).map_err(why)?)),
        "even" => Ok(planes::even(&QualityRecord::read(first).map_err(why)?)),
        "presets" => presets::presets(&QualityRecord::read(first).map_err(why)?),
        "guide" => Ok(presets::scenes(&QualityRecord::read(first).map_err(why)?)),
        "guide-goals" => presets::goals(files),
        "demodulated" => Ok(quality::demodulated(&QualityRecord::read(first).map_err(why)?)),
        "motion" => Ok(motion::methods(&MotionRecord::read(first).map_err(why)?)),
        "gaps" => Ok(quality::gaps(&QualityRecord::read(first).map_err(why)?)),
        "hard" => hard::kernels(files),
        "rivals" => isa::rivals(&IsaRecord::read(first).map_err(why)?),
        "gathers" => gathers::gathers(&IsaRecord::read(first).map_err(why)?),
        "gathers-times" => {
            let records = files.iter().map(|file| LoopsRecord::read(file).map_err(why));
            gathers::times(&records.collect::<Result<Vec<_>, _>>()?)
        }
        "tiles" => tiles::cycles(&IsaRecord::read(first).map_err(why)?),
        "tiles-times" => Ok(tiles::times(&LoopsRecord::read(first).map_err(why)?)),
        "isa" => isa::cycles(&IsaRecord::read(first).map_err(why)?),
        "fast" => {
            let times = files
                .get(1)
                .ok_or_else(|| format!("the table `{name}` needs two records"))?;
            fast::mathematics(
                &IsaRecord::read(first).map_err(why)?,
                &LoopsRecord::read(times).map_err(why)?,
            )
        }
        "goals" => goals::table(files),
        "reached" => reached::table(files),
        "alive" => alive::registers(&IsaRecord::read(first).map_err(why)?),
        "rank" => {
            let times: Result<Vec<_>, _> = files[1..].iter().map(|file| LoopsRecord::read(file)).collect();
            rank::correlations(&IsaRecord::read(first).map_err(why)?, &times.map_err(why)?)
        }
        "tune" => {
            let all: Result<Vec<_>, _> = files.iter().map(|file| TuneRecord::read(file)).collect();
            Ok(tune::scenes(&all.map_err(why)?))
        }
        "budget" => budget::metrics(files),
        "table2" => budget::frames(files),
        "speedups" => budget::speedups(files),
        "quads" => Ok(quads::ways(&QuadsRecord::read(first).map_err(why)?)),
        "encode" => encode::ways(first),
        "crates" => crates::needs(first),
        "sweep" => sweep::factors(&SweepRecord::read(first).map_err(why)?),
        _ => Err(format!(
            "there is no table `{name}`; there are frame, speed, loops, agreement, quality, methods, scenes, planes, even, presets, guide, guide-goals, demodulated, motion, gaps, goals, reached, hard, fast, gathers, gathers-times, isa, alive, rank, tiles, tiles-times, tune, pictures, samplings, radii, budget, table2, speedups, quads, encode, crates and sweep"
        )),
    }
}

fn markdown(head: &[&str], rows: Vec<Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut text = line(&head.iter().map(|h| (*h).to_owned()).collect::<Vec<_>>());
    text += &format!("| --- |{}\n", " --: |".repeat(head.len() - 1));
    rows.iter().for_each(|row| text += &line(row));
    text
}
