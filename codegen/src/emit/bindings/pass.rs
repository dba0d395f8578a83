//! Generated methods that bind a shader and run it: as a pass over a picture, or to draw triangles.

use super::inputs::Input;
use super::{doc_line, rust_identifier};
use proc_macro2::{Literal, TokenStream};
use quote::quote;
use straightline_manifest::{Binding, Manifest};

/// Parameters for a pass's inputs and uniforms, and the code that forwards them.
pub struct Given {
    /// The parameter for the inputs.
    used: TokenStream,
    /// The parameter for runtime values, if there are any.
    parameters: TokenStream,
    /// The statement that pairs inputs with their names.
    pairs: TokenStream,
    /// Arguments other than inputs and target.
    options: TokenStream,
    /// Methods that set runtime values later.
    setters: TokenStream,
}

impl Given {
    /// Builds the parameters; `parameters` is the structure of runtime values, empty if there are none.
    pub fn from_inputs(inputs: &[Input], parameters: &TokenStream, setters: TokenStream) -> Given {
        let count = Literal::usize_unsuffixed(inputs.len());
        let pairs = inputs.iter().map(|input| {
            let (field, name) = (&input.name, &input.bound);
            quote! { (#name, Resource::from(inputs.#field)) }
        });
        let (parameters, options) = match parameters.is_empty() {
            true => (
                TokenStream::new(),
                quote! { straightline_runtime::BindOptions::default() },
            ),
            false => (
                quote! { parameters: &Parameters, },
                quote! { straightline_runtime::BindOptions::default().uniforms(&parameters.to_bytes()) },
            ),
        };
        Given {
            used: match inputs.is_empty() {
                true => quote! { _: &Inputs },
                false => quote! { inputs: &Inputs<'_> },
            },
            parameters,
            pairs: quote! { let inputs: [(&str, Resource<'_>); #count] = [#(#pairs),*]; },
            options,
            setters,
        }
    }
}

impl Given {
    /// Returns `Pass::choose`, for a shader with candidates.
    pub fn quote_choose(&self, targets: &Targets) -> TokenStream {
        let Given {
            used,
            parameters,
            pairs,
            options,
            ..
        } = self;
        let (target_ty, target) = (&targets.ty, &targets.given);
        quote! {
            impl Pass {
                /// Compiles the candidate that is fastest on this device: by `choices`, or else by timing all with these
                /// inputs and targets, which takes seconds and is remembered in `choices`.
                ///
                /// # Errors
                ///
                /// Errors of `bind`, and if the device can run none of them or is lost.
                pub fn choose(
                    device: (&wgpu::Device, &wgpu::Queue),
                    choices: &mut straightline_runtime::Choices,
                    pass_options: &straightline_runtime::PassOptions,
                    #used,
                    #parameters
                    #target_ty
                ) -> Result<Self, Error> {
                    #pairs
                    let bind = |pass: &straightline_runtime::Pass| pass.bind_with(&inputs, #target, &#options);
                    choices.choose(device, &CANDIDATES, pass_options, bind).map(|chosen| Self(chosen.pass))
                }
            }
        }
    }
}

/// Returns the bindings of a kernel that runs as a pass.
pub fn quote_pass(manifest: &Manifest, given: &Given, targets: &Targets) -> TokenStream {
    let Given {
        used,
        parameters,
        pairs,
        options,
        setters,
    } = given;
    let (target_ty, target) = (&targets.ty, &targets.given);
    let region = manifest.bindings.iter().any(Binding::is_region).then(|| {
        quote! {
            /// Binds the shader for a rectangle: from `region.first` of `inputs` to `region.place` of the target.
            ///
            /// # Errors
            ///
            /// Those of `bind`, and if the rectangle leaves the inputs or the target.
            pub fn bind_region(
                &self,
                #used,
                #parameters
                #target_ty
                region: straightline_runtime::Region,
            ) -> Result<Bound, Error> {
                #pairs
                self.0.bind_with(&inputs, #target, &#options.region(region)).map(Bound)
            }
        }
    });
    quote! {
        /// The shader on a device: create it once, and bind it to its inputs and outputs.
        #[derive(Debug)]
        pub struct Pass(straightline_runtime::Pass);

        impl Pass {
            /// Compiles the shader.
            ///
            /// # Errors
            ///
            /// If the device cannot run it or is lost.
            pub fn new(device: &wgpu::Device) -> Result<Self, Error> {
                Self::with_options(device, &straightline_runtime::PassOptions::default())
            }

            /// Compiles the shader with options, for example for a target of another format.
            ///
            /// # Errors
            ///
            /// Errors of `new`, and options that the shader does not have.
            pub fn with_options(device: &wgpu::Device, options: &straightline_runtime::PassOptions) -> Result<Self, Error> {
                straightline_runtime::Pass::from_shader(device, &SHADER, options).map(Self)
            }

            /// Binds the shader: from `inputs` to the target.
            ///
            /// # Errors
            ///
            /// If an input or the target does not fit, naming it.
            pub fn bind(
                &self,
                #used,
                #parameters
                #target_ty
            ) -> Result<Bound, Error> {
                #pairs
                self.0.bind_with(&inputs, #target, &#options).map(Bound)
            }

            #region

            /// The underlying pass, for queries about its bindings.
            #[must_use]
            pub fn inner(&self) -> &straightline_runtime::Pass {
                &self.0
            }
        }

        /// The shader with its inputs and outputs: encode it every frame.
        #[derive(Debug)]
        pub struct Bound(straightline_runtime::Bound);

        impl Bound {
            /// Records the shader.
            pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
                self.0.encode(encoder);
            }

            #setters

            /// The underlying binding, for timing.
            #[must_use]
            pub fn inner(&self) -> &straightline_runtime::Bound {
                &self.0
            }
        }
    }
}

/// Returns the constant of interpolated values; nothing if there are none.
pub fn quote_varyings(manifest: &Manifest) -> TokenStream {
    let members = manifest.varyings.iter();
    let members: String = members
        .map(|v| format!("@location({}) {}: {},\n", v.location, v.name, v.ty))
        .collect();
    let constant = quote! {
        /// Outputs that the vertex shader must have, as members of a structure in WGSL.
        pub const VARYINGS: &str = #members;
    };
    match members.is_empty() {
        true => TokenStream::new(),
        false => constant,
    }
}

/// Returns the bindings of a kernel with interpolated values, drawn after a vertex shader of the caller's.
pub fn quote_draw(manifest: &Manifest, given: &Given) -> TokenStream {
    let Given {
        used,
        parameters,
        pairs,
        options,
        setters,
    } = given;
    let varyings = quote_varyings(manifest);
    quote! {
        #varyings

        /// The shader on a device, after a vertex shader: create it once, and bind it to its inputs.
        #[derive(Debug)]
        pub struct Draw(straightline_runtime::Draw);

        impl Draw {
            /// Compiles the shader, and the vertex shader of `options`, which outputs [`VARYINGS`].
            ///
            /// # Errors
            ///
            /// If they do not fit together, the device cannot run them or is lost.
            pub fn new(device: &wgpu::Device, options: &straightline_runtime::DrawOptions<'_>) -> Result<Self, Error> {
                straightline_runtime::Draw::from_shader(device, &SHADER, options).map(Self)
            }

            /// Binds the shader to its inputs.
            ///
            /// # Errors
            ///
            /// If an input does not fit, naming it.
            pub fn bind(&self, #used, #parameters) -> Result<BoundDraw, Error> {
                #pairs
                self.0.bind_with(&inputs, &#options).map(BoundDraw)
            }

            /// The underlying draw, for queries about its bindings.
            #[must_use]
            pub fn inner(&self) -> &straightline_runtime::Draw {
                &self.0
            }
        }

        /// The shader with its inputs: set it in a render pass, and draw triangles.
        #[derive(Debug)]
        pub struct BoundDraw(straightline_runtime::BoundDraw);

        impl BoundDraw {
            /// Sets the pipeline and the shader's bind group; vertices and draw calls are the caller's.
            pub fn set(&self, pass: &mut wgpu::RenderPass<'_>) {
                self.0.set(pass);
            }

            #setters

            /// The underlying binding.
            #[must_use]
            pub fn inner(&self) -> &straightline_runtime::BoundDraw {
                &self.0
            }
        }
    }
}

/// Parameters for a pass's outputs, and the code that forwards them.
pub struct Targets {
    /// The parameter with its trailing comma; empty for a kernel that writes only to buffers.
    ty: TokenStream,
    /// Argument that passes the targets on.
    given: TokenStream,
    /// The structure of several targets.
    pub structure: TokenStream,
}

impl Targets {
    pub fn from_manifest(manifest: &Manifest) -> Targets {
        if manifest.outputs.len() == 1 {
            return Targets {
                ty: quote! { target: &wgpu::TextureView, },
                given: quote! { target },
                structure: TokenStream::new(),
            };
        }
        if manifest.outputs.is_empty() {
            return Targets {
                ty: TokenStream::new(),
                given: quote! { &[] as &[(&str, &wgpu::TextureView)] },
                structure: TokenStream::new(),
            };
        }
        let names: Vec<&str> = manifest.outputs.iter().map(|o| o.name.as_str()).collect();
        let fields: Vec<_> = names.iter().map(|name| rust_identifier(name)).collect();
        let docs = manifest.outputs.iter().map(|output| {
            let at = output.location.map_or(String::new(), |k| format!(" at location {k}"));
            doc_line(&format!(
                "The target of `{}`{at}, generated for `{}`.",
                output.name, output.format
            ))
        });
        Targets {
            ty: quote! { targets: &Targets<'_>, },
            given: quote! { &[#((#names, targets.#fields)),*] },
            structure: quote! {
                /// Targets of the shader: textures of one size.
                #[derive(Clone, Copy, Debug)]
                pub struct Targets<'a> {
                    #(#[doc = #docs] pub #fields: &'a wgpu::TextureView,)*
                }
            },
        }
    }
}
