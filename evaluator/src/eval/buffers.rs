//! Buffer parameters, and reads of their elements.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, Type as SourceType};
use crate::front::unraw;
use crate::ir::vector_named as vector_type;
use crate::ir::{Access, Buffer, Element, NodeId, Op, Scalar, Structure, Type};

/// Maximum number of elements of a host-filled array: the number of vectors in a uniform buffer on every device.
const LONGEST: i64 = 1024;

impl Evaluator<'_> {
    /// Adds a buffer parameter.
    pub(super) fn buffer_parameter(&mut self, name: &str, of: &str, args: &[SourceType], span: Span) -> Eval {
        let element = self.element_type(name, args, span)?;
        let access = match of {
            "AtomicBuffer" => Access::Atomic,
            "StorageBuffer" => Access::Write,
            _ => Access::Read,
        };
        let whole = [Element::Value(Type::I32), Element::Value(Type::U32)];
        if access == Access::Atomic && !whole.contains(&element) {
            return Err(Diagnostic::error_at(
                Code::ResourceElement,
                span,
                format!("the buffer `{name}` has no elements that are changed at once"),
            )
            .label("of this type")
            .help("elements of an `AtomicBuffer` are u32 or i32")
            .into());
        }
        if access == Access::Write && matches!(element, Element::Struct(_)) {
            return Err(Diagnostic::error_at(
                Code::ResourceElement,
                span,
                format!("the buffer `{name}` has no elements that a shader can write"),
            )
            .label("of this type")
            .help("elements of a `StorageBuffer` are f32, i32, u32, or vectors of 2 or 4 of them")
            .into());
        }
        let name = &*self.input_name(name);
        self.inputs.elements.extend(args.first().cloned());
        let buffers = &mut self.builder.graph_mut().buffers;
        buffers.push(Buffer {
            name: name.to_owned(),
            element,
            access,
        });
        Ok(Value::Buffer(buffers.len() as u32 - 1))
    }

    /// Returns the element type of a buffer. Value elements are packed natively and in a shader; structures use the
    /// shader's layout.
    fn element_type(&mut self, name: &str, args: &[SourceType], span: Span) -> Eval<Element> {
        let refused = || -> Exit {
            Diagnostic::error_at(
Code::ResourceElement,
                span,
                format!("the buffer `{name}` has no elements that a shader can read"),
            )
            .label("of this type")
            .note("a vector of 3 takes the room of 4 in a shader's array, and of 3 in Rust's")
            .help("elements are f32, i32, u32, vectors of 2 or 4 of them, or structures of numbers, vectors, matrices and arrays")
            .into()
        };
        let [element @ SourceType::Name(of, _)] = args else {
            return Err(refused());
        };
        if self.library.structs.contains_key(of) {
            let mut fields = Vec::new();
            self.fields_of(of, "", element, span, &mut fields)?;
            if fields.is_empty() {
                return Err(refused());
            }
            // The name of a nested field is joined from both names, which may clash with another field.
            let mut named: Vec<(String, Type)> = Vec::new();
            for (name, ty) in fields {
                let name = self.free_name(&name, &|name| named.iter().any(|(other, _)| other == name));
                named.push((name, ty));
            }
            return Ok(Element::Struct(Structure::new(unraw(of).to_owned(), named)));
        }
        match value_named(of).filter(|ty| ty.component_count() != 3) {
            Some(ty) => Ok(Element::Value(ty)),
            None => Err(refused()),
        }
    }

    /// Collects the fields that a type occupies in a structure `of`. A number is one field; the fields of a nested
    /// structure are prefixed with its name.
    fn fields_of(
        &mut self,
        of: &str,
        name: &str,
        ty: &SourceType,
        span: Span,
        fields: &mut Vec<(String, Type)>,
    ) -> Eval<()> {
        let library = self.library;
        let inner = |field: &str| match name {
            // Field of a tuple structure.
            "" if field.starts_with(|c: char| c.is_ascii_digit()) => format!("part_{field}"),
            "" => unraw(field).to_owned(),
            outer => format!("{outer}_{}", unraw(field)),
        };
        let refused = || -> Exit {
            Diagnostic::error_at(Code::ResourceElement, span, format!("`{name}` is nothing that a buffer of `{of}` can hold"))
                .label("of this type")
                .help("fields are f32, i32, u32, vectors, matrices, structures of these, and arrays of numbers, vectors or structures")
                .into()
        };
        match ty {
            SourceType::Name(type_name, _) if library.structs.contains_key(type_name) => {
                for (field, ty, at) in &library.structs[type_name].fields {
                    self.fields_of(of, &inner(field), ty, *at, fields)?;
                }
            }
            SourceType::Name(type_name, _) => match (value_named(type_name), super::matrix::column_count(type_name)) {
                (Some(ty), _) => fields.push((name.to_owned(), ty)),
                (None, Some(n)) => {
                    let column = Type::value(Scalar::F32, n);
                    fields.extend(super::matrix::axis_names(n).iter().map(|axis| (inner(axis), column)));
                }
                (None, None) => return Err(refused()),
            },
            SourceType::Array(element, Some(len)) => {
                let SourceType::Name(type_name, _) = &**element else {
                    return Err(refused());
                };
                if library.structs.contains_key(type_name) {
                    for k in 0..self.known_length(len)? {
                        self.fields_of(of, &format!("{name}_{k}"), element, span, fields)?;
                    }
                    if fields.len() > LONGEST as usize {
                        let message = format!("an element of a buffer has more than {LONGEST} fields");
                        return Err(Diagnostic::error_at(Code::ResourceElement, span, message)
                            .label("with those of this array")
                            .help("keep the array in a buffer of its own")
                            .into());
                    }
                    return Ok(());
                }
                let Some(Type::Value {
                    scalar,
                    components: lanes,
                }) = value_named(type_name)
                else {
                    return Err(refused());
                };
                let len = self.known_length(len)?;
                fields.push((
                    name.to_owned(),
                    Type::Array {
                        scalar,
                        components: lanes,
                        len,
                    },
                ));
            }
            _ => return Err(refused()),
        }
        Ok(())
    }

    /// Returns the length of a host-filled array. Fails unless it is a constant between 1 and `LONGEST`.
    pub(super) fn known_length(&mut self, len: &Expr) -> Eval<u32> {
        let count = self.eval_expr(len)?;
        match self.known_int(&count) {
            Some(n) if (1..=LONGEST).contains(&n) => Ok(n as u32),
            _ => Err(Diagnostic::error_at(
                Code::ResourceElement,
                len.span,
                format!("an array that a host fills has 1 to {LONGEST} elements"),
            )
            .label("not this many")
            .help("keep what is longer in a buffer of its own")
            .into()),
        }
    }

    /// Evaluates a buffer method.
    pub fn eval_buffer_method(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        if self.builder.graph().buffers[index as usize].access != Access::Read {
            return self.written_buffer(index, name, args, span);
        }
        match (name, args) {
            ("len", []) => {
                let len = self.builder.add(Op::BufferLen(index), Vec::new(), Type::I32);
                Ok(self.as_usize(len))
            }
            ("load", [at]) => {
                let len = self.builder.add(Op::BufferLen(index), Vec::new(), Type::I32);
                let inside = self.held_index(at, len, "last", span)?;
                let mut next = 0;
                match self.inputs.elements[index as usize].clone() {
                    SourceType::Name(of, _) => {
                        self.read_part(index, inside, &SourceType::Name(of, Vec::new()), &mut next)
                    }
                    _ => Err(Exit::Noted),
                }
            }
            _ => Err(
                Diagnostic::error_at(Code::UnknownMethod, span, format!("a buffer has no method `{name}`"))
                    .label("not supported")
                    .help("buffers have `load` and `len`")
                    .into(),
            ),
        }
    }

    /// Reads the part of an element that a value of type `ty` occupies, from field `next` on.
    fn read_part(&mut self, buffer: u32, index: NodeId, ty: &SourceType, next: &mut u32) -> Eval {
        let library = self.library;
        match ty {
            SourceType::Name(of, _) if library.structs.contains_key(of) => {
                let mut fields = Vec::new();
                for (field, ty, _) in &library.structs[of].fields {
                    fields.push((field.clone(), self.read_part(buffer, index, ty, next)?));
                }
                Ok(Value::structure(of.clone(), fields))
            }
            SourceType::Name(of, _) => match super::matrix::column_count(of) {
                Some(n) => {
                    let columns: Vec<NodeId> = (0..n).map(|_| self.read_field(buffer, index, next, None)).collect();
                    Ok(super::matrix::matrix_value(&columns))
                }
                None => Ok(Value::Node(self.read_field(buffer, index, next, None))),
            },
            SourceType::Array(element, Some(len)) if matches!(&**element, SourceType::Name(of, _) if library.structs.contains_key(of)) =>
            {
                let mut parts = Vec::new();
                for _ in 0..self.known_length(len)? {
                    parts.push(self.read_part(buffer, index, element, next)?);
                }
                Ok(Value::array(parts))
            }
            SourceType::Array(..) => {
                let field = *next;
                let of = self.builder.graph().buffers[buffer as usize].element.field_type(field);
                let parts = (0..of.map_or(1, Type::part_count)).map(|k| {
                    *next = field;
                    Value::Node(self.read_field(buffer, index, next, Some(k)))
                });
                let parts = parts.collect();
                Ok(Value::array(parts))
            }
            _ => Err(Exit::Noted),
        }
    }

    /// Reads a field of an element, or one element of a field that is an array.
    fn read_field(&mut self, buffer: u32, element: NodeId, next: &mut u32, part: Option<u32>) -> NodeId {
        let field = *next;
        *next += 1;
        let ty = self.builder.graph().buffers[buffer as usize].element.field_type(field);
        let part = part.map(|k| self.builder.i32(k as i32));
        let op = Op::BufferLoad {
            buffer,
            field,
            site: self.next_site(),
        };
        let ty = ty.map_or(Type::F32, Type::element_type);
        self.builder
            .add(op, std::iter::once(element).chain(part).collect::<Vec<_>>(), ty)
    }
}

/// Number or vector type with a name.
pub(super) fn value_named(name: &str) -> Option<Type> {
    match name {
        "f32" => Some(Type::F32),
        "i32" => Some(Type::I32),
        "u32" => Some(Type::U32),
        vector => vector_type(vector).map(|(kind, lanes)| Type::value(kind, lanes)),
    }
}
