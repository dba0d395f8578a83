//! The module of a set of shaders: an enum for each option that varies, and a shader for each combination.

use super::{Module, doc_line, rust_identifier};
use crate::emit::prose::single_line_comment;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use straightline_manifest::Form;

/// Input of the module of a set of shaders.
pub struct VariantsModule<'a> {
    /// Name of the module.
    pub name: &'a str,
    /// Options that vary; the last one varies fastest.
    pub axes: &'a [Axis],
    /// Shaders that differ.
    pub shaders: Vec<Module<'a>>,
    /// Position of the shader of each combination.
    pub shader_of: Vec<usize>,
}

/// An option that varies, as a type of Rust.
pub struct Axis {
    option: String,
    field: Ident,
    ty: Ident,
    /// Values as the generator spells them, and as constants of Rust.
    values: Vec<(String, TokenStream)>,
    /// Variants of the enum; `None` for `bool`.
    variants: Option<Vec<Ident>>,
}

/// Names of types that the module has besides the enums.
const TAKEN: [&str; 4] = ["Passes", "Result", "Self", "Variant"];

impl Axis {
    /// Describes an option with its values.
    pub fn new(option: &str, values: &[String]) -> Axis {
        let field = rust_identifier(&value_words(option).join("_"));
        if values.len() == 2
            && ["false", "true"]
                .iter()
                .all(|both| values.iter().any(|value| value == both))
        {
            return Axis {
                option: option.to_owned(),
                field,
                ty: format_ident!("bool"),
                values: values.iter().map(|value| (value.clone(), constant(value))).collect(),
                variants: None,
            };
        }
        let ty = type_name(option, &mut TAKEN.map(str::to_owned).to_vec());
        let mut taken = vec!["Self".to_owned()];
        let variants: Vec<Ident> = values.iter().map(|value| type_name(value, &mut taken)).collect();
        let constants = variants.iter().map(|variant| quote! { #ty::#variant });
        Axis {
            option: option.to_owned(),
            field,
            values: values.iter().cloned().zip(constants).collect(),
            ty,
            variants: Some(variants),
        }
    }

    /// Returns the enum of the values.
    fn quote_type(&self) -> TokenStream {
        let Some(variants) = &self.variants else {
            return TokenStream::new();
        };
        let ty = &self.ty;
        let docs = doc_line(&format!("Values of the option `{}`.", self.option));
        let names = self.values.iter().map(|(name, _)| name);
        let value_docs = self.values.iter().map(|(name, _)| doc_line(&format!("`{name}`.")));
        let count = Literal::usize_unsuffixed(variants.len());
        quote! {
            #[doc = #docs]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum #ty {
                #(#[doc = #value_docs] #variants,)*
            }

            impl #ty {
                /// All values.
                pub const ALL: [#ty; #count] = [#(#ty::#variants),*];

                /// Value as the generator spells it.
                #[must_use]
                pub const fn name(self) -> &'static str {
                    match self {
                        #(#ty::#variants => #names,)*
                    }
                }
            }
        }
    }
}

fn constant(text: &str) -> TokenStream {
    text.parse().expect("a word")
}

/// Words of an option's name or value, in lower case, for names in Rust: `-0.5` is `minus`, `0`, `5`.
pub fn value_words(value: &str) -> Vec<String> {
    let marked = value.replace(
        '-',
        if value.starts_with(char::is_alphabetic) {
            " "
        } else {
            " minus "
        },
    );
    let words = marked.split(|c: char| !c.is_ascii_alphanumeric());
    words.filter(|word| !word.is_empty()).map(str::to_lowercase).collect()
}

/// Name of an enum or of its variant that is not taken yet: `depth-normals` is `DepthNormals`, `0.5` is `V0_5`.
fn type_name(value: &str, taken: &mut Vec<String>) -> Ident {
    let mut name = String::new();
    for word in value_words(value) {
        let is_digit = |c: char| c.is_ascii_digit();
        if word.starts_with(is_digit) && name.is_empty() {
            name.push('V');
        } else if word.starts_with(is_digit) && name.ends_with(is_digit) {
            name.push('_');
        }
        let (first, rest) = word.split_at(1);
        name.extend([&first.to_uppercase(), rest]);
    }
    if name.is_empty() {
        name.push_str("Empty");
    }
    while taken.contains(&name) {
        name.push_str("Value");
    }
    taken.push(name.clone());
    format_ident!("{name}")
}

