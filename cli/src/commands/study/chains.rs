//! `study chains`: chains of passes, stored and fused.

use super::uniforms::Asked;
use super::{ProgressBars, run_circumstances};
use crate::args::{ChainsArgs, CommonArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use std::path::Path;
use std::time::Duration;
use straightline_bench::execute::Inputs;
use straightline_codegen::ShaderSpec;
use straightline_codegen::chain::Chain;
use straightline_scene::picture;
use straightline_study::chains::{ChainSetup, ChainSubject, ChainsError, study_chains};
use straightline_study::progress::Progress;
use straightline_study::record::{ChainsRecord, Record};

/// Minimum time for one measurement of a form, as that of `study loops`.
const LEAST: Duration = Duration::from_millis(40);

/// Measures, writes the record, and prints it.
pub fn measure_chains(common: &CommonArgs, args: &ChainsArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let mut given = Inputs::default();
    for (name, path) in &args.input {
        // Tables and data are read as they are stored.
        let read = picture::read_linear(Path::new(path)).map_err(Failure::from_error)?;
        given = given.with_image(name, read);
    }
    let mut asked = Asked::new(&args.uniform);
    let subjects = args.chains.iter().map(|name| {
        let chain = Chain::from_argument(name)?.ok_or_else(|| {
            Failure::Usage(format!(
                "`{name}` is no chain: a chain returns pictures that `draw` draws"
            ))
        })?;
        let chain = args
            .source
            .iter()
            .try_fold(chain, |chain, path| chain.with_file(path))?;
        let shader = ShaderSpec::new();
        let mut given = given.clone();
        if !args.uniform.is_empty() {
            let compiled = chain.compile(&shader.clone().into())?;
            given.uniforms = asked.values_of(&compiled.inputs_graph().uniforms)?;
        }
        Ok(ChainSubject { chain, shader, given })
    });
    let subjects = subjects.collect::<Result<Vec<_>, Failure>>()?;
    asked.check_all_found("chain")?;
    let gpu = Gpu::require(&common.adapter)?;
    let setup = ChainSetup {
        size: common.picture_size(),
        rounds: common.timing_rounds(),
        most_outputs: args.most_outputs,
        least: LEAST,
    };
    let mut circumstances = run_circumstances(common, &gpu);
    let studied = study_chains(&gpu.bench(), &subjects, &setup, progress);
    progress.clear_bar();
    let chains = studied.map_err(|error| match error {
        ChainsError::Chain { errors, .. } => Failure::Kernel(errors),
        other => Failure::from_error(other),
    })?;
    circumstances.complete = !progress.is_stopped();
    let record = ChainsRecord { circumstances, chains };
    record.write(&common.out).map_err(Failure::from_error)?;
    outln!("{}", record.to_table().to_text());
    outln!("speedup: over the same chain without fused pictures, in the same round");
    outln!("off 32-bit pictures: largest difference to the chain whose pictures are 32-bit floats");
    Ok(())
}
