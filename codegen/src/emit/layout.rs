//! Offsets of a uniform struct's members: the same in WGSL and in GLSL's std140.

use super::print::wgsl_type;
use crate::ir::{Type, Uniform};
use straightline_manifest::UniformField;

/// Members at their offsets, in order of declaration, and the buffer's size in bytes, a multiple of 16.
pub fn layout(uniforms: &[&Uniform]) -> (Vec<UniformField>, u32) {
    let mut at = 0u32;
    let mut fields = Vec::new();
    for uniform in uniforms {
        let (align, size) = measure(uniform.ty);
        at = at.next_multiple_of(align);
        fields.push(UniformField {
            name: uniform.name.clone(),
            ty: wgsl_type(uniform.ty.into()),
            offset: at,
            size,
            default: uniform.default,
        });
        at += size;
    }
    (fields, at.max(1).next_multiple_of(16))
}

/// Bytes from one element of a storage buffer to the next.
pub fn stride(ty: Type) -> u32 {
    let (align, size) = measure(ty);
    size.next_multiple_of(align)
}

/// Alignment and size in bytes of a scalar or vector.
fn measure(ty: Type) -> (u32, u32) {
    match ty.lanes() {
        1 => (4, 4),
        2 => (8, 8),
        3 => (16, 12),
        _ => (16, 16),
    }
}
