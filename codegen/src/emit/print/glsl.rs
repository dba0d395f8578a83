//! GLSL 4.50 for Vulkan, with separate textures.

use super::expr::{float, integer};
use super::{Language, Text, wrapped_comment};
use crate::emit::ast::{Builtin, Ty};
use crate::emit::resources::{OUTPUT, Resources, SAMPLER, UNIFORMS};
use crate::ir::{self, Axis, BinaryOp, Direction, Scalar, TextureKind, Type, UnaryOp};
use straightline_manifest::{REGION, Stage};

/// What follows a buffer's name to ask for its length.
pub const LENGTH: &str = ".elements.length()";

/// The four texels around a place, or what a comparison gives of them.
pub const GATHER: &str = "textureGather";

/// Quad operations, horizontal, vertical and diagonal.
pub const MESSAGES: [&str; 3] = [
    "subgroupQuadSwapHorizontal",
    "subgroupQuadSwapVertical",
    "subgroupQuadSwapDiagonal",
];

/// GLSL 4.50.
pub struct Glsl<'a> {
    /// The shader's bindings.
    pub resources: &'a Resources,
}

impl Glsl<'_> {
    /// A texture with the sampler that filters nothing.
    fn unfiltered(&self, texture: u32) -> Text {
        let texture = self.resources.texture(texture);
        let kind = match texture.kind {
            TextureKind::Flat | TextureKind::Depth => "sampler2D",
            TextureKind::Layers => "sampler2DArray",
            TextureKind::Multisampled => "sampler2DMS",
        };
        Text::name(format!("{kind}({}, {SAMPLER})", texture.name))
    }

    /// A texture with a sampler of the kernel's.
    fn through(&self, kind: &str, texture: u32, sampler: u32) -> Text {
        let texture = &self.resources.texture(texture).name;
        Text::name(format!("{kind}({texture}, {})", self.resources.sampler(sampler).name))
    }
}

