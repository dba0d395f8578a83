//! Buffers: their elements, and the layout of each.

use super::Type;

/// An array that the host fills.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Buffer {
    /// Name in the kernel.
    pub name: String,
    /// Type of an element.
    pub element: Element,
    /// Accesses by the kernel.
    pub access: Access,
}

impl Buffer {
    /// Type of the elements; `Type::Results` for structures, which are read only field by field.
    pub fn value_type(&self) -> Type {
        match self.element {
            Element::Value(ty) => ty,
            Element::Struct(_) => Type::Results,
        }
    }
}

/// Accesses of a kernel to a buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Access {
    /// Only reads. Nothing changes the buffer during a dispatch.
    #[default]
    Read,
    /// Only writes.
    Write,
    /// Changes elements by atomic operations.
    Atomic,
}

/// An element of a buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Element {
    /// A scalar, or a vector of 2 or 4 components.
    Value(Type),
    /// Several named numbers.
    Struct(Structure),
}

/// A structure in memory. Its fields are in order, each at the next multiple of its alignment, as in WGSL and in GLSL's
/// std430.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Name in the kernel.
    pub name: String,
    /// Fields in order.
    pub fields: Vec<Field>,
}

/// A field of a structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name; names of fields of a nested structure are joined by `_`.
    pub name: String,
    /// A scalar or vector, or an array of them.
    pub ty: Type,
    /// Offset in bytes from the start of the structure.
    pub offset: u32,
}

impl Structure {
    /// Lays out fields with these names and types.
    pub fn new(name: String, fields: Vec<(String, Type)>) -> Structure {
        let mut at = 0u32;
        let placed = fields.into_iter().map(|(name, ty)| {
            let (alignment, size) = ty.memory_layout();
            let offset = at.next_multiple_of(alignment);
            at = offset + size;
            Field { name, ty, offset }
        });
        let fields = placed.collect();
        Structure { name, fields }
    }

    /// Distance in bytes between structures: the size, rounded up to the largest alignment.
    pub fn stride(&self) -> u32 {
        let end = self
            .fields
            .last()
            .map_or(4, |field| field.offset + field.ty.memory_layout().1);
        let alignment = self.fields.iter().map(|field| field.ty.memory_layout().0).max();
        end.next_multiple_of(alignment.unwrap_or(4))
    }
}

impl Element {
    /// Type of field `k`; a single value is field 0.
    pub fn field_type(&self, k: u32) -> Option<Type> {
        match self {
            Element::Value(ty) => (k == 0).then_some(*ty),
            Element::Struct(structure) => structure.fields.get(k as usize).map(|field| field.ty),
        }
    }

    /// Distance in bytes between elements.
    pub fn stride(&self) -> u32 {
        match self {
            Element::Value(ty) => {
                let (alignment, size) = ty.memory_layout();
                size.next_multiple_of(alignment)
            }
            Element::Struct(structure) => structure.stride(),
        }
    }

    /// Types of all scalars and vectors of an element, in order; array elements one by one.
    pub fn value_types(&self) -> Vec<Type> {
        match self {
            Element::Value(ty) => vec![*ty],
            Element::Struct(structure) => {
                let of = |field: &Field| vec![field.ty.element_type(); field.ty.part_count() as usize];
                structure.fields.iter().flat_map(of).collect()
            }
        }
    }

    /// Index in [`value_types`](Self::value_types) of a field's first value.
    pub fn first_value(&self, field: u32) -> usize {
        match self {
            Element::Value(_) => 0,
            Element::Struct(structure) => {
                let before = structure.fields.iter().take(field as usize);
                before.map(|field| field.ty.part_count() as usize).sum()
            }
        }
    }
}
