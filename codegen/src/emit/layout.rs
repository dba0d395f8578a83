//! Offsets of a uniform struct's members: the same in WGSL and in GLSL's std140.

use super::print::wgsl_type;
use crate::ir::Uniform;
use straightline_manifest::UniformField;

/// Members at their offsets, in order of declaration, and the buffer's size in bytes, a multiple of 16.
pub fn layout(uniforms: &[&Uniform]) -> (Vec<UniformField>, u32) {
    let mut at = 0u32;
    let mut fields = Vec::new();
    for uniform in uniforms {
        let (align, size) = uniform.ty.layout();
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
