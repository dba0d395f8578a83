//! Counts of the publications, beside those of a kernel.

use crate::failure::Failure;
use straightline_codegen::{Compiled, Kernel, Settings};
use straightline_kernels::PaperCounts;

/// Options of `sraa` that the paper leaves open, or whose work it does not count. All others must have their defaults.
const OPEN: [&str; 11] = [
    "pattern",
    "shading",
    "latin",
    "falloff",
    "sharpness",
    "sigma",
    "tau",
    "depth-scale",
    "turn",
    "guards",
    "non-finite",
];

/// Returns the counts of a kernel's publication; `None` where none are stated for its options.
///
/// The counts of `sraa` are those of the kernel as the paper writes it (section 3.5). Every shading sample within a pixel is
/// weighed, that of the pixel against itself too. No read is shared: one of each G-buffer for every evaluation and sample.
pub fn count_for_paper(kernel: &Kernel, compiled: &Compiled) -> Result<Option<PaperCounts>, Failure> {
    let stated = compiled.paper_counts();
    if stated.is_none() || compiled.builtin.is_none_or(|entry| entry.name != "sraa") {
        return Ok(stated);
    }
    if compiled.changed.iter().any(|name| !OPEN.contains(&name.as_str())) {
        return Ok(None);
    }
    let samples = match compiled.options.choice("pattern") {
        Some("ordered4" | "latin4") => 4,
        _ => 16,
    };
    let settings = Settings::new().set("pattern", format!("ordered{samples}"));
    let written = kernel.compile(&settings.set("shading", "sample0").set("falloff", "none"))?;
    let tallied = written.counts.tallies.get("weight_evaluations");
    let weight_evaluations = tallied.copied().unwrap_or(0) + 1;
    let buffers = written.counts.reads.keys().filter(|name| *name != "color").count() as u32;
    Ok(Some(PaperCounts {
        weight_evaluations,
        texture_reads: (weight_evaluations + samples) * buffers,
    }))
}
