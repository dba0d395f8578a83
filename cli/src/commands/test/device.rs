//! Running the cases of a test on a GPU.

use crate::gpu::Gpu;
use glam::{UVec2, Vec4};
use straightline_bench::execute::{Address, Bench, ExecuteError, Inputs, SamplerState};
use straightline_codegen::testing::{Case, Outcome, Painted, Runner, RunnerError, TestKernel, TestPicture};
use straightline_codegen::{Manifest, Stage, interp};
use straightline_kernels::pictures::Drawn;
use straightline_kernels::prelude::Frame;
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

    /// Draws the picture of a test by each stage that can: a fragment shader has no assertions.
    pub fn draw(
        &self,
        kernel: &TestKernel,
        picture: &TestPicture,
        images: &[(String, Drawn)],
    ) -> Result<Vec<(String, Painted)>, RunnerError> {
        let mut inputs = Inputs::new(UVec2::from_array(picture.size));
        for (name, image) in images {
            let texels = image.texels.iter().copied().map(Vec4::from_array);
            inputs = inputs.with_image(name, Frame::new(image.size.into(), texels.collect()));
        }
        for (name, state) in &picture.samplers {
            inputs = inputs.with_sampler(name, sampler_state(*state));
        }
        let contents = kernel.picture_buffers(picture).contents.into_iter();
        inputs.buffers = contents.map(|(name, values)| (name.to_owned(), values)).collect();
        let mut stages = vec![(Stage::Compute, self.name.clone())];
        if !kernel.compiled.graph.has_effects() {
            stages.push((Stage::Fragment, format!("{}, as a fragment shader", self.name)));
        }
        let draw = |(stage, name)| {
            let (targets, buffers) = self.bench.all_written(&kernel.compiled, stage, &inputs)?;
            let texels = targets
                .first()
                .map(|target| target.texels.as_slice())
                .unwrap_or_default();
            let texels = texels.iter().map(|texel| texel.map(|component| component as f32));
            Ok((name, kernel.read_painted(picture, texels.collect(), &buffers)))
        };
        let drawn: Result<Vec<_>, ExecuteError> = stages.into_iter().map(draw).collect();
        drawn.map_err(|error| RunnerError::Failed(error.to_string()))
    }
}

/// A sampler's state as the runtime takes it.
fn sampler_state(state: interp::SamplerState) -> SamplerState {
    SamplerState {
        linear: state.linear,
        address: match state.address {
            interp::Address::Clamp => Address::Clamp,
            interp::Address::Repeat => Address::Repeat,
            interp::Address::Mirror => Address::Mirror,
        },
        linear_mip: state.linear_mip,
        ..SamplerState::default()
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
