//! Values that are set at run time: where they start, and their buffers or immediates.

mod value;

use crate::guard::run_guarded;
use crate::plan::{FieldPlan, Plan, UniformPlan};
use crate::{BindOptions, Error, Names};
use std::sync::{Mutex, MutexGuard, PoisonError};
pub use value::{Component, UniformValue};

/// The uniform structs of a bound pass.
#[derive(Debug)]
pub(crate) struct Uniforms {
    /// One for each struct of the plan, in its order.
    blocks: Vec<Block>,
    /// The frame's size as stored in its field, if the targets determine it: index of the struct, offset and bytes.
    frame: Option<(usize, u32, [u8; 8])>,
}

/// Memory of a uniform struct.
#[derive(Debug)]
enum Block {
    /// On the device.
    Buffer(wgpu::Buffer),
    /// Recorded with each dispatch or draw.
    Immediates(Mutex<Box<[u8]>>),
}

fn lock(bytes: &Mutex<Box<[u8]>>) -> MutexGuard<'_, Box<[u8]>> {
    bytes.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Uniforms {
    /// Blocks that hold the manifest's defaults, the values of `options`, and the size of the targets where they determine it.
    /// Buffers are filled while mapped, so that no queue is needed and the first submission already sees them.
    pub(crate) fn new(
        device: &wgpu::Device,
        plan: &Plan,
        options: &BindOptions<'_>,
        size: Option<[u32; 2]>,
    ) -> Result<Self, Error> {
        let frame = size.and_then(|[width, height]| {
            let (block, offset) = frame_field(plan)?;
            let mut bytes = [0; 8];
            copy_bytes(&mut bytes, 0, &width.to_le_bytes());
            copy_bytes(&mut bytes, 4, &height.to_le_bytes());
            Some((block, offset, bytes))
        });
        let contents = initial_blocks(plan, options, frame)?;
        let blocks = plan.uniforms.iter().zip(contents).map(|(block, bytes)| {
            if block.place.is_none() {
                return Ok(Block::Immediates(Mutex::new(bytes.into())));
            }
            let refused = |description| Error::Pipeline {
                kernel: plan.kernel.to_string(),
                description,
            };
            filled_buffer(device, &plan.kernel, &block.name, &bytes, refused).map(Block::Buffer)
        });
        Ok(Uniforms {
            blocks: blocks.collect::<Result<_, _>>()?,
            frame,
        })
    }

    /// The buffers, in the order of the plan's structs; `None` for immediates.
    pub(crate) fn buffers(&self) -> impl Iterator<Item = Option<&wgpu::Buffer>> {
        self.blocks.iter().map(|block| match block {
            Block::Buffer(buffer) => Some(buffer),
            Block::Immediates(_) => None,
        })
    }

    /// Passes the immediates to `set`, if there are any.
    pub(crate) fn record_immediates(&self, set: impl FnOnce(&[u8])) {
        let immediates = self.blocks.iter().find_map(|block| match block {
            Block::Immediates(bytes) => Some(bytes),
            Block::Buffer(_) => None,
        });
        if let Some(bytes) = immediates {
            set(&lock(bytes));
        }
    }

    /// Puts `bytes` at `offset` of a block, ahead of the queue's next submission or of the next recording.
    fn write_block(&self, queue: &wgpu::Queue, block: usize, offset: u32, bytes: &[u8]) {
        match &self.blocks[block] {
            Block::Buffer(buffer) => queue.write_buffer(buffer, u64::from(offset), bytes),
            Block::Immediates(own) => copy_bytes(&mut lock(own), offset, bytes),
        }
    }

    /// Puts `value` into the uniform `name`, ahead of the queue's next submission or of the next recording.
    pub(crate) fn write_value(
        &self,
        plan: &Plan,
        queue: &wgpu::Queue,
        name: &str,
        value: &UniformValue,
    ) -> Result<(), Error> {
        place_value(plan, name, value, |block, offset, bytes| {
            self.write_block(queue, block, offset, bytes);
        })?;
        self.restore_frame(queue);
        Ok(())
    }

    /// Puts `bytes` at `offset` of the first struct.
    pub(crate) fn write_at(&self, queue: &wgpu::Queue, offset: u32, bytes: &[u8]) {
        if !self.blocks.is_empty() {
            self.write_block(queue, 0, offset, bytes);
        }
        self.restore_frame(queue);
    }

    /// Puts the targets' size back into its field, which a caller's write of the whole struct covers.
    fn restore_frame(&self, queue: &wgpu::Queue) {
        if let Some((block, offset, bytes)) = &self.frame {
            self.write_block(queue, *block, *offset, bytes);
        }
    }

    /// Puts `bytes` into all structs, one after the other.
    pub(crate) fn write_all(&self, plan: &Plan, queue: &wgpu::Queue, bytes: &[u8]) -> Result<(), Error> {
        for (block, bytes) in split_blocks(plan, bytes)?.enumerate() {
            self.write_block(queue, block, 0, bytes);
        }
        self.restore_frame(queue);
        Ok(())
    }
}

/// A uniform buffer with these contents.
pub(crate) fn filled_buffer(
    device: &wgpu::Device,
    kernel: &str,
    name: &str,
    bytes: &[u8],
    refused: impl Fn(String) -> Error,
) -> Result<wgpu::Buffer, Error> {
    let doing = format!("making the uniform buffer `{name}` of `{kernel}`");
    let buffer = run_guarded(device, &doing, &refused, || {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(name),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: true,
        })
    })?;
    // A buffer of a lost device was made without complaint and has no mapping.
    let mut mapping = buffer
        .get_mapped_range_mut(..)
        .map_err(|_| Error::DeviceLost { doing: doing.clone() })?;
    mapping.copy_from_slice(bytes);
    drop(mapping);
    run_guarded(device, &doing, &refused, || buffer.unmap())?;
    Ok(buffer)
}

