//! Runs emitted shaders in the caller's own [`wgpu::Device`] and encoder.
//!
//! A [`Pass`] is made once, from a [`Shader`]: the constant that the generator wrote in a build script, see [`include_shaders`], or a
//! text and a manifest that travelled (the feature `manifest`). Binding it takes texture
//! views, samplers and buffers by name, and a target, and checks them; the [`Bound`] that it gives is recorded every frame, which cannot
//! fail and costs what a hand-written wgpu pass does. A [`Draw`] is the same for triangles of the caller's. Nothing here creates a device, submits, or owns a texture, but for
//! [`Quads::detect`], which asks a device what its pixel quads can do, and [`Choices::choose`], which times shaders that compute
//! the same.
//!
//! ```no_run
//! use straightline_runtime::{Bound, Error, Pass, PassOptions, Shader, wgpu};
//!
//! struct Antialiasing {
//!     pass: Pass,
//!     bound: Bound,
//! }
//!
//! impl Antialiasing {
//!     // Usually `shaders::sraa::SHADER`; generated code is a thin layer on what is written out here.
//!     fn new(
//!         device: &wgpu::Device,
//!         shader: &Shader<'_>,
//!         [color, depth, normal]: [&wgpu::TextureView; 3],
//!         target: &wgpu::TextureView,
//!     ) -> Result<Self, Error> {
//!         let pass = Pass::from_shader(device, shader, &PassOptions::default())?;
//!         // Once more whenever one of these is replaced.
//!         let bound = pass.bind(&[("color", color), ("depth", depth), ("normal", normal)], target)?;
//!         Ok(Antialiasing { pass, bound })
//!     }
//!
//!     fn frame(&self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
//!         self.bound.write_uniform(queue, "tau", 300.0)?;
//!         self.bound.encode(encoder);
//!         Ok(())
//!     }
//! }
//! ```
//!
//! Every failure is an [`Error`] that names what is at fault and what to do: a wrong view, a shader that is not
//! its manifest's, a lost device. Errors that wgpu raises meanwhile are caught in error scopes and do not reach the
//! device's own handler; the device's callbacks are left alone. Scopes belong to the thread that makes a pass, so several threads may
//! make passes at once ([`Pending`]).
//!
//! # Features
//!
//! - `manifest`: reads manifests, and compares texts with them by naga: `Shader::from_json`, `Pass::from_json`. Without it the crate
//!   has no naga, serde or serde_json of its own, and nothing but the WGSL is parsed, by wgpu.
//!
//! - `reload`: generates kernels again while the program runs, when their files change: `Reloading`. It brings the generator, and is
//!   for development.
//!
//! # What an emitted shader looks like
//!
//! - Compute: one invocation a pixel, in workgroups that tile the target; an invocation outside of it returns. The
//!   result goes to a write-only storage texture.
//! - Fragment: the module holds the fragment entry point only, with the result at location 0. This crate brings the
//!   vertex shader of a triangle that covers the target; a [`Draw`] has the caller's, which gives what the kernel has interpolated.
//! - Textures are `texture_2d<f32>`, `texture_2d_array<f32>`, `texture_multisampled_2d<f32>` or `texture_depth_2d`, of
//!   the target's size unless the manifest says that any will do. They are read texel by texel, or through a
//!   `sampler` or `sampler_comparison`.
//! - Buffers are `var<storage, read>` arrays of a scalar or vector.
//! - Values set at run time are members of a uniform struct.
//! - Options set when the pipeline is created are `override` declarations, each with an `@id`.
//! - A shader for regions has one more, which says what rectangle of the inputs goes where in the target.

mod bind;
mod bound;
mod cache;
mod chain;
mod choice;
mod draw;
mod error;
mod guard;
mod inputs;
mod layout;
mod module;
mod options;
mod overrides;
mod pass;
mod passes;
mod pending;
mod pipeline;
#[doc(hidden)]
pub mod plan;
mod quads;
mod region;
#[cfg(feature = "reload")]
mod reload;
mod resource;
mod shader;
#[cfg(feature = "manifest")]
mod source;
mod targets;
mod timer;
#[cfg(feature = "manifest")]
mod travelling;
mod uniforms;

pub use bound::Bound;
pub use cache::{CacheOrigin, PipelineCacheFile};
pub use chain::{BoundChain, Chain, ChainShaders};
pub use choice::{Candidate, Choice, Choices, Chosen, Reason};
pub use draw::{BoundDraw, Draw, DrawOptions, VertexShader};
pub use error::{BufferProblem, ChainProblem, Error, Names, SamplerProblem, ViewProblem};
pub use options::{BindOptions, PassOptions};
pub use overrides::OverrideValue;
pub use pass::Pass;
pub use passes::Passes;
pub use pending::Pending;
pub use quads::{Arrivals, DerivativeControl, DerivativeKind, QuadTransport, Quads};
pub use region::Region;
#[cfg(feature = "reload")]
pub use reload::Reloading;
pub use resource::{Resource, ResourceKind};
pub use shader::Shader;
#[cfg(feature = "reload")]
pub use straightline_codegen::{self as codegen, KernelConfig};
pub use straightline_manifest as manifest;
pub use targets::Targets;
pub use timer::{Span, Timer};
pub use uniforms::{Component, UniformValue};

/// The wgpu that this crate was built with, so that callers and generated code use the same one.
pub use wgpu;

/// Includes the modules that `straightline_codegen::Config::compile` wrote in this crate's `build.rs`: one for each
/// shader, with its `Pass` and `Inputs`.
#[macro_export]
macro_rules! include_shaders {
    () => {
        include!(concat!(env!("OUT_DIR"), "/straightline.rs"));
    };
}
