//! Reading glTF accessors: typed arrays somewhere in a buffer.
//!
//! Written out here because the `gltf` crate's readers take a file's word for the element type, and panic or read
//! something else where it is not what the attribute calls for.

use gltf::accessor::{Accessor, DataType};
use gltf::buffer::Data;

/// The elements of `accessor` as `N` numbers each. Integers that stand for fractions are made such.
pub(super) fn read_floats<const N: usize>(accessor: &Accessor, buffers: &[Data]) -> Result<Vec<[f32; N]>, String> {
    let elements = Elements::from_accessor(accessor, buffers, N)?;
    let kind = accessor.data_type();
    let normalized = accessor.normalized();
    let number = |bytes: &[u8]| match (kind, normalized) {
        (DataType::F32, _) => f32::from_le_bytes(word_bytes(bytes)),
        (DataType::I8, true) => (f32::from(bytes[0] as i8) / 127.0).max(-1.0),
        (DataType::I8, false) => f32::from(bytes[0] as i8),
        (DataType::U8, true) => f32::from(bytes[0]) / 255.0,
        (DataType::U8, false) => f32::from(bytes[0]),
        (DataType::I16, true) => (f32::from(u16_of(bytes) as i16) / 32_767.0).max(-1.0),
        (DataType::I16, false) => f32::from(u16_of(bytes) as i16),
        (DataType::U16, true) => f32::from(u16_of(bytes)) / 65_535.0,
        (DataType::U16, false) => f32::from(u16_of(bytes)),
        (DataType::U32, _) => u32::from_le_bytes(word_bytes(bytes)) as f32,
    };
    let size = kind.size();
    let element = |bytes: &[u8]| std::array::from_fn(|axis| number(&bytes[axis * size..(axis + 1) * size]));
    Ok(elements.iter().map(element).collect())
}

/// The elements of `accessor` as indices.
pub(super) fn read_indices(accessor: &Accessor, buffers: &[Data]) -> Result<Vec<u32>, String> {
    let elements = Elements::from_accessor(accessor, buffers, 1)?;
    let index: fn(&[u8]) -> u32 = match accessor.data_type() {
        DataType::U8 => |bytes| u32::from(bytes[0]),
        DataType::U16 => |bytes| u32::from(u16_of(bytes)),
        DataType::U32 => |bytes| u32::from_le_bytes(word_bytes(bytes)),
        other => return Err(format!("accessor {} has indices of type {other:?}", accessor.index())),
    };
    Ok(elements.iter().map(index).collect())
}

fn u16_of(bytes: &[u8]) -> u16 {
    u16::from_le_bytes([bytes[0], bytes[1]])
}

fn word_bytes(bytes: &[u8]) -> [u8; 4] {
    [bytes[0], bytes[1], bytes[2], bytes[3]]
}

/// Bytes of an accessor's elements, known to be there.
struct Elements<'a> {
    bytes: &'a [u8],
    count: usize,
    stride: usize,
    size: usize,
}

impl<'a> Elements<'a> {
    fn from_accessor(accessor: &Accessor, buffers: &'a [Data], components: usize) -> Result<Self, String> {
        let index = accessor.index();
        let found = accessor.dimensions().multiplicity();
        if found != components {
            return Err(format!(
                "accessor {index} has elements of {found} numbers, not of {components}"
            ));
        }
        if accessor.sparse().is_some() {
            return Err(format!(
                "accessor {index} is sparse, which is not supported: export it without"
            ));
        }
        let Some(view) = accessor.view() else {
            return Err(format!("accessor {index} has no buffer view"));
        };
        let size = accessor.size();
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(format!(
                "accessor {index} has elements of {size} bytes, {stride} bytes apart"
            ));
        }
        let count = accessor.count();
        let view_bytes = || {
            let buffer = buffers.get(view.buffer().index())?;
            buffer.get(view.offset()..view.offset().checked_add(view.length())?)
        };
        let wanted = || {
            let length = count.checked_sub(1)?.checked_mul(stride)?.checked_add(size)?;
            view_bytes()?.get(accessor.offset()..accessor.offset().checked_add(length)?)
        };
        match wanted() {
            Some(bytes) => Ok(Elements {
                bytes,
                count,
                stride,
                size,
            }),
            None => Err(format!(
                "accessor {index} reaches beyond its buffer, or is empty ({count} elements)"
            )),
        }
    }

    fn iter(&self) -> impl Iterator<Item = &'a [u8]> {
        let (bytes, stride, size) = (self.bytes, self.stride, self.size);
        (0..self.count).map(move |element| &bytes[element * stride..element * stride + size])
    }
}
