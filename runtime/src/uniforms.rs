//! Values that are set at run time: their types, their buffer, their defaults.

use crate::guard::guarded;
use crate::plan::{FieldPlan, UniformPlan};
use crate::{Error, Names};
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

/// Type of a uniform: a scalar or a vector of 32-bit components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UniformType {
    kind: Kind,
    components: u8,
}

/// Component type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Float,
    Sint,
    Uint,
}

impl UniformType {
    /// The type that WGSL spells `text`: `f32`, `i32`, `u32`, `vec2f`, `vec3i`, `vec4<f32>`, ...
    pub fn from_wgsl(text: &str) -> Option<Self> {
        let kind = |suffix: &str| match suffix {
            "f" | "<f32>" | "f32" => Some(Kind::Float),
            "i" | "<i32>" | "i32" => Some(Kind::Sint),
            "u" | "<u32>" | "u32" => Some(Kind::Uint),
            _ => None,
        };
        if matches!(text, "f32" | "i32" | "u32") {
            return Some(UniformType {
                kind: kind(text)?,
                components: 1,
            });
        }
        let rest = text.strip_prefix("vec")?;
        let components = match rest.as_bytes().first()? {
            digit @ b'2'..=b'4' => digit - b'0',
            _ => return None,
        };
        let suffix = &rest[1..];
        // `vec2f32` is no type.
        let kind = if suffix.len() == 3 { None } else { kind(suffix) }?;
        Some(UniformType { kind, components })
    }

    /// Bytes that a value takes.
    pub fn size(self) -> u32 {
        4 * u32::from(self.components)
    }

    pub(crate) fn kind(self) -> Kind {
        self.kind
    }

    pub(crate) fn components(self) -> u8 {
        self.components
    }

    /// `value` as this type, if it is a scalar that can hold it.
    pub(crate) fn scalar(self, value: f64) -> Option<UniformValue> {
        if self.components != 1 || !value.is_finite() {
            return None;
        }
        match self.kind {
            Kind::Float => {
                let narrow = value as f32;
                narrow.is_finite().then(|| narrow.into())
            }
            Kind::Sint => {
                let whole = value as i32;
                (f64::from(whole) == value).then(|| whole.into())
            }
            Kind::Uint => {
                let whole = value as u32;
                (f64::from(whole) == value).then(|| whole.into())
            }
        }
    }
}

impl fmt::Display for UniformType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letter = match self.kind {
            Kind::Float => 'f',
            Kind::Sint => 'i',
            Kind::Uint => 'u',
        };
        match self.components {
            1 => write!(f, "{letter}32"),
            n => write!(f, "vec{n}{letter}"),
        }
    }
}

/// A value for a uniform. Made by `From` of `f32`, `i32`, `u32` and arrays of two to four of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UniformValue {
    ty: UniformType,
    bytes: [u8; 16],
}

impl UniformValue {
    /// The value's type.
    pub fn ty(&self) -> UniformType {
        self.ty
    }

    /// The value as it lies in the buffer.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..self.ty.size() as usize]
    }

    fn new(kind: Kind, words: &[[u8; 4]]) -> Self {
        let mut bytes = [0; 16];
        for (place, word) in bytes.chunks_exact_mut(4).zip(words) {
            place.copy_from_slice(word);
        }
        UniformValue {
            ty: UniformType {
                kind,
                components: words.len() as u8,
            },
            bytes,
        }
    }
}

macro_rules! values {
    ($($scalar:ty => $kind:expr),*) => {$(
        impl From<$scalar> for UniformValue {
            fn from(value: $scalar) -> Self {
                UniformValue::new($kind, &[value.to_le_bytes()])
            }
        }
        values!(@vector $scalar, $kind, 2);
        values!(@vector $scalar, $kind, 3);
        values!(@vector $scalar, $kind, 4);
    )*};
    (@vector $scalar:ty, $kind:expr, $n:literal) => {
        impl From<[$scalar; $n]> for UniformValue {
            fn from(value: [$scalar; $n]) -> Self {
                UniformValue::new($kind, &value.map(<$scalar>::to_le_bytes))
            }
        }
    };
}

values!(f32 => Kind::Float, i32 => Kind::Sint, u32 => Kind::Uint);

/// One uniform struct on the device.
#[derive(Debug)]
pub(crate) struct UniformBlock {
    pub(crate) group: u32,
    pub(crate) binding: u32,
    pub(crate) buffer: wgpu::Buffer,
    fields: Vec<Field>,
}

#[derive(Debug)]
struct Field {
    name: String,
    ty: UniformType,
    offset: u32,
    /// Atomic only so that a pass can be shared between threads and still be written.
    set: AtomicBool,
}

