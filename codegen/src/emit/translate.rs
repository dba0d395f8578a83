//! Validation by naga, and its output languages.

use super::derived::Derived;
use super::print::PrintedText;
use super::refusal::Refusal;
use super::resources::Resources;
use super::source_map::file_text;
use super::spirv::{SourceFile, SpecConstant};
use crate::compiled::Compiled;
use crate::spec::{DebugInfo, Target};
use naga::back::{msl, spv};
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use std::time::Duration;
use straightline_evaluator::diagnostic::Code;
use straightline_evaluator::ir::Type;
use straightline_manifest::Stage;

/// Returns the time limit for naga to parse a number of statements: quadratic, 5 s for 10 000 on a slow machine.
pub fn time_to_parse(statements: u32) -> Duration {
    Duration::from_secs_f64((f64::from(statements) / 10_000.0).powi(2) * 5.0)
}

/// A validated module.
pub struct Module<'g> {
    kernel: String,
    /// The WGSL that it was parsed from.
    wgsl: PrintedText<'g>,
    module: naga::Module,
    info: ModuleInfo,
}

impl<'g> Module<'g> {
    /// Parses and validates WGSL.
    pub fn parse_wgsl(kernel: &str, wgsl: PrintedText<'g>) -> Result<Module<'g>, Refusal> {
        let (module, info) = validate_wgsl(kernel, &wgsl.text)?;
        Ok(Module {
            kernel: kernel.to_owned(),
            wgsl,
            module,
            info,
        })
    }

    fn entry_stage(resources: &Resources) -> naga::ShaderStage {
        naga_stage(resources.options.stage)
    }

    fn translation_error(&self, target: &'static str, message: impl ToString) -> Refusal {
        let what = format!(
            "`{}` cannot be written in {target}: {}",
            self.kernel,
            message.to_string()
        );
        Refusal::new(Code::Untranslated, what).help(format!("leave the language {target} out"))
    }

    /// SPIR-V 1.3.
    pub fn to_spirv(&self, resources: &Resources, compiled: &Compiled) -> Result<Vec<u32>, Refusal> {
        let has_lines = resources.options.debug == DebugInfo::Lines;
        let options = spv::Options {
            debug_info: has_lines.then_some(spv::DebugInfo {
                source_code: &self.wgsl.text,
                file_name: "",
                language: naga::back::spv::SourceLanguage::Unknown,
            }),
            lang_version: (1, 3),
            flags: spv::WriterFlags::DEBUG,
            force_loop_bounding: !resources.options.unbounded_loops,
            bounds_check_policies: bounds_checks(resources),
            zero_initialize_workgroup_memory: match resources.is_zeroed() {
                true => spv::ZeroInitializeWorkgroupMemoryMode::Polyfill,
                false => spv::ZeroInitializeWorkgroupMemoryMode::None,
            },
            ..Default::default()
        };
        let pipeline = spv::PipelineOptions {
            shader_stage: Self::entry_stage(resources),
            entry_point: resources.entry.clone(),
        };
        let words = spv::write_vec(&self.module, &self.info, &options, Some(&pipeline))
            .map_err(|e| self.translation_error("spirv", e))?;
        let words = match has_lines {
            true => super::spirv::set_source_lines(&words, &self.wgsl.statements, |file| SourceFile {
                path: resources.files.get(file as usize).map_or("", String::as_str),
                text: file_text(compiled, file).unwrap_or_default(),
            }),
            false => words,
        };
        let words = super::spirv::join_blocks(&super::spirv::forbid_contraction(&words));
        let words = super::spirv::inline_functions(&words);
        let named = resources.spelled_for(Target::Wgsl)?;
        let held = named.overrides.iter().map(|(k, bound)| SpecConstant {
            variable: named.derived_name(Derived::Held(*k)),
            name: &bound.of.name,
            id: bound.of.id,
            default: bound.of.default_bits(),
            is_bool: bound.of.ty == Type::BOOL,
        });
        Ok(super::spirv::add_spec_constants(&words, &held.collect::<Vec<_>>()))
    }

    /// Translates to Metal; returns the text and the name of the entry point. Textures, buffers and samplers are numbered
    /// by their bindings, each kind separately.
    pub fn to_msl(&self, resources: &Resources) -> Result<(String, String), Refusal> {
        let mut slots = msl::EntryPointResources::default();
        let group = resources.places.bind_group();
        let mut bind = |binding: u32, target: msl::BindTarget| {
            slots.resources.insert(naga::ResourceBinding { group, binding }, target);
        };
        let textures = resources.read.iter().map(|t| (t.binding, false));
        let written = resources.outputs.iter().filter_map(|output| output.binding);
        for (binding, mutable) in textures.chain(written.map(|binding| (binding, true))) {
            let texture = Some(self.msl_slot("texture", binding, LAST_TEXTURE)?);
            bind(
                binding,
                msl::BindTarget {
                    texture,
                    mutable,
                    ..Default::default()
                },
            );
        }
        for (_, binding) in &resources.used_samplers {
            let slot = self.msl_slot("sampler", *binding, LAST_SAMPLER)?;
            let sampler = Some(msl::BindSamplerTarget::Resource(slot));
            bind(
                *binding,
                msl::BindTarget {
                    sampler,
                    ..Default::default()
                },
            );
        }
        let buffers = resources
            .read_buffers
            .iter()
            .map(|(k, binding)| (*binding, resources.is_written(*k)));
        let own = resources.uniform_binding();
        let uniforms = [own.filter(|_| !resources.has_immediates()), resources.region_binding()];
        let uniforms = uniforms.into_iter().flatten().map(|binding| (binding, false));
        for (binding, mutable) in buffers.chain(uniforms) {
            let buffer = Some(self.msl_slot("buffer", binding, LAST_BUFFER)?);
            bind(
                binding,
                msl::BindTarget {
                    buffer,
                    mutable,
                    ..Default::default()
                },
            );
        }
        if let Some(binding) = own.filter(|_| resources.has_immediates()) {
            slots.immediates_buffer = Some(self.msl_slot("buffer", binding, LAST_BUFFER)?);
        }
        if !resources.read_buffers.is_empty() {
            // A Metal shader cannot query a buffer's length: the host writes the lengths to this buffer.
            slots.sizes_buffer = Some(self.msl_slot("buffer", resources.sizes_binding(), LAST_BUFFER)?);
        }
        let entry = resources.entry.clone();
        let options = msl::Options {
            lang_version: (2, 0),
            per_entry_point_map: [(entry, slots)].into_iter().collect(),
            fake_missing_bindings: false,
            bounds_check_policies: bounds_checks(resources),
            zero_initialize_workgroup_memory: resources.is_zeroed(),
            force_loop_bounding: !resources.options.unbounded_loops,
            ..Default::default()
        };
        let pipeline = msl::PipelineOptions::default();
        let (text, info) = msl::write_string(&self.module, &self.info, &options, &pipeline)
            .map_err(|e| self.translation_error("msl", e))?;
        let name = match info.entry_point_names.into_iter().next() {
            Some(Ok(name)) => name,
            Some(Err(error)) => return Err(self.translation_error("msl", error)),
            None => return Err(self.translation_error("msl", "it has no entry point")),
        };
        // naga appends an underscore to names that end in digits or are reserved.
        let is_word = name != resources.entry && !resources.entry.ends_with(|c: char| c.is_ascii_digit());
        if is_word && resources.options.entry.is_some() {
            return Err(Refusal::entry_name(&self.kernel, &resources.entry, "is a word of MSL"));
        }
        Ok((text, name))
    }

    /// Returns the Metal slot of a binding number. Fails if there is none.
    fn msl_slot(&self, kind: &str, binding: u32, last: u32) -> Result<u8, Refusal> {
        match u8::try_from(binding) {
            Ok(slot) if binding <= last => Ok(slot),
            _ => Err(Refusal::invalid_binding(
                &self.kernel,
                &format!("the binding number {binding} is that of a {kind}, and MSL numbers {kind}s 0 to {last}"),
                "give it a lower number, or leave the language msl out",
            )),
        }
    }
}

/// The largest indices of Metal on Macs.
const LAST_TEXTURE: u32 = 127;
const LAST_SAMPLER: u32 = 15;
const LAST_BUFFER: u32 = 30;

/// Clamps an array index out of bounds to the last element, as in WGSL. Not needed if a shader only has tiles of texels.
/// Coordinates of texels and indices of buffers are clamped in the text.
fn bounds_checks(resources: &Resources) -> BoundsCheckPolicies {
    BoundsCheckPolicies {
        index: match resources.indexes_tiles_alone {
            true => BoundsCheckPolicy::Unchecked,
            false => BoundsCheckPolicy::Restrict,
        },
        ..BoundsCheckPolicies::default()
    }
}

/// Parses and validates WGSL.
pub fn validate_wgsl(kernel: &str, text: &str) -> Result<(naga::Module, ModuleInfo), Refusal> {
    let invalid = |message: String| Refusal::invalid_text(kernel, "wgsl", &message);
    let module = naga::front::wgsl::parse_str(text).map_err(|error| invalid(error.emit_to_string(text)))?;
    let info = validate_module(&module, text).map_err(invalid)?;
    Ok((module, info))
}

/// Parses and validates GLSL 4.50.
pub fn validate_glsl(kernel: &str, of: Stage, text: &str) -> Result<(), Refusal> {
    let invalid = |message: String| Refusal::invalid_text(kernel, "glsl450", &message);
    let options = naga::front::glsl::Options::from(naga_stage(of));
    let module = naga::front::glsl::Frontend::default()
        .parse(&options, text)
        .map_err(|error| invalid(error.emit_to_string(text)))?;
    validate_module(&module, text).map_err(invalid).map(drop)
}

fn naga_stage(stage: Stage) -> naga::ShaderStage {
    match stage {
        Stage::Compute => naga::ShaderStage::Compute,
        Stage::Fragment => naga::ShaderStage::Fragment,
    }
}

fn validate_module(module: &naga::Module, text: &str) -> Result<ModuleInfo, String> {
    let mut validator = Validator::new(
        ValidationFlags::all(),
        Capabilities::SUBGROUP | Capabilities::SHADER_FLOAT16 | Capabilities::IMMEDIATES,
    );
    validator.validate(module).map_err(|error| error.emit_to_string(text))
}
