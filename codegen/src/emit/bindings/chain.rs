//! The module of a chain: its shaders, and the constant `CHAIN` that a runtime makes it of.

use super::shader::{quote_option, quote_shader, variant_name};
use super::{Module, doc_line, quote_constants, rust_identifier};
use crate::chain::{ChainPlan, CompiledChain, EmittedChain, SizeRule, SizeTerm};
use crate::emit::prose::single_line_comment;
use proc_macro2::{Literal, TokenStream};
use quote::quote;
use straightline_evaluator::diagnostic::Errors;

/// Input of one chain's module in the bindings file.
pub struct ChainModule<'a> {
    /// The compiled chain.
    pub compiled: &'a CompiledChain,
    /// Its shaders and plan.
    pub emitted: &'a EmittedChain,
}

impl<'a> ChainModule<'a> {
    /// Returns the shaders of the passes.
    pub(super) fn modules(&self) -> impl Iterator<Item = Module<'a>> + use<'a> {
        let ChainModule { compiled, emitted } = *self;
        emitted.shaders.iter().map(move |(name, pass)| Module {
            name,
            compiled: &compiled.kernels[&pass.kernel],
            manifest: &pass.emitted.manifest,
            wgsl: pass.emitted.wgsl(),
        })
    }
}

/// Returns the module of a chain.
///
/// # Errors
///
/// A text that is not the shader that its manifest describes.
pub fn quote_chain(chain: &ChainModule<'_>) -> Result<TokenStream, Errors> {
    let ChainModule { compiled, emitted } = chain;
    let name = rust_identifier(&emitted.plan.chain);
    let summary = match compiled.summary.is_empty() {
        true => format!("The chain `{}`.", compiled.name),
        false => format!("{}.", compiled.summary.trim_end_matches('.')),
    };
    let docs = [
        doc_line(&single_line_comment(&summary)),
        String::new(),
        format!(
            " A chain of {} passes: make it by `straightline_runtime::Chain::new(&device, &CHAIN, ..)`.",
            emitted.plan.passes.len()
        ),
    ];
    let mut modules = Vec::new();
    for module in chain.modules() {
        let constant = quote_shader(&module).map_err(|refusal| refusal.into_errors(module.compiled))?;
        let (ident, constants) = (rust_identifier(module.name), quote_constants(&module));
        let docs = doc_line(&format!("Shader `{}`.", module.name));
        modules.push(quote! {
            #[doc = #docs]
            #[allow(dead_code)]
            pub mod #ident {
                use straightline_runtime::wgpu;

                #constants

                #constant
            }
        });
    }
    let names = emitted.shaders.keys();
    let entries = names.map(|shader| {
        let ident = rust_identifier(shader);
        quote! { (#shader, &shaders::#ident::SHADER) }
    });
    let (plan, json) = (quote_plan(&emitted.plan), format!("{}.chain.json", emitted.plan.chain));
    Ok(quote! {
        #(#[doc = #docs])*
        #[allow(non_snake_case)]
        pub mod #name {
            /// Shaders of the passes, each with its text, manifest and layout.
            pub mod shaders {
                #(#modules)*
            }

            /// Passes and pictures of the chain as JSON, for other programs.
            #[allow(dead_code)]
            pub const PLAN: &str = include_str!(#json);

            /// The chain with its shaders: creating it parses nothing.
            pub static CHAIN: straightline_runtime::ChainShaders = {
                #[allow(unused_imports)]
                use straightline_runtime::plan::{
                    Borrowed, CHAIN_SCHEMA, ChainPlan, Format, PassPlan, PicturePlan, ReadPlan, SizeOp, SizeRule, SizeTerm,
                };

                straightline_runtime::ChainShaders::generated(#plan, &[#(#entries),*])
            };
        }
    })
}

fn quote_plan(plan: &ChainPlan) -> TokenStream {
    let ChainPlan {
        schema: _,
        chain,
        inputs,
        pictures,
        passes,
    } = plan;
    let text = |text: &str| quote! { Borrowed(#text) };
    let chain = text(chain);
    let inputs = inputs.iter().map(|input| text(input));
    let pictures = pictures.iter().map(|picture| {
        let (name, size, format) = (
            text(&picture.name),
            quote_rule(&picture.size),
            variant_name(&picture.format),
        );
        let memory = quote_option(picture.memory.map(|memory| {
            let memory = Literal::u32_unsuffixed(memory);
            quote! { #memory }
        }));
        quote! { PicturePlan { name: #name, size: #size, format: Format::#format, memory: #memory } }
    });
    let passes = passes.iter().map(|pass| {
        let (name, shader) = (text(&pass.name), text(&pass.shader));
        let reads = pass.reads.iter().map(|read| {
            let (name, from) = (text(&read.name), text(&read.from));
            quote! { ReadPlan { name: #name, from: #from } }
        });
        let writes = pass.writes.iter().map(|picture| text(picture));
        quote! {
            PassPlan {
                name: #name,
                shader: #shader,
                reads: Borrowed(&[#(#reads),*]),
                writes: Borrowed(&[#(#writes),*]),
            }
        }
    });
    quote! {
        ChainPlan {
            schema: CHAIN_SCHEMA,
            chain: #chain,
            inputs: Borrowed(&[#(#inputs),*]),
            pictures: Borrowed(&[#(#pictures),*]),
            passes: Borrowed(&[#(#passes),*]),
        }
    }
}

fn quote_rule(rule: &SizeRule) -> TokenStream {
    let terms = rule.0.iter().map(|term| match term {
        SizeTerm::Of(name) => quote! { SizeTerm::Of(Borrowed(#name)) },
        SizeTerm::Number(size) => {
            let [x, y] = size.map(Literal::u32_unsuffixed);
            quote! { SizeTerm::Number([#x, #y]) }
        }
        SizeTerm::Apply(op) => {
            let op = variant_name(op);
            quote! { SizeTerm::Apply(SizeOp::#op) }
        }
    });
    quote! { SizeRule(Borrowed(&[#(#terms),*])) }
}
