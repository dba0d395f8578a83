//! Chains of passes, by the interpreter.

use super::{ExecuteError, Inputs, Written, find_entry, interpret_kernel};
use glam::{UVec2, UVec4, Vec4};
use half::f16;
use straightline_codegen::chain::{CompiledChain, CompiledPass, SizeRule, Source};
use straightline_codegen::ir::{Real, Scalar};
use straightline_codegen::{Compiled, Format};
use straightline_kernels::prelude::Frame;

/// A picture as the passes after it read it.
enum Stored {
    Floats(Frame<Vec4>),
    Integers(Frame<UVec4>),
}

/// Computes the results of a chain in the precision `R`. Pictures between passes are rounded to their formats.
///
/// # Errors
///
/// If something that a pass reads is missing or does not fit.
pub fn interpret_chain<R: Real>(chain: &CompiledChain, inputs: &Inputs) -> Result<Vec<Written>, ExecuteError> {
    let mut pictures: Vec<Option<Stored>> = chain.pictures.iter().map(|_| None).collect();
    let mut results = Vec::new();
    for pass in &chain.passes {
        let kernel = chain.kernel_of(pass);
        let mut given = collect_reads(chain, pass, &pictures, inputs)?;
        for picture in pass.draws.iter().map(|index| &chain.pictures[*index]) {
            given.size = picture_size(&picture.size, inputs)?;
            given.target_sizes.push((picture.name.clone(), given.size));
        }
        let made = interpret_kernel::<R>(kernel, &given, false)?;
        for (output, (index, written)) in pass.draws.iter().zip(&made.targets).enumerate() {
            if chain.results.contains(index) {
                let name = chain.pictures[*index].name.clone();
                results.push((
                    *index,
                    Written {
                        name,
                        ..written.clone()
                    },
                ));
            }
            pictures[*index] = Some(store(written, (kernel, output), pass.format));
        }
    }
    results.sort_by_key(|(index, _)| chain.results.iter().position(|result| result == index));
    Ok(results.into_iter().map(|(_, written)| written).collect())
}

/// Size of a picture, by the sizes of the images among the inputs.
///
/// # Errors
///
/// If an image is missing.
pub fn picture_size(rule: &SizeRule, inputs: &Inputs) -> Result<UVec2, ExecuteError> {
    let size_of = |name: &str| {
        let floats = find_entry(&inputs.images, name)
            .and_then(|layers| layers.first())
            .map(Frame::size);
        let integers = find_entry(&inputs.integers, name)
            .and_then(|layers| layers.first())
            .map(Frame::size);
        floats.or(integers).map(|size| size.to_array())
    };
    let size = rule.evaluate(&size_of);
    size.map(UVec2::from_array)
        .map_err(|bad| ExecuteError::Input(format!("a picture of size {rule}: {bad}")))
}

/// Inputs of a pass by the names that its kernel has for them.
fn collect_reads(
    chain: &CompiledChain,
    pass: &CompiledPass,
    pictures: &[Option<Stored>],
    inputs: &Inputs,
) -> Result<Inputs, ExecuteError> {
    let mut given = Inputs {
        uniforms: inputs.uniforms.clone(),
        ..Inputs::default()
    };
    for (name, source) in &pass.reads {
        match source {
            Source::Picture(index) => match &pictures[*index] {
                Some(Stored::Floats(picture)) => given.images.push((name.clone(), vec![picture.clone()])),
                Some(Stored::Integers(picture)) => given.integers.push((name.clone(), vec![picture.clone()])),
                None => {
                    let name = &chain.pictures[*index].name;
                    return Err(ExecuteError::Input(format!("`{name}` is read before it is drawn")));
                }
            },
            Source::Input(input) => add_input(&mut given, name, input, inputs, chain)?,
        }
    }
    Ok(given)
}

fn add_input(
    given: &mut Inputs,
    name: &str,
    input: &str,
    inputs: &Inputs,
    chain: &CompiledChain,
) -> Result<(), ExecuteError> {
    let name = || name.to_owned();
    given
        .images
        .extend(find_entry(&inputs.images, input).map(|layers| (name(), layers.clone())));
    given
        .smaller
        .extend(find_entry(&inputs.smaller, input).map(|levels| (name(), levels.clone())));
    given
        .integers
        .extend(find_entry(&inputs.integers, input).map(|layers| (name(), layers.clone())));
    given
        .buffers
        .extend(find_entry(&inputs.buffers, input).map(|elements| (name(), elements.clone())));
    given
        .samplers
        .extend(find_entry(&inputs.samplers, input).map(|state| (name(), *state)));
    match chain.inputs.iter().any(|known| known == input) {
        true => Ok(()),
        false => Err(ExecuteError::Input(format!("`{}` has no input `{input}`", chain.name))),
    }
}

/// A picture in its format: an output of a kernel, by index.
fn store(written: &Written, (kernel, output): (&Compiled, usize), colour: Format) -> Stored {
    let size = written.size;
    let target = kernel.graph.written_targets().nth(output);
    let (scalar, format) = (
        target.and_then(|target| target.ty.scalar_kind()),
        kernel.target_formats(colour)[output],
    );
    let texels = written.texels.iter();
    match scalar {
        Some(Scalar::U32) => {
            let bits = texels.map(|texel| UVec4::from_array(texel.map(|value| value as u32)));
            Stored::Integers(Frame::new(size, bits.collect()))
        }
        Some(Scalar::I32) => {
            let bits = texels.map(|texel| UVec4::from_array(texel.map(|value| value as i32 as u32)));
            Stored::Integers(Frame::new(size, bits.collect()))
        }
        _ => {
            let rounded = texels.map(|texel| Vec4::from_array(texel.map(|value| round_to(format, value as f32))));
            Stored::Floats(Frame::new(size, rounded.collect()))
        }
    }
}

/// A component as a format holds it.
fn round_to(format: Format, value: f32) -> f32 {
    match format {
        Format::Rgba8Unorm => (value.clamp(0.0, 1.0) * 255.0).round() / 255.0,
        Format::Rgba16Float => f16::from_f32(value).to_f32(),
        _ => value,
    }
}
