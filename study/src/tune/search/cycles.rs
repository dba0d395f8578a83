//! Cycles or instructions of variants, as a compiler gives them for a GPU that need not be there.

use super::Search;
use crate::progress::Progress;
use crate::statistics::Interval;
use crate::tune::{Gauge, Term, TuneError};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Precision, Stage};
use straightline_isa::IsaError;

impl Search {
    /// Asks the compiler for the cycles of variants, of which the first is the most general one. Whether all was done.
    pub(super) fn measure_cycles(
        &mut self,
        which: &[usize],
        what: &str,
        progress: &mut dyn Progress,
    ) -> Result<bool, TuneError> {
        progress.begin(what, which.len());
        for k in which {
            if progress.is_stopped() {
                return Ok(false);
            }
            if self.entries[*k].cycles.is_none() {
                match self.cycles_per_pixel(*k) {
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
            // Cycles are the same every time: a variant that is faster by little is faster.
            let ratio = general.zip(self.entries[*k].cycles).map(|(general, own)| general / own);
            self.entries[*k].ratio = ratio.map(|ratio| Interval {
                median: ratio,
                low: ratio,
                high: ratio,
            });
        }
        Ok(true)
    }

    /// Cycles of a wave and pixel of its invocations, of both passes where its pixels are placed.
    fn cycles_per_pixel(&mut self, index: usize) -> Result<f64, TuneError> {
        let variant = self.entries[index].variant;
        let [width, height] = self.space.variant_value(variant, Term::Block).block;
        let filter = self.compile(variant)?;
        let filter = self.kernel_cycles(&filter, self.space.precision(variant))? / f64::from(width * height);
        let samples = variant.value_index(Term::Samples);
        let placing = self.placing_for(variant);
        let place = match placing.map(|placing| (placing.cycles, placing.compiled.clone())) {
            None => 0.0,
            Some((Some(cycles), _)) => cycles,
            Some((None, compiled)) => {
                let cycles = self.kernel_cycles(&compiled, Precision::F32)?;
                if let Some(placing) = &mut self.grounds[samples].placing {
                    placing.cycles = Some(cycles);
                }
                cycles
            }
        };
        Ok(filter + place)
    }

    /// Cycles of a wave and invocation of a kernel.
    fn kernel_cycles(&mut self, compiled: &Compiled, precision: Precision) -> Result<f64, TuneError> {
        let options = EmitOptions::new()
            .stage(Stage::Compute)
            .precision(precision)
            .accept_loss(true)
            .unbounded_loops(true)
            .targets([Target::Spirv]);
        let emitted = compiled
            .emit(&options)
            .map_err(straightline_bench::execute::ExecuteError::from)?;
        let Gauge::Compiler(compiler) = &mut self.gauge else {
            unreachable!("a compiler is asked where there is one");
        };
        let module = emitted.files.get(&Target::Spirv).map_or(&[][..], Vec::as_slice);
        let report = compiler.compile(module, &emitted.manifest.entry_point)?;
        let cost = report.figures.cost().ok_or_else(|| {
            let why = "its compiler states no cycles, and instructions do not say how often those of a loop run";
            IsaError::Shader(compiler.gpu(), why.to_owned())
        })?;
        Ok(cost as f64)
    }
}
