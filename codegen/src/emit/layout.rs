//! Offsets of a uniform struct's members: the same in WGSL and in GLSL's std140.

use straightline_evaluator::ir::{self, Type, Uniform};
use straightline_manifest::{Part, Scalar, UniformField, ValueType};

/// Returns the members at their offsets, in order of declaration, and the buffer's size in bytes, a multiple of 16.
pub fn layout_uniforms(uniforms: &[&Uniform]) -> (Vec<UniformField>, u32) {
    let mut at = 0u32;
    let mut fields = Vec::new();
    for uniform in uniforms {
        let (align, size) = uniform.ty.memory_layout();
        at = at.next_multiple_of(align);
        fields.push(UniformField {
            name: uniform.name.clone(),
            ty: value_type(uniform.ty),
            offset: at,
            size,
            default: uniform.default,
            part: uniform.part.as_ref().map(|part| Part {
                of: part.of.clone(),
                ty: whole_type(uniform.ty, part),
                index: part.index,
            }),
            frame_size: false,
        });
        at += size;
    }
    (fields, at.max(1).next_multiple_of(16))
}

/// Returns the type of the whole value that a uniform of type `ty` is a part of.
fn whole_type(ty: Type, part: &ir::UniformPart) -> ValueType {
    let ty = value_type(ty);
    match part.columns {
        true => ValueType::Matrix {
            columns: part.count as u8,
            rows: ty.components(),
        },
        false => ValueType::Array {
            of: ty.scalar(),
            components: ty.components(),
            count: part.count,
        },
    }
}

/// Returns a type as seen by hosts, which have no booleans: a stored boolean is a `u32`.
pub fn value_type(ty: Type) -> ValueType {
    let of = match ty.scalar_kind() {
        Some(ir::Scalar::I32) => Scalar::I32,
        Some(ir::Scalar::U32 | ir::Scalar::Usize | ir::Scalar::Bool) => Scalar::U32,
        Some(ir::Scalar::F32) | None => Scalar::F32,
    };
    match ty {
        Type::Array {
            components: lanes, len, ..
        } => ValueType::Array {
            of,
            components: lanes,
            count: len,
        },
        Type::Value { .. } | Type::Results => ValueType::of(of, ty.component_count()),
    }
}
