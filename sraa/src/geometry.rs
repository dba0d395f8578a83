//! Passes in which a renderer draws its geometry.

use crate::Projection;
use crate::targets::Surface;
use straightline_runtime::wgpu;
use wgpu::TextureView;

/// A pass in which the renderer draws its geometry: depth, and what else the preset compares.
///
/// Its colour targets are, in this order and each only with options that have it:
///
/// 1. The unit normal in the camera's space.
/// 2. The guide: an estimate of the colour, in linear light. Good is albedo times the sun's light and a constant of ambient light.
///
/// Their alpha is not read.
#[derive(Clone, Copy, Debug)]
pub struct GeometryPass<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) projection: &'a Projection,
    pub(crate) size: [u32; 2],
    /// Sample that the pass draws, from the pixel's centre, in pixels, y down. (0, 0) if it draws all samples at once.
    pub offset: [f32; 2],
    /// Samples of the targets, for the pipelines that draw into them.
    pub sample_count: u32,
}

impl<'a> GeometryPass<'a> {
    /// Projection matrix for this pass: that of the camera, moved so that pixels are sampled at [`offset`](Self::offset).
    pub fn matrix(&self) -> [[f32; 4]; 4] {
        self.projection.matrix_at(self.offset, self.size)
    }

    /// Depth target.
    pub fn depth(&self) -> &'a TextureView {
        &self.surface.depth
    }

    /// Target of the normals, if the preset compares them.
    pub fn normal(&self) -> Option<&'a TextureView> {
        self.surface.normal.as_ref()
    }

    /// Target of the guide, if the preset has one.
    pub fn guide(&self) -> Option<&'a TextureView> {
        self.surface.guide.as_ref()
    }

    /// Begins the pass with all targets cleared.
    pub fn begin(&self, encoder: &mut wgpu::CommandEncoder) -> wgpu::RenderPass<'static> {
        self.begin_with(encoder, &[], None)
    }

    /// Begins the pass with targets of the renderer's before those of the geometry, and with timestamps.
    pub fn begin_with(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        first: &[Option<wgpu::RenderPassColorAttachment<'_>>],
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'static> {
        let own = [self.normal(), self.guide()].into_iter().flatten();
        // A normal of length 0 says that there is no surface.
        let own = own.map(|view| Some(cleared(view, wgpu::Color::TRANSPARENT)));
        let all: Vec<_> = first.iter().cloned().chain(own).collect();
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("SRAA geometry"),
            color_attachments: &all,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: self.depth(),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(self.projection.clear_depth()),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            ..Default::default()
        });
        pass.forget_lifetime()
    }
}

/// A colour target that is cleared and kept.
pub(crate) fn cleared(view: &TextureView, color: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(color),
            store: wgpu::StoreOp::Store,
        },
    }
}