impl UniformBlock {
    /// The buffer of `plan`, filled with the manifest's defaults.
    pub(crate) fn new(device: &wgpu::Device, kernel: &str, plan: &UniformPlan) -> Result<Self, Error> {
        let doing = format!("making the uniform buffer of `{kernel}`");
        let refused = |description| Error::Pipeline {
            kernel: kernel.to_owned(),
            description,
        };
        // Filled while mapped, so that no queue is needed and the first encode already sees the defaults.
        let buffer = guarded(device, &doing, refused, || {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(&plan.name),
                size: u64::from(plan.size),
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: true,
            })
        })?;
        let mut bytes = vec![0u8; plan.size as usize];
        for FieldPlan { offset, default, .. } in &plan.fields {
            if let Some(value) = default {
                let start = *offset as usize;
                bytes[start..start + value.bytes().len()].copy_from_slice(value.bytes());
            }
        }
        // A buffer of a lost device was made without complaint and has no mapping.
        let mut mapping = buffer
            .get_mapped_range_mut(..)
            .map_err(|_| Error::DeviceLost { doing: doing.clone() })?;
        mapping.copy_from_slice(&bytes);
        drop(mapping);
        guarded(device, &doing, refused, || buffer.unmap())?;

        let fields = plan
            .fields
            .iter()
            .map(|field| Field {
                name: field.name.clone(),
                ty: field.ty,
                offset: field.offset,
                set: AtomicBool::new(field.default.is_some()),
            })
            .collect();
        Ok(UniformBlock {
            group: plan.group,
            binding: plan.binding,
            buffer,
            fields,
        })
    }
}

/// Puts `value` into the field `name` of whichever block has it, ahead of the queue's next submission.
pub(crate) fn write(
    blocks: &[UniformBlock],
    kernel: &str,
    queue: &wgpu::Queue,
    name: &str,
    value: UniformValue,
) -> Result<(), Error> {
    let found = blocks
        .iter()
        .find_map(|block| block.fields.iter().find(|f| f.name == name).map(|f| (block, f)));
    let Some((block, field)) = found else {
        return Err(Error::UnknownUniform {
            kernel: kernel.to_owned(),
            name: name.to_owned(),
            known: blocks
                .iter()
                .flat_map(|b| &b.fields)
                .map(|f| f.name.as_str())
                .collect::<Names>(),
        });
    };
    if value.ty() != field.ty {
        return Err(Error::UniformType {
            kernel: kernel.to_owned(),
            name: name.to_owned(),
            needed: field.ty.to_string(),
            given: value.ty().to_string(),
        });
    }
    queue.write_buffer(&block.buffer, u64::from(field.offset), value.bytes());
    field.set.store(true, Ordering::Release);
    Ok(())
}

/// Puts `bytes` into all `blocks`, one after the other, ahead of the queue's next submission.
pub(crate) fn write_all(blocks: &[UniformBlock], kernel: &str, queue: &wgpu::Queue, bytes: &[u8]) -> Result<(), Error> {
    if blocks.is_empty() {
        return Err(Error::NoUniforms {
            kernel: kernel.to_owned(),
        });
    }
    let needed: u64 = blocks.iter().map(|block| block.buffer.size()).sum();
    let given = bytes.len() as u64;
    if given != needed {
        return Err(Error::UniformSize {
            kernel: kernel.to_owned(),
            needed,
            given,
        });
    }
    let mut rest = bytes;
    for block in blocks {
        // In bounds, as the sizes add up.
        let (bytes, after) = rest.split_at(block.buffer.size() as usize);
        queue.write_buffer(&block.buffer, 0, bytes);
        for field in &block.fields {
            field.set.store(true, Ordering::Release);
        }
        rest = after;
    }
    Ok(())
}

/// [`Error::UniformUnset`] for the first field that has neither a default nor a value.
pub(crate) fn check_set(blocks: &[UniformBlock], kernel: &str) -> Result<(), Error> {
    match blocks
        .iter()
        .flat_map(|b| &b.fields)
        .find(|f| !f.set.load(Ordering::Acquire))
    {
        None => Ok(()),
        Some(field) => Err(Error::UniformUnset {
            kernel: kernel.to_owned(),
            name: field.name.clone(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_read_as_wgsl_spells_them() {
        for text in ["f32", "i32", "u32", "vec2f", "vec3i", "vec4u"] {
            assert_eq!(
                UniformType::from_wgsl(text).map(|t| t.to_string()).as_deref(),
                Some(text)
            );
        }
        assert_eq!(UniformType::from_wgsl("vec3<f32>"), UniformType::from_wgsl("vec3f"));
        for text in [
            "", "f", "f16", "bool", "vec", "vec5f", "vec2", "vec2f32", "mat4x4f", "vec2é",
        ] {
            assert_eq!(UniformType::from_wgsl(text), None, "{text}");
        }
    }

    #[test]
    fn defaults_must_fit_their_type() {
        let ty = |text| UniformType::from_wgsl(text).unwrap();
        assert_eq!(ty("f32").scalar(0.5), Some(0.5f32.into()));
        assert_eq!(ty("i32").scalar(-3.0), Some((-3i32).into()));
        assert_eq!(ty("u32").scalar(4294967295.0), Some(u32::MAX.into()));
        for (text, value) in [
            ("u32", -1.0),
            ("i32", 0.5),
            ("i32", 3e9),
            ("f32", 1e300),
            ("f32", f64::NAN),
        ] {
            assert_eq!(ty(text).scalar(value), None, "{text} {value}");
        }
        assert_eq!(ty("vec2f").scalar(1.0), None);
    }

    #[test]
    fn vectors_lie_component_by_component() {
        let value = UniformValue::from([1u32, 2, 3]);
        assert_eq!(value.ty().to_string(), "vec3u");
        assert_eq!(value.bytes(), [1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0]);
    }
}
