//! Compute shaders on a driver without wgpu: GLSL compiled by glslang, HLSL compiled by DXC, SPIR-V unchanged.
//!
//! Without wgpu's additions: no texture is zeroed, no access is made robust, no text is validated.

use crate::compilers;
use glam::{UVec2, Vec4};
use straightline_bench::execute::Inputs;
use straightline_codegen::Stage;
use straightline_codegen::emit::{Emitted, Target};
use straightline_foreign::vulkan::{Binding, Device, Dispatch, Format, Image, Resource};
use straightline_kernels::prelude::Frame;
use straightline_runtime::manifest::{
    BindingKind, Dimension, Element, LanguageKind, Manifest, SampleType, SamplerType, Scalar, UniformField, ValueType,
};

/// Languages that can run without wgpu.
pub const LANGUAGES: [Target; 3] = [Target::Glsl450, Target::Spirv, Target::Hlsl];

/// Initial bits of each component of a target: a small number that no shader computes by chance.
pub const SENTINEL: u32 = 0x9a5a_5a5a;

/// A compute shader's text in one language, as SPIR-V.
#[derive(Clone, Debug)]
pub struct Shader {
    manifest: Manifest,
    target: Target,
    words: Vec<u32>,
    entry: String,
}

impl Shader {
    /// Compiles the text of a language, one of [`LANGUAGES`].
    ///
    /// # Errors
    ///
    /// A compiler refuses the text, it was not emitted, or the shader is no compute shader.
    pub fn new(emitted: &Emitted, target: Target) -> Result<Shader, String> {
        let manifest = &emitted.manifest;
        if manifest.stage != Stage::Compute {
            return Err("only compute shaders are run here".to_owned());
        }
        let bytes = emitted.files.get(&target);
        let bytes = bytes.ok_or_else(|| format!("it was not emitted in {target}"))?;
        let text = String::from_utf8_lossy(bytes);
        let mut entry = manifest.entry_point.clone();
        let words = match target {
            Target::Glsl450 => {
                "main".clone_into(&mut entry);
                compilers::compiled_glsl(&text, "comp")?
            }
            Target::Hlsl => compilers::spirv_by_dxc(&text, manifest.stage, &entry)?,
            Target::Spirv => compilers::words(bytes),
            _ => return Err(format!("nothing makes SPIR-V of {target} here")),
        };
        Ok(Shader {
            manifest: manifest.clone(),
            target,
            words,
            entry,
        })
    }

    /// Runs the shader and returns its targets in order. Their texels must be four floats, as `Bench::options` requests.
    /// Unwritten texels keep [`SENTINEL`].
    ///
    /// Inputs may be single pictures of floats or integers, uniforms and buffers of numbers and vectors, and samplers.
    ///
    /// # Errors
    ///
    /// If the driver refuses the shader, or an input is not supported here.
    pub fn run(&self, device: &Device, inputs: &Inputs) -> Result<Vec<Frame<Vec4>>, String> {
        let manifest = &self.manifest;
        let mut bindings = bindings(manifest, inputs)?;
        bindings.extend(own_bindings(manifest, self.target)?);
        let first_target = bindings.len();
        for output in &manifest.outputs {
            let (Some(set), Some(number)) = (output.group, output.binding) else {
                return Err(format!("`{}` is bound nowhere", output.name));
            };
            let texels = (inputs.size.x * inputs.size.y) as usize;
            let bytes = SENTINEL.to_le_bytes().repeat(4 * texels);
            bindings.push(Binding {
                set,
                number,
                resource: Resource::Target(image(Format::Rgba32Float, inputs.size, bytes)),
            });
        }
        let dispatch = Dispatch {
            words: &self.words,
            entry: &self.entry,
            groups: groups(manifest, inputs.size)?,
        };
        device.dispatch(&dispatch, &mut bindings)?;
        let targets = bindings[first_target..].iter().map(|binding| match &binding.resource {
            Resource::Target(image) => frame(image),
            _ => unreachable!("only targets were added"),
        });
        Ok(targets.collect())
    }
}

fn groups(manifest: &Manifest, size: UVec2) -> Result<[u32; 3], String> {
    let [x, y, _] = manifest.workgroup_size.ok_or("no workgroup")?;
    let [across, down] = manifest.block;
    Ok([size.x.div_ceil(x * across), size.y.div_ceil(y * down), 1])
}

/// Bindings of the manifest, except for its targets.
fn bindings(manifest: &Manifest, inputs: &Inputs) -> Result<Vec<Binding>, String> {
    let bound = manifest.bindings.iter().map(|binding| {
        Ok(Binding {
            set: binding.group,
            number: binding.binding,
            resource: resource(&binding.name, &binding.kind, inputs)?,
        })
    });
    bound.collect()
}

