//! Statistics of a GPU's compiler for a shader, for `explain --isa`.

use super::study::isa::SERVE;
use crate::args::Family;
use crate::failure::Failure;
use serde_json::{Value, json};
use straightline_codegen::emit::{Emitted, Target};
use straightline_isa::{Compiler, Report};
use straightline_table::Table;

/// Machine code, and the compiler's name for its GPU.
pub struct Machine {
    device: String,
    report: Report,
}

/// Compiles the shader for a GPU family.
pub fn ask(emitted: &Emitted, family: Family) -> Result<Machine, Failure> {
    let program = std::env::current_exe().map_err(Failure::from_error)?;
    let mut compiler = Compiler::start(&program, &[SERVE], family).map_err(Failure::from_error)?;
    let report = compiler
        .compile(&emitted.files[&Target::Spirv], &emitted.manifest.entry_point)
        .map_err(Failure::from_error)?;
    let device = compiler.device().to_owned();
    Ok(Machine { device, report })
}

impl Machine {
    pub fn to_json(&self) -> Value {
        json!({ "device": self.device, "figures": self.report.figures })
    }

    /// Prints the statistics, and with `code` the machine code.
    pub fn print(&self, code: bool) {
        let figures = &self.report.figures;
        let own = figures.own.iter().map(|(name, figure)| (name.as_str(), *figure));
        // A driver that names its figures itself has none of the others.
        let common = figures.named_figures().into_iter().filter(|_| figures.own.is_empty());
        let table = Table::of(common.chain(own))
            .column(&*self.device, |(name, _)| *name)
            .column("a wave", |(_, figure)| *figure)
            .finish();
        out!("\n{}", table.to_text());
        if code {
            out!("\n{}", self.report.assembly);
        }
    }
}
