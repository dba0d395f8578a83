//! Checks of textures, and of constraints between inputs and target.

use super::Abilities;
use crate::error::ViewProblem;
use crate::plan::TexturePlan;
use straightline_manifest::{Dimension, Extent, SampleType};
use wgpu::{Features, Texture, TextureAspect, TextureDimension, TextureFormat, TextureSampleType, TextureUsages};

/// Checks an input of `texture` against the manifest, the device and the frame, which is as large as the target, or as the
/// other inputs where a region is filtered.
pub(super) fn check_texture(
    plan: &TexturePlan,
    abilities: &Abilities,
    texture: &Texture,
    frame: [u32; 2],
) -> Result<(), ViewProblem> {
    check_shape(plan.dimension, plan.samples, texture)?;
    let (found, cube) = (texture.depth_or_array_layers(), plan.dimension == Dimension::Cube);
    let needed = if cube { 6 } else { plan.layers };
    if found < needed {
        return Err(ViewProblem::Layers { needed, found });
    }
    if cube && texture.width() != texture.height() {
        return Err(ViewProblem::NotSquare {
            size: texture_size(texture),
        });
    }
    check_readable(plan, abilities, texture.format())?;
    check_usage(texture, TextureUsages::TEXTURE_BINDING, "TEXTURE_BINDING")?;
    let input = texture_size(texture);
    match plan.extent {
        Extent::Output if input != frame => Err(ViewProblem::Size { input, target: frame }),
        Extent::Output | Extent::Any => Ok(()),
    }
}

/// Checks that a texture of `format` has what the shader reads of it.
pub(crate) fn check_readable(
    plan: &TexturePlan,
    abilities: &Abilities,
    format: TextureFormat,
) -> Result<(), ViewProblem> {
    match plan.sample_type {
        SampleType::Unfilterable => check_float(format)?,
        SampleType::Filterable => {
            check_float(format)?;
            check_filterable(format, abilities.features)?;
        }
        SampleType::Depth if format.has_depth_aspect() => {}
        SampleType::Depth => {
            check_float(format)?;
            return Err(ViewProblem::NotDepth { format });
        }
        SampleType::Sint => check_integer(format, TextureSampleType::Sint)?,
        SampleType::Uint => check_integer(format, TextureSampleType::Uint)?,
    }
    if component_count(format) < plan.components {
        let (needed, found) = (plan.components, component_count(format));
        return Err(ViewProblem::Components { format, needed, found });
    }
    Ok(())
}

/// Width and height in texels.
pub(crate) fn texture_size(texture: &Texture) -> [u32; 2] {
    [texture.width(), texture.height()]
}

/// Returns whether `texture` has neither further mip levels nor further layers.
pub(crate) fn is_one_image(texture: &Texture) -> bool {
    texture.mip_level_count() == 1 && texture.depth_or_array_layers() == 1
}

/// `samples` is the least number that will do where `needed` is multisampled.
pub(super) fn check_shape(needed: Dimension, samples: u32, texture: &Texture) -> Result<(), ViewProblem> {
    let found = match (texture.dimension(), needed) {
        (TextureDimension::D3, Dimension::D3) => return Ok(()),
        (TextureDimension::D1, _) => "a 1d texture",
        (TextureDimension::D3, _) => "a 3d texture",
        (TextureDimension::D2, Dimension::D3) => "a 2d texture",
        (TextureDimension::D2, _) => return check_samples(needed, samples, texture.sample_count()),
    };
    Err(ViewProblem::Dimension {
        needed,
        found: found.to_owned(),
    })
}

fn check_samples(needed: Dimension, samples: u32, found: u32) -> Result<(), ViewProblem> {
    match (needed, found) {
        (Dimension::D2Multisampled, 1) => Err(ViewProblem::SingleSampled { needed: samples.max(2) }),
        (Dimension::D2Multisampled, _) if found < samples => Err(ViewProblem::Samples { needed: samples, found }),
        (Dimension::D2Multisampled, _) | (_, 1) => Ok(()),
        (_, _) => Err(ViewProblem::Multisampled { samples: found }),
    }
}

pub(super) fn check_usage(texture: &Texture, usage: TextureUsages, missing: &'static str) -> Result<(), ViewProblem> {
    if texture.usage().contains(usage) {
        Ok(())
    } else {
        Err(ViewProblem::Usage { missing })
    }
}

/// Checks for float, normalised and depth formats, which are read as floats. For a combined depth-stencil format the view
/// must select the depth; wgpu checks that when the view is bound.
fn check_float(format: TextureFormat) -> Result<(), ViewProblem> {
    match format.sample_type(Some(TextureAspect::DepthOnly), None) {
        Some(TextureSampleType::Float { .. } | TextureSampleType::Depth) => Ok(()),
        _ => Err(ViewProblem::NotFloat { format }),
    }
}

/// Formats of integers of one kind.
fn check_integer(format: TextureFormat, needed: TextureSampleType) -> Result<(), ViewProblem> {
    let (words, example) = match needed {
        TextureSampleType::Sint => ("signed", TextureFormat::R32Sint),
        _ => ("unsigned", TextureFormat::R32Uint),
    };
    match format.sample_type(None, None) == Some(needed) {
        true => Ok(()),
        false => Err(ViewProblem::NotInteger {
            format,
            needed: words,
            example,
        }),
    }
}

/// Returns the components that a read yields. For a depth texture, combined with stencil or not, only the first is defined.
fn component_count(format: TextureFormat) -> u8 {
    if format.has_depth_aspect() {
        1
    } else {
        format.components()
    }
}

fn check_filterable(format: TextureFormat, features: Features) -> Result<(), ViewProblem> {
    if format.has_depth_aspect() {
        return Err(ViewProblem::DepthFiltered { format });
    }
    match format.sample_type(None, Some(features)) {
        Some(TextureSampleType::Float { filterable: true }) => Ok(()),
        // The adapter may filter more than WebGPU promises; wgpu knows when the view is bound.
        _ if features.contains(Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES) => Ok(()),
        _ => Err(ViewProblem::NotFilterable { format }),
    }
}
