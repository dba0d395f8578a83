//! Chains of passes on a device.

use super::gpu::Uploaded;
use super::{Bench, ExecuteError, Inputs, Written, picture_size};
use glam::UVec2;
use std::collections::BTreeMap;
use straightline_codegen::chain::EmittedChain;
use straightline_codegen::emit::Target;
use straightline_manifest::{Binding, BindingKind, Manifest};
use straightline_runtime::{Chain, PassOptions, Shader};

impl Bench {
    /// Makes a chain of its emitted shaders.
    ///
    /// # Errors
    ///
    /// If the device cannot run one of them.
    pub fn create_chain(&self, emitted: &EmittedChain) -> Result<Chain, ExecuteError> {
        let texts: Vec<(&str, &Manifest, String)> = emitted
            .shaders
            .iter()
            .map(|(name, pass)| {
                let wgsl = pass
                    .emitted
                    .files
                    .get(&Target::Wgsl)
                    .map(Vec::as_slice)
                    .unwrap_or_default();
                (
                    name.as_str(),
                    &pass.emitted.manifest,
                    String::from_utf8_lossy(wgsl).into_owned(),
                )
            })
            .collect();
        let shaders: Vec<(&str, Shader<'_>)> = texts
            .iter()
            .map(|(name, manifest, wgsl)| Ok((*name, Shader::from_manifest(manifest, wgsl)?)))
            .collect::<Result<_, ExecuteError>>()?;
        let shaders: Vec<(&str, &Shader<'_>)> = shaders.iter().map(|(name, shader)| (*name, shader)).collect();
        Ok(Chain::from_shaders(
            &self.device,
            &emitted.plan,
            &shaders,
            &PassOptions::default(),
        )?)
    }

    /// Puts onto the device what a chain takes from the caller.
    ///
    /// # Errors
    ///
    /// If something is missing, or the device refuses it.
    pub fn upload_for_chain(&self, emitted: &EmittedChain, inputs: &Inputs) -> Result<Uploaded, ExecuteError> {
        let mut bindings: BTreeMap<&str, Binding> = BTreeMap::new();
        let mut structs: Vec<Binding> = Vec::new();
        let mut manifest: Option<Manifest> = None;
        for pass in emitted.plan.passes.iter() {
            let own = &emitted.shaders[&*pass.shader].emitted.manifest;
            for read in pass
                .reads
                .iter()
                .filter(|read| emitted.plan.inputs.contains(&read.from))
            {
                let found = own.bindings.iter().find(|binding| *binding.name == *read.name);
                if let Some(found) = found {
                    let mut binding = found.clone();
                    binding.name = read.from.to_string();
                    widen(bindings.entry(&read.from).or_insert(binding), found);
                }
            }
            structs.extend(own.bindings.iter().filter_map(without_frame_size));
            manifest.get_or_insert_with(|| own.clone());
        }
        let Some(mut manifest) = manifest else {
            return Err(ExecuteError::Input("the chain has no passes".to_owned()));
        };
        manifest.bindings = bindings.into_values().chain(structs).collect();
        self.upload(&manifest, inputs)
    }

    /// Runs a chain, whose results are of 32-bit components, and returns them.
    ///
    /// # Errors
    ///
    /// If it cannot be run on these inputs.
    pub fn run_chain(&self, emitted: &EmittedChain, inputs: &Inputs) -> Result<Vec<Written>, ExecuteError> {
        let chain = self.create_chain(emitted)?;
        let uploaded = self.upload_for_chain(emitted, inputs)?;
        let targets: Vec<(&str, UVec2, wgpu::Texture)> = emitted
            .plan
            .results()
            .zip(chain.targets())
            .map(|(picture, (name, format))| {
                let size = picture_size(&picture.size, inputs)?;
                Ok((name, size, self.create_target(size, format)))
            })
            .collect::<Result<_, ExecuteError>>()?;
        let views: Vec<wgpu::TextureView> = targets
            .iter()
            .map(|(_, _, texture)| texture.create_view(&wgpu::TextureViewDescriptor::default()))
            .collect();
        let named: Vec<(&str, &wgpu::TextureView)> = targets.iter().map(|(name, ..)| *name).zip(&views).collect();
        let bound = uploaded.bind_chain(&chain, &named)?;
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bound.encode(&mut encoder);
        self.queue.submit([encoder.finish()]);
        let written = targets.iter().map(|(name, size, texture)| {
            Ok(Written {
                name: (*name).to_owned(),
                size: *size,
                texels: self.read_texels(texture)?,
            })
        });
        written.collect()
    }
}

/// A uniform struct without the size of the frame, which each pass has from its targets; `None` of other bindings.
fn without_frame_size(binding: &Binding) -> Option<Binding> {
    let mut binding = binding.clone();
    match &mut binding.kind {
        BindingKind::Uniform { fields, .. } => fields.retain(|field| !field.frame_size),
        _ => return None,
    }
    Some(binding)
}

/// Lets the texture of `binding` have as many components as `other` reads.
fn widen(binding: &mut Binding, other: &Binding) {
    if let (BindingKind::Texture { components, .. }, BindingKind::Texture { components: more, .. }) =
        (&mut binding.kind, &other.kind)
    {
        *components = (*components).max(*more);
    }
}
