//! Functions of the host's, by which a function reads textures that it is not given ([`Texels::Functions`]).
//!
//! [`Texels::Functions`]: crate::spec::Texels::Functions

use super::refusal::Refusal;
use super::resources::Resources;
use super::spelled::Derived;
use super::text::Text;
use crate::compiled::Compiled;
use crate::spec::Target;
use straightline_evaluator::ir::{Op, Scalar, TextureKind};

/// What a host's function does with a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Load,
    Sample,
    Size,
}

impl What {
    /// What the function is called, before the texture's name.
    fn prefix(self) -> &'static str {
        match self {
            What::Load => "load_",
            What::Sample => "sample_",
            What::Size => "size_of_",
        }
    }

    /// What the function gives, for a manifest.
    fn gives(self) -> &'static str {
        match self {
            What::Load => "the texel at a pixel (two integers)",
            What::Sample => "the colour, filtered, at a place (two floats, 0 to 1), at the finest level",
            What::Size => "width and height in pixels (two integers)",
        }
    }
}

/// A function of the host's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HostFunction {
    texture: u32,
    what: What,
}

impl HostFunction {
    /// Its name in a text: `load_color`, `size_of_color`.
    pub fn name(self, resources: &Resources) -> &str {
        resources.derived(Derived::Host(self))
    }

    /// The name that it has unless something else does.
    pub fn default_name(self, resources: &Resources) -> String {
        format!("{}{}", self.what.prefix(), self.texture(resources))
    }

    /// Name of the texture that it reads.
    pub fn texture(self, resources: &Resources) -> &str {
        &resources.texture(self.texture).name
    }

    /// As WGSL declares it, of a body that only has its type: for who reads a text that calls it before the host's is there.
    fn stub(self, resources: &Resources) -> String {
        let (takes, gives) = match self.what {
            What::Load => ("pixel: vec2i", "vec4f"),
            What::Sample => ("place: vec2f", "vec4f"),
            What::Size => ("", "vec2i"),
        };
        format!(
            "fn {}({takes}) -> {gives} {{ return {gives}(); }}\n",
            self.name(resources)
        )
    }

    /// What it gives, in words.
    pub fn gives(self) -> &'static str {
        self.what.gives()
    }

    /// The function that stands for a read, if there can be one.
    fn of(op: &Op) -> Option<HostFunction> {
        let (texture, what) = match op {
            Op::Load { texture, .. } => (*texture, What::Load),
            Op::Sample { texture, .. } => (*texture, What::Sample),
            Op::TextureSize(texture) => (*texture, What::Size),
            _ => return None,
        };
        Some(HostFunction { texture, what })
    }
}

/// All functions of the host's that a kernel calls, in one order.
pub fn functions(ops: &[&Op], sized: Option<u32>) -> Vec<HostFunction> {
    let mut all: Vec<HostFunction> = ops.iter().filter_map(|op| HostFunction::of(op)).collect();
    all.extend(sized.map(|texture| HostFunction {
        texture,
        what: What::Size,
    }));
    all.sort();
    all.dedup();
    all
}

/// Stubs of WGSL for all functions of the host's.
pub fn stubs(resources: &Resources) -> String {
    resources.host.iter().map(|function| function.stub(resources)).collect()
}

/// The call of a host's function that stands for a read.
pub fn call(resources: &Resources, op: &Op, args: &[Text]) -> Option<Text> {
    if !resources.options.calls_host() {
        return None;
    }
    let function = HostFunction::of(op)?;
    Some(Text::call(function.name(resources), &args.iter().collect::<Vec<_>>()))
}

/// Whether functions of the host's can give all that a kernel reads.
///
/// # Errors
///
/// The first read or language that they do not have.
pub fn check(compiled: &Compiled, resources: &Resources) -> Result<(), Refusal> {
    let refused = |why: &str, help: &str| Refusal::function(&compiled.kernel, why, help);
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
            return Err(refused(&why, "give it as a texture").about(&texture.name));
        }
    }
    let graph = &compiled.graph;
    let live = graph.ids().filter(|id| compiled.schedule.has(*id));
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
        return Err(refused(&why, "give it as a texture").about(name));
    }
    Ok(())
}
