//! Options of a [`Draw`](crate::Draw): the caller's vertex shader and the state of the render pipeline.

use crate::PassOptions;
use wgpu::{
    BindGroupLayout, BlendState, DepthStencilState, MultisampleState, PrimitiveState, ShaderModule, VertexBufferLayout,
};

/// A vertex shader: its text, which is checked against the kernel's varyings by name, or a module that wgpu alone checks.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum VertexShader<'a> {
    /// WGSL with an entry point of stage vertex; other entry points may be there too.
    Wgsl {
        /// The text.
        text: &'a str,
        /// Name of the function.
        entry_point: &'a str,
    },
    /// An existing module. In a browser, only the device's error handler learns of a mismatch.
    Module {
        /// The module.
        module: &'a ShaderModule,
        /// Name of the function.
        entry_point: &'a str,
    },
}

impl<'a> VertexShader<'a> {
    pub(super) fn entry_point(&self) -> &'a str {
        match self {
            VertexShader::Wgsl { entry_point, .. } | VertexShader::Module { entry_point, .. } => entry_point,
        }
    }
}

/// The caller's part of a pipeline: its vertex shader, and states that are wgpu's defaults unless they are given.
#[derive(Clone, Debug)]
pub struct DrawOptions<'a> {
    pub(super) vertex: VertexShader<'a>,
    pub(super) buffers: Vec<Option<VertexBufferLayout<'a>>>,
    pub(super) groups: Vec<(u32, &'a BindGroupLayout)>,
    pub(super) primitive: PrimitiveState,
    pub(super) depth_stencil: Option<DepthStencilState>,
    pub(super) multisample: MultisampleState,
    pub(super) blend: Option<BlendState>,
    pub(super) pass: PassOptions,
}

impl<'a> DrawOptions<'a> {
    /// Creates options with the function `entry_point` of the WGSL `text` as vertex shader.
    pub fn new(text: &'a str, entry_point: &'a str) -> Self {
        Self::behind(VertexShader::Wgsl { text, entry_point })
    }

    /// Creates options with any vertex shader.
    pub fn behind(vertex: VertexShader<'a>) -> Self {
        DrawOptions {
            vertex,
            buffers: Vec::new(),
            groups: Vec::new(),
            primitive: PrimitiveState::default(),
            depth_stencil: None,
            multisample: MultisampleState::default(),
            blend: None,
            pass: PassOptions::default(),
        }
    }

    /// Layouts of the vertex buffers, in the order of their slots.
    pub fn buffers(mut self, buffers: &[Option<VertexBufferLayout<'a>>]) -> Self {
        self.buffers = buffers.to_vec();
        self
    }

    /// A bind group that the vertex shader reads, which the caller sets itself. The kernel's own is group 0, unless it was
    /// generated with another number (`--group`).
    pub fn group(mut self, index: u32, layout: &'a BindGroupLayout) -> Self {
        self.groups.push((index, layout));
        self
    }

    /// Sets the primitive topology and which side is culled.
    pub fn primitive(mut self, primitive: PrimitiveState) -> Self {
        self.primitive = primitive;
        self
    }

    /// The depth and stencil tests, for a render pass with such an attachment.
    pub fn depth_stencil(mut self, state: DepthStencilState) -> Self {
        self.depth_stencil = Some(state);
        self
    }

    /// Sets the multisampling of the render pass. The kernel still runs once a pixel.
    pub fn multisample(mut self, state: MultisampleState) -> Self {
        self.multisample = state;
        self
    }

    /// Sets the blending of each colour with the target, such as multiplication for light.
    pub fn blend(mut self, blend: BlendState) -> Self {
        self.blend = Some(blend);
        self
    }

    /// Formats of the targets, values of overrides, and whether loops go without wgpu's bound.
    pub fn pass(mut self, options: PassOptions) -> Self {
        self.pass = options;
        self
    }
}
