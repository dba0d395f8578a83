//! Checks the target.

use super::Abilities;
use super::texture::{check_shape, check_usage, size};
use crate::error::{Error, ViewProblem};
use crate::plan::{OutputPlan, Plan};
use straightline_manifest::Dimension;
use wgpu::{TextureFormat, TextureUsages, TextureView};

/// Checks `target` against the stage: usage, format, shape, and for compute that one dispatch can cover it.
/// `format` is the one that the pipeline writes.
pub(crate) fn check_target(
    plan: &Plan,
    format: TextureFormat,
    abilities: &Abilities,
    target: &TextureView,
) -> Result<(), Error> {
    let texture = target.texture();
    let check = || {
        check_shape(Dimension::D2, 1, texture)?;
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
                    if size.div_ceil(workgroup) > abilities.max_workgroups {
                        return Err(ViewProblem::TooLarge {
                            size,
                            max: abilities.max_workgroups.saturating_mul(workgroup),
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
