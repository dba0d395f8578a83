//! `study frame`: time of a whole frame against its error, composed from two records.

use super::command_line;
use crate::args::{CommonArgs, FrameArgs};
use crate::failure::Failure;
use std::collections::BTreeMap;
use straightline_codegen::files;
use straightline_study::frame::{FrameRequest, combine_frames};
use straightline_study::record::{FrameRecord, PassTimes, QualityRecord, Record, read_file};
use straightline_study::report::frame_plot;

/// Maximum number of shading costs; each is a panel.
const MOST_COSTS: usize = 6;

/// Width and height of a panel in its own file.
const PANEL: (u32, u32) = (820, 460);

/// Composes frames, prints the best, and writes record and panels.
pub fn compose_frames(common: &CommonArgs, args: &FrameArgs) -> Result<(), Failure> {
    if args.shading.is_empty() || args.shading.len() > MOST_COSTS {
        return Err(Failure::Usage(format!("--shading takes 1 to {MOST_COSTS} costs")));
    }
    let text = read_file(&args.passes).map_err(Failure::from_error)?;
    let passes: PassTimes = serde_json::from_slice(&text).map_err(|why| {
        let path = args.passes.display();
        Failure::Failed(format!("`{path}` is not a record of `budget --record`: {why}"))
    })?;
    let errors = QualityRecord::read(&args.errors).map_err(Failure::from_error)?;
    let request = FrameRequest {
        shading_ms: args.shading.clone(),
        only: args.only.clone(),
    };
    let record = combine_frames(&passes, &errors, &request, command_line()).map_err(Failure::from_error)?;
    print(&record);
    let mut panels = BTreeMap::new();
    for (k, ms) in record.shading_ms.iter().enumerate() {
        let svg = frame_plot(&record, k, PANEL).map_err(Failure::from_error)?;
        panels.insert(format!("{}-{ms}ms.svg", FrameRecord::STEM), (svg + "\n").into_bytes());
    }
    panels.extend(record.to_files(FrameRecord::STEM).map_err(Failure::from_error)?);
    files::write_all(&common.out, &panels).map_err(Failure::from_error)?;
    Ok(())
}

/// Prints all methods, and marks the best at each cost.
fn print(record: &FrameRecord) {
    out!("{}", record.summarise(" *").to_text());
    outln!(
        "\n* no other method takes as little time with a smaller error. Medians; shading costs are of one sample of every pixel."
    );
    for (method, why) in &record.absent {
        outln!("{method} is left out: {why}");
    }
}
