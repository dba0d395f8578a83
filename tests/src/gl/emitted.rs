//! Running what the generator emits for OpenGL, by its manifest.

use super::{Context, Program, Texture, Uniform};
use straightline_bench::execute::{Inputs, SamplerState};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Format, Stage};
use straightline_kernels::prelude::{Frame, Vec4};
use straightline_manifest::{BindingKind, Dimension, Element, Manifest, SampleType, Scalar, UniformField, ValueType};

/// The picture that the text of a language of OpenGL computes, row by row from the first; pixel rows count as the kernel's do.
///
/// # Errors
///
/// It is not among the files, or what the driver says.
pub fn run(context: &Context, emitted: &Emitted, target: Target, inputs: &Inputs) -> Result<Frame<Vec4>, String> {
    run_output(context, emitted, target, inputs, 0)
}

/// As [`run`], of one of the values that the kernel gives, by its index in the manifest.
///
/// # Errors
///
/// Those of [`run`].
pub fn run_output(
    context: &Context,
    emitted: &Emitted,
    target: Target,
    inputs: &Inputs,
    output: usize,
) -> Result<Frame<Vec4>, String> {
    let bytes = emitted.files.get(&target);
    let bytes = bytes.ok_or_else(|| format!("it was not emitted in {target}"))?;
    let text = String::from_utf8_lossy(bytes);
    let manifest = &emitted.manifest;
    let (size, output) = (inputs.size.to_array(), &manifest.outputs[output]);
    let mut program = match (manifest.stage, manifest.workgroup_size) {
        (Stage::Compute, Some([width, height, _])) => {
            let covered = [width * manifest.block[0], height * manifest.block[1]];
            Program::compute(&text, size, covered, output.binding.unwrap_or_default())
        }
        _ => Program::fragment(&text, size).location(output.location.unwrap_or_default()),
    };
    for other in manifest.outputs.iter().filter(|other| other.name != output.name) {
        if let Some(binding) = other.binding {
            program = program.other_image(binding, other.format);
        }
    }
    if output.format != Format::Rgba32Float {
        program = program.format(output.format);
    }
    let language = target.to_string();
    for extra in manifest
        .language_bindings
        .iter()
        .filter(|extra| extra.language == language)
    {
        // Buffers, uniforms and the output have what the manifest's bindings say of them.
        let Some(of) = extra.texture.as_deref() else {
            continue;
        };
        program = program.texture(texture(manifest, inputs, &extra.name, of, extra.sampler.as_deref())?);
    }
    for field in manifest.immediates.iter().flat_map(|immediates| &immediates.fields) {
        program = program.uniform(&field.name, value(field, inputs)?);
    }
    for binding in &manifest.bindings {
        match &binding.kind {
            BindingKind::Uniform { fields, .. } => {
                for field in fields {
                    program = program.uniform(&field.name, value(field, inputs)?);
                }
            }
            BindingKind::Buffer {
                element: Element::Structure(_),
                ..
            } => {
                return Err(format!(
                    "`{}` holds structures, which are not laid out here",
                    binding.name
                ));
            }
            BindingKind::Buffer {
                element: Element::Value(ty),
                ..
            } => {
                let elements = inputs.buffers.iter().find(|(name, _)| *name == binding.name);
                let (_, elements) = elements.ok_or_else(|| format!("no buffer `{}`", binding.name))?;
                program = program.buffer(binding.binding, element_bytes(elements, *ty));
            }
            BindingKind::Texture { .. } | BindingKind::Sampler { .. } => {}
        }
    }
    let pixels = context.run(&program)?;
    Ok(Frame::new(
        inputs.size,
        pixels.into_iter().map(Vec4::from_array).collect(),
    ))
}

/// Elements of a buffer as they lie in it.
fn element_bytes(elements: &[[f64; 4]], ty: ValueType) -> Vec<u8> {
    let word = |x: &f64| match ty.scalar() {
        Scalar::F32 => (*x as f32).to_le_bytes(),
        Scalar::I32 => (*x as i32).to_le_bytes(),
        Scalar::U32 => (*x as u32).to_le_bytes(),
    };
    let components = elements.iter().flat_map(|e| &e[..ty.components().into()]);
    components.flat_map(word).collect()
}

fn texture(
    manifest: &Manifest,
    inputs: &Inputs,
    name: &str,
    of: &str,
    sampler: Option<&str>,
) -> Result<Texture, String> {
    let images = inputs.images.iter().find(|(known, _)| known == of);
    let (_, images) = images.ok_or_else(|| format!("no image `{of}`"))?;
    let bound = manifest.bindings.iter().find(|binding| binding.name == of);
    let dimension = bound.and_then(|binding| match binding.kind {
        BindingKind::Texture { dimension, .. } => Some(dimension),
        _ => None,
    });
    let mut texture = match dimension {
        Some(Dimension::D2Array) => Texture::array(name, images),
        Some(Dimension::D2) => Texture::image(name, images.first().ok_or("an image has a layer")?),
        other => return Err(format!("`{of}` is {other:?}, which is not bound here")),
    };
    if let Some(sampler) = sampler {
        let state = inputs.samplers.iter().find(|(known, _)| known == sampler);
        texture = texture.sampler(state.map_or_else(SamplerState::default, |(_, state)| *state));
        let compares = bound.is_some_and(|binding| {
            matches!(&binding.kind, BindingKind::Texture { sample_type, .. } if *sample_type == SampleType::Depth)
        });
        if compares {
            texture = texture.compares();
        }
    }
    Ok(texture)
}

fn value(field: &UniformField, inputs: &Inputs) -> Result<Uniform, String> {
    let given = inputs.uniforms.iter().find(|(name, _)| *name == field.name);
    let lanes = match (given, field.default) {
        _ if field.frame_size => inputs.size.to_array().map(f64::from).to_vec(),
        (Some((_, lanes)), _) => lanes.clone(),
        (None, Some(default)) => vec![default],
        (None, None) => return Err(format!("the uniform `{}` is not set", field.name)),
    };
    Ok(match field.ty.scalar() {
        Scalar::F32 => Uniform::Float(lanes.iter().map(|x| *x as f32).collect()),
        Scalar::U32 => Uniform::Uint(lanes.iter().map(|x| *x as u32).collect()),
        Scalar::I32 => Uniform::Int(lanes.iter().map(|x| *x as i32).collect()),
    })
}
