//! Resources that the caller binds to inputs.

use crate::plan::InputKind;
use std::fmt;
use wgpu::{Buffer, Sampler, TextureView};

/// A resource given for one input of a [`Pass`](crate::Pass). Made by `From` of a reference to each.
///
/// ```no_run
/// # use straightline_runtime::{Resource, wgpu};
/// # fn inputs(color: &wgpu::TextureView, linear: &wgpu::Sampler) {
/// let inputs = [("color", Resource::from(color)), ("linear", linear.into())];
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Resource<'a> {
    /// A view of a texture.
    Texture(&'a TextureView),
    /// A sampler.
    Sampler(&'a Sampler),
    /// A storage buffer, of which all is bound.
    Buffer(&'a Buffer),
}

impl<'a> Resource<'a> {
    /// Returns the kind of the resource.
    pub fn kind(&self) -> ResourceKind {
        match self {
            Resource::Texture(_) => ResourceKind::Texture,
            Resource::Sampler(_) => ResourceKind::Sampler,
            Resource::Buffer(_) => ResourceKind::Buffer,
        }
    }

    /// The resource as wgpu binds it.
    pub(crate) fn as_binding(self) -> wgpu::BindingResource<'a> {
        match self {
            Resource::Texture(view) => wgpu::BindingResource::TextureView(view),
            Resource::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
            Resource::Buffer(buffer) => buffer.as_entire_binding(),
        }
    }
}

impl<'a> From<&'a TextureView> for Resource<'a> {
    fn from(view: &'a TextureView) -> Self {
        Resource::Texture(view)
    }
}

impl<'a> From<&'a Sampler> for Resource<'a> {
    fn from(sampler: &'a Sampler) -> Self {
        Resource::Sampler(sampler)
    }
}

impl<'a> From<&'a Buffer> for Resource<'a> {
    fn from(buffer: &'a Buffer) -> Self {
        Resource::Buffer(buffer)
    }
}

/// The kind of a [`Resource`], for messages: `a texture`, `a sampler` or `a storage buffer`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ResourceKind {
    /// A view of a texture.
    Texture,
    /// A sampler.
    Sampler,
    /// A storage buffer.
    Buffer,
}

impl ResourceKind {
    /// The kind that an input must be.
    pub(crate) fn of_input(input: InputKind) -> Self {
        match input {
            InputKind::Texture(_) => ResourceKind::Texture,
            InputKind::Sampler(_) => ResourceKind::Sampler,
            InputKind::Buffer(_) => ResourceKind::Buffer,
        }
    }

    /// The wgpu type of such a resource.
    pub(crate) fn type_name(self) -> &'static str {
        match self {
            ResourceKind::Texture => "TextureView",
            ResourceKind::Sampler => "Sampler",
            ResourceKind::Buffer => "Buffer",
        }
    }
}

impl fmt::Display for ResourceKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ResourceKind::Texture => "a texture",
            ResourceKind::Sampler => "a sampler",
            ResourceKind::Buffer => "a storage buffer",
        })
    }
}
