//! Calls of `draw`, which become passes.

use super::capture::Captured;
use super::rule::rule_of_picture;
use super::signature::{PictureType, picture_type};
use super::state::{Place, Walk};
use super::syntax::{closure_parameter, format_attribute, frame_parameters, unused_name};
use super::value::{Image, Value};
use super::{MOST_PASSES, Pass, Picture, Source, item, refused};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::{token_span, unraw};
use proc_macro2::Ident;
use quote::ToTokens;
use std::rc::Rc;
use straightline_manifest::Format;
use straightline_manifest::chain::SizeRule;
use syn::spanned::Spanned;

impl Walk<'_> {
    /// Makes a pass of `draw(size, |pixel| ..)`.
    pub(super) fn draw(&mut self, call: &syn::ExprCall, place: Place<'_>) -> Result<Value, Box<Diagnostic>> {
        let arguments: Vec<&syn::Expr> = call.args.iter().collect();
        let help = "write `draw(color.size(), |pixel| ..)`";
        let [size, syn::Expr::Closure(closure)] = arguments.as_slice() else {
            return Err(refused(self.file, call, "`draw` with such arguments", help));
        };
        let Some(pixel) = closure_parameter(closure) else {
            return Err(refused(self.file, closure, "a closure without one parameter", help));
        };
        let known = self.known(size)?;
        if known.is_none() && !self.errors.is_empty() {
            return Ok(Value::Broken);
        }
        let Some(Value::Size(size)) = known else {
            let help = "compute it of sizes of pictures, integers and options: `color.size() / 2`, `uvec2(256, 1)`";
            return Err(refused(
                self.file,
                *size,
                "a picture whose size is a runtime value",
                help,
            ));
        };
        let size = rule_of_picture(&size);
        let Some(ty) = place.ty.and_then(picture_type) else {
            let name = place.name.map_or("name".to_owned(), Ident::to_string);
            let help = format!("write its type: `let {name}: Texture<Vec4> = draw(..);`");
            return Err(Box::new(
                Diagnostic::error_at(
                    Code::TypeNeeded,
                    token_span(self.file, call.func.span()),
                    "a picture of unknown type",
                )
                .label("nothing states what it holds")
                .help(help),
            ));
        };
        if self.chain.passes.len() == MOST_PASSES {
            let what = format!("a chain of more than {MOST_PASSES} passes");
            return Err(refused(self.file, call, what, "give its loops fewer iterations"));
        }
        let captured = self.captured(closure.body.to_token_stream(), &*closure.body)?;
        let index = self.chain.pictures.len();
        self.add_pass(call, (closure, pixel), captured, &ty, &size, place)?;
        Ok(Value::Image(Image {
            source: Source::Picture(index),
            ty: Rc::new(ty),
        }))
    }

    pub(super) fn add_pass(
        &mut self,
        call: &syn::ExprCall,
        (closure, pixel): (&syn::ExprClosure, &syn::Pat),
        captured: Captured,
        ty: &PictureType,
        size: &SizeRule,
        place: Place<'_>,
    ) -> Result<(), Box<Diagnostic>> {
        let at = token_span(self.file, call.func.span());
        let format = self.read_format(place.attrs)?;
        let stem = place.name.map(Ident::to_string);
        let stem = stem.as_deref().map_or("", unraw);
        let entry = match stem {
            "" => self.chain.name.clone(),
            stem => format!("{}_{stem}", self.chain.name),
        };
        let parts = item::PassParts {
            entry: Ident::new(&entry, call.func.span()),
            pixel: pixel.clone(),
            body: captured.tokens,
            texel: ty.texel.clone(),
            values: captured.values,
            lets: &self.lets,
            params: &self.params,
        };
        let mut made = item::make_kernel(parts).map_err(|two| {
            let what = format!("`{}` stands for two values in this pass", two.0);
            let help = "a value that is computed before the pass reads what has changed since: compute it in the pass";
            refused(self.file, &*closure.body, what, help)
        })?;
        self.check_frames(&made.reads, size, &frame_parameters(&made.kernel), call)?;
        let text = item::text_without_name(&made.kernel);
        let known = self.entries.get(&text).cloned();
        let entry = known.unwrap_or_else(|| {
            let taken = |name: &str| self.kernels.iter().any(|kernel| kernel.sig.ident == name);
            let entry = match self.has_function(&entry) {
                true => unused_name(&format!("{entry}_pass"), taken),
                false => unused_name(&entry, taken),
            };
            made.kernel.sig.ident = Ident::new(&entry, call.func.span());
            self.kernels.push(made.kernel.clone());
            self.entries.insert(text, entry.clone());
            entry
        });
        let taken = |name: &str| {
            self.chain.pictures.iter().any(|picture| picture.name == name)
                || self.chain.inputs.iter().any(|input| input == name)
        };
        let name = unused_name(if stem.is_empty() { "result" } else { stem }, taken);
        self.chain.pictures.push(Picture {
            name,
            size: size.clone(),
            format,
            span: at,
        });
        self.chain.passes.push(Pass {
            entry,
            reads: made.reads,
            has_options: made.has_options,
        });
        Ok(())
    }

    /// Checks that the frames that a pass reads have the size of what it draws.
    pub(super) fn check_frames(
        &self,
        reads: &[(String, Source)],
        size: &SizeRule,
        frames: &[String],
        at: &impl Spanned,
    ) -> Result<(), Box<Diagnostic>> {
        for (name, source) in reads.iter().filter(|(name, _)| frames.contains(name)) {
            let of = rule_of_picture(&self.size_of(source));
            if of != *size {
                let what = format!("`{name}` is a frame of size {of}, read by a pass of size {size}");
                let help = format!("let `{name}` be a `Texture`, which may have any size");
                return Err(refused(self.file, at, what, &help));
            }
        }
        Ok(())
    }

    /// Format that an attribute asks for.
    fn read_format(&self, attrs: &[syn::Attribute]) -> Result<Option<Format>, Box<Diagnostic>> {
        let Some(written) = format_attribute(attrs) else {
            return Ok(None);
        };
        let text = written.to_string();
        match Format::COLOURS.into_iter().find(|format| format.wgsl_name() == text) {
            Some(format) => Ok(Some(format)),
            None => {
                let names: Vec<&str> = Format::COLOURS.iter().map(|format| format.wgsl_name()).collect();
                let what = format!("`{text}` is no format of a picture");
                Err(refused(self.file, &written, what, &format!("use {}", names.join(", "))))
            }
        }
    }
}
