//! Textures between the passes.

use super::SAMPLES;
use crate::Size;
use straightline_runtime::wgpu;
use wgpu::{TextureFormat, TextureUsages, TextureViewDimension};

/// Layers of the G-buffer: one for each geometry sample, and the last for the pixel's centre.
pub const LAYERS: u32 = SAMPLES.len() as u32 + 1;

/// Linear depth, so that the kernel does not depend on the projection.
pub const DEPTH: TextureFormat = TextureFormat::R32Float;
pub const NORMAL: TextureFormat = TextureFormat::Rgba16Float;
pub const ALBEDO: TextureFormat = TextureFormat::Rgba8Unorm;
pub const COLOR: TextureFormat = TextureFormat::Rgba16Float;
pub const Z_BUFFER: TextureFormat = TextureFormat::Depth32Float;
const PLACE: TextureFormat = TextureFormat::R32Uint;

/// Width and height of the tiles that the kernel `sraa_fit_sums` adds up.
const TILE: u32 = 16;

pub struct Targets {
    pub size: Size,
    /// Depth, normal and albedo, in layers.
    pub geometry: [wgpu::Texture; 3],
    pub z_buffer: wgpu::TextureView,
    /// Shading sample of each pixel.
    pub place: wgpu::TextureView,
    /// Shaded colour.
    pub shaded: wgpu::TextureView,
    /// Sums that the guide's scale follows from, a texel a tile, and that scale, one texel.
    pub fit_sums: [wgpu::TextureView; 2],
    pub guide_scale: wgpu::TextureView,
    /// Mean of the guide over each pixel's samples.
    pub guide_mean: wgpu::TextureView,
    /// Shaded colour less the guide: below 0 too.
    pub difference: wgpu::TextureView,
    /// Antialiased colour.
    pub resolved: wgpu::TextureView,
}

impl Targets {
    pub fn new(device: &wgpu::Device, size: Size) -> Self {
        let drawn = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let stored = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
        let one = |size, format, usage| layer(&texture(device, size, format, 1, usage), 0);
        let sums = || one(size.map(|side| side.div_ceil(TILE)), COLOR, stored);
        Targets {
            size,
            geometry: [DEPTH, NORMAL, ALBEDO].map(|format| texture(device, size, format, LAYERS, drawn)),
            z_buffer: one(size, Z_BUFFER, TextureUsages::RENDER_ATTACHMENT),
            place: one(size, PLACE, stored),
            shaded: one(size, COLOR, drawn),
            fit_sums: [sums(), sums()],
            guide_scale: one([1, 1], COLOR, stored),
            guide_mean: one(size, COLOR, stored),
            difference: one(size, COLOR, stored),
            resolved: one(size, COLOR, stored),
        }
    }
}

/// Creates a texture of some layers.
pub fn texture(
    device: &wgpu::Device,
    [width, height]: Size,
    format: TextureFormat,
    layers: u32,
    usage: TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// Returns one layer as a plain texture.
pub fn layer(texture: &wgpu::Texture, at: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2),
        base_array_layer: at,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

/// Returns all layers, as read by the kernels.
pub fn all_layers(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        ..Default::default()
    })
}
