//! Chains of passes: stored and fused pictures, in time, memory and error.

use crate::progress::Progress;
use crate::record::{ChainForm, ChainForms};
use crate::statistics::Interval;
use crate::turns::run_in_turn;
use glam::UVec2;
use std::time::Duration;
use straightline_bench::execute::{Bench, ExecuteError, Inputs, Written, test_inputs};
use straightline_codegen::chain::{Chain, ChainSpec, CompiledChain, EmittedChain, Fuse};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::{Format, ShaderSpec};
use straightline_runtime::BoundChain;

/// A chain to study.
#[derive(Clone, Debug)]
pub struct ChainSubject {
    /// The chain.
    pub chain: Chain,
    /// Description of its shaders.
    pub shader: ShaderSpec,
    /// Inputs in place of those of the test card.
    pub given: Inputs,
}

/// Setup of the measurements.
#[derive(Clone, Copy, Debug)]
pub struct ChainSetup {
    /// Width and height of the inputs.
    pub size: UVec2,
    /// Rounds of timing.
    pub rounds: u32,
    /// Most pictures that a pass may write, where workgroups compute several.
    pub most_outputs: u32,
    /// Minimum time of one measurement; faster forms are run several times in a row.
    pub least: Duration,
}

/// Reason why a chain could not be studied.
#[derive(Debug, thiserror::Error)]
pub enum ChainsError {
    /// The chain is invalid.
    #[error("the chain `{name}` is refused")]
    Chain {
        /// The chain's name.
        name: String,
        /// Every error.
        errors: Errors,
    },
    /// Execution failed.
    #[error("`{name}`: {source}")]
    Execute {
        /// The chain's name.
        name: String,
        /// Cause of the failure.
        source: Box<ExecuteError>,
    },
}

/// A form of a chain, ready to be timed.
struct Ready {
    fuse: Fuse,
    compiled: CompiledChain,
    emitted: EmittedChain,
    bound: BoundChain,
    difference: f64,
}

/// Measures each chain stored, fused where it should pay, fused where it can be, and shared by workgroups. Forms of a chain are timed in turn.
///
/// # Errors
///
/// A chain that is refused or cannot be run.
pub fn study_chains(
    bench: &Bench,
    subjects: &[ChainSubject],
    setup: &ChainSetup,
    progress: &mut dyn Progress,
) -> Result<Vec<ChainForms>, ChainsError> {
    let mut studied = Vec::new();
    for subject in subjects {
        if progress.is_stopped() {
            break;
        }
        let name = subject.chain.name().to_owned();
        progress.begin(&name, setup.rounds as usize);
        studied.push(study_chain(bench, subject, setup, progress)?);
    }
    Ok(studied)
}

fn study_chain(
    bench: &Bench,
    subject: &ChainSubject,
    setup: &ChainSetup,
    progress: &mut dyn Progress,
) -> Result<ChainForms, ChainsError> {
    let name = subject.chain.name().to_owned();
    let failed = |source: ExecuteError| ChainsError::Execute {
        name: name.clone(),
        source: Box::new(source),
    };
    let compile = |fuse: Fuse, exact: bool| {
        let mut spec = ChainSpec::from(subject.shader.clone())
            .fuse(fuse)
            .most_outputs(setup.most_outputs);
        spec.shader = spec.shader.format(Format::Rgba32Float);
        if exact {
            spec = spec.pictures(Format::Rgba32Float);
        }
        let compiled = subject.chain.compile(&spec);
        let emitted = compiled.and_then(|compiled| compiled.emit().map(|emitted| (compiled, emitted)));
        emitted.map_err(|errors| ChainsError::Chain {
            name: name.clone(),
            errors,
        })
    };
    let (exact, emitted) = compile(Fuse::None, true)?;
    let inputs = with_given(test_inputs(&exact.inputs_graph(), setup.size), &subject.given);
    let truth = bench.run_chain(&emitted, &inputs).map_err(failed)?;
    let mut forms = Vec::new();
    for fuse in [Fuse::None, Fuse::Auto, Fuse::All, Fuse::Share] {
        let (compiled, emitted) = compile(fuse.clone(), false)?;
        let found = bench.run_chain(&emitted, &inputs).map_err(failed)?;
        let difference = largest_difference(&truth, &found);
        let bound = bench.bind_chain(&emitted, &inputs).map_err(failed)?;
        forms.push(Ready {
            fuse,
            compiled,
            emitted,
            bound,
            difference,
        });
    }
    let works = forms.iter().map(|form| bench.chain_work(&form.bound, setup.least));
    let mut works = works.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    let timed = run_in_turn(bench, &mut works, setup.rounds, progress).map_err(failed)?;
    drop(works);
    let rounds = timed.rounds_ms();
    let recorded = forms.iter().enumerate().filter_map(|(k, form)| {
        Some(ChainForm {
            fuse: form.fuse.to_string(),
            fused: form.compiled.fused.clone(),
            shared: shared_pictures(&form.compiled),
            passes: form.emitted.plan.passes.len(),
            bytes: form.bound.bytes(),
            difference: form.difference,
            time: timed.times(k)?,
            speedup: Interval::of_ratio(&rounds[0], &rounds[k])?,
        })
    });
    Ok(ChainForms {
        chain: name.clone(),
        options: subject.shader.settings.option_texts(),
        forms: recorded.collect(),
    })
}

/// Pictures that workgroups compute for later ones.
fn shared_pictures(compiled: &CompiledChain) -> Vec<String> {
    let passes = compiled
        .shared
        .iter()
        .filter_map(|pass| pass.cascade.tiles.split_last());
    let names = passes.flat_map(|(_, tiles)| tiles.iter().map(|tile| tile.name.clone()));
    names.collect()
}

/// Inputs of a test card, but for those that are given.
fn with_given(mut inputs: Inputs, given: &Inputs) -> Inputs {
    inputs.images.extend(given.images.iter().cloned());
    inputs.integers.extend(given.integers.iter().cloned());
    inputs.buffers.extend(given.buffers.iter().cloned());
    inputs.uniforms.extend(given.uniforms.iter().cloned());
    inputs
}

/// Largest difference of a component of two pictures.
fn largest_difference(a: &[Written], b: &[Written]) -> f64 {
    let pairs = a
        .iter()
        .zip(b)
        .flat_map(|(a, b)| a.texels.iter().flatten().zip(b.texels.iter().flatten()));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
