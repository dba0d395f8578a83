//! Textures of the renderer's own: what SRAA has no use for.

use crate::Size;
use straightline_sraa::{COLOR, wgpu};
use wgpu::{TextureFormat, TextureUsages};

pub const ALBEDO: TextureFormat = TextureFormat::Rgba8Unorm;

const DRAWN: TextureUsages = TextureUsages::RENDER_ATTACHMENT.union(TextureUsages::TEXTURE_BINDING);

pub struct Targets {
    /// Albedo at all samples, and at the pixel's centre.
    pub albedo: [wgpu::TextureView; 2],
    /// Picture without SRAA.
    pub shaded: wgpu::TextureView,
}

impl Targets {
    pub fn new(device: &wgpu::Device, size: Size) -> Self {
        Targets {
            albedo: [4, 1].map(|samples| view(device, size, ALBEDO, samples)),
            shaded: view(device, size, COLOR, 1),
        }
    }
}

/// Creates a texture to draw into and to read.
pub fn view(
    device: &wgpu::Device,
    [width, height]: Size,
    format: TextureFormat,
    sample_count: u32,
) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: DRAWN,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
