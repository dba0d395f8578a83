//! Statistics of a GPU's compiler for a shader, for `explain --isa`.

use super::study::isa::start_compiler;
use crate::args::Gpu;
use crate::failure::Failure;
use serde_json::{Value, json};
use straightline_codegen::emit::{Emitted, Target};
use straightline_isa::Report;
use straightline_table::Table;

/// Machine code, and the compiler's name for its GPU.
pub struct Machine {
    gpu: Gpu,
    device: String,
    report: Report,
}

/// Compiles the shader for a GPU.
pub fn ask(emitted: &Emitted, gpu: Gpu) -> Result<Machine, Failure> {
    let mut compiler = start_compiler(gpu).map_err(Failure::from_error)?;
    let report = compiler
        .compile(&emitted.files[&Target::Spirv], &emitted.manifest.entry_point)
        .map_err(Failure::from_error)?;
    let device = compiler.device().to_owned();
    Ok(Machine { gpu, device, report })
}

impl Machine {
    pub fn to_json(&self) -> Value {
        json!({ "gpu": self.gpu, "device": self.device, "figures": self.report.figures })
    }

    /// Prints the statistics, and with `code` the machine code.
    pub fn print(&self, code: bool) {
        let figures = &self.report.figures;
        let known = figures.known_figures().into_iter();
        let common = known.filter_map(|(name, figure)| Some((name.to_owned(), figure?)));
        let common = common.map(|(name, figure)| match name.as_str() {
            "occupancy" => (format!("{name} ({})", self.gpu.occupancy_unit()), figure),
            _ => (name, figure),
        });
        let loops = figures.loops.map(|loops| ("loops".to_owned(), loops));
        let own = figures.own.iter().map(|(name, figure)| (name.clone(), *figure));
        let table = Table::of(common.chain(loops).chain(own))
            .column(&*self.device, |(name, _)| name.clone())
            .column("a wave", |(_, figure)| *figure)
            .finish();
        out!("\n{}", table.to_text());
        match (code, self.report.assembly.as_str()) {
            (true, "") => out!("\nthe driver does not print its machine code\n"),
            (true, assembly) => out!("\n{assembly}"),
            (false, _) => {}
        }
    }
}