impl Language for Glsl<'_> {
    fn ty(&self, ty: Ty) -> String {
        type_name(ty)
    }

    fn scalar(&self, kind: Scalar, _: bool, bits: u32) -> Text {
        match kind {
            Scalar::F32 => float(bits),
            // The smallest `int`, which no literal is.
            Scalar::I32 if bits as i32 == i32::MIN => Text::name("(-2147483647 - 1)"),
            Scalar::I32 => integer(i64::from(bits as i32), ""),
            Scalar::U32 => integer(i64::from(bits), "u"),
            Scalar::Bool => Text::name(if bits != 0 { "true" } else { "false" }),
        }
    }

    fn builtin(&self, builtin: Builtin) -> Text {
        match builtin {
            Builtin::Invocation => Text::name("ivec2(gl_GlobalInvocationID.xy)"),
            Builtin::Position => Text::name("gl_FragCoord.xy"),
            Builtin::OutputSize => Text::name(format!("imageSize({OUTPUT})")),
            Builtin::RegionFirst => Text::name(format!("{REGION}.first")),
            Builtin::RegionSize => Text::name(format!("{REGION}.size")),
            Builtin::RegionPlace => Text::name(format!("{REGION}.place")),
        }
    }

    fn function(&self, op: &ir::Op) -> &'static str {
        use UnaryOp::*;
        match op {
            ir::Op::Binary(BinaryOp::Min) => "min",
            ir::Op::Binary(BinaryOp::Max) => "max",
            ir::Op::Binary(BinaryOp::Pow) => "pow",
            ir::Op::Binary(BinaryOp::Atan2) => "atan",
            ir::Op::Unary(op) => match op {
                Abs => "abs",
                Sign => "sign",
                Floor => "floor",
                Ceil => "ceil",
                Round => "roundEven",
                Trunc => "trunc",
                Fract => "fract",
                Sqrt => "sqrt",
                InverseSqrt => "inversesqrt",
                Exp => "exp",
                Exp2 => "exp2",
                Log => "log",
                Log2 => "log2",
                Sin => "sin",
                Cos => "cos",
                Tan => "tan",
                Asin => "asin",
                Acos => "acos",
                Atan => "atan",
                Sinh => "sinh",
                Cosh => "cosh",
                Tanh => "tanh",
                ReverseBits => "bitfieldReverse",
                Neg | Not | BitNot => unreachable!("these are operators"),
                Saturate | CountOneBits | LeadingZeros | TrailingZeros => unreachable!("rewritten for GLSL"),
            },
            other => unreachable!("{other:?} is no function"),
        }
    }

    fn read(&self, op: &ir::Op, args: &[Text]) -> Text {
        let zero = Text::name("0");
        match op {
            ir::Op::Uniform(k) => Text::name(format!("{UNIFORMS}.{}", self.resources.uniform(*k))),
            ir::Op::Varying(k) => Text::name(self.resources.varying(*k)),
            ir::Op::TextureSize(texture) => {
                let name = self.unfiltered(*texture);
                match self.resources.texture(*texture).kind {
                    TextureKind::Multisampled => Text::call("textureSize", &[&name]),
                    TextureKind::Layers => Text::member(&Text::call("textureSize", &[&name, &zero]), "xy"),
                    _ => Text::call("textureSize", &[&name, &zero]),
                }
            }
            ir::Op::Load { texture, .. } => {
                let entry = self.resources.texture(*texture);
                let name = self.unfiltered(*texture);
                match (args, entry.kind) {
                    ([coord, sample], TextureKind::Multisampled) => Text::call("texelFetch", &[&name, coord, sample]),
                    ([coord, layer], _) => {
                        let coord = Text::call("ivec3", &[coord, layer]);
                        Text::call("texelFetch", &[&name, &coord, &zero])
                    }
                    _ => Text::call("texelFetch", &[&name, &args[0], &zero]),
                }
            }
            ir::Op::Sample { texture, sampler, .. } => {
                let through = self.through("sampler2D", *texture, *sampler);
                Text::call("textureLod", &[&through, &args[0], &Text::name("0.0")])
            }
            ir::Op::Gather {
                texture,
                sampler,
                component,
                ..
            } => {
                let through = self.through("sampler2D", *texture, *sampler);
                Text::call(GATHER, &[&through, &args[0], &Text::name(component.to_string())])
            }
            ir::Op::Compare { texture, sampler, .. } => {
                let through = self.through("sampler2DShadow", *texture, *sampler);
                let place = Text::call("vec3", &[&args[0], &args[1]]);
                Text::call("textureLod", &[&through, &place, &Text::name("0.0")])
            }
            ir::Op::GatherCompare { texture, sampler, .. } => {
                let through = self.through("sampler2DShadow", *texture, *sampler);
                Text::call(GATHER, &[&through, &args[0], &args[1]])
            }
            ir::Op::BufferLoad { buffer, .. } => {
                let elements = Text::name(format!("{}.elements", self.resources.buffer(*buffer).name));
                Text::index(&elements, &args[0])
            }
            ir::Op::BufferLen(buffer) => {
                let length = Text::name(format!("{}{LENGTH}", self.resources.buffer(*buffer).name));
                Text::call("int", &[&length])
            }
            ir::Op::Message(direction) => {
                let function = match direction {
                    Direction::Horizontal => MESSAGES[0],
                    Direction::Vertical => MESSAGES[1],
                    Direction::Diagonal => MESSAGES[2],
                };
                Text::call(function, &[&args[0]])
            }
            ir::Op::Derivative(axis) => {
                let function = if *axis == Axis::X { "dFdxFine" } else { "dFdyFine" };
                Text::call(function, &[&args[0]])
            }
            other => unreachable!("{other:?} is no read"),
        }
    }

    fn select(&self, _: Ty, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::name(format!("({} ? {} : {})", condition.code, yes.code, no.code))
    }

    fn choose(&self, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::call("mix", &[no, yes, condition])
    }

    fn logical(&self, op: BinaryOp, kind: Scalar) -> &'static str {
        match (op, kind) {
            (BinaryOp::And, Scalar::Bool) => "&&",
            (_, Scalar::Bool) => "||",
            (BinaryOp::And, _) => "&",
            _ => "|",
        }
    }

    fn immutable(&self, name: &str, ty: Ty) -> String {
        declared(name, ty)
    }

    fn mutable(&self, name: &str, ty: Ty, _: bool) -> String {
        declared(name, ty)
    }

    fn table(&self, name: &str, ty: Ty) -> String {
        format!("const {}", declared(name, ty))
    }

    fn loop_head(&self, counter: &str, ty: Ty, start: &str, bound: &str) -> String {
        format!("for ({} {counter} = {start}; {bound}; {counter}++) {{", type_name(ty))
    }

    fn if_head(&self) -> [&'static str; 2] {
        ["if (", ") {"]
    }

    fn function_head(&self, name: &str, params: &[(&str, Ty)], result: Ty) -> String {
        let params: Vec<String> = params.iter().map(|(name, ty)| declared(name, *ty)).collect();
        format!("{} {name}({}) {{", type_name(result), params.join(", "))
    }

    fn store(&self, place: &Text, colour: &Text) -> Text {
        Text::call("imageStore", &[&Text::name(OUTPUT), place, colour])
    }

    fn output(&self) -> String {
        format!("{OUTPUT} = ")
    }

    fn preamble(&self, header: &[String]) -> String {
        let r = self.resources;
        let mut out = String::from("#version 450\n");
        if r.subgroups {
            out += "#extension GL_KHR_shader_subgroup_quad : require\n";
        }
        for line in header {
            out += &wrapped_comment(line, 0);
            out.push('\n');
        }
        if !r.read.is_empty() {
            out +=
                "// GLSL names a texture together with a sampler even where it filters nothing: any sampler will do.\n";
        }
        out.push('\n');
        if r.options.stage == Stage::Compute {
            let [x, y, z] = r.options.workgroup();
            out += &format!("layout(local_size_x = {x}, local_size_y = {y}, local_size_z = {z}) in;\n\n");
        }
        for bound in &r.read {
            let texture = r.texture(bound.index);
            let (binding, ty) = (bound.binding, texture_type(texture.kind));
            out += &format!("layout(set = 0, binding = {binding}) uniform {ty} {};\n", texture.name);
        }
        for (k, binding) in &r.read_buffers {
            let (name, element) = (&r.buffer(*k).name, type_name(r.buffer(*k).element.into()));
            out += &format!(
                "layout(std430, set = 0, binding = {binding}) readonly buffer {name}_buffer {{ {element} elements[]; }} {name};\n"
            );
        }
        for (k, binding) in &r.used_samplers {
            let sampler = r.sampler(*k);
            let ty = if sampler.comparison { "samplerShadow" } else { "sampler" };
            out += &format!("layout(set = 0, binding = {binding}) uniform {ty} {};\n", sampler.name);
        }
        match r.output_binding() {
            Some(binding) => {
                let format = r.options.format.glsl();
                out += &format!("layout(set = 0, binding = {binding}, {format}) uniform writeonly image2D {OUTPUT};\n");
            }
            None => {
                for (k, varying) in r.varyings.iter().enumerate() {
                    let declared = declared(&varying.name, varying.ty.into());
                    out += &format!("layout(location = {k}) in {declared};\n");
                }
                out += &format!("layout(location = 0) out vec4 {OUTPUT};\n");
            }
        }
        if let Some(binding) = r.uniform_binding() {
            out += &format!("\nlayout(std140, set = 0, binding = {binding}) uniform Parameters {{\n");
            for uniform in &r.uniforms {
                out += &format!("    {};\n", declared(&uniform.name, uniform.ty.into()));
            }
            out += &format!("}} {UNIFORMS};\n");
        }
        if let Some(binding) = r.region_binding() {
            out += &format!("\nlayout(std140, set = 0, binding = {binding}) uniform Region {{\n");
            out += "    // The upper left pixel in the inputs, the size, and the upper left pixel in the target.\n    ivec2 \
                    first;\n    ivec2 size;\n    ivec2 place;\n";
            out += &format!("}} {REGION};\n");
        }
        if !r.read.is_empty() {
            let binding = r.sampler_binding();
            out += &format!("layout(set = 0, binding = {binding}) uniform sampler {SAMPLER};\n");
        }
        out
    }

    fn entry_head(&self) -> String {
        "void main() {".to_owned()
    }
}

