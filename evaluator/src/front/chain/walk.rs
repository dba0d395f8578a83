//! The walk through a chain: its statements in order, as they would run.

use super::signature::{ParamKind, param_kind, param_name, picture_type};
use super::state::{Place, Walk};
use super::value::{Image, Value};
use super::{Chain, Source, item, read, refused};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::items::doc_text;
use crate::front::{token_span, unraw};
use std::collections::HashMap;
use std::rc::Rc;
use straightline_kernels::OptionValues;

/// A chain with the kernels of its passes.
pub struct Walked {
    /// The chain.
    pub chain: Chain,
    /// Kernels of its passes, each once.
    pub kernels: Vec<syn::ItemFn>,
}

/// Walks the chain `name`.
///
/// # Errors
///
/// Every statement that no chain has.
pub fn walk_chain(syntax: &[(u32, syn::File)], name: &str, options: &OptionValues) -> Result<Walked, Vec<Diagnostic>> {
    let Some((file, function)) = read::find_function(syntax, name) else {
        let what = format!("the files have no function `{name}`");
        return Err(vec![Diagnostic::new(Code::UnknownKernel, what)]);
    };
    let params = item::params_by_name(&function.sig);
    let mut walk = Walk {
        syntax,
        options,
        file,
        frames: Vec::new(),
        scopes: vec![HashMap::new()],
        lets: Vec::new(),
        chain: Chain {
            name: unraw(name).to_owned(),
            span: token_span(file, function.sig.ident.span()),
            docs: doc_text(&function.attrs),
            inputs: Vec::new(),
            pictures: Vec::new(),
            passes: Vec::new(),
            results: Vec::new(),
        },
        kernels: Vec::new(),
        entries: HashMap::new(),
        steps: 0,
        depth: 0,
        errors: Vec::new(),
        params,
    };
    walk.bind_params(function);
    if walk.errors.is_empty() {
        walk.walk_results(function);
    }
    match walk.errors.is_empty() {
        true => Ok(Walked {
            chain: walk.chain,
            kernels: walk.kernels,
        }),
        false => Err(walk.errors),
    }
}

impl Walk<'_> {
    /// Declares the parameters of the chain.
    pub(super) fn bind_params(&mut self, function: &syn::ItemFn) {
        let types = function.sig.generics.type_params().next();
        if let Some(first) = types {
            let help = "write the types of its pictures";
            self.errors
                .push(*refused(self.file, first, "a chain with type parameters", help));
        }
        for input in &function.sig.inputs {
            let Some((name, ty)) = param_name(input) else {
                let help = "write `name: type`";
                self.errors
                    .push(*refused(self.file, input, "a parameter without a name", help));
                continue;
            };
            let variable = name.to_string();
            let text = unraw(&variable).to_owned();
            if ["pixel", "resolution"].contains(&text.as_str()) {
                let help = "each pass has its own: the closure of `draw` takes `pixel`, and `color.size()` is the size of `color`";
                let what = format!("`{text}` as a parameter of a chain");
                self.errors.push(*refused(self.file, name, what, help));
            }
            let value = match param_kind(ty) {
                ParamKind::Image => {
                    self.chain.inputs.push(text.clone());
                    let source = Source::Input(text.clone());
                    match picture_type(ty).map(Rc::new) {
                        Some(ty) => {
                            if ty.is_frame {
                                self.frames.push(text.clone());
                            }
                            Value::Image(Image { source, ty })
                        }
                        None => Value::Param(text.clone()),
                    }
                }
                ParamKind::Resource => {
                    self.chain.inputs.push(text.clone());
                    Value::Param(text.clone())
                }
                ParamKind::Uniform => Value::Param(text.clone()),
                ParamKind::Options => Value::Options(text.clone()),
            };
            self.declare(&variable, value, Some(ty.clone()));
        }
    }

    /// Walks the body of the chain, and records what it returns.
    pub(super) fn walk_results(&mut self, function: &syn::ItemFn) {
        let syn::ReturnType::Type(_, ty) = &function.sig.output else {
            return;
        };
        let place = Place {
            ty: Some(ty),
            ..Place::default()
        };
        let results = match self.block(&function.block, place) {
            Ok(Some(Value::Tuple(values))) => values,
            Ok(Some(value)) => vec![value],
            Ok(None) => Vec::new(),
            Err(error) => {
                self.errors.push(*error);
                return;
            }
        };
        if !self.errors.is_empty() {
            return;
        }
        let each = results.into_iter().flat_map(|value| match value {
            Value::Images(images) => images.into_iter().map(Value::Image).collect(),
            other => vec![other],
        });
        let results: Vec<Value> = each.collect();
        for value in &results {
            let image = match value {
                Value::Image(image) => &image.source,
                _ => {
                    let help = "end it with a picture: `draw(size, |pixel| ..)`, or a variable that holds one";
                    let what = format!("`{}` ends with {}", self.chain.name, value.kind());
                    self.errors.push(*refused(self.file, &function.sig.output, what, help));
                    continue;
                }
            };
            match image {
                Source::Picture(index) if !self.chain.results.contains(index) => self.chain.results.push(*index),
                Source::Picture(_) => {
                    let what = "one picture as two results";
                    let help = "return it once: the host can use it twice";
                    self.errors.push(*refused(self.file, &function.sig.output, what, help));
                }
                Source::Input(name) => {
                    let what = format!("the input `{name}` as a result");
                    let help = "draw it: `draw(input.size(), |pixel| input.load(pixel))`";
                    self.errors.push(*refused(self.file, &function.sig.output, what, help));
                }
            }
        }
        if results.is_empty() && self.errors.is_empty() {
            let what = format!("`{}` returns no picture that is known", self.chain.name);
            let help = "end it with `draw(size, |pixel| ..)`, or a variable that holds a picture";
            self.errors.push(*refused(self.file, &function.sig.output, what, help));
        }
    }
}
