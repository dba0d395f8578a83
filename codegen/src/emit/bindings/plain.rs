//! Rust that binds a shader by wgpu alone, of any version that has these names.

use super::inputs::Input;
use super::shader::variant_name;
use super::{
    Module, doc_line, group_number, module_docs, overrides, parameters, pass, quote_constants, rust_identifier,
};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use straightline_manifest::{Binding, BindingKind, Form, Manifest, Output};

/// Returns the module of a shader. It names the crate `wgpu`, and nothing else outside of the standard library.
pub fn quote_plain(module: &Module<'_>) -> TokenStream {
    let manifest = module.manifest;
    let name = rust_identifier(module.name);
    let docs = module_docs(module);
    let docs = docs.iter().map(|line| doc_line(line));
    let constants = quote_constants(module);
    let rest = (manifest.form == Form::Entry).then(|| {
        let (structure, _) = parameters::quote_parameters(manifest);
        let elements = parameters::quote_elements(manifest);
        let overrides = overrides::quote_overrides(manifest);
        let pairs = overrides::quote_pairs(manifest);
        let varyings = pass::quote_varyings(manifest);
        let (targets, resources, workgroups) = (
            quote_targets(manifest),
            quote_resources(manifest),
            quote_workgroups(manifest),
        );
        let size = manifest.immediates.as_ref().map(|immediates| {
            let size = Literal::u32_unsuffixed(immediates.size);
            quote! {
                /// Bytes of immediates, for the layout of a pipeline: those of [`Parameters`].
                pub const IMMEDIATE_SIZE: u32 = #size;
            }
        });
        quote! { #targets #size #varyings #resources #structure #elements #overrides #pairs #workgroups }
    });
    quote! {
        #(#[doc = #docs])*
        // A caller uses only the parts that it needs.
        #[allow(dead_code, non_camel_case_types, non_snake_case)]
        pub mod #name {
            #constants

            #rest
        }
    }
}

/// Returns the formats of the outputs.
fn quote_targets(manifest: &Manifest) -> TokenStream {
    let count = Literal::usize_unsuffixed(manifest.outputs.len());
    let formats = manifest.outputs.iter().map(|output| variant_name(&output.format));
    quote! {
        /// Formats of the targets, in the order of the kernel's fields. A fragment shader may draw to others.
        pub const TARGETS: [wgpu::TextureFormat; #count] = [#(wgpu::TextureFormat::#formats),*];
    }
}

/// A field of `Resources`.
struct Field {
    name: Ident,
    docs: String,
    ty: Ident,
    number: u32,
}

impl Field {
    fn from_binding(binding: &Binding, manifest: &Manifest) -> Field {
        let (docs, ty) = match Input::from_binding(binding, manifest) {
            Some(input) => {
                let usage = match &binding.kind {
                    BindingKind::Texture { .. } => " Its usage includes `TEXTURE_BINDING`.",
                    BindingKind::Buffer { .. } => " Its usage includes `STORAGE`.",
                    _ => "",
                };
                (input.docs + usage, input.ty)
            }
            None => {
                let holds = match binding.is_region() {
                    true => {
                        "the upper left pixel in the inputs, the size, and the upper left pixel in the target, as `i32`"
                    }
                    false => "[`Parameters`]",
                };
                (
                    format!("A buffer that holds {holds}. Its usage includes `UNIFORM`."),
                    format_ident!("Buffer"),
                )
            }
        };
        Field {
            name: rust_identifier(&binding.name),
            docs,
            ty,
            number: binding.binding,
        }
    }

    /// Returns the field of a storage texture, under a name that no earlier field has.
    fn from_output(output: &Output, number: u32, earlier: &[Field]) -> Field {
        let mut name = output.name.clone();
        while earlier.iter().any(|field| field.name == rust_identifier(&name)) {
            name.insert_str(0, "output_");
        }
        Field {
            name: rust_identifier(&name),
            docs: format!(
                "The target of `{}`, of the format `{}`. Its usage includes `STORAGE_BINDING`.",
                output.name, output.format
            ),
            ty: format_ident!("TextureView"),
            number,
        }
    }
}

/// Returns the structure of everything in the bind group.
fn quote_resources(manifest: &Manifest) -> TokenStream {
    let bindings = manifest.bindings.iter();
    let mut fields: Vec<Field> = bindings.map(|binding| Field::from_binding(binding, manifest)).collect();
    for output in &manifest.outputs {
        if let Some(number) = output.binding {
            fields.push(Field::from_output(output, number, &fields));
        }
    }
    if fields.is_empty() {
        return TokenStream::new();
    }
    let docs = fields.iter().map(|field| doc_line(&field.docs));
    let (names, types): (Vec<_>, Vec<_>) = fields.iter().map(|field| (&field.name, &field.ty)).unzip();
    let entries = fields.iter().map(|field| {
        let (name, number) = (&field.name, Literal::u32_unsuffixed(field.number));
        let resource = match field.ty.to_string().as_str() {
            "TextureView" => quote! { wgpu::BindingResource::TextureView(self.#name) },
            "Sampler" => quote! { wgpu::BindingResource::Sampler(self.#name) },
            _ => quote! { self.#name.as_entire_binding() },
        };
        quote! { wgpu::BindGroupEntry { binding: #number, resource: #resource } }
    });
    let count = Literal::usize_unsuffixed(fields.len());
    let group = Literal::u32_unsuffixed(group_number(manifest));
    quote! {
        /// Number of the bind group.
        pub const BIND_GROUP: u32 = #group;

        /// Resources of the bind group.
        #[derive(Clone, Copy, Debug)]
        pub struct Resources<'a> {
            #(#[doc = #docs] pub #names: &'a wgpu::#types,)*
        }

        impl<'a> Resources<'a> {
            /// Returns the entries of a bind group with [`BIND_GROUP_LAYOUT`].
            #[must_use]
            pub fn entries(&self) -> [wgpu::BindGroupEntry<'a>; #count] {
                [#(#entries),*]
            }
        }
    }
}

/// Returns the function that computes a dispatch; nothing for a fragment shader.
fn quote_workgroups(manifest: &Manifest) -> TokenStream {
    let Some([width, height, _]) = manifest.workgroup_size else {
        return TokenStream::new();
    };
    let tiles: Option<Vec<[u32; 2]>> = manifest.outputs.iter().map(|output| output.tile).collect();
    let own = [width * manifest.block[0], height * manifest.block[1]];
    let tiles = tiles.filter(|tiles| !tiles.is_empty()).unwrap_or(vec![own]);
    let count = Literal::usize_unsuffixed(tiles.len());
    let sides = tiles.iter().map(|sides| {
        let [across, down] = sides.map(Literal::u32_unsuffixed);
        quote! { [#across, #down] }
    });
    let (about, ty, sizes) = match tiles.len() {
        1 => (
            "that compute a target of `size` pixels",
            quote! { [u32; 2] },
            quote! { [size] },
        ),
        _ => (
            "that compute targets of these sizes, in the order of [`TARGETS`]",
            quote! { [[u32; 2]; #count] },
            quote! { size },
        ),
    };
    let docs = doc_line(&format!("Returns the workgroups {about}."));
    quote! {
        #[doc = #docs]
        #[must_use]
        pub fn workgroups(size: #ty) -> [u32; 3] {
            const TILES: [[u32; 2]; #count] = [#(#sides),*];
            let mut most = [1; 3];
            for ([across, down], [width, height]) in TILES.into_iter().zip(#sizes) {
                most[0] = width.div_ceil(across).max(most[0]);
                most[1] = height.div_ceil(down).max(most[1]);
            }
            most
        }
    }
}