/// Returns the module of a set, with the modules of its shaders in it.
pub fn quote_variants(set: &VariantsModule<'_>, modules: &[TokenStream]) -> TokenStream {
    let name = rust_identifier(set.name);
    let types = set.axes.iter().map(Axis::quote_type);
    let variant = quote_variant(set);
    let has_passes = set
        .shaders
        .iter()
        .all(|module| module.manifest.form != Form::Function && module.manifest.varyings.is_empty());
    let passes = has_passes.then(quote_passes);
    let summary = set
        .shaders
        .first()
        .map_or("", |module| module.compiled.summary.trim_end_matches('.'));
    let (combinations, shaders) = (set.shader_of.len(), set.shaders.len());
    let docs = [
        doc_line(&format!("{}.", single_line_comment(summary))),
        String::new(),
        doc_line(&format!("{combinations} combinations of options, {shaders} shaders.")),
    ];
    quote! {
        #(#[doc = #docs])*
        // A caller uses only the parts that it needs.
        #[allow(dead_code, clippy::enum_variant_names)]
        pub mod #name {
            #(#types)*

            #variant

            #passes

            #(#modules)*
        }
    }
}

/// Returns the structure `Variant`.
fn quote_variant(set: &VariantsModule<'_>) -> TokenStream {
    let fields: Vec<&Ident> = set.axes.iter().map(|axis| &axis.field).collect();
    let types = set.axes.iter().map(|axis| &axis.ty);
    let docs = set
        .axes
        .iter()
        .map(|axis| doc_line(&format!("Option `{}`.", axis.option)));
    let combinations: Vec<TokenStream> = combinations(set.axes)
        .map(|values| quote! { Variant { #(#fields: #values),* } })
        .collect();
    let count = Literal::usize_unsuffixed(combinations.len());
    // Each shader with the combinations that have it.
    let arms = |of: &dyn Fn(&Module<'_>) -> TokenStream| {
        let arms = set.shaders.iter().enumerate().map(|(k, module)| {
            let own = set.shader_of.iter().zip(&combinations).filter(|(at, _)| **at == k);
            let (own, value) = (own.map(|(_, combination)| combination), of(module));
            quote! { #(#own)|* => #value, }
        });
        quote! { match self { #(#arms)* } }
    };
    let texts = arms(&|module| {
        let module = rust_identifier(module.name);
        quote! { #module::WGSL }
    });
    let is_function = set.shaders.iter().any(|module| module.manifest.form == Form::Function);
    let shader = (!is_function).then(|| {
        let shaders = arms(&|module| {
            let module = rust_identifier(module.name);
            quote! { &#module::SHADER }
        });
        quote! {
            /// Shader with its bindings. Combinations with the same text have the same one.
            #[must_use]
            pub fn shader(self) -> &'static straightline_runtime::Shader<'static> {
                #shaders
            }
        }
    });
    quote! {
        /// A combination of options.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct Variant {
            #(#[doc = #docs] pub #fields: #types,)*
        }

        impl Variant {
            /// All combinations.
            pub const ALL: [Variant; #count] = [#(#combinations),*];

            /// Text of the shader.
            #[must_use]
            pub const fn wgsl(self) -> &'static str {
                #texts
            }

            #shader
        }
    }
}

/// Values of every combination as constants, the last option fastest.
fn combinations(axes: &[Axis]) -> impl Iterator<Item = Vec<&TokenStream>> {
    let count = axes.iter().map(|axis| axis.values.len()).product::<usize>();
    (0..count).map(move |mut at| {
        let mut values = Vec::new();
        for axis in axes.iter().rev() {
            values.push(&axis.values[at % axis.values.len()].1);
            at /= axis.values.len();
        }
        values.reverse();
        values
    })
}

/// Returns the structure `Passes`.
fn quote_passes() -> TokenStream {
    quote! {
        /// Passes of the variants, each made when it is first asked for.
        #[derive(Debug)]
        pub struct Passes(straightline_runtime::Passes);

        impl Passes {
            /// No pass yet, for `device`.
            #[must_use]
            pub fn new(device: &straightline_runtime::wgpu::Device) -> Self {
                Self::with_options(device, straightline_runtime::PassOptions::default())
            }

            /// No pass yet; each will be made with `options`.
            #[must_use]
            pub fn with_options(
                device: &straightline_runtime::wgpu::Device,
                options: straightline_runtime::PassOptions,
            ) -> Self {
                Passes(straightline_runtime::Passes::new(device, options))
            }

            /// Pass of a variant. The first call compiles the shader.
            ///
            /// # Errors
            ///
            /// If the device cannot run it or is lost.
            pub fn get(&mut self, variant: Variant) -> Result<&straightline_runtime::Pass, straightline_runtime::Error> {
                self.0.get(variant.shader())
            }
        }
    }
}
