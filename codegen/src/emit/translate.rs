//! Validation by naga, and the languages that naga writes.

use super::error::EmitError;
use super::resources::Resources;
use naga::back::{msl, spv};
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use straightline_manifest::Stage;

/// A validated module.
pub struct Module {
    kernel: String,
    module: naga::Module,
    info: ModuleInfo,
}

impl Module {
    /// Parses and validates WGSL.
    pub fn parse_wgsl(kernel: &str, text: &str) -> Result<Module, EmitError> {
        let invalid = |message| EmitError::Invalid {
            kernel: kernel.to_owned(),
            target: "wgsl",
            message,
        };
        let module = naga::front::wgsl::parse_str(text).map_err(|error| invalid(error.emit_to_string(text)))?;
        let info = validate(&module, text).map_err(invalid)?;
        Ok(Module {
            kernel: kernel.to_owned(),
            module,
            info,
        })
    }

    fn stage(resources: &Resources) -> naga::ShaderStage {
        stage(resources.options.stage)
    }

    fn failed(&self, target: &'static str, message: impl ToString) -> EmitError {
        EmitError::Translate {
            kernel: self.kernel.clone(),
            target,
            message: message.to_string(),
        }
    }

    /// SPIR-V 1.3.
    pub fn spirv(&self, resources: &Resources) -> Result<Vec<u32>, EmitError> {
        let options = spv::Options {
            lang_version: (1, 3),
            flags: spv::WriterFlags::DEBUG,
            force_loop_bounding: !resources.options.unbounded_loops,
            bounds_check_policies: restricted(),
            ..Default::default()
        };
        let pipeline = spv::PipelineOptions {
            shader_stage: Self::stage(resources),
            entry_point: resources.entry.clone(),
        };
        let words =
            spv::write_vec(&self.module, &self.info, &options, Some(&pipeline)).map_err(|e| self.failed("spirv", e))?;
        Ok(super::spirv::joined(&words))
    }

    /// Metal: textures and buffers by their binding numbers.
    pub fn msl(&self, resources: &Resources) -> Result<String, EmitError> {
        let mut slots = msl::EntryPointResources::default();
        let at = |binding| naga::ResourceBinding { group: 0, binding };
        for (_, binding) in &resources.read_buffers {
            let target = msl::BindTarget {
                buffer: Some(*binding as u8),
                ..Default::default()
            };
            slots.resources.insert(at(*binding), target);
        }
        for (_, binding) in &resources.used_samplers {
            let target = msl::BindTarget {
                sampler: Some(msl::BindSamplerTarget::Resource(*binding as u8)),
                ..Default::default()
            };
            slots.resources.insert(at(*binding), target);
        }
        if !resources.read_buffers.is_empty() {
            // Metal does not tell a shader how long a buffer is: the host writes the lengths here.
            slots.sizes_buffer = Some(resources.sampler_binding() as u8);
        }
        let textures = resources.read.iter().map(|t| (t.binding, false));
        for (binding, mutable) in textures.chain(resources.output_binding().map(|b| (b, true))) {
            let target = msl::BindTarget {
                texture: Some(binding as u8),
                mutable,
                ..Default::default()
            };
            slots.resources.insert(at(binding), target);
        }
        if let Some(binding) = resources.uniform_binding() {
            let target = msl::BindTarget {
                buffer: Some(binding as u8),
                ..Default::default()
            };
            slots.resources.insert(at(binding), target);
        }
        let entry = resources.entry.clone();
        let options = msl::Options {
            lang_version: (2, 0),
            per_entry_point_map: [(entry, slots)].into_iter().collect(),
            fake_missing_bindings: false,
            bounds_check_policies: restricted(),
            force_loop_bounding: !resources.options.unbounded_loops,
            ..Default::default()
        };
        let pipeline = msl::PipelineOptions::default();
        let (text, _) =
            msl::write_string(&self.module, &self.info, &options, &pipeline).map_err(|e| self.failed("msl", e))?;
        Ok(text)
    }
}

/// An index outside of an array is that of its last element, as it is to who reads the WGSL. Coordinates of texels and indices
/// of buffers are clamped in the text.
fn restricted() -> BoundsCheckPolicies {
    BoundsCheckPolicies {
        index: BoundsCheckPolicy::Restrict,
        ..BoundsCheckPolicies::default()
    }
}

pub(super) fn stage(stage: Stage) -> naga::ShaderStage {
    match stage {
        Stage::Compute => naga::ShaderStage::Compute,
        Stage::Fragment => naga::ShaderStage::Fragment,
    }
}

pub(super) fn validate(module: &naga::Module, text: &str) -> Result<ModuleInfo, String> {
    let mut validator = Validator::new(
        ValidationFlags::all(),
        Capabilities::SUBGROUP | Capabilities::SHADER_FLOAT16,
    );
    validator.validate(module).map_err(|error| error.emit_to_string(text))
}
