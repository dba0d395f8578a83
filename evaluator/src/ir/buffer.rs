//! Buffers: what their elements are, and where each part of one lies.

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
    /// The type of its elements; of structures, which are only read field by field, `Type::Results`.
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
    /// Only reads, and nothing changes the buffer meanwhile.
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
    /// A scalar, or a vector of 2 or 4.
    Value(Type),
    /// Several numbers under their names.
    Struct(Structure),
}

/// A structure in memory: its fields in order, each at the next multiple of its alignment, as WGSL and GLSL's std430 lay it
/// out.
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
    /// Name; those of the fields of a nested structure are joined by `_`.
    pub name: String,
    /// A scalar or vector, or an array of them.
    pub ty: Type,
    /// Bytes from the structure's beginning.
    pub offset: u32,
}

impl Structure {
    /// With fields of these names and types.
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

    /// Bytes from one structure to the next: its size, to a multiple of its largest alignment.
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
    /// The type of a field by its number, 0 of a single value.
    pub fn field_type(&self, k: u32) -> Option<Type> {
        match self {
            Element::Value(ty) => (k == 0).then_some(*ty),
            Element::Struct(structure) => structure.fields.get(k as usize).map(|field| field.ty),
        }
    }

    /// Bytes from one element to the next.
    pub fn stride(&self) -> u32 {
        match self {
            Element::Value(ty) => {
                let (alignment, size) = ty.memory_layout();
                size.next_multiple_of(alignment)
            }
            Element::Struct(structure) => structure.stride(),
        }
    }

    /// The types of all scalars and vectors of an element, in order: elements of arrays one by one.
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