/// Additional bindings of a language.
fn own_bindings(manifest: &Manifest, target: Target) -> Result<Vec<Binding>, String> {
    let language = target.to_string();
    let own = manifest.language_bindings.iter();
    let own = own.filter(|own| own.language == language && own.of.is_none());
    let bound = own.map(|own| match (own.group, own.binding, own.kind) {
        (Some(set), Some(number), LanguageKind::Sampler) => Ok(Binding {
            set,
            number,
            resource: Resource::Sampler { linear: false },
        }),
        _ => Err(format!("`{}` of {target} is not known here", own.name)),
    });
    bound.collect()
}

fn resource(name: &str, kind: &BindingKind, inputs: &Inputs) -> Result<Resource, String> {
    let unknown = || format!("`{name}` is of a kind that is not known here");
    let missing = || format!("nothing is given for `{name}`");
    Ok(match kind {
        BindingKind::Texture {
            dimension: Dimension::D2,
            sample_type,
            ..
        } => Resource::Texture(match sample_type {
            SampleType::Filterable | SampleType::Unfilterable => {
                let texels = single(&inputs.images, name).ok_or_else(missing)?;
                let numbers = texels.texels().iter().flat_map(|texel| texel.to_array());
                image(
                    Format::Rgba32Float,
                    texels.size(),
                    numbers.flat_map(f32::to_le_bytes).collect(),
                )
            }
            SampleType::Sint | SampleType::Uint => {
                let texels = single(&inputs.integers, name).ok_or_else(missing)?;
                let numbers = texels.texels().iter().flat_map(|texel| texel.to_array());
                let format = match sample_type {
                    SampleType::Sint => Format::Rgba32Sint,
                    _ => Format::Rgba32Uint,
                };
                image(format, texels.size(), numbers.flat_map(u32::to_le_bytes).collect())
            }
            SampleType::Depth => return Err(unknown()),
        }),
        BindingKind::Sampler {
            sampler: SamplerType::Comparison,
        } => return Err(unknown()),
        BindingKind::Sampler { sampler } => Resource::Sampler {
            linear: *sampler == SamplerType::Filtering && find(&inputs.samplers, name).is_none_or(|state| state.linear),
        },
        BindingKind::Buffer {
            element: Element::Value(ty),
            ..
        } if ty.is_single() => {
            let elements = find(&inputs.buffers, name).ok_or_else(missing)?;
            let bytes = elements.iter().flat_map(|element| number_bytes(*ty, element));
            Resource::Buffer(bytes.collect())
        }
        BindingKind::Uniform { size, fields, .. } => Resource::Uniform(uniform(*size, fields, inputs)?),
        _ => return Err(unknown()),
    })
}

/// Returns the bytes of a uniform buffer. A uniform without a value has its default.
fn uniform(size: u32, fields: &[UniformField], inputs: &Inputs) -> Result<Vec<u8>, String> {
    let mut bytes = vec![0; size as usize];
    for field in fields.iter().filter(|field| field.ty.is_single()) {
        let given = match field.frame_size {
            true => Some(inputs.size.to_array().map(f64::from).to_vec()),
            false => find(&inputs.uniforms, &field.name).cloned(),
        };
        let numbers = given.or_else(|| field.default.map(|default| vec![default]));
        let numbers = numbers.ok_or_else(|| format!("nothing is given for `{}`", field.name))?;
        let own = number_bytes(field.ty, &numbers);
        let at = field.offset as usize;
        bytes[at..at + own.len()].copy_from_slice(&own);
    }
    match fields.iter().find(|field| !field.ty.is_single()) {
        Some(field) => Err(format!(
            "`{}` is a uniform of a type that is not known here",
            field.name
        )),
        None => Ok(bytes),
    }
}

/// Returns the bytes of a number or a vector; a single number applies to every component.
fn number_bytes(ty: ValueType, numbers: &[f64]) -> Vec<u8> {
    let number = |k: usize| numbers.get(k).or(numbers.first()).copied().unwrap_or(0.0);
    let word = |k: usize| match ty.scalar() {
        Scalar::F32 => (number(k) as f32).to_le_bytes(),
        Scalar::I32 => (number(k) as i32).to_le_bytes(),
        Scalar::U32 => (number(k) as u32).to_le_bytes(),
    };
    (0..usize::from(ty.components())).flat_map(word).collect()
}

fn find<'a, T>(entries: &'a [(String, T)], name: &str) -> Option<&'a T> {
    let found = entries.iter().rev().find(|(known, _)| known == name);
    found.map(|(_, value)| value)
}

fn single<'a, T>(entries: &'a [(String, Vec<Frame<T>>)], name: &str) -> Option<&'a Frame<T>> {
    match find(entries, name)?.as_slice() {
        [one] => Some(one),
        _ => None,
    }
}

fn image(format: Format, size: UVec2, bytes: Vec<u8>) -> Image {
    Image {
        format,
        width: size.x,
        height: size.y,
        bytes,
    }
}

fn frame(image: &Image) -> Frame<Vec4> {
    let numbers = compilers::words(&image.bytes)
        .into_iter()
        .map(f32::from_bits)
        .collect::<Vec<_>>();
    let texels = numbers.as_chunks::<4>().0.iter().map(|texel| Vec4::from_array(*texel));
    Frame::new(UVec2::new(image.width, image.height), texels.collect())
}
