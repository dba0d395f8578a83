//! Checks the caller's views against what a shader reads and writes, before wgpu sees them.

use crate::error::{Error, Names, ViewProblem};
use crate::plan::{OutputPlan, Plan, TexturePlan};
use straightline_manifest::Dimension;
use wgpu::{Texture, TextureDimension, TextureFormat, TextureSampleType, TextureUsages, TextureView};

/// The views for `plan.textures`, in that order: each exactly once, and nothing else.
pub(crate) fn arrange<'v>(plan: &Plan, inputs: &[(&str, &'v TextureView)]) -> Result<Vec<&'v TextureView>, Error> {
    let kernel = || plan.kernel.clone();
    let known = || plan.textures.iter().map(|t| t.name.as_str()).collect::<Names>();
    for (i, (name, _)) in inputs.iter().enumerate() {
        if plan.textures.iter().all(|t| t.name != *name) {
            return Err(Error::UnknownInput {
                kernel: kernel(),
                name: (*name).to_owned(),
                known: known(),
            });
        }
        if inputs[..i].iter().any(|(earlier, _)| earlier == name) {
            return Err(Error::DuplicateInput {
                kernel: kernel(),
                name: (*name).to_owned(),
            });
        }
    }
    plan.textures
        .iter()
        .map(|texture| match inputs.iter().find(|(name, _)| *name == texture.name) {
            Some((_, view)) => Ok(*view),
            None => Err(Error::MissingInput {
                kernel: kernel(),
                name: texture.name.clone(),
                known: known(),
            }),
        })
        .collect()
}

/// Checks each input against the manifest and the target. `views` is in the order of `plan.textures`.
pub(crate) fn check_inputs(plan: &Plan, views: &[&TextureView], target: &TextureView) -> Result<(), Error> {
    for (texture, view) in plan.textures.iter().zip(views) {
        check_input(texture, view.texture(), target.texture()).map_err(|problem| Error::Input {
            kernel: plan.kernel.clone(),
            name: texture.name.clone(),
            problem,
        })?;
    }
    Ok(())
}

fn check_input(plan: &TexturePlan, texture: &Texture, target: &Texture) -> Result<(), ViewProblem> {
    check_shape(plan.dimension, texture)?;
    if texture.depth_or_array_layers() < plan.layers {
        return Err(ViewProblem::Layers {
            needed: plan.layers,
            found: texture.depth_or_array_layers(),
        });
    }
    let format = texture.format();
    check_float(format)?;
    if components(format) < plan.components {
        let (needed, found) = (plan.components, components(format));
        return Err(ViewProblem::Components { format, needed, found });
    }
    check_usage(texture, TextureUsages::TEXTURE_BINDING, "TEXTURE_BINDING")?;
    let (input, target_size) = (size(texture), size(target));
    if input != target_size {
        return Err(ViewProblem::Size {
            input,
            target: target_size,
        });
    }
    Ok(())
}

/// Checks `target` against the stage: usage, format, shape, and for compute that one dispatch can cover it.
/// `format` is the one that the pipeline writes.
pub(crate) fn check_target(
    plan: &Plan,
    format: TextureFormat,
    max_workgroups: u32,
    target: &TextureView,
) -> Result<(), Error> {
    let texture = target.texture();
    let check = || {
        check_shape(Dimension::D2, texture)?;
        let found = texture.format();
        match plan.output {
            OutputPlan::Storage { workgroup, .. } => {
                if found != format {
                    let remedy = "use a texture of that format, or generate the shader for this one";
                    return Err(ViewProblem::Format {
                        needed: format,
                        found,
                        remedy,
                    });
                }
                check_usage(texture, TextureUsages::STORAGE_BINDING, "STORAGE_BINDING")?;
                for (size, workgroup) in size(texture).into_iter().zip(workgroup) {
                    if size.div_ceil(workgroup) > max_workgroups {
                        return Err(ViewProblem::TooLarge {
                            size,
                            max: max_workgroups.saturating_mul(workgroup),
                        });
                    }
                }
            }
            OutputPlan::Attachment { .. } => {
                // A view may differ from its texture in the sRGB suffix alone; the rehearsal has wgpu look at it.
                if found.remove_srgb_suffix() != format.remove_srgb_suffix() {
                    let remedy = "name the target's format with `PassOptions::target_format`";
                    return Err(ViewProblem::Format {
                        needed: format,
                        found,
                        remedy,
                    });
                }
                check_usage(texture, TextureUsages::RENDER_ATTACHMENT, "RENDER_ATTACHMENT")?;
            }
        }
        Ok(())
    };
    check().map_err(|problem| Error::Target {
        kernel: plan.kernel.clone(),
        problem,
    })
}

/// The first input that is of the target's texture. Whether it shows the same part of it, only wgpu knows.
pub(crate) fn shared<'p>(plan: &'p Plan, views: &[&TextureView], target: &TextureView) -> Option<&'p TexturePlan> {
    let mut pairs = plan.textures.iter().zip(views);
    pairs
        .find(|(_, view)| view.texture() == target.texture())
        .map(|(texture, _)| texture)
}

/// Width and height in texels.
pub(crate) fn size(texture: &Texture) -> [u32; 2] {
    [texture.width(), texture.height()]
}

/// Whether `texture` has neither further mip levels nor further layers.
pub(crate) fn is_one_image(texture: &Texture) -> bool {
    texture.mip_level_count() == 1 && texture.depth_or_array_layers() == 1
}

fn check_shape(needed: Dimension, texture: &Texture) -> Result<(), ViewProblem> {
    let found = match texture.dimension() {
        TextureDimension::D1 => "a 1d texture",
        TextureDimension::D3 => "a 3d texture",
        TextureDimension::D2 if texture.sample_count() != 1 => {
            return Err(ViewProblem::Multisampled {
                samples: texture.sample_count(),
            });
        }
        TextureDimension::D2 => return Ok(()),
    };
    Err(ViewProblem::Dimension {
        needed,
        found: found.to_owned(),
    })
}

fn check_usage(texture: &Texture, usage: TextureUsages, missing: &'static str) -> Result<(), ViewProblem> {
    if texture.usage().contains(usage) {
        Ok(())
    } else {
        Err(ViewProblem::Usage { missing })
    }
}

/// Float, normalised and depth formats read as floats. Of a combined depth-stencil format the view must select the
/// depth; that is asked of wgpu when the view is bound.
fn check_float(format: TextureFormat) -> Result<(), ViewProblem> {
    match format.sample_type(Some(wgpu::TextureAspect::DepthOnly), None) {
        Some(TextureSampleType::Float { .. } | TextureSampleType::Depth) => Ok(()),
        _ => Err(ViewProblem::NotFloat { format }),
    }
}

/// Components that a read yields. Of a depth texture, combined with stencil or not, only the first is defined.
fn components(format: TextureFormat) -> u8 {
    if format.has_depth_aspect() {
        1
    } else {
        format.components()
    }
}
