//! Functions of the host that read textures for an emitted function ([`Texels::Functions`]).
//!
//! [`Texels::Functions`]: crate::spec::Texels::Functions

use super::derived::{Derived, HostFunction};
use super::refusal::Refusal;
use super::resources::Resources;
use super::text::Text;
use crate::compiled::Compiled;
use crate::spec::Target;
use straightline_evaluator::ir::{Op, Scalar, TextureKind};

/// Declares the host functions in WGSL, with placeholder bodies, so that the text can be validated without the host.
pub fn host_stubs(resources: &Resources) -> String {
    let stub = |function: &HostFunction| {
        let (takes, gives) = function.signature();
        let name = resources.derived_name(Derived::Host(*function));
        format!("fn {name}({takes}) -> {gives} {{ return {gives}(); }}\n")
    };
    resources.host.iter().map(stub).collect()
}

/// Returns the call of the host function that implements a read.
pub fn host_call(resources: &Resources, op: &Op, args: &[Text]) -> Option<Text> {
    if !resources.options.calls_host() {
        return None;
    }
    let name = resources.derived_name(Derived::Host(HostFunction::of_read(op)?));
    Some(Text::call(name, &args.iter().collect::<Vec<_>>()))
}

/// Checks that host functions can implement all reads of a kernel.
///
/// # Errors
///
/// The first read or language without such a function.
pub fn check_host_reads(compiled: &Compiled, resources: &Resources) -> Result<(), Refusal> {
    let refused = |why: &str, help: &str| Refusal::no_function_form(&compiled.kernel, why, help);
    let options = &resources.options;
    if !(options.calls_host() || options.global_uniforms) {
        return Ok(());
    }
    let declares = |target: &Target| *target == Target::Hlsl || Target::OPENGL.contains(target);
    let has = |target: &Target| declares(target) || (*target == Target::Wgsl && !options.global_uniforms);
    if let Some(target) = options.targets.iter().find(|target| !has(target)) {
        let also = if options.global_uniforms { "" } else { "wgsl, " };
        return Err(refused(
            &format!("the host declares what it reads, which {target} does not have"),
            &format!("write {also}glsl430, glsl330, essl310, essl300 or hlsl"),
        ));
    }
    if !options.calls_host() {
        return Ok(());
    }
    for bound in &resources.read {
        let texture = resources.texture(bound.index);
        if texture.kind != TextureKind::Flat || texture.scalar != Scalar::F32 {
            let why = format!(
                "a function of the host's gives texels of a two-dimensional texture of floats, and `{}` is none",
                texture.name
            );
            return Err(refused(&why, "give it as a texture").about_input(&texture.name));
        }
    }
    let graph = &compiled.graph;
    let live = graph.node_ids().filter(|id| compiled.schedule.has_node(*id));
    for node in live.map(|id| graph.node(id)) {
        let Some(texture) = node.op.texture() else { continue };
        let name = &resources.texture(texture).name;
        let how = match &node.op {
            Op::Load { .. } | Op::Sample { .. } if node.args.len() == 1 => continue,
            Op::TextureSize(_) => continue,
            Op::Load { .. } | Op::Sample { .. } => "of a level that it names",
            Op::Gather { .. } | Op::GatherCompare { .. } => "four at a time",
            Op::Compare { .. } => "by comparison",
            _ => "and asks how many levels or layers it has",
        };
        let why = format!("it reads `{name}` {how}, for which the host has no function");
        return Err(refused(&why, "give it as a texture").about_input(name));
    }
    Ok(())
}
