//! Declarations of variables, resources and structures in HLSL.

use crate::emit::ast::Ty;
use crate::emit::resources::Resources;
use straightline_evaluator::ir::{Access, Element, Scalar, Texture, TextureKind, Type};

/// Returns the declaration of a texture.
pub fn texture_declared(resources: &Resources, index: u32) -> String {
    let texture = resources.texture(index);
    format!("{} {}", texture_type(texture), texture.name)
}

/// Returns the declaration of a buffer.
pub fn buffer_declared(resources: &Resources, index: u32) -> String {
    let buffer = resources.buffer(index);
    let element = match &buffer.element {
        Element::Value(ty) => type_name((*ty).into()),
        Element::Struct(structure) => structure.name.clone(),
    };
    let access = match buffer.access {
        Access::Read => "",
        Access::Write | Access::Atomic => "RW",
    };
    format!("{access}StructuredBuffer<{element}> {}", buffer.name)
}

/// Returns the declaration of a sampler.
pub fn sampler_declared(resources: &Resources, index: u32) -> String {
    let sampler = resources.sampler(index);
    let ty = match sampler.comparison {
        true => "SamplerComparisonState",
        false => "SamplerState",
    };
    format!("{ty} {}", sampler.name)
}

/// Declares the structures of buffers, with padding where HLSL would pack members closer than the buffer does: HLSL aligns
/// only to single numbers.
pub fn structure_declarations(resources: &Resources) -> String {
    let mut out = String::new();
    for structure in resources.read_structures() {
        out += &format!("struct {} {{\n", structure.name);
        let mut at = 0;
        let pad = |out: &mut String, at: &mut u32, to: u32| {
            while *at < to {
                *out += &format!("    uint padding_{at};\n");
                *at += 4;
            }
        };
        for field in &structure.fields {
            pad(&mut out, &mut at, field.offset);
            let ty = match field.ty {
                Type::Array {
                    scalar,
                    components: 3,
                    len,
                } => Type::Array {
                    scalar,
                    components: 4,
                    len,
                },
                other => other,
            };
            out += &format!("    {};\n", variable_declared(&field.name, ty.into()));
            at = field.offset + field.ty.memory_layout().1;
        }
        pad(&mut out, &mut at, structure.stride());
        out += "};\n\n";
    }
    out
}

/// Returns the members of the uniform struct, with padding where HLSL would pack them closer than the buffer does.
pub fn uniform_members(resources: &Resources) -> Vec<String> {
    let mut lines = Vec::new();
    let mut at = 0;
    for (field, uniform) in resources.fields.iter().zip(&resources.uniforms) {
        // A member begins at the next word, unless it would cross a row of four.
        let packed = |at: u32| match at % 16 + field.size > 16 {
            true => at.next_multiple_of(16),
            false => at,
        };
        while packed(at) < field.offset {
            lines.push(format!("uint padding_{at}"));
            at += 4;
        }
        lines.push(variable_declared(&uniform.name, uniform.ty.into()));
        at = field.offset + field.size;
    }
    lines
}

/// Declares a variable with its type; the extent of an array follows the name.
pub fn variable_declared(name: &str, ty: Ty) -> String {
    match ty.shape {
        Type::Array { len, .. } => format!("{} {name}[{len}]", type_name(ty.element_ty())),
        _ => format!("{} {name}", type_name(ty)),
    }
}

fn texture_type(texture: &Texture) -> String {
    let shape = match texture.kind {
        TextureKind::Flat | TextureKind::Depth => "2D",
        TextureKind::Layers | TextureKind::DepthLayers => "2DArray",
        TextureKind::Volume => "3D",
        TextureKind::Cube | TextureKind::DepthCube => "Cube",
        TextureKind::Multisampled => "2DMS",
    };
    let texel = Type::value(texture.scalar, if texture.kind.is_depth() { 1 } else { 4 });
    format!("Texture{shape}<{}>", type_name(texel.into()))
}

/// Returns a type in HLSL's spelling.
pub fn type_name(ty: Ty) -> String {
    let scalar = match ty.scalar_kind() {
        Some(Scalar::F32) if ty.half => "half",
        Some(Scalar::F32) => "float",
        Some(Scalar::I32) => "int",
        Some(Scalar::U32 | Scalar::Usize) => "uint",
        Some(Scalar::Bool) => "bool",
        None => return "void".to_owned(),
    };
    match ty.component_count() {
        1 => scalar.to_owned(),
        lanes => format!("{scalar}{lanes}"),
    }
}
