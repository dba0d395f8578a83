//! The kernel's own parameters and result.

use super::Evaluator;
use super::call::vector_type;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::Type as SourceType;
use crate::ir::{NodeId, Op, Scalar, Texture, Type};
use std::collections::BTreeMap;

impl Evaluator<'_> {
    /// Evaluates the kernel `entry`: its colour, the options chosen, its documentation.
    pub fn kernel(
        &mut self,
        entry: &str,
        settings: &[(String, String)],
    ) -> Eval<(NodeId, BTreeMap<String, String>, String)> {
        let library = self.library;
        let Some(function) = library.functions.get(entry) else {
            let mut names: Vec<&str> = library
                .functions
                .keys()
                .filter(|n| !n.contains("::"))
                .map(String::as_str)
                .collect();
            names.sort_unstable();
            return Err(
                Diagnostic::new(format!("there is no function `{entry}` in the kernel's files"))
                    .help(format!("there are {}", names.join(", ")))
                    .into(),
            );
        };
        let mut options = BTreeMap::new();
        let mut args = Vec::new();
        for (name, ty, span) in &function.params {
            args.push(self.parameter(name, ty, *span, settings, &mut options)?);
        }
        for (name, _) in settings {
            if !options.contains_key(name) {
                let known: Vec<&str> = options.keys().map(String::as_str).collect();
                let help = if known.is_empty() {
                    "it has no options".to_owned()
                } else {
                    format!("its options are {}", known.join(", "))
                };
                let error = Diagnostic::new(format!("`{entry}` has no option `{name}`")).help(help);
                self.note(error.into());
            }
        }
        if !self.errors.is_empty() {
            return Err(Exit::Noted);
        }
        let value = self.inline(entry, args, function.span)?;
        let output = self.node(&value, function.span)?;
        if self.ty(output) != Type::value(Scalar::F32, 4) {
            return Err(
                Diagnostic::at(function.span, format!("a kernel gives a Vec4, not {}", self.ty(output)))
                    .label("the kernel")
                    .help("for a Vec3 write `.extend(1.0)`, for a number `Vec4::splat(x)`")
                    .into(),
            );
        }
        Ok((output, options, function.docs.clone()))
    }

    fn parameter(
        &mut self,
        name: &str,
        ty: &SourceType,
        span: Span,
        settings: &[(String, String)],
        options: &mut BTreeMap<String, String>,
    ) -> Eval {
        let SourceType::Name(type_name, args) = ty else {
            return Err(bad_parameter(name, span));
        };
        match type_name.as_str() {
            "Frame" | "FrameLayers" => return self.texture_parameter(name, type_name, args, span),
            "IVec2" if name == "pixel" => {
                return Ok(Value::Node(self.builder.add(
                    Op::Pixel,
                    Vec::new(),
                    Type::value(Scalar::I32, 2),
                )));
            }
            "f32" => return Ok(self.uniform(name, Type::F32, None)),
            "i32" => return Ok(self.uniform(name, Type::I32, None)),
            "u32" => return Ok(self.uniform(name, Type::U32, None)),
            _ => {}
        }
        if let Some((kind, lanes)) = vector_type(type_name) {
            return Ok(self.uniform(name, Type::value(kind, lanes), None));
        }
        if self.library.options.contains_key(type_name) {
            return self.configure(type_name, settings, options);
        }
        let library = self.library;
        let Some(structure) = library.structs.get(type_name) else {
            return Err(bad_parameter(name, span));
        };
        let mut fields = Vec::new();
        for (field, ty, at) in &structure.fields {
            match ty {
                SourceType::Name(texture, args) if texture == "Frame" || texture == "FrameLayers" => {
                    fields.push((field.clone(), self.texture_parameter(field, texture, args, *at)?));
                }
                _ => {
                    return Err(Diagnostic::at(*at, format!("`{field}` is not a texture"))
                        .help("a structure that a kernel takes holds textures; options are declared by `options!`")
                        .into());
                }
            }
        }
        Ok(Value::Struct {
            ty: type_name.clone(),
            fields,
        })
    }

    fn texture_parameter(&mut self, name: &str, ty: &str, args: &[SourceType], span: Span) -> Eval {
        let components = match args {
            [SourceType::Name(texel, _)] if texel == "f32" => Some(1),
            [SourceType::Name(texel, _)] => vector_type(texel)
                .filter(|(kind, _)| *kind == Scalar::F32)
                .map(|(_, n)| n),
            _ => None,
        };
        let Some(components) = components else {
            return Err(Diagnostic::at(
                span,
                format!("the texture `{name}` has no texels that a shader can read"),
            )
            .help("texels are f32, Vec2, Vec3 or Vec4")
            .into());
        };
        let textures = &mut self.builder.graph_mut().textures;
        if textures.iter().any(|t| t.name == name) {
            return Err(Diagnostic::at(span, format!("two textures are called `{name}`"))
                .help("bindings go by name: rename one")
                .into());
        }
        textures.push(Texture {
            name: name.to_owned(),
            components,
            layered: ty == "FrameLayers",
        });
        Ok(Value::Texture(textures.len() as u32 - 1))
    }
}

fn bad_parameter(name: &str, span: Span) -> Exit {
    Diagnostic::at(span, format!("a kernel cannot take `{name}` of this type"))
        .label("not supported")
        .help("a kernel takes options (`options!`), textures (`Frame`, `FrameLayers`, or a structure of them), numbers and vectors, and `pixel: IVec2`")
        .into()
}
