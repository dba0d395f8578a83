//! Runs shaders in languages that wgpu does not read: glslang makes SPIR-V of them, which wgpu hands to the Vulkan driver as it
//! is.

use crate::compilers;
use glam::Vec4;
use straightline_bench::execute::{AllWritten, Bench, Buffers, Inputs, SamplerState, Written, override_options};
use straightline_codegen::Stage;
use straightline_codegen::emit::{Emitted, Target};
use straightline_kernels::prelude::Frame;
use straightline_runtime::manifest::{Binding, BindingKind, LanguageKind, Manifest, SamplerType};
use straightline_runtime::{Pass, PassOptions};
use wgpu::Features;

/// A bench that runs SPIR-V, of any Vulkan adapter, with what kernels can use of it.
///
/// # Errors
///
/// If there is no such adapter: what to install.
pub fn bench() -> Result<Bench, String> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.map_err(|e| {
        format!("this test needs a Vulkan adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}")
    })?;
    let wanted = Features::FLOAT32_FILTERABLE | Features::SUBGROUP | Features::SHADER_F16 | Features::IMMEDIATES;
    let descriptor = wgpu::DeviceDescriptor {
        required_features: Features::PASSTHROUGH_SHADERS | (adapter.features() & wanted),
        // Several targets of full floats, and immediates, are more than WebGPU promises.
        required_limits: wgpu::Limits {
            max_color_attachment_bytes_per_sample: adapter.limits().max_color_attachment_bytes_per_sample,
            max_immediate_size: adapter.limits().max_immediate_size,
            ..wgpu::Limits::default()
        },
        ..Default::default()
    };
    let device = pollster::block_on(adapter.request_device(&descriptor));
    let (device, queue) = device.map_err(|e| format!("the adapter {}: {e}", adapter.get_info().name))?;
    Ok(Bench::new(&device, &queue, false))
}

/// The picture that the text of one language computes: GLSL 4.50 and HLSL as glslang compiles them, SPIR-V as it is. The shader
/// is one that writes full floats.
///
/// # Errors
///
/// What the compiler says of the text; or if it is not among the files, or cannot be run on these inputs.
pub fn run(bench: &Bench, emitted: &Emitted, target: Target, inputs: &Inputs) -> Result<Frame<Vec4>, String> {
    let mut written = run_all(bench, emitted, target, inputs)?;
    Ok(written.swap_remove(0).frame())
}

/// As [`run`], of everything that the kernel gives.
///
/// # Errors
///
/// Those of [`run`].
pub fn run_all(bench: &Bench, emitted: &Emitted, target: Target, inputs: &Inputs) -> Result<Vec<Written>, String> {
    all_written(bench, emitted, target, inputs).map(|(written, _)| written)
}

/// As [`run`], of the buffers that the kernel writes.
///
/// # Errors
///
/// Those of [`run`].
pub fn run_buffers(bench: &Bench, emitted: &Emitted, target: Target, inputs: &Inputs) -> Result<Buffers, String> {
    all_written(bench, emitted, target, inputs).map(|(_, buffers)| buffers)
}

fn all_written(bench: &Bench, emitted: &Emitted, target: Target, inputs: &Inputs) -> Result<AllWritten, String> {
    let bytes = emitted.files.get(&target);
    let bytes = bytes.ok_or_else(|| format!("it was not emitted in {target}"))?;
    let words = words(bytes, target, &emitted.manifest)?;
    written(bench, emitted.manifest.clone(), target, &words, inputs)
}

/// Everything that a kernel gives and writes, run as the SPIR-V of the text that its manifest describes.
///
/// # Errors
///
/// If it cannot be run on these inputs.
pub fn written(
    bench: &Bench,
    mut manifest: Manifest,
    target: Target,
    words: &[u32],
    inputs: &Inputs,
) -> Result<AllWritten, String> {
    if target == Target::Glsl450 {
        manifest.entry_point = "main".to_owned();
    }
    let inputs = with_language_bindings(&mut manifest, target, inputs)?;
    let pass = pass(bench, &manifest, words, &override_options(&manifest, &inputs))?;
    let uploaded = bench.upload(&manifest, &inputs).map_err(|e| e.to_string())?;
    let written = bench.written_by(&pass, &uploaded, inputs.size);
    let written = written.map_err(|e| e.to_string())?;
    let buffers = bench.read_buffers(&manifest, &uploaded).map_err(|e| e.to_string())?;
    Ok((written, buffers))
}

/// The SPIR-V of a file.
fn words(bytes: &[u8], target: Target, manifest: &Manifest) -> Result<Vec<u32>, String> {
    let text = String::from_utf8_lossy(bytes);
    match target {
        Target::Glsl450 => {
            let stage = match manifest.stage {
                Stage::Compute => "comp",
                Stage::Fragment => "frag",
            };
            compilers::compiled_glsl(&text, stage)
        }
        Target::Hlsl => compilers::compiled_hlsl(&text, manifest.stage, &manifest.entry_point),
        Target::Spirv => Ok(compilers::words(bytes)),
        _ => Err(format!("no compiler makes SPIR-V of {target} here")),
    }
}

/// Lists what the language binds beside the others among the inputs, and adds it to those given.
fn with_language_bindings(manifest: &mut Manifest, target: Target, inputs: &Inputs) -> Result<Inputs, String> {
    let mut inputs = inputs.clone();
    let language = target.to_string();
    let extras: Vec<_> = manifest
        .language_bindings
        .iter()
        .filter(|extra| extra.language == language)
        .cloned()
        .collect();
    for extra in extras {
        // Items with another name in this language are in the manifest already.
        if extra.of.is_some() {
            continue;
        }
        let (Some(group), Some(binding), LanguageKind::Sampler) = (extra.group, extra.binding, extra.kind) else {
            return Err(format!(
                "`{}` of {target} is not known here: {:?}",
                extra.name, extra.what
            ));
        };
        manifest.bindings.push(Binding {
            group,
            binding,
            name: extra.name.clone(),
            kind: BindingKind::Sampler {
                sampler: SamplerType::Filtering,
            },
        });
        let nearest = SamplerState {
            linear: false,
            ..SamplerState::default()
        };
        inputs = inputs.with_sampler(&extra.name, nearest);
    }
    Ok(inputs)
}

/// wgpu leaves SPIR-V unchecked. These words come from a compiler, of a text that the generator wrote together with the manifest.
#[allow(unsafe_code)]
fn pass(bench: &Bench, manifest: &Manifest, words: &[u32], options: &PassOptions) -> Result<Pass, String> {
    // SAFETY: text and manifest are of one run of the generator, whose texts read within bounds and have loops that end, and the
    // compiler made a valid module of the text.
    let pass = unsafe { Pass::from_spirv(bench.device(), manifest, words, options) };
    pass.map_err(|e| e.to_string())
}
