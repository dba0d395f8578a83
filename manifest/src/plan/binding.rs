//! Checks of single bindings: textures, storage buffers, and the fields of uniform structs.

use super::read::require;
use super::{BufferPlan, FieldPlan, PartPlan, TexturePlan};
use crate::{Dimension, Element, Part, SampleType, Scalar, UniformField, ValueType};

/// Checks a texture's numbers against one another and against the types that a shader can declare.
pub(super) fn check_texture(plan: &TexturePlan) -> Result<(), String> {
    let TexturePlan {
        dimension,
        sample_type,
        components,
        layers,
        samples,
        extent: _,
    } = *plan;
    require((1..=4).contains(&components), || {
        format!("{components} components, not 1 to 4")
    })?;
    require(layers >= 1, || "no layers".to_owned())?;
    require(dimension == Dimension::D2Array || layers == 1, || {
        format!("not a 2d-array, but with {layers} layers")
    })?;
    require(samples >= 1, || "no samples".to_owned())?;
    require(dimension == Dimension::D2Multisampled || samples == 1, || {
        format!("not multisampled, but with {samples} samples")
    })?;
    match sample_type {
        SampleType::Unfilterable | SampleType::Sint | SampleType::Uint => Ok(()),
        // Neither a device nor a shading language can filter the samples of a texel.
        SampleType::Filterable => require(dimension != Dimension::D2Multisampled, || {
            "multisampled, but filterable".to_owned()
        }),
        SampleType::Depth => {
            let shaped = matches!(dimension, Dimension::D2 | Dimension::D2Array | Dimension::Cube);
            require(shaped, || "a depth, but not 2d, 2d-array or cube".to_owned())?;
            require(components == 1, || format!("a depth, but with {components} components"))
        }
    }
}

/// A storage buffer of elements of `element`, or of structures of `fields`, `stride` bytes apart.
pub(super) fn plan_buffer(
    element: &Element,
    stride: u32,
    fields: &[UniformField],
    written: bool,
) -> Result<BufferPlan, String> {
    if !fields.is_empty() {
        require(stride > 0 && stride.is_multiple_of(4), || {
            format!("a stride of {stride} bytes, not a positive multiple of 4")
        })?;
        for field in fields {
            let inside = field.offset.checked_add(field.size).is_some_and(|end| end <= stride);
            require(inside && field.offset % 4 == 0, || {
                format!(
                    "field `{}` does not lie inside the {stride} bytes of an element",
                    field.name
                )
            })?;
        }
        return Ok(BufferPlan {
            element: None,
            stride,
            written,
        });
    }
    let ty = match element {
        Element::Value(ty) if ty.is_single() => *ty,
        other => return Err(format!("elements of type `{other}`, not a 32-bit scalar or vector")),
    };
    require(stride > 0 && stride.is_multiple_of(4), || {
        format!("a stride of {stride} bytes, not a positive multiple of 4")
    })?;
    require(stride >= ty.size(), || {
        format!(
            "a stride of {stride} bytes, but an element of type {ty} takes {}",
            ty.size()
        )
    })?;
    Ok(BufferPlan {
        element: Some(ty),
        stride,
        written,
    })
}

/// A field of a struct of `block` bytes.
pub(super) fn plan_field(field: &UniformField, block: u32) -> Result<FieldPlan, String> {
    let UniformField {
        name,
        ty,
        offset,
        size,
        default,
        part,
        frame_size,
    } = field;
    require(ty.is_single(), || {
        format!("field `{name}` is of type `{ty}`, not a 32-bit scalar or vector")
    })?;
    require(*size == ty.size(), || {
        format!(
            "field `{name}` of type {ty} takes {size} bytes instead of {}",
            ty.size()
        )
    })?;
    require(offset % 4 == 0, || {
        format!("field `{name}` lies at offset {offset}, not a multiple of 4")
    })?;
    let inside = offset.checked_add(*size).is_some_and(|end| end <= block);
    require(inside, || {
        format!("field `{name}` ends beyond the buffer of {block} bytes")
    })?;
    let default = match default {
        None => None,
        Some(value) => Some(
            Some(ty.scalar())
                .filter(|_| ty.components() == 1)
                .and_then(|scalar| scalar.encode_word(*value))
                .ok_or_else(|| format!("the default {value} of field `{name}` is no {ty}"))?,
        ),
    };
    if let Some(Part { of, ty: whole, index }) = part {
        require(whole.part() == *ty && *index < whole.parts(), || {
            format!("field `{name}` of type {ty} is no part {index} of `{of}` of type {whole}")
        })?;
    }
    require(!frame_size || *ty == ValueType::of(Scalar::U32, 2), || {
        format!("field `{name}` of type {ty} holds the frame's size, which is a vec2u")
    })?;
    Ok(FieldPlan {
        name: name.clone().into(),
        ty: *ty,
        offset: *offset,
        default,
        part: part.as_ref().map(|part| PartPlan {
            of: part.of.clone().into(),
            ty: part.ty,
            index: part.index,
        }),
        frame_size: *frame_size,
    })
}
