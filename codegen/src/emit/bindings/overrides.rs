//! Rust for the options that are set when the pipeline is created.

use super::{doc_line, rust_identifier};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use straightline_manifest::{Manifest, Override, OverrideType};

/// Returns the struct `Overrides` with its defaults; nothing for a shader without overrides.
pub fn quote_overrides(manifest: &Manifest) -> TokenStream {
    let all = &manifest.overrides;
    if all.is_empty() {
        return TokenStream::new();
    }
    let names: Vec<&str> = all.iter().map(|of| of.name.as_str()).collect();
    let fields: Vec<_> = names.iter().map(|name| rust_identifier(name)).collect();
    let types = all.iter().map(|of| format_ident!("{}", of.ty.to_string()));
    let docs = all.iter().map(|of| {
        let range = of
            .range
            .map_or(String::new(), |[low, high]| format!(", {low} to {high}"));
        doc_line(&format!(
            "`{}` of the kernel{range}; {} by default.",
            of.name,
            default_text(of)
        ))
    });
    let defaults = all
        .iter()
        .map(|of| default_text(of).parse::<TokenStream>().expect("a literal"));
    quote! {
        /// Options that are set when the pipeline is created.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Overrides {
            #(#[doc = #docs] pub #fields: #types,)*
        }

        impl Default for Overrides {
            fn default() -> Self {
                Overrides { #(#fields: #defaults,)* }
            }
        }

    }
}

/// Returns the method that gives the values to a pass; nothing for a shader without overrides.
pub fn quote_apply(manifest: &Manifest) -> TokenStream {
    let names: Vec<&str> = manifest.overrides.iter().map(|of| of.name.as_str()).collect();
    let fields = names.iter().map(|name| rust_identifier(name));
    let method = quote! {
        impl Overrides {
            /// `options` with these values. Values out of range are refused when the pipeline is created.
            #[must_use]
            pub fn apply(&self, options: straightline_runtime::PassOptions) -> straightline_runtime::PassOptions {
                options #(.override_option(#names, self.#fields))*
            }
        }
    };
    match names.is_empty() {
        true => TokenStream::new(),
        false => method,
    }
}

/// Returns the method that gives the values to a pipeline of wgpu; nothing for a shader without overrides.
pub fn quote_pairs(manifest: &Manifest) -> TokenStream {
    let all = &manifest.overrides;
    let count = Literal::usize_unsuffixed(all.len());
    let pairs = all.iter().map(|of| {
        let (id, field) = (of.id.to_string(), rust_identifier(&of.name));
        let value = match of.ty {
            OverrideType::Bool => quote! { u8::from(self.#field) },
            _ => quote! { self.#field },
        };
        quote! { (#id, f64::from(#value)) }
    });
    let method = quote! {
        impl Overrides {
            /// Returns the values as `constants` of `wgpu::PipelineCompilationOptions`. No value is compared with its range.
            #[must_use]
            pub fn constants(&self) -> [(&'static str, f64); #count] {
                [#(#pairs),*]
            }
        }
    };
    match all.is_empty() {
        true => TokenStream::new(),
        false => method,
    }
}

/// Default of an override as a Rust literal.
fn default_text(of: &Override) -> String {
    match of.ty {
        OverrideType::F32 => format!("{:?}", of.default as f32),
        OverrideType::I32 | OverrideType::U32 => of.default.to_string(),
        OverrideType::Bool => (of.default != 0.0).to_string(),
    }
}
