//! Needs and offers of an emitted shader, as data.
//!
//! The generator writes one manifest beside each shader; the runtime, or any other engine, reads it to
//! bind the shader without looking inside. Fields are plain data and serialise to JSON: the feature `json`.
//!
//! Without that feature there is the [`plan`] of a shader alone, which the Rust of a `build.rs` has as constants.

#[cfg(feature = "json")]
mod binding;
pub mod chain;
#[cfg(feature = "json")]
mod form;
mod format;
mod hash;
#[cfg(feature = "json")]
mod manifest;
#[cfg(feature = "json")]
mod output;
mod override_value;
pub mod plan;
#[cfg(feature = "json")]
mod precision;
#[cfg(feature = "json")]
mod source_map;
#[cfg(feature = "json")]
mod tuned;
mod value;
mod words;

#[cfg(feature = "json")]
pub use binding::{Binding, BindingKind, Immediates, LanguageBinding, LanguageKind, Part, UniformField, region_fields};
#[cfg(feature = "json")]
pub use form::{Form, Origin};
pub use format::{Component, Format};
pub use hash::{hash_of_bytes, hash_of_text, text_hash};
#[cfg(feature = "json")]
pub use manifest::{Counts, Error, Manifest, SCHEMA, Varying};
#[cfg(feature = "json")]
pub use output::Output;
#[cfg(feature = "json")]
pub use override_value::Override;
pub use override_value::OverrideType;
#[cfg(feature = "json")]
pub use precision::Precision;
#[cfg(feature = "json")]
pub use source_map::{MappedStatement, SOURCE_MAP_SCHEMA, SourceMap};
#[cfg(feature = "json")]
pub use tuned::{LeftOut, Tuned};
pub use value::{Element, NotAType, Scalar, ValueType};
pub use words::{
    Access, BufferType, Dimension, Extent, REGION, REGION_SIZE, SampleType, SamplerType, Stage, ViewDimension,
};
