//! From the device back to memory.

use super::guard::{failed, guarded};
use super::resources::TEXEL_FORMAT;
use crate::render::RenderError;
use glam::Vec4;
use std::sync::mpsc;
use wgpu::{Buffer, CommandEncoder, Device, Queue, Texture};

const DOING: &str = "reading a picture back";

/// All of a buffer of colours.
pub(super) fn buffer(device: &Device, queue: &Queue, source: &Buffer) -> Result<Vec<Vec4>, RenderError> {
    let bytes = read(device, queue, source.size(), |encoder, staging| {
        encoder.copy_buffer_to_buffer(source, 0, staging, 0, source.size());
    })?;
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}

/// All texels of a G-buffer texture, row by row from the top.
pub(super) fn texture(device: &Device, queue: &Queue, source: &Texture) -> Result<Vec<Vec4>, RenderError> {
    debug_assert_eq!(source.format(), TEXEL_FORMAT);
    let row = source.width() * size_of::<Vec4>() as u32;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let size = u64::from(padded) * u64::from(source.height());
    let bytes = read(device, queue, size, |encoder, staging| {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded),
            rows_per_image: None,
        };
        let target = wgpu::TexelCopyBufferInfo {
            buffer: staging,
            layout,
        };
        encoder.copy_texture_to_buffer(source.as_image_copy(), target, source.size());
    })?;
    let rows = bytes.chunks_exact(padded as usize);
    Ok(rows
        .flat_map(|bytes| bytemuck::pod_collect_to_vec::<u8, Vec4>(&bytes[..row as usize]))
        .collect())
}

/// The `size` bytes that `copy` puts into a buffer.
fn read(
    device: &Device,
    queue: &Queue,
    size: u64,
    copy: impl FnOnce(&mut CommandEncoder, &Buffer),
) -> Result<Vec<u8>, RenderError> {
    let (sender, receiver) = mpsc::channel();
    let staging = guarded(device, DOING, || {
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
            // Nobody listens any more only if waiting failed, which is reported already.
            let _ = sender.send(result);
        });
        staging
    })?;
    device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|error| failed(DOING, error))?;
    match receiver.recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(failed(DOING, error)),
        Err(error) => return Err(failed(DOING, error)),
    }
    let mapped = staging.get_mapped_range(..).map_err(|error| failed(DOING, error))?;
    Ok(mapped.to_vec())
}
