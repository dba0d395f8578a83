//! Chains of passes on a device.

use super::gpu::Uploaded;
use super::parameters::override_options;
use super::{Bench, ExecuteError, Inputs, Work, Written, picture_size};
use std::time::Duration;
use straightline_codegen::chain::EmittedChain;
use straightline_runtime::{BoundChain, Chain, PassOptions, Shader};

impl Bench {
    /// Makes a chain of its emitted shaders.
    ///
    /// # Errors
    ///
    /// If the device cannot run one of them.
    pub fn create_chain(&self, emitted: &EmittedChain, options: &PassOptions) -> Result<Chain, ExecuteError> {
        let shaders = emitted.shaders.iter().map(|(name, pass)| {
            let shader = Shader::from_manifest(&pass.emitted.manifest, pass.emitted.wgsl())?;
            Ok((name.as_str(), shader))
        });
        let shaders = shaders.collect::<Result<Vec<_>, ExecuteError>>()?;
        let shaders: Vec<(&str, &Shader<'_>)> = shaders.iter().map(|(name, shader)| (*name, shader)).collect();
        Ok(Chain::from_shaders(&self.device, &emitted.plan, &shaders, options)?)
    }

    /// Puts onto the device what a chain takes from the caller.
    ///
    /// # Errors
    ///
    /// If something is missing, or the device refuses it.
    pub fn upload_for_chain(&self, emitted: &EmittedChain, inputs: &Inputs) -> Result<Uploaded, ExecuteError> {
        self.upload_bindings((&emitted.bindings(), None), inputs, &Uploaded::default())
    }

    /// A chain with its inputs, targets and the textures between its passes.
    ///
    /// # Errors
    ///
    /// If it cannot be run on these inputs.
    pub fn bind_chain(&self, emitted: &EmittedChain, inputs: &Inputs) -> Result<BoundChain, ExecuteError> {
        let mut options = PassOptions::default();
        for pass in emitted.shaders.values() {
            let of_pass = override_options(&pass.emitted.manifest, inputs);
            options.overrides.extend(of_pass.overrides);
        }
        let chain = self.create_chain(emitted, &options)?;
        let uploaded = self.upload_for_chain(emitted, inputs)?;
        let mut views = Vec::new();
        for (picture, (name, format)) in emitted.plan.results().zip(chain.targets()) {
            let target = self.create_target(picture_size(&picture.size, inputs)?, format);
            views.push((name, target.create_view(&wgpu::TextureViewDescriptor::default())));
        }
        let targets: Vec<(&str, &wgpu::TextureView)> = views.iter().map(|(name, view)| (*name, view)).collect();
        Ok(chain.bind_with(&uploaded.resources(), targets.as_slice(), &uploaded.bind_options())?)
    }

    /// Runs a chain, whose results are of 32-bit components, and returns them.
    ///
    /// # Errors
    ///
    /// If it cannot be run on these inputs.
    pub fn run_chain(&self, emitted: &EmittedChain, inputs: &Inputs) -> Result<Vec<Written>, ExecuteError> {
        let bound = self.bind_chain(emitted, inputs)?;
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bound.encode(&mut encoder);
        self.queue.submit([encoder.finish()]);
        let views = emitted.plan.results().filter_map(|picture| {
            let view = bound.picture(&picture.name)?;
            Some((picture, view.texture()))
        });
        let written = views.map(|(picture, texture)| {
            Ok(Written {
                name: picture.name.to_string(),
                size: picture_size(&picture.size, inputs)?,
                texels: self.read_texels(texture)?,
            })
        });
        written.collect()
    }

    /// A chain to be timed with others, repeated as [`timed_for`](Self::timed_for) says. The times of its passes are added up.
    ///
    /// # Errors
    ///
    /// If the device cannot be asked for the time.
    pub fn chain_work<'a>(&self, bound: &'a BoundChain, least: Duration) -> Result<Work<'a>, ExecuteError> {
        let passes = bound.passes().len() as u32;
        self.recorded_work(passes, least, move |encoder, timer| {
            match timer {
                Some(timer) => bound.encode_timed(encoder, timer)?,
                None => bound.encode(encoder),
            }
            Ok(())
        })
    }
}
