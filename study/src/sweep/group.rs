//! Variants that are compared with each other: made, checked and timed in turn.

use super::machine::ask_compilers;
use super::{Give, Loops, Sweep, SweepError, Variant};
use crate::loops::truth;
use crate::progress::Progress;
use crate::record::{Measured, Swept};
use crate::statistics::{CONFIDENCE, Interval};
use crate::turns::run_in_turn;
use glam::{UVec2, Vec4};
use std::collections::BTreeMap;
use std::rc::Rc;
use straightline_bench::execute::{Bench, ExecuteError, Inputs, Job, Uploaded, Uploads, Work, interpret_kernel};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Compiled, Settings, Unroll};
use straightline_isa::Compiler;
use straightline_kernels::prelude::Frame;
use straightline_manifest::hash_of_text;
use straightline_runtime::{Pass, PassOptions};

/// Rounds between two looks at how sure the ratios are.
const ROUNDS_AT_ONCE: u32 = 10;

/// A variant on the device.
struct Ready {
    /// Index of the variant in the group.
    at: usize,
    emitted: Emitted,
    is_rival: bool,
    pass: Pass,
    uploaded: Rc<Uploaded>,
    difference: f64,
    difference_999: f64,
}

/// All variants of a group and their rivals; `None` if it was stopped before all were measured.
pub fn measure_group(
    sweep: &Sweep,
    bench: &Bench,
    group: &[Variant],
    give: &Give<'_>,
    compilers: &mut [Compiler],
    progress: &mut dyn Progress,
) -> Result<Option<Vec<Swept>>, SweepError> {
    let mut swept: Vec<Swept> = group
        .iter()
        .map(|variant| unmeasured_variant(variant.axis_values(), None))
        .collect();
    let compiled: Vec<Result<Compiled, String>> = group
        .iter()
        .map(|variant| {
            let compiled = variant.spec()?.compile(&sweep.kernel);
            compiled.map_err(|errors| errors.first_message().to_owned())
        })
        .collect();
    for (swept, compiled) in swept.iter_mut().zip(&compiled) {
        swept.refused = compiled.as_ref().err().cloned();
    }
    let Some(judge) = compile_reference(sweep, group, &compiled) else {
        return Ok(Some(swept));
    };
    let inputs = give(&judge)?;
    let exact = interpret_kernel::<f64>(&judge, &inputs, false)?.texels;
    let exact: Vec<_> = exact.into_iter().map(Some).collect();
    progress.step();

    let mut stand = Stand {
        bench,
        inputs: &inputs,
        exact: &exact,
        uploads: Uploads::new(bench, &inputs),
    };
    let mut ready: Vec<Ready> = Vec::new();
    for (at, (variant, compiled)) in group.iter().zip(&compiled).enumerate() {
        if progress.is_stopped() {
            return Ok(None);
        }
        if let Ok(compiled) = compiled {
            match variant
                .emit(compiled)
                .and_then(|emitted| stand.prepare_shader(at, emitted, variant.loops, false))
            {
                Ok(variant) => ready.push(variant),
                Err(why) => swept[at].refused = Some(why),
            }
        }
        progress.step();
    }
    for rival in &sweep.rivals {
        let like = ready
            .iter()
            .filter(|ready| !ready.is_rival)
            .map(|ready| &ready.emitted)
            .collect::<Vec<_>>();
        let mut settings = group.first().map(Variant::axis_values).unwrap_or_default();
        settings.retain(|name, _| !sweep.baseline.contains_key(name));
        let file = rival.file_for(&settings);
        let put = rival
            .load_emitted(&file, &like)
            .and_then(|emitted| stand.prepare_shader(swept.len(), emitted, Loops::Bounded, true));
        let mut of = unmeasured_variant(settings, Some(file));
        match put {
            Ok(rival) => ready.push(rival),
            Err(why) => of.refused = Some(why),
        }
        swept.push(of);
        progress.step();
    }

    let baseline = group.iter().position(|variant| sweep.is_baseline(variant));
    let Some(rounds) = time_shaders(sweep, bench, inputs.size, &mut ready, &mut swept, baseline, progress)? else {
        return Ok(None);
    };
    let base = ready.iter().position(|ready| Some(ready.at) == baseline);
    for (k, ready) in ready.iter().enumerate() {
        let base = base.map(|base| rounds[base].as_slice());
        let mut measured = measured_figures(ready, &rounds[k], base);
        measured.machine = ask_compilers(compilers, &ready.emitted)?;
        swept[ready.at].measured = Some(measured);
    }
    Ok(Some(swept))
}

fn unmeasured_variant(settings: BTreeMap<String, String>, rival: Option<String>) -> Swept {
    Swept {
        settings,
        rival,
        measured: None,
        refused: None,
    }
}

