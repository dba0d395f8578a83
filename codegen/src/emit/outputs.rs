//! Outputs of a shader: a value for each target of a pixel.

use super::ast::{Expr, Op, Ty};
use straightline_evaluator::ir::{OutputTarget, Scalar, Type};
use straightline_manifest::{Component, Format};

/// A value that the shader outputs for each pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoundOutput {
    /// Name of the target.
    pub name: String,
    /// Type in the kernel.
    pub ty: Type,
    /// Texel format of the storage texture, or of the colour target.
    pub format: Format,
    /// Binding number of a storage texture.
    pub binding: Option<u32>,
    /// Width and height of the texels that a workgroup writes, of an output with a size of its own.
    pub tile: Option<[u32; 2]>,
}

impl BoundOutput {
    /// Describes a target of a kernel; `colour` is the format of colours.
    pub fn new(target: &OutputTarget, colour: Format) -> BoundOutput {
        BoundOutput {
            name: target.name.clone(),
            ty: target.ty,
            format: texel_format(target.ty, colour),
            binding: None,
            tile: target.tile,
        }
    }

    /// Returns the type of the entry point's result, with all components of the texel.
    pub fn texel_type(&self) -> Type {
        widen_texel(self.ty)
    }
}

/// Returns the texel format of a value: the format of colours for 3 or 4 floats.
fn texel_format(ty: Type, colour: Format) -> Format {
    let component = match ty.scalar_kind() {
        Some(Scalar::I32) => Component::Sint,
        Some(Scalar::U32) => Component::Uint,
        _ => Component::Float,
    };
    let components = widen_texel(ty).component_count();
    match (component, components) {
        (Component::Float, 4) => colour,
        _ => {
            let mut all = Format::ALL.into_iter();
            let wide = |f: &Format| !Format::COLOURS.contains(f) && f.component_type() == component;
            let found = all.find(|f| wide(f) && f.components() == components);
            found.expect("there is a format of 1, 2 and 4 components of each kind")
        }
    }
}

/// Texels have 1, 2 or 4 components.
fn widen_texel(ty: Type) -> Type {
    match ty {
        Type::Value { scalar, components: 3 } => Type::value(scalar, 4),
        other => other,
    }
}

/// Returns a value with all components of its texel; a missing fourth component is 1.
pub fn whole_texel(value: Expr) -> Expr {
    let shape = widen_texel(value.ty.shape);
    if shape == value.ty.shape {
        return value;
    }
    let ty = Ty { shape, ..value.ty };
    let one = Expr::splat(value.ty.element_of(), one_bits(value.ty.scalar_kind()));
    Expr::new(Op::Construct, vec![value, one], ty)
}

/// The bits of 1.
pub fn one_bits(kind: Option<Scalar>) -> u32 {
    match kind {
        Some(Scalar::F32) => 1.0f32.to_bits(),
        _ => 1,
    }
}
