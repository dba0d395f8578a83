//! Chains of passes, to be timed.

use super::{Bench, ExecuteError, Inputs, Work, picture_size};
use std::time::Duration;
use straightline_codegen::chain::EmittedChain;
use straightline_runtime::BoundChain;

impl Bench {
    /// A chain with its inputs, targets and the textures between its passes.
    ///
    /// # Errors
    ///
    /// If it cannot be run on these inputs.
    pub fn bind_chain(&self, emitted: &EmittedChain, inputs: &Inputs) -> Result<BoundChain, ExecuteError> {
        let chain = self.create_chain(emitted)?;
        let uploaded = self.upload_for_chain(emitted, inputs)?;
        let mut views = Vec::new();
        for (picture, (name, format)) in emitted.plan.results().zip(chain.targets()) {
            let target = self.create_target(picture_size(&picture.size, inputs)?, format);
            views.push((name, target.create_view(&wgpu::TextureViewDescriptor::default())));
        }
        let targets: Vec<(&str, &wgpu::TextureView)> = views.iter().map(|(name, view)| (*name, view)).collect();
        Ok(uploaded.bind_chain(&chain, &targets)?)
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
