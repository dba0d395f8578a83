//! Names of types in GLSL.

use crate::emit::ast::Ty;
use crate::emit::outputs::BoundOutput;
use straightline_evaluator::ir::{Scalar, Texture, TextureKind, Type};

/// Returns the type of a written image.
pub fn image_type(output: &BoundOutput) -> &'static str {
    match output.ty.scalar_kind() {
        Some(Scalar::I32) => "iimage2D",
        Some(Scalar::U32) => "uimage2D",
        _ => "image2D",
    }
}

/// Returns the suffix of `sampler` and `texture` for a kind of texture.
pub fn texture_suffix(kind: TextureKind) -> &'static str {
    match kind {
        TextureKind::Flat | TextureKind::Depth => "2D",
        TextureKind::Layers | TextureKind::DepthLayers => "2DArray",
        TextureKind::Volume => "3D",
        TextureKind::Cube | TextureKind::DepthCube => "Cube",
        TextureKind::Multisampled => "2DMS",
    }
}

/// Returns the prefix of the types of a scalar kind.
fn type_prefix(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::I32 => "i",
        Scalar::U32 | Scalar::Usize => "u",
        Scalar::F32 | Scalar::Bool => "",
    }
}

/// Returns the type of a texture with a sampler.
pub fn plain_sampler(texture: &Texture) -> String {
    format!("{}sampler{}", type_prefix(texture.scalar), texture_suffix(texture.kind))
}

/// Returns the type of a texture with a sampler, comparing or not.
pub fn sampler_of(texture: &Texture, compares: bool) -> String {
    let shadow = if compares { "Shadow" } else { "" };
    plain_sampler(texture) + shadow
}

/// Declares a variable with its type; the extent of an array follows the name.
pub fn variable_declared(name: &str, ty: Ty) -> String {
    match ty.shape {
        Type::Array { len, .. } => format!("{} {name}[{len}]", type_name(ty.element_ty())),
        _ => format!("{} {name}", type_name(ty)),
    }
}

/// Returns the type of a separate sampler.
pub fn sampler_type(comparison: bool) -> &'static str {
    match comparison {
        true => "samplerShadow",
        false => "sampler",
    }
}

/// Returns the type of a separate texture.
pub fn texture_type(texture: &Texture) -> String {
    format!("{}texture{}", type_prefix(texture.scalar), texture_suffix(texture.kind))
}

/// Returns a type in GLSL's spelling.
pub fn type_name(ty: Ty) -> String {
    match ty.shape {
        Type::Value { scalar, components: 1 } => match scalar {
            Scalar::F32 => "float",
            Scalar::I32 => "int",
            Scalar::U32 | Scalar::Usize => "uint",
            Scalar::Bool => "bool",
        }
        .to_owned(),
        Type::Value {
            scalar,
            components: lanes,
        } => {
            let kind = match scalar {
                Scalar::F32 => "",
                Scalar::I32 => "i",
                Scalar::U32 | Scalar::Usize => "u",
                Scalar::Bool => "b",
            };
            format!("{kind}vec{lanes}")
        }
        Type::Array { len, .. } => {
            format!("{}[{len}]", type_name(ty.element_ty()))
        }
        Type::Results => "void".to_owned(),
    }
}