/// A variable with its type: arrays have their extent after the name.
fn declared(name: &str, ty: Ty) -> String {
    let element = Ty {
        shape: ty.element(),
        ..ty
    };
    match ty.shape {
        Type::Array { len, .. } => format!("{} {name}[{len}]", type_name(element)),
        _ => format!("{} {name}", type_name(element)),
    }
}

fn texture_type(kind: TextureKind) -> &'static str {
    match kind {
        TextureKind::Flat | TextureKind::Depth => "texture2D",
        TextureKind::Layers => "texture2DArray",
        TextureKind::Multisampled => "texture2DMS",
    }
}

/// A type as GLSL spells it.
pub fn type_name(ty: Ty) -> String {
    match ty.shape {
        Type::Value { scalar, lanes: 1 } => match scalar {
            Scalar::F32 => "float",
            Scalar::I32 => "int",
            Scalar::U32 => "uint",
            Scalar::Bool => "bool",
        }
        .to_owned(),
        Type::Value { scalar, lanes } => {
            let kind = match scalar {
                Scalar::F32 => "",
                Scalar::I32 => "i",
                Scalar::U32 => "u",
                Scalar::Bool => "b",
            };
            format!("{kind}vec{lanes}")
        }
        Type::Array { len, .. } => {
            let element = Ty {
                shape: ty.element(),
                ..ty
            };
            format!("{}[{len}]", type_name(element))
        }
        Type::Results => "void".to_owned(),
    }
}
