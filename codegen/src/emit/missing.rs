//! Checks for features that a version of GLSL lacks, before anything is written.

use super::refusal::Refusal;
use super::resources::Resources;
use crate::compiled::Compiled;
use crate::spec::Target;
use straightline_evaluator::diagnostic::Code;
use straightline_evaluator::ir::{Op, TextureKind, UnaryOp};
use straightline_manifest::{Precision, Stage};

/// Checks that a language has every feature that a shader needs.
///
/// # Errors
///
/// The first missing feature, and the languages that have it.
pub fn check_features(compiled: &Compiled, resources: &Resources, target: Target) -> Result<(), Refusal> {
    let (name, old, combined) = match target {
        Target::Glsl430 => ("glsl430", false, true),
        Target::Glsl330 => ("glsl330", true, true),
        Target::Essl310 => ("essl310", false, true),
        Target::Essl300 => ("essl300", true, true),
        _ => ("glsl450", false, false),
    };
    if resources.half {
        let what = format!(
            "`{}` in half precision cannot be written in {name}, where naga knows no f16",
            compiled.kernel
        );
        let leave = match resources.options.precision {
            Precision::F16 => "leave the precision at f32",
            Precision::F32 => "leave `half` out",
        };
        return Err(Refusal::new(Code::NotInTarget, what).help(format!("use wgsl, spirv, hlsl or msl, or {leave}")));
    }
    let graph = &compiled.graph;
    let live = graph.node_ids().filter(|id| compiled.schedule.has_node(*id));
    let ops: Vec<&Op> = live.map(|id| &graph.node(id).op).collect();
    let any = |is: &dyn Fn(&Op) -> bool| ops.iter().any(|op| is(op));
    let of_kind = |kind: TextureKind| resources.read.iter().any(|t| resources.texture(t.index).kind == kind);
    let modern = "glsl450, wgsl, spirv, hlsl or msl";
    let with_compute = "glsl430 or essl310, or any that is newer";
    let needs = [
        (
            combined && any(&|op| matches!(op, Op::QuadSwap(_))),
            "swaps values by quad operations",
            modern,
        ),
        (
            combined && any(&|op| matches!(op, Op::Derivative(_))),
            "swaps values by fine derivatives",
            "glsl450, wgsl, spirv or hlsl",
        ),
        (
            old && resources.options.stage == Stage::Compute,
            "is a compute shader",
            "the stage fragment, glsl430 or essl310",
        ),
        (
            old && !resources.read_buffers.is_empty(),
            "has a storage buffer",
            with_compute,
        ),
        (
            combined && target != Target::Glsl430 && any(&|op| matches!(op, Op::TextureLevels(_))),
            "asks how many levels a texture has",
            "glsl430, or read it by `sample_level`",
        ),
        (
            old && any(&|op| matches!(op, Op::Gather { .. } | Op::GatherCompare { .. })),
            "gathers texels",
            with_compute,
        ),
        (
            old && any(&|op| {
                use UnaryOp::{CountOneBits, LeadingZeros, ReverseBits, TrailingZeros};
                matches!(op, Op::Unary(CountOneBits | LeadingZeros | ReverseBits | TrailingZeros))
            }),
            "counts or reverses bits",
            with_compute,
        ),
        (
            target == Target::Essl310
                && resources
                    .outputs
                    .iter()
                    .any(|o| o.binding.is_some() && o.format.components() == 2),
            "stores values of two components",
            "glsl430, any that is newer, or vectors of four",
        ),
        (
            target == Target::Essl300 && of_kind(TextureKind::Multisampled),
            "reads a multisampled texture",
            "glsl330 or essl310, or any that is newer",
        ),
    ];
    match needs.into_iter().find(|(needed, ..)| *needed) {
        Some((_, does, instead)) => {
            let what = format!(
                "`{}` cannot be written in {name}: it {does}, which {name} does not have",
                compiled.kernel
            );
            Err(Refusal::new(Code::NotInTarget, what).help(format!("use {instead}")))
        }
        None => Ok(()),
    }
}