/// Returns the struct and the offset of the field with the frame's size.
fn frame_field(plan: &Plan) -> Option<(usize, u32)> {
    let mut blocks = plan.uniforms.iter().enumerate();
    blocks.find_map(|(block, uniform)| {
        let field = uniform.fields.iter().find(|field| field.frame_size)?;
        Some((block, field.offset))
    })
}

/// Returns the frame's size as `options` set it, for a kernel without targets and without textures of that size.
pub(crate) fn frame_option(plan: &Plan, options: &BindOptions<'_>) -> Result<Option<[u32; 2]>, Error> {
    let Some((block, offset)) = frame_field(plan) else {
        return Ok(None);
    };
    let blocks = initial_blocks(plan, options, None)?;
    let word = |at: u32| {
        let at = at as usize;
        let bytes = blocks[block].get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    Ok(word(offset).zip(word(offset + 4)).map(<[u32; 2]>::from))
}

/// Initial bytes of the structs of `plan`, with `frame` as the targets' size. A field without a value is an error.
fn initial_blocks(
    plan: &Plan,
    options: &BindOptions<'_>,
    frame: Option<(usize, u32, [u8; 8])>,
) -> Result<Vec<Vec<u8>>, Error> {
    let mut blocks: Vec<Vec<u8>> = plan.uniforms.iter().map(|block| vec![0; block.size as usize]).collect();
    let mut missing: Vec<(usize, u32)> = Vec::new();
    for (k, block) in plan.uniforms.iter().enumerate() {
        for FieldPlan { offset, default, .. } in block.fields.iter() {
            match default {
                Some(word) => copy_bytes(&mut blocks[k], *offset, word),
                None => missing.push((k, *offset)),
            }
        }
    }
    if let Some(bytes) = options.uniforms {
        for (block, bytes) in blocks.iter_mut().zip(split_blocks(plan, bytes)?) {
            block.copy_from_slice(bytes);
        }
        missing.clear();
    }
    for (name, value) in &options.values {
        place_value(plan, name, value, |block, offset, bytes| {
            copy_bytes(&mut blocks[block], offset, bytes);
            missing.retain(|place| *place != (block, offset));
        })?;
    }
    if let Some((block, offset, bytes)) = frame {
        copy_bytes(&mut blocks[block], offset, &bytes);
        missing.retain(|place| *place != (block, offset));
    }
    let unset = missing.first().and_then(|(block, offset)| {
        let mut fields = plan.uniforms[*block].fields.iter();
        fields.find(|field| field.offset == *offset)
    });
    match unset {
        None => Ok(blocks),
        Some(field) => Err(Error::UniformUnset {
            kernel: plan.kernel.to_string(),
            name: field.source_name().to_owned(),
        }),
    }
}

fn copy_bytes(block: &mut [u8], offset: u32, bytes: &[u8]) {
    let offset = offset as usize;
    block[offset..offset + bytes.len()].copy_from_slice(bytes);
}

/// Passes struct, offset and bytes of each part of `value` to `put`: a field, or the parts of a matrix or an array that the
/// shader reads.
fn place_value(
    plan: &Plan,
    name: &str,
    value: &UniformValue,
    mut put: impl FnMut(usize, u32, &[u8]),
) -> Result<(), Error> {
    let mismatch = |needed: String| Error::UniformType {
        kernel: plan.kernel.to_string(),
        name: name.to_owned(),
        needed,
        given: value.ty().to_string(),
    };
    let mut found = false;
    for (k, block) in plan.uniforms.iter().enumerate() {
        for field in block.fields.iter() {
            let (ty, index) = match &field.part {
                _ if field.name == name => (field.ty, 0),
                Some(part) if part.of == name => (part.ty, part.index),
                _ => continue,
            };
            if value.ty() != ty {
                return Err(mismatch(ty.to_string()));
            }
            found = true;
            put(k, field.offset, value.part_bytes(index));
        }
    }
    match found {
        true => Ok(()),
        false => Err(Error::UnknownUniform {
            kernel: plan.kernel.to_string(),
            name: name.to_owned(),
            known: settable_names(plan),
        }),
    }
}

/// Names that can be set; a matrix or an array has one.
fn settable_names(plan: &Plan) -> Names {
    let mut names: Vec<&str> = plan
        .uniforms
        .iter()
        .flat_map(|block| block.fields.iter())
        .map(FieldPlan::source_name)
        .collect();
    names.dedup();
    names.into_iter().collect()
}

/// `bytes` as the structs of `plan`.
fn split_blocks<'b>(plan: &Plan, bytes: &'b [u8]) -> Result<impl Iterator<Item = &'b [u8]>, Error> {
    if plan.uniforms.is_empty() {
        return Err(Error::NoUniforms {
            kernel: plan.kernel.to_string(),
        });
    }
    let needed: u64 = plan.uniforms.iter().map(|block| u64::from(block.size)).sum();
    let given = bytes.len() as u64;
    if given != needed {
        return Err(Error::UniformSize {
            kernel: plan.kernel.to_string(),
            needed,
            given,
        });
    }
    let mut rest = bytes;
    let sizes = plan.uniforms.iter().map(|UniformPlan { size, .. }| *size as usize);
    // In bounds, as the sizes add up.
    Ok(sizes.map(move |size| {
        let (own, after) = rest.split_at(size);
        rest = after;
        own
    }))
}
