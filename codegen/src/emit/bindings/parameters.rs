//! Rust for a shader's uniform struct, with the layout of the shader, which the caller's compiler checks.

use super::{doc_line, rust_identifier};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use straightline_manifest::{BindingKind, Element, Manifest, Scalar, UniformField, ValueType};

/// Returns the struct `Parameters` with its items, and the methods that set it.
pub fn quote_parameters(manifest: &Manifest) -> (TokenStream, TokenStream) {
    match manifest.uniform_block() {
        Some((fields, size)) => {
            let docs = match manifest.immediates {
                None => " Values that are set at run time, as they lie in the shader's uniform buffer.",
                Some(_) => " Values that are set at run time, as they lie in the shader's immediates.",
            };
            let structure = quote_structure("Parameters", docs, fields, size);
            let by_name = by_name(fields);
            (quote! { #structure #by_name }, quote_setters(manifest, fields))
        }
        None => (TokenStream::new(), TokenStream::new()),
    }
}

/// Returns the structures of buffers, each once.
pub fn quote_elements(manifest: &Manifest) -> TokenStream {
    let mut made: Vec<&str> = Vec::new();
    let mut all = TokenStream::new();
    for binding in &manifest.bindings {
        if let BindingKind::Buffer {
            element: Element::Structure(name),
            stride,
            fields,
            ..
        } = &binding.kind
            && !made.contains(&name.as_str())
        {
            made.push(name);
            let docs = " An element of a storage buffer, as it lies there.";
            all.extend(quote_structure(&structure_name(manifest, name), docs, fields, *stride));
        }
    }
    all
}

/// Names of types that the module uses, including those of the prelude.
const TYPES: [&str; 31] = [
    "Bound",
    "BoundDraw",
    "Clone",
    "Copy",
    "Debug",
    "Default",
    "Draw",
    "Eq",
    "Error",
    "From",
    "Inputs",
    "Into",
    "IntoIterator",
    "Iterator",
    "Option",
    "Overrides",
    "Parameters",
    "PartialEq",
    "Pass",
    "Resource",
    "Result",
    "Targets",
    "bool",
    "core",
    "f32",
    "i32",
    "str",
    "straightline_runtime",
    "u32",
    "u8",
    "wgpu",
];

/// Returns the name of a buffer's structure: its own name, unless the module uses that for something else.
pub fn structure_name(manifest: &Manifest, element: &str) -> String {
    if !TYPES.contains(&element) {
        return element.to_owned();
    }
    let is_structure = |name: &str| {
        manifest.bindings.iter().any(|binding| {
            matches!(&binding.kind, BindingKind::Buffer { element: Element::Structure(other), .. } if other == name)
        })
    };
    let mut name = format!("{element}Element");
    // Each iteration excludes one structure of the shader, so this many suffice.
    for _ in &manifest.bindings {
        if is_structure(&name) {
            name.push('_');
        }
    }
    name
}

fn quote_structure(of: &str, docs: &str, fields: &[UniformField], size: u32) -> TokenStream {
    let of = rust_identifier(of);
    let of_docs = docs;
    let mut members = Vec::new();
    let mut pads = Vec::new();
    let mut at = 0;
    for field in fields {
        push_padding(&mut members, &mut pads, fields, field.offset - at);
        let (name, ty) = (rust_identifier(&field.name), stored_type(field.ty));
        let docs = match field.default {
            _ if field.frame_size => "Width and height of the target; a bound pass sets them.".to_owned(),
            Some(default) => format!("`{}` of the kernel; {default} by default.", field.name),
            None => format!("`{}` of the kernel.", field.name),
        };
        let docs = doc_line(&docs);
        members.push(quote! { #[doc = #docs] pub #name: #ty });
        at = field.offset + field.size;
    }
    push_padding(&mut members, &mut pads, fields, size - at);

    let names: Vec<_> = fields.iter().map(|f| rust_identifier(&f.name)).collect();
    let arguments: Vec<_> = (0..fields.len()).map(|k| argument_name(fields, k)).collect();
    let types: Vec<_> = fields.iter().map(|f| stored_type(f.ty)).collect();
    let zeros: Vec<_> = fields.iter().map(|f| quote_zero(f.ty)).collect();
    let offsets: Vec<_> = fields.iter().map(|f| Literal::u32_unsuffixed(f.offset)).collect();
    let total = Literal::u32_unsuffixed(size);
    let copies = fields.iter().map(|field| {
        let name = rust_identifier(&field.name);
        let start = Literal::u32_unsuffixed(field.offset);
        let end = Literal::u32_unsuffixed(field.offset + field.size);
        match field.ty {
            ValueType::Array { components, count, .. } => {
                let step = Literal::u32_unsuffixed(field.size / count);
                let flat = match components {
                    1 => quote! { [*part] },
                    _ => quote! { *part },
                };
                quote! {
                    for (room, part) in bytes[#start..#end].chunks_exact_mut(#step).zip(&self.#name) {
                        for (place, lane) in room.chunks_exact_mut(4).zip(#flat) {
                            place.copy_from_slice(&lane.to_le_bytes());
                        }
                    }
                }
            }
            ValueType::Scalar(_) => quote! { bytes[#start..#end].copy_from_slice(&self.#name.to_le_bytes()); },
            ValueType::Vector { .. } | ValueType::Matrix { .. } => quote! {
                for (place, lane) in bytes[#start..#end].chunks_exact_mut(4).zip(self.#name) {
                    place.copy_from_slice(&lane.to_le_bytes());
                }
            },
        }
    });
    let given = names
        .iter()
        .zip(&arguments)
        .map(|(name, argument)| match name == argument {
            true => quote! { #name },
            false => quote! { #name: #argument },
        });
    let new = match fields.len() {
        // With more arguments, only the order would distinguish them.
        0..=7 => quote! {
            impl #of {
                /// All values, in order.
                #[must_use]
                pub const fn new(#(#arguments: #types),*) -> Self {
                    Self { #(#given,)* #(#pads,)* }
                }
            }
        },
        _ => TokenStream::new(),
    };
    let defaults: Option<Vec<TokenStream>> = fields.iter().map(default).collect();
    let default = defaults.map(|values| {
        quote! {
            impl Default for #of {
                fn default() -> Self {
                    Self { #(#names: #values,)* #(#pads,)* }
                }
            }
        }
    });
    quote! {
        #[doc = #of_docs]
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #of {
            #(#members,)*
        }

        // The layout must equal the shader's, or this does not compile.
        const _: () = {
            #(assert!(core::mem::offset_of!(#of, #names) == #offsets);)*
            assert!(core::mem::size_of::<#of>() == #total);
        };

        impl #of {
            /// All zeros, as a base for setting single values by name: `Self { name: value, ..Self::ZERO }`.
            pub const ZERO: Self = Self { #(#names: #zeros,)* #(#pads,)* };
        }

        #new

        #default

        impl #of {
            /// Returns the bytes of the values in the buffer's layout.
            #[must_use]
            pub fn to_bytes(self) -> [u8; #total] {
                let mut bytes = [0; #total];
                #(#copies)*
                bytes
            }
        }
    }
}

/// Returns the name of a setter's argument: the field's name, unless as a pattern it could be a constant or a type.
fn argument_name(fields: &[UniformField], k: usize) -> proc_macro2::Ident {
    let name = &fields[k].name;
    if !name.starts_with(|c: char| c.is_ascii_uppercase()) {
        return rust_identifier(name);
    }
    free_field_name(fields, &format!("value_{k}"))
}

/// Returns a name that no field has: `wanted`, with as many underscores appended as needed.
fn free_field_name(fields: &[UniformField], wanted: &str) -> proc_macro2::Ident {
    let mut name = wanted.to_owned();
    // Each iteration excludes one field, so this many suffice.
    for _ in fields {
        if fields.iter().any(|field| field.name == name) {
            name.push('_');
        }
    }
    format_ident!("{name}")
}

/// Returns the name of the method that sets a value: `set_NAME`, unless that is the method that sets all values.
fn setter_name(fields: &[UniformField], name: &str) -> proc_macro2::Ident {
    match name {
        "parameters" => {
            let name = free_field_name(fields, "parameters_");
            format_ident!("set_{name}")
        }
        _ => format_ident!("set_{name}"),
    }
}

/// Adds the padding before a value as a separate field.
fn push_padding(members: &mut Vec<TokenStream>, pads: &mut Vec<TokenStream>, fields: &[UniformField], bytes: u32) {
    if bytes == 0 {
        return;
    }
    let name = free_field_name(fields, &format!("padding_{}", pads.len()));
    let words = Literal::u32_unsuffixed(bytes / 4);
    members.push(quote! { #[doc = " Not read."] pub #name: [u32; #words] });
    pads.push(quote! { #name: [0; #words] });
}

/// A value that the kernel sets at run time. A matrix or an array is one value, with a field for each part that is read.
struct Whole<'f> {
    name: &'f str,
    ty: ValueType,
    /// The fields, each with the index of its part.
    parts: Vec<(&'f UniformField, u32)>,
}

/// Groups fields into the values that they are parts of, in order.
fn group_fields(fields: &[UniformField]) -> Vec<Whole<'_>> {
    let mut wholes: Vec<Whole<'_>> = Vec::new();
    for field in fields {
        let (name, ty, index) = match &field.part {
            Some(part) => (&part.of, part.ty, part.index),
            None => (&field.name, field.ty, 0),
        };
        match wholes.iter_mut().find(|whole| whole.name == name) {
            Some(whole) => whole.parts.push((field, index)),
            None => wholes.push(Whole {
                name,
                ty,
                parts: vec![(field, index)],
            }),
        }
    }
    wholes
}

impl Whole<'_> {
    /// Returns the type of the setter's argument, and the conversion to the value's own type.
    fn setter_argument(&self) -> (TokenStream, TokenStream) {
        let value = value_type(self.ty);
        match self.ty {
            // An array, or a vector type of another crate.
            ValueType::Vector { .. } => (
                quote! { impl Into<#value> },
                quote! { let value: #value = value.into(); },
            ),
            _ => (value, TokenStream::new()),
        }
    }

    /// Returns each field with the expression of its part of `value`.
    fn field_values(&self) -> impl Iterator<Item = (&UniformField, TokenStream)> {
        self.parts.iter().map(|(field, index)| {
            let index = Literal::u32_unsuffixed(*index);
            let value = match self.ty.is_single() {
                true => quote! { value },
                false => quote! { value[#index] },
            };
            (*field, value)
        })
    }

    fn column_docs(&self) -> TokenStream {
        match self.ty {
            ValueType::Matrix { .. } => quote! { #[doc = " Columns first."] },
            _ => TokenStream::new(),
        }
    }
}

/// Returns the methods of `Parameters` that set one value, by name.
fn by_name(fields: &[UniformField]) -> TokenStream {
    let wholes = group_fields(fields);
    let each = wholes.iter().map(|whole| {
        let method = format_ident!("with_{}", whole.name);
        let docs = doc_line(&format!("Replaces `{}`.", whole.name));
        let columns = whole.column_docs();
        let (taken, own) = whole.setter_argument();
        let sets = whole.field_values().map(|(field, value)| {
            let name = rust_identifier(&field.name);
            quote! { self.#name = #value; }
        });
        quote! {
            #[doc = #docs]
            #columns
            #[must_use]
            pub fn #method(mut self, value: #taken) -> Self {
                #own
                #(#sets)*
                self
            }
        }
    });
    quote! {
        impl Parameters {
            #(#each)*
        }
    }
}

/// Returns the setters of a bound shader: one that sets all values, and one for each value. The setters cannot fail, since
/// the compiler checks names and types.
fn quote_setters(manifest: &Manifest, fields: &[UniformField]) -> TokenStream {
    let from = match manifest.immediates {
        None => "submission",
        Some(_) => "recording",
    };
    let wholes = group_fields(fields);
    let each = wholes.iter().map(|whole| {
        let setter = setter_name(fields, whole.name);
        let docs = doc_line(&format!("Sets `{}` from the next {from} on.", whole.name));
        let columns = whole.column_docs();
        let (taken, own) = whole.setter_argument();
        let writes = whole.field_values().map(|(field, value)| {
            let offset = Literal::u32_unsuffixed(field.offset);
            let scalar = format_ident!("{}", field.ty.scalar().name());
            let bytes = match field.ty.components() {
                1 => quote! { &#value.to_le_bytes() },
                _ => quote! { #value.map(#scalar::to_le_bytes).as_flattened() },
            };
            quote! { self.0.write_at(queue, #offset, #bytes); }
        });
        quote! {
            #[doc = #docs]
            #columns
            pub fn #setter(&self, queue: &wgpu::Queue, value: #taken) {
                #own
                #(#writes)*
            }
        }
    });
    let docs = doc_line(&format!("Sets all runtime values, from the next {from} on."));
    quote! {
        #[doc = #docs]
        pub fn set_parameters(&self, queue: &wgpu::Queue, parameters: &Parameters) {
            self.0.write_at(queue, 0, &parameters.to_bytes());
        }

        #(#each)*
    }
}

/// Returns the zeros of a field as stored in the buffer.
fn quote_zero(ty: ValueType) -> TokenStream {
    let number = match ty.scalar() {
        Scalar::F32 => quote! { 0.0 },
        Scalar::I32 | Scalar::U32 => quote! { 0 },
    };
    let part = match ty {
        // An element with three components occupies the space of four.
        ValueType::Array { components: 3, .. } => quote! { [#number; 4] },
        _ if ty.components() == 1 => number,
        _ => {
            let components = Literal::u8_unsuffixed(ty.components());
            quote! { [#number; #components] }
        }
    };
    match ty.is_single() {
        true => part,
        false => {
            let count = Literal::u32_unsuffixed(ty.parts());
            quote! { [#part; #count] }
        }
    }
}

/// Returns the default of every field, as Rust.
fn default(field: &UniformField) -> Option<TokenStream> {
    let value = field.default?;
    Some(match field.ty.scalar() {
        Scalar::F32 => {
            let literal = Literal::f32_suffixed(value.abs() as f32);
            if value.is_sign_negative() {
                quote! { -#literal }
            } else {
                quote! { #literal }
            }
        }
        Scalar::I32 => {
            let literal = Literal::i32_suffixed(value as i32);
            quote! { #literal }
        }
        Scalar::U32 => {
            let literal = Literal::u32_suffixed(value as u32);
            quote! { #literal }
        }
    })
}

/// Returns the type of a field as stored in the buffer: a number, an array of components, or an array of those. An element
/// with three components occupies the space of four.
fn stored_type(ty: ValueType) -> TokenStream {
    match ty {
        ValueType::Array {
            of,
            components: 3,
            count,
        } => {
            let (of, count) = (single_type(ValueType::of(of, 4)), Literal::u32_unsuffixed(count));
            quote! { [#of; #count] }
        }
        other => value_type(other),
    }
}

/// Returns the type of a value in the caller's API: a number, an array of components, or an array of those.
fn value_type(ty: ValueType) -> TokenStream {
    let part = single_type(ty.part());
    match ty.is_single() {
        true => part,
        false => {
            let count = Literal::u32_unsuffixed(ty.parts());
            quote! { [#part; #count] }
        }
    }
}

fn single_type(ty: ValueType) -> TokenStream {
    let scalar = format_ident!("{}", ty.scalar().name());
    match ty.components() {
        1 => quote! { #scalar },
        n => {
            let n = Literal::u8_unsuffixed(n);
            quote! { [#scalar; #n] }
        }
    }
}
