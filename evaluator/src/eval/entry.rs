//! The kernel's own parameters and result.

use super::Evaluator;
use super::enums::{EnumValue, Tag};
use super::options::unknown_settings;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Param, Type as SourceType};
use crate::front::unraw;
use crate::ir::vector_named as vector_type;
use crate::ir::{BinaryOp, Invocation, NodeId, Op, Scalar, Type, UniformPart};
use std::collections::BTreeMap;
use std::rc::Rc;
use straightline_kernels::{OptionText, OptionValues};

impl Evaluator<'_> {
    /// Evaluates the kernel `entry`. Returns its results, the chosen options and its documentation.
    pub fn eval_kernel(&mut self, entry: &str, settings: &[OptionText]) -> Eval<(Vec<NodeId>, OptionValues, String)> {
        let library = self.library;
        let Some(function) = library.functions.get(entry) else {
            let mut names: Vec<&str> = library
                .functions
                .keys()
                .filter(|n| !n.contains("::"))
                .map(String::as_str)
                .collect();
            names.sort_unstable();
            return Err(Diagnostic::new(
                Code::UnknownKernel,
                format!("there is no function `{entry}` in the kernel's files"),
            )
            .help(format!("there are {}: say which, FILE.rs::FUNCTION", names.join(", ")))
            .into());
        };
        self.inputs.names = self.names_of_parameters(&function.params);
        let mut options = OptionValues::default();
        let mut args = Vec::new();
        for Param { name, ty, span, .. } in &function.params {
            if ty.is_mutable_reference() {
                self.record_error(by_reference(name, *span));
                continue;
            }
            match self.eval_parameter(name, ty.peel_refs(), *span, settings, &mut options) {
                Ok(value) => args.push(value),
                Err(exit) => drop(self.record_error(exit)),
            }
        }
        let of_group = matches!(self.builder.graph().invocation, Invocation::Group(_));
        let is_pixel = |param: &&Param| {
            param.name == "pixel" && matches!(param.ty.peel_refs(), SourceType::Name(of, _) if of == "IVec2")
        };
        let pixel = function.params.iter().find(is_pixel);
        if let (true, Some(pixel)) = (of_group, pixel) {
            let error = Diagnostic::error_at(
                Code::KernelParameter,
                pixel.span,
                "a kernel of workgroups has a pixel for each thread",
            )
            .label("of which thread?")
            .help("leave it out, and take `thread.pixel` in a `group.each(|thread| ...)`");
            self.record_error(error.into());
        }
        let names: Vec<&str> = options.iter().map(|(name, _)| name.as_str()).collect();
        for error in unknown_settings(entry, &names, settings) {
            self.record_error(error.into());
        }
        if self.report.error_count() > 0 {
            return Err(Exit::Noted);
        }
        let outputs = self.meeting_demands(|e| {
            let value = e.inline_function(entry, &[], args.clone(), function.span)?;
            let value = e.deref_value(value, function.span)?;
            e.split_results(&value, function)
        })?;
        Ok((outputs, options, function.docs.clone()))
    }

    /// Returns errors for parameters that no kernel can have, whatever their types. Used if other errors were found.
    pub fn parameter_errors(mut self, entry: &str) -> Vec<Diagnostic> {
        let Some(function) = self.library.functions.get(entry) else {
            return Vec::new();
        };
        self.inputs.names = self.names_of_parameters(&function.params);
        for Param { name, ty, span, .. } in &function.params {
            let is_options = matches!(ty.peel_refs(), SourceType::Name(of, _) if self.library.options.contains_key(of));
            if ty.is_mutable_reference() {
                self.record_error(by_reference(name, *span));
            } else if !is_options
                && let Err(exit) = self.eval_parameter(name, ty.peel_refs(), *span, &[], &mut OptionValues::default())
            {
                self.record_error(exit);
            }
        }
        let mut errors = self.report.take_errors();
        errors.retain(|error| error.code() == Some(Code::KernelParameter));
        errors
    }

    /// Names of parameters and of the fields of structure parameters, with the number of uses of each.
    fn names_of_parameters(&self, params: &[Param]) -> BTreeMap<String, usize> {
        let library = self.library;
        let mut names = BTreeMap::new();
        let mut add = |name: &str| *names.entry(unraw(name).to_owned()).or_default() += 1;
        for param in params {
            let of = match param.ty.peel_refs() {
                SourceType::Name(of, _) => of.as_str(),
                _ => "",
            };
            match library.structs.get(of) {
                _ if library.options.contains_key(of) => {}
                Some(structure) => structure.fields.iter().for_each(|(field, ..)| add(field)),
                None => add(&param.name),
            }
        }
        names
    }

    fn eval_parameter(
        &mut self,
        name: &str,
        ty: &SourceType,
        span: Span,
        settings: &[OptionText],
        options: &mut OptionValues,
    ) -> Eval {
        self.inputs.declared.push((name.to_owned(), span));
        if let Some(resource) = self.resource_parameter(name, ty, span)? {
            return Ok(resource);
        }
        if let Some(group) = self.workgroup_parameter(name, ty, span)? {
            return Ok(group);
        }
        if matches!(ty, SourceType::Array(..)) {
            let array = self.uniform_part(name, ty, span)?;
            return array.ok_or_else(|| bad_parameter(name, span));
        }
        if let Some(uniform) = self.uniform_parameter(name, ty, span)? {
            return Ok(uniform);
        }
        let SourceType::Name(type_name, _) = ty else {
            return Err(bad_parameter(name, span));
        };
        if self.library.options.contains_key(type_name) {
            return self.configure_options(type_name, settings, options);
        }
        let library = self.library;
        let Some(structure) = library.structs.get(type_name) else {
            return Err(bad_parameter(name, span));
        };
        let mut fields = Vec::new();
        for (field, ty, at) in &structure.fields {
            let ty = ty.peel_refs();
            // If several structures have a field of this name, the parameter's name is prefixed.
            let is_one = self.inputs.names.get(unraw(field)).is_none_or(|times| *times == 1);
            let known = match is_one {
                true => field.to_string(),
                false => self.part_name(name, field),
            };
            self.inputs.declared.push((known.clone(), *at));
            let value = match self.resource_parameter(&known, ty, *at)? {
                Some(value) => Some(value),
                None => self.uniform_part(&known, ty, *at)?,
            };
            let Some(value) = value else {
                return Err(
                    Diagnostic::error_at(Code::KernelParameter, *at, format!("`{field}` is neither a resource nor a number"))
                        .label("not supported")
                        .help(
                            "a structure that a kernel takes holds textures, samplers, buffers, numbers, vectors and matrices, and arrays \
                             and structures of numbers; options are declared by `options!`",
                        )
                        .into(),
                );
            };
            fields.push((field.clone(), value));
        }
        Ok(Value::structure(type_name.clone(), fields))
    }

    /// Adds the uniforms of a parameter. Array elements are named by number, fields of a nested structure by both names.
    /// Returns `None` if the type contains something that is no number.
    fn uniform_part(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let library = self.library;
        match ty {
            SourceType::Array(element, Some(len)) => {
                let mut elements = Vec::new();
                let count = self.known_length(len)?;
                for k in 0..count {
                    let own = self.part_name(name, &k.to_string());
                    match self.uniform_part(&own, element, span)? {
                        Some(element) => elements.push(element),
                        None => return Ok(None),
                    }
                    // The uniforms added for structures and matrices have longer names.
                    let added = self.builder.graph_mut().uniforms.last_mut();
                    if let Some(uniform) = added.filter(|uniform| uniform.name == own) {
                        uniform.part = Some(UniformPart {
                            of: unraw(name).to_owned(),
                            index: k,
                            count,
                            columns: false,
                        });
                    }
                }
                Ok(Some(Value::array(elements)))
            }
            SourceType::Name(of, _) if library.structs.contains_key(of) => {
                let mut fields = Vec::new();
                for (field, ty, at) in &library.structs[of].fields {
                    match self.uniform_part(&self.part_name(name, field), ty, *at)? {
                        Some(value) => fields.push((field.clone(), value)),
                        None => return Ok(None),
                    }
                }
                Ok(Some(Value::structure(of.clone(), fields)))
            }
            _ => self.uniform_parameter(name, ty, span),
        }
    }

    /// Adds a parameter that is set at run time or built in; `None` if its type is no number.
    fn uniform_parameter(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        if let Some(value) = self.quad_parameter(name, ty, span)? {
            return Ok(Some(value));
        }
        let SourceType::Name(type_name, _) = ty else {
            return Ok(None);
        };
        let pair = Type::value(Scalar::I32, 2);
        let ty = match type_name.as_str() {
            "IVec2" if name == "pixel" => {
                return Ok(Some(Value::Node(self.builder.add(Op::Pixel, Vec::new(), pair))));
            }
            "UVec2" if name == "resolution" => {
                let size = self.builder.add(Op::FrameSize, Vec::new(), pair);
                return Ok(Some(Value::Node(self.convert_node(size, Scalar::U32))));
            }
            "f32" => Type::F32,
            "i32" => Type::I32,
            "u32" => Type::U32,
            // Booleans cannot be stored in buffers.
            "bool" => {
                let set = self.add_uniform(&self.input_name(name), Type::U32, None);
                let zero = Value::Node(self.builder.constant(Type::U32, [0; 4]));
                return self.eval_binary(BinaryOp::Ne, &set, &zero, span).map(Some);
            }
            other => match (vector_type(other), super::matrix::column_count(other)) {
                (Some((kind, lanes)), _) => Type::value(kind, lanes),
                (None, Some(n)) => {
                    // Consecutive columns form a matrix in memory, in WGSL and in GLSL.
                    let mut columns = Vec::new();
                    for (index, axis) in (0..).zip(super::matrix::axis_names(n)) {
                        let own = self.part_name(name, axis);
                        let column = self.add_uniform(&own, Type::value(Scalar::F32, n), None);
                        if let Some(uniform) = self.builder.graph_mut().uniforms.last_mut() {
                            uniform.part = Some(UniformPart {
                                of: unraw(name).to_owned(),
                                index,
                                count: n.into(),
                                columns: true,
                            });
                        }
                        columns.push(self.value_node(&column, span)?);
                    }
                    return Ok(Some(super::matrix::matrix_value(&columns)));
                }
                (None, None) => return self.enum_parameter(name, other, span),
            },
        };
        let name = &*self.input_name(name);
        Ok(Some(self.add_uniform(name, ty, None)))
    }

    /// Adds a parameter that is an enum whose variants hold no values: a `u32`, the position of the variant. A greater
    /// number is the last variant. Returns `None` if the type is no enum.
    fn enum_parameter(&mut self, name: &str, of: &str, span: Span) -> Eval<Option<Value>> {
        let library = self.library;
        let Some(definition) = library.enums.get(of) else {
            return Ok(None);
        };
        let count = definition.variants.len();
        if count == 0 || definition.variants.iter().any(|variant| !variant.fields.is_empty()) {
            return Err(enum_with_values(name, of, span));
        }
        let set = self.add_uniform(&self.input_name(name), Type::U32, None);
        let tag = match count {
            1 => Tag::Known(0),
            2 => {
                let zero = Value::Node(self.builder.constant(Type::U32, [0; 4]));
                let is_second = self.eval_binary(BinaryOp::Ne, &set, &zero, span)?;
                Tag::Node(self.value_node(&is_second, span)?)
            }
            _ => {
                let last = Value::Node(self.builder.constant(Type::U32, [count as u32 - 1, 0, 0, 0]));
                let variant = self.eval_binary(BinaryOp::Min, &set, &last, span)?;
                let variant = self.value_node(&variant, span)?;
                Tag::Node(self.convert_node(variant, Scalar::I32))
            }
        };
        Ok(Some(Value::Enum(Rc::new(EnumValue {
            ty: of.into(),
            tag,
            variants: vec![Some(Vec::new()); count],
        }))))
    }
}

fn by_reference(name: &str, span: Span) -> Exit {
    Diagnostic::error_at(
        Code::KernelParameter,
        span,
        format!("a kernel cannot take `{name}` by `&mut`"),
    )
    .label("not supported")
    .help("a kernel reads its parameters, and gives one colour")
    .into()
}

fn enum_with_values(name: &str, of: &str, span: Span) -> Exit {
    let message = format!("a kernel cannot take `{name}`: not every `{of}` is a variant without values");
    Diagnostic::error_at(Code::KernelParameter, span, message)
        .label("not supported")
        .help(format!(
            "take an enum of the variants alone, and their values as parameters of their own: `{name}: u32, {name}_value: f32`"
        ))
        .into()
}

fn bad_parameter(name: &str, span: Span) -> Exit {
    Diagnostic::error_at(Code::KernelParameter, span, format!("a kernel cannot take `{name}` of this type"))
        .label("not supported")
        .help(
            "a kernel takes options (`options!`), textures, samplers and buffers of the prelude, numbers, vectors and matrices, \
             enums without values, structures and arrays of these, `pixel: IVec2` and `resolution: UVec2`; of many values take a `&Buffer<T>`",
        )
        .into()
}
