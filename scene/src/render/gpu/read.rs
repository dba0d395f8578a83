//! From the device back to memory.

use super::guard::{device_error, with_error_scope};
use super::resources::TEXEL_FORMAT;
use crate::render::RenderError;
use glam::Vec4;
use half::f16;
use std::sync::mpsc;
use wgpu::{Buffer, CommandEncoder, Device, Queue, Texture, TextureFormat};

const DOING: &str = "reading a picture back";

/// All of a buffer of colours.
pub(super) fn read_buffer(device: &Device, queue: &Queue, source: &Buffer) -> Result<Vec<Vec4>, RenderError> {
    let bytes = read_staged(device, queue, source.size(), |encoder, staging| {
        encoder.copy_buffer_to_buffer(source, 0, staging, 0, source.size());
    })?;
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}

/// All texels of a G-buffer texture, row by row from the top.
pub(super) fn read_texture(device: &Device, queue: &Queue, source: &Texture) -> Result<Vec<Vec4>, RenderError> {
    debug_assert_eq!(source.format(), TEXEL_FORMAT);
    read_layer(device, queue, source, 0)
}

/// All texels of a texture's layer, row by row from the top, of one or four components of 32 bits or of four halves.
pub(super) fn read_layer(
    device: &Device,
    queue: &Queue,
    source: &Texture,
    layer: u32,
) -> Result<Vec<Vec4>, RenderError> {
    let format = source.format();
    let row = source.width() * format.block_copy_size(None).unwrap_or(size_of::<Vec4>() as u32);
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let size = u64::from(padded) * u64::from(source.height());
    let bytes = read_staged(device, queue, size, |encoder, staging| {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded),
            rows_per_image: None,
        };
        let target = wgpu::TexelCopyBufferInfo {
            buffer: staging,
            layout,
        };
        let mut from = source.as_image_copy();
        from.origin.z = layer;
        let extent = wgpu::Extent3d {
            depth_or_array_layers: 1,
            ..source.size()
        };
        encoder.copy_texture_to_buffer(from, target, extent);
    })?;
    let rows = bytes.chunks_exact(padded as usize).map(|bytes| &bytes[..row as usize]);
    let texels = |bytes: &[u8]| -> Vec<Vec4> {
        match format {
            TextureFormat::Rgba16Float => {
                let halves = bytemuck::pod_collect_to_vec::<u8, [u16; 4]>(bytes);
                let texel = |texel: [u16; 4]| Vec4::from_array(texel.map(|bits| f16::from_bits(bits).to_f32()));
                halves.into_iter().map(texel).collect()
            }
            TextureFormat::R32Float => {
                let floats = bytemuck::pod_collect_to_vec::<u8, f32>(bytes);
                floats.into_iter().map(|x| Vec4::new(x, 0.0, 0.0, 1.0)).collect()
            }
            _ => bytemuck::pod_collect_to_vec(bytes),
        }
    };
    Ok(rows.flat_map(texels).collect())
}

/// The `size` bytes that `copy` puts into a buffer.
fn read_staged(
    device: &Device,
    queue: &Queue,
    size: u64,
    copy: impl FnOnce(&mut CommandEncoder, &Buffer),
) -> Result<Vec<u8>, RenderError> {
    let (sender, receiver) = mpsc::channel();
    let staging = with_error_scope(device, DOING, || {
        let staging = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        copy(&mut encoder, &staging);
        queue.submit([encoder.finish()]);
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver is gone only if waiting failed, which is reported already.
            let _ = sender.send(result);
        });
        staging
    })?;
    device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|error| device_error(DOING, error))?;
    match receiver.recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(device_error(DOING, error)),
        Err(error) => return Err(device_error(DOING, error)),
    }
    let mapped = staging
        .get_mapped_range(..)
        .map_err(|error| device_error(DOING, error))?;
    Ok(mapped.to_vec())
}
