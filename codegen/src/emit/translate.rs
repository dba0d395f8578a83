//! Validation by naga, and the languages that naga writes.

use super::error::EmitError;
use super::resources::Resources;
use naga::back::{hlsl, msl, spv};
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use straightline_manifest::{Precision, Stage};

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

    /// HLSL of shader model 5.1, with quad operations 6.0, in half precision 6.2: group as space, binding as register.
    pub fn hlsl(&self, resources: &Resources) -> Result<String, EmitError> {
        let mut text = String::new();
        let mut options = hlsl::Options {
            force_loop_bounding: !resources.options.unbounded_loops,
            ..Default::default()
        };
        if resources.subgroups {
            options.shader_model = hlsl::ShaderModel::V6_0;
        }
        if resources.options.precision == Precision::F16 {
            options.shader_model = hlsl::ShaderModel::V6_2;
        }
        let pipeline = hlsl::PipelineOptions::default();
        let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
        writer
            .write(&self.module, &self.info, None)
            .map_err(|e| self.failed("hlsl", e))?;
        samplers_by_register(&text).ok_or_else(|| self.failed("hlsl", "naga binds samplers in a way that is not known"))
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

/// A table of constants as a list of its elements, where naga calls a function: no compiler needs to evaluate that then.
fn table(line: &str) -> String {
    let parts = line
        .strip_prefix("static const ")
        .and_then(|rest| rest.split_once(" = Constructarray"))
        .and_then(|(declared, call)| Some((declared, call.split_once('(')?.1.strip_suffix(");")?)));
    match parts {
        Some((declared, elements)) => format!("static const {declared} = {{ {elements} }};"),
        None => line.to_owned(),
    }
}

/// HLSL in which each sampler is bound by a register of its binding's number. naga writes wgpu's own scheme: an array of all
/// samplers, and a buffer that says which of them each one is.
fn samplers_by_register(text: &str) -> Option<String> {
    let mut out = String::new();
    for line in text.lines() {
        let declares = |what: &str| line.starts_with(what);
        if declares("SamplerState nagaSamplerHeap[")
            || declares("SamplerComparisonState nagaComparisonSamplerHeap[")
            || declares("StructuredBuffer<uint> nagaGroup0SamplerIndexArray ")
        {
            continue;
        }
        match line.strip_prefix("static const Sampler") {
            Some(rest) => {
                let (declared, from) = rest.split_once(" = naga")?;
                let (_, index) = from.split_once("[nagaGroup0SamplerIndexArray[")?;
                let register: u32 = index.strip_suffix("]];")?.parse().ok()?;
                out += &format!("Sampler{declared} : register(s{register});");
            }
            None => out += &table(line),
        }
        out.push('\n');
    }
    let known = !out.contains("SamplerHeap[") && !out.contains("SamplerIndexArray");
    known.then_some(out)
}
