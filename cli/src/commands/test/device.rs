//! Running the cases of a test on a GPU.

use crate::gpu::Gpu;
use glam::UVec2;
use straightline_bench::execute::{Bench, ExecuteError, Inputs};
use straightline_codegen::testing::{Case, Outcome, Runner, RunnerError, TestKernel};
use straightline_codegen::{Manifest, Stage};
use straightline_runtime::Pass;

/// A GPU with the pass of one test.
pub struct DeviceRunner {
    bench: Bench,
    name: String,
    /// Created for the first cases.
    pass: Option<(Pass, Manifest)>,
}

impl DeviceRunner {
    pub fn new(gpu: &Gpu) -> DeviceRunner {
        DeviceRunner {
            bench: gpu.bench(),
            name: gpu.describe(),
            pass: None,
        }
    }

    fn run(&mut self, kernel: &TestKernel, cases: &[Case]) -> Result<Vec<Outcome>, ExecuteError> {
        let (pass, manifest) = match &mut self.pass {
            Some(pass) => pass,
            none => none.insert(self.bench.compile_pass(&kernel.compiled, Stage::Compute)?),
        };
        let given = kernel.buffers(cases);
        let mut inputs = Inputs::new(UVec2::from_array(given.size));
        let contents = given.contents.into_iter();
        inputs.buffers = contents.map(|(name, values)| (name.to_owned(), values)).collect();
        let uploaded = self.bench.upload(manifest, &inputs)?;
        self.bench.written_by(pass, &uploaded, inputs.size)?;
        let written = self.bench.read_buffers(manifest, &uploaded)?;
        Ok(kernel.outcomes(&written, cases.len()))
    }
}

impl Runner for DeviceRunner {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn run_cases(&mut self, kernel: &TestKernel, cases: &[Case]) -> Result<Vec<Outcome>, RunnerError> {
        self.run(kernel, cases)
            .map_err(|error| RunnerError::Failed(error.to_string()))
    }
}
