//! Everything on the device that one scene at one size needs.

use super::pipelines::Pipelines;
use crate::render::RenderError;
use crate::render::frame::{Lighting, Pass};
use crate::scene::{Scene, Vertex};
use glam::{UVec2, Vec4};
use wgpu::{BufferUsages, TextureFormat, TextureUsages};

/// Format of both G-buffer textures: full floats, so that the CPU renderer gives the same values.
pub(super) const TEXEL_FORMAT: TextureFormat = TextureFormat::Rgba32Float;

/// Format of the depth test, which uses the reciprocal of depth.
pub(super) const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

#[derive(Debug)]
pub(super) struct Resources {
    pub vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    /// A [`Pass`].
    pub pass: wgpu::Buffer,
    /// A [`Lighting`].
    pub lighting: wgpu::Buffer,
    /// View-space normal and linear depth.
    pub normal_depth: wgpu::Texture,
    /// Linear RGB and material.
    pub color_material: wgpu::Texture,
    pub depth: wgpu::Texture,
    /// A sum of colours for each pixel, row by row from the top.
    pub colors: wgpu::Buffer,
    pub geometry_group: wgpu::BindGroup,
    /// Images and texels of the scene's textures.
    pub texture_group: wgpu::BindGroup,
    pub shading_group: wgpu::BindGroup,
}

/// Rejects sizes beyond the device's limits, before wgpu does in its own words.
pub(super) fn check_limits(device: &wgpu::Device, scene: &Scene, size: UVec2) -> Result<(), RenderError> {
    let limits = device.limits();
    let most = limits.max_texture_dimension_2d;
    if size.min_element() == 0 || size.max_element() > most {
        return Err(RenderError::Size { size, most });
    }
    let pixels = u64::from(size.x) * u64::from(size.y);
    let sums = pixels * size_of::<Vec4>() as u64;
    let vertices = scene.vertices.len() as u64 * size_of::<Vertex>() as u64;
    let indices = scene.triangles.len() as u64 * size_of::<[u32; 3]>() as u64;
    let storage = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    let texels = 4 * scene.textures.texels.len() as u64;
    let checks = [
        ("storage buffers", storage, texels, "scene"),
        ("storage buffers", storage, sums, "picture"),
        ("buffers", limits.max_buffer_size, vertices, "scene"),
        // The number of indices is 32 bits, too.
        ("buffers", limits.max_buffer_size.min(4 << 32), indices, "scene"),
    ];
    for (what, most, needed, smaller) in checks {
        if needed > most {
            return Err(RenderError::Limit {
                what,
                most,
                needed,
                smaller,
            });
        }
    }
    Ok(())
}

impl Resources {
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, pipelines: &Pipelines, scene: &Scene, size: UVec2) -> Self {
        let filled = |usage: BufferUsages, bytes: &[u8]| {
            let buffer = create_buffer(device, usage | BufferUsages::COPY_DST, bytes.len() as u64);
            queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let vertices = filled(BufferUsages::VERTEX, bytemuck::cast_slice(&scene.vertices));
        let indices = filled(BufferUsages::INDEX, bytemuck::cast_slice(&scene.triangles));
        let images = filled(
            BufferUsages::STORAGE,
            bytes_or_padding(bytemuck::cast_slice(&scene.textures.images)),
        );
        let texels = filled(
            BufferUsages::STORAGE,
            bytes_or_padding(bytemuck::cast_slice(&scene.textures.texels)),
        );
        let lighting = filled(BufferUsages::UNIFORM, bytemuck::bytes_of(&Lighting::new(scene, size)));
        let pass = create_buffer(
            device,
            BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            size_of::<Pass>() as u64,
        );
        let pixels = u64::from(size.x) * u64::from(size.y);
        let colors = create_buffer(
            device,
            BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST,
            pixels * size_of::<Vec4>() as u64,
        );
        let read = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
        let normal_depth = create_target(device, size, TEXEL_FORMAT, read);
        let color_material = create_target(device, size, TEXEL_FORMAT, read);
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let (normal_depth_view, color_material_view) = (view(&normal_depth), view(&color_material));
        let geometry_group = create_bind_group(device, &pipelines.geometry_layout, &[pass.as_entire_binding()]);
        let textures = [images.as_entire_binding(), texels.as_entire_binding()];
        let texture_group = create_bind_group(device, &pipelines.texture_layout, &textures);
        let shading_group = create_bind_group(
            device,
            &pipelines.shading_layout,
            &[
                pass.as_entire_binding(),
                lighting.as_entire_binding(),
                wgpu::BindingResource::TextureView(&normal_depth_view),
                wgpu::BindingResource::TextureView(&color_material_view),
                colors.as_entire_binding(),
            ],
        );
        Resources {
            vertices,
            indices,
            index_count: 3 * scene.triangles.len() as u32,
            pass,
            lighting,
            normal_depth,
            color_material,
            depth: create_target(device, size, DEPTH_FORMAT, TextureUsages::empty()),
            colors,
            geometry_group,
            texture_group,
            shading_group,
        }
    }
}

/// Returns the scene's data, or some unread bytes if a scene without textures has none: no buffer is empty.
fn bytes_or_padding(bytes: &[u8]) -> &[u8] {
    match bytes {
        [] => &[0; 32],
        bytes => bytes,
    }
}

pub(super) fn create_buffer(device: &wgpu::Device, usage: BufferUsages, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage,
        mapped_at_creation: false,
    })
}

fn create_target(device: &wgpu::Device, size: UVec2, format: TextureFormat, usage: TextureUsages) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: size.x,
            height: size.y,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

/// Bindings 0, 1, 2, ... of group 0.
pub(super) fn create_bind_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource],
) -> wgpu::BindGroup {
    let entries: Vec<_> = resources
        .iter()
        .enumerate()
        .map(|(at, resource)| wgpu::BindGroupEntry {
            binding: at as u32,
            resource: resource.clone(),
        })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}
