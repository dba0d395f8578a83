//! Checks the targets.

use super::Abilities;
use super::texture::{check_shape, check_usage, is_one_image, texture_size};
use crate::error::{Error, ViewProblem};
use crate::plan::{Plan, StagePlan};
use straightline_manifest::Dimension;
use wgpu::{TextureFormat, TextureUsages, TextureView};

/// Checks `targets` against the stage: usage, format, shape, that all without tiles have one size, and for compute that one dispatch can
/// cover it. `formats` are those that the pipeline writes.
pub(crate) fn check_targets(
    plan: &Plan,
    formats: &[TextureFormat],
    abilities: &Abilities,
    targets: &[&TextureView],
) -> Result<(), Error> {
    for (k, (view, format)) in targets.iter().zip(formats).enumerate() {
        let checked = check_target((plan, plan.outputs[k].tile), *format, abilities, view)
            .and_then(|()| check_against_earlier(plan, targets, k));
        checked.map_err(|problem| Error::Target {
            kernel: plan.kernel.to_string(),
            name: plan.target_name(k),
            problem,
        })?;
    }
    Ok(())
}

/// Checks a target against those before it.
fn check_against_earlier(plan: &Plan, targets: &[&TextureView], k: usize) -> Result<(), ViewProblem> {
    let [own, first] = [k, 0].map(|k| texture_size(targets[k].texture()));
    if own != first && plan.outputs[k].tile.is_none() {
        return Err(ViewProblem::TargetSize { size: own, first });
    }
    // Two views of a texture of one image show the same; of others only wgpu knows which part a view shows.
    let is_same = |other: &TextureView| {
        other == targets[k] || (other.texture() == targets[k].texture() && is_one_image(other.texture()))
    };
    match targets[..k].iter().position(|other| is_same(other)) {
        Some(other) => Err(ViewProblem::IsOtherTarget {
            other: plan.outputs[other].name.to_string(),
        }),
        None => Ok(()),
    }
}

/// Checks a target of `plan`, of which a workgroup writes a `tile` if it has a size of its own.
fn check_target(
    (plan, tile): (&Plan, Option<[u32; 2]>),
    format: TextureFormat,
    abilities: &Abilities,
    target: &TextureView,
) -> Result<(), ViewProblem> {
    let texture = target.texture();
    check_shape(Dimension::D2, 1, texture)?;
    let found = texture.format();
    match plan.stage {
        StagePlan::Compute { workgroup, .. } => {
            if found != format {
                let remedy = "use a texture of that format, or generate the shader for this one";
                return Err(ViewProblem::Format {
                    needed: format,
                    found,
                    remedy,
                });
            }
            check_usage(texture, TextureUsages::STORAGE_BINDING, "STORAGE_BINDING")?;
            let written = tile.unwrap_or([workgroup[0], workgroup[1]]);
            for (size, written) in texture_size(texture).into_iter().zip(written) {
                if size.div_ceil(written) > abilities.max_workgroups {
                    return Err(ViewProblem::TooLarge {
                        size,
                        max: abilities.max_workgroups.saturating_mul(written),
                    });
                }
            }
        }
        StagePlan::Fragment => {
            // A view may differ from its texture in the sRGB suffix alone; validating the recording has wgpu look at it.
            if found.remove_srgb_suffix() != format.remove_srgb_suffix() {
                let remedy = match plan.outputs.len() {
                    1 => "name the target's format with `PassOptions::target_format`",
                    _ => "name the target's format with `PassOptions::format_of`",
                };
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
}