/// The kernel by which all of a group are judged: without loops where that is allowed.
fn compile_reference(sweep: &Sweep, group: &[Variant], compiled: &[Result<Compiled, String>]) -> Option<Compiled> {
    let first = compiled.iter().position(Result::is_ok)?;
    let settings = Settings::new()
        .set_all(group[first].options.clone())
        .unroll(Unroll::Full);
    let full = sweep.kernel.compile(&settings).ok();
    full.or_else(|| compiled[first].as_ref().ok().cloned())
}

/// Device and inputs that variants are run with.
struct Stand<'a> {
    bench: &'a Bench,
    inputs: &'a Inputs,
    exact: &'a [Option<[f64; 4]>],
    uploads: Uploads<'a>,
}

impl Stand<'_> {
    /// Makes a shader and runs it once.
    fn prepare_shader(&mut self, at: usize, emitted: Emitted, loops: Loops, is_rival: bool) -> Result<Ready, String> {
        let (pass, uploaded, picture) = self.run_shader(&emitted, loops).map_err(|error| error.to_string())?;
        let (difference, difference_999) = truth::largest_differences(picture.texels(), self.exact);
        Ok(Ready {
            at,
            emitted,
            is_rival,
            pass,
            uploaded,
            difference,
            difference_999,
        })
    }

    fn run_shader(
        &mut self,
        emitted: &Emitted,
        loops: Loops,
    ) -> Result<(Pass, Rc<Uploaded>, Frame<Vec4>), ExecuteError> {
        let options = PassOptions::default().unbounded_loops(loops == Loops::Unbounded);
        let pass = self.bench.create_pass(emitted, &options)?;
        let uploaded = self.uploads.upload_shared(&emitted.manifest)?;
        let picture = self.bench.picture_of(&pass, &uploaded, self.inputs.size)?;
        Ok((pass, uploaded, picture))
    }
}

/// Milliseconds of all that are ready, round by round. What cannot be timed is refused, and ready no more. `None` if it was
/// stopped before two rounds.
fn time_shaders(
    sweep: &Sweep,
    bench: &Bench,
    size: UVec2,
    ready: &mut Vec<Ready>,
    swept: &mut [Swept],
    baseline: Option<usize>,
    progress: &mut dyn Progress,
) -> Result<Option<Vec<Vec<f64>>>, SweepError> {
    let work = |ready: &Ready| {
        let job = Job {
            pass: &ready.pass,
            uploaded: &ready.uploaded,
            size,
        };
        bench.job_work(job, sweep.least).map(drop)
    };
    ready.retain(|ready| match work(ready) {
        Ok(()) => true,
        Err(error) => {
            swept[ready.at].refused = Some(error.to_string());
            false
        }
    });
    let jobs = ready.iter().map(|ready| Job {
        pass: &ready.pass,
        uploaded: &ready.uploaded,
        size,
    });
    let works: Result<Vec<Work<'_>>, _> = jobs.map(|job| bench.job_work(job, sweep.least)).collect();
    let mut works = works?;
    let base = ready.iter().position(|ready| Some(ready.at) == baseline);
    let mut rounds: Vec<Vec<f64>> = vec![Vec::new(); works.len()];
    let mut done = 0;
    while done < sweep.rounds && !progress.is_stopped() && !works.is_empty() {
        let at_once = sweep
            .until
            .map_or(sweep.rounds, |_| ROUNDS_AT_ONCE)
            .min(sweep.rounds - done);
        let times = run_in_turn(bench, &mut works, at_once, progress)?;
        for (rounds, more) in rounds.iter_mut().zip(times.rounds_ms()) {
            rounds.extend(more);
        }
        done += at_once;
        if let (Some(until), Some(base)) = (sweep.until, base)
            && rounds.iter().all(|own| is_sure(own, &rounds[base], until))
        {
            break;
        }
    }
    let enough = rounds.iter().all(|own| own.len() >= 2.min(sweep.rounds as usize));
    Ok(enough.then_some(rounds))
}

fn is_sure(own: &[f64], base: &[f64], until: f64) -> bool {
    let interval = Interval::of_ratio(base, own);
    interval.is_some_and(|interval| interval.spread() <= until)
}

fn measured_figures(ready: &Ready, rounds: &[f64], base: Option<&[f64]>) -> Measured {
    let counts = &ready.emitted.manifest.counts;
    let emitted = !ready.is_rival;
    let wgsl = ready.emitted.files.get(&Target::Wgsl);
    let spirv = ready.emitted.files.get(&Target::Spirv);
    Measured {
        hash: hash_of_text(&wgsl.map(|text| String::from_utf8_lossy(text)).unwrap_or_default()),
        loops: emitted.then_some(counts.loops),
        statements: emitted.then_some(counts.statements),
        reads: emitted.then(|| counts.reads.values().sum()),
        spirv_bytes: spirv.filter(|_| emitted).map(Vec::len),
        rounds_ms: rounds.to_vec(),
        median_ms: Interval::of_median(rounds, CONFIDENCE).map_or(0.0, |of| of.median),
        speedup: base.and_then(|base| Interval::of_ratio(base, rounds)),
        difference: ready.difference,
        difference_999: ready.difference_999,
        machine: BTreeMap::new(),
    }
}
