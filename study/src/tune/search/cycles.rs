//! Cycles of variants, as a compiler gives them for a GPU that need not be there.

use super::Search;
use crate::progress::Progress;
use crate::tune::{Gauge, Term, TuneError};
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Stage};
use straightline_isa::IsaError;
use straightline_testbed::execute::Ratio;

impl Search {
    /// Asks the compiler for the cycles of variants, of which the first is the most general one. Whether all was done.
    pub(super) fn ask(&mut self, which: &[usize], what: &str, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        progress.begin(what, which.len());
        for k in which {
            if progress.stopped() {
                return Ok(false);
            }
            if self.entries[*k].cycles.is_none() {
                match self.cycles(*k) {
                    Ok(cycles) => self.entries[*k].cycles = Some(cycles),
                    // Without the most general variant nothing can be said.
                    Err(TuneError::Compiler(IsaError::Shader(_, why))) if *k != 0 => {
                        self.entries[*k].refused = Some(why)
                    }
                    Err(error) => return Err(error),
                }
            }
            progress.step();
        }
        let general = self.entries[0].cycles;
        for k in which {
            // The same every time: what is faster by little is faster.
            let ratio = general.zip(self.entries[*k].cycles).map(|(general, own)| general / own);
            self.entries[*k].ratio = ratio.map(|ratio| Ratio {
                median: ratio,
                low: ratio,
                high: ratio,
            });
        }
        Ok(true)
    }

    /// Cycles of a wave and pixel of its invocations.
    fn cycles(&mut self, index: usize) -> Result<f64, TuneError> {
        let variant = self.entries[index].variant;
        let options = EmitOptions::new()
            .stage(Stage::Compute)
            .precision(self.space.precision(variant))
            .accept_loss(true)
            .unbounded_loops(true)
            .targets([Target::Spirv]);
        let emitted = self
            .compile(variant)?
            .emit(&options)
            .map_err(straightline_testbed::execute::ExecuteError::from)?;
        let [width, height] = self.space.value(variant, Term::Block).block;
        let Gauge::Compiler(compiler) = &mut self.gauge else {
            unreachable!("a compiler is asked where there is one");
        };
        let module = emitted.files.get(&Target::Spirv).map_or(&[][..], Vec::as_slice);
        let report = compiler.compile(module, &emitted.manifest.entry_point)?;
        Ok(report.figures.inverse_throughput as f64 / f64::from(width * height))
    }
}
