//! A variant of a filter with one transport, ready to run.

use super::families::{Family, Source};
use super::{QUAD, QuadsError, Setup};
use glam::Vec4;
use straightline_bench::execute::{Bench, ExecuteError, Forward, Inputs, Job, Shadowed, Uploaded, Work};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, Transport};
use straightline_kernels::prelude::Frame;
use straightline_manifest::{Counts, Stage};
use straightline_runtime::Pass;

/// Options that reach as far as the scene's walls and steps, and make the occlusion dark enough to be judged.
pub const OCCLUSION: [(&str, &str); 3] = [("pixel-angle", "uniform"), ("radius", "1.2"), ("strength", "4")];

/// A variant with a transport.
pub struct Subject {
    pub family: &'static Family,
    pub way: &'static str,
    pub transport: String,
    pub stage: Stage,
    pub counts: Counts,
    /// Hash of the WGSL.
    pub hash: Option<String>,
    pub image: Frame<Vec4>,
    drawn: Drawn,
}

enum Drawn {
    Pass(Box<Pass>, Uploaded),
    Forward(Box<Forward>),
}

impl Subject {
    /// Compiles the filter, for blocks of this many pixels if an invocation computes whole blocks, runs it once and keeps
    /// its picture.
    pub fn new(
        bench: &Bench,
        family: &'static Family,
        way: &'static str,
        options: &[(&str, &str)],
        (transport, block): (Transport, [u32; 2]),
        inputs: &Inputs,
        shadowed: &Shadowed,
    ) -> Result<Subject, QuadsError> {
        let mut options = options.to_vec();
        if family.kernel == "quad_ssao" {
            options.extend(OCCLUSION);
        }
        let compiled = compile_filter(family.kernel, &options, Some(transport), block)?;
        let stage = match transport {
            Transport::Block => Stage::Compute,
            _ => Stage::Fragment,
        };
        let (drawn, image, manifest) = if family.from == Source::Triangles && stage == Stage::Fragment {
            let forward = bench.prepare_forward(&compiled, inputs, &shadowed.corners)?;
            let image = bench.draw_forward(&forward)?;
            let emitted = compiled.emit(&EmitOptions::new().stage(stage).targets([Target::Wgsl]));
            let manifest = emitted.map_err(ExecuteError::from)?.manifest;
            (Drawn::Forward(Box::new(forward)), image, manifest)
        } else {
            let (pass, manifest) = bench.compile_pass(&compiled, stage)?;
            let uploaded = bench.upload(&manifest, inputs)?;
            let image = bench.run(&compiled, stage, inputs)?;
            (Drawn::Pass(Box::new(pass), uploaded), image, manifest)
        };
        Ok(Subject {
            family,
            way,
            transport: match transport {
                Transport::Block if block != QUAD => format!("block {}x{}", block[0], block[1]),
                Transport::Block => transport.to_string(),
                _ if manifest.counts.messages > 0 => transport.to_string(),
                _ => "none".to_owned(),
            },
            stage,
            hash: manifest.hashes.get("wgsl").cloned(),
            counts: manifest.counts,
            image,
            drawn,
        })
    }

    /// Returns the work to be timed.
    pub fn work<'a>(&'a self, bench: &Bench, setup: &Setup) -> Result<Work<'a>, ExecuteError> {
        match &self.drawn {
            Drawn::Pass(pass, uploaded) => {
                let job = Job {
                    pass,
                    uploaded,
                    size: setup.size,
                };
                bench.job_work(job, setup.least)
            }
            Drawn::Forward(forward) => bench.draw_work(forward, setup.least),
        }
    }
}

/// Compiles a filter of the catalogue.
pub fn compile_filter(
    kernel: &str,
    options: &[(&str, &str)],
    transport: Option<Transport>,
    block: [u32; 2],
) -> Result<Compiled, Errors> {
    let options = options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned()));
    let settings = Settings::new()
        .set_all(options)
        .transport(transport)
        // The transport `block` computes the quad itself, as does a kernel of single pixels in blocks.
        .block(
            if block == QUAD { [1, 1] } else { block }[0],
            if block == QUAD { [1, 1] } else { block }[1],
        );
    Kernel::builtin(kernel)?.compile(&settings)
}
