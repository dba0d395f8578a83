//! Buffers and images with memory of their own.
#![expect(
    unsafe_code,
    reason = "Vulkan's functions are foreign; each handle is destroyed by what made it"
)]

use super::Device;
use ash::vk;

/// An image as bytes, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Format of a texel.
    pub format: Format,
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Texels: `width * height * format.bytes()` bytes.
    pub bytes: Vec<u8>,
}

/// Format of a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A single `f32`.
    R32Float,
    /// Two `f32`.
    Rg32Float,
    /// Four `f32`.
    Rgba32Float,
    /// Four `u32`.
    Rgba32Uint,
    /// Four `i32`.
    Rgba32Sint,
}

impl Format {
    /// Bytes of a texel.
    pub fn bytes(self) -> usize {
        match self {
            Format::R32Float => 4,
            Format::Rg32Float => 8,
            Format::Rgba32Float | Format::Rgba32Uint | Format::Rgba32Sint => 16,
        }
    }

    fn vulkan(self) -> vk::Format {
        match self {
            Format::R32Float => vk::Format::R32_SFLOAT,
            Format::Rg32Float => vk::Format::R32G32_SFLOAT,
            Format::Rgba32Float => vk::Format::R32G32B32A32_SFLOAT,
            Format::Rgba32Uint => vk::Format::R32G32B32A32_UINT,
            Format::Rgba32Sint => vk::Format::R32G32B32A32_SINT,
        }
    }
}

/// The part of an image that a view, a copy or a barrier is of: all of it.
pub(super) const ALL_OF_IT: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

/// A buffer that the host sees.
pub(super) struct Bytes<'d> {
    device: &'d ash::Device,
    pub buffer: vk::Buffer,
    memory: vk::DeviceMemory,
    length: usize,
}

impl<'d> Bytes<'d> {
    /// A buffer that holds these bytes.
    pub fn new(device: &'d Device, bytes: &[u8]) -> Result<Bytes<'d>, vk::Result> {
        let usage = vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST
            | vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::UNIFORM_BUFFER;
        let info = vk::BufferCreateInfo::default()
            .size(bytes.len().max(4) as u64)
            .usage(usage);
        let mut made = Bytes {
            device: &device.device,
            buffer: vk::Buffer::null(),
            memory: vk::DeviceMemory::null(),
            length: bytes.len(),
        };
        let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // SAFETY: the handles are new, and the memory is as large as is asked for.
        unsafe {
            made.buffer = device.device.create_buffer(&info, None)?;
            let wanted = device.device.get_buffer_memory_requirements(made.buffer);
            made.memory = device.allocate(wanted, visible)?;
            device.device.bind_buffer_memory(made.buffer, made.memory, 0)?;
            let mapped = device
                .device
                .map_memory(made.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?;
            std::ptr::copy_nonoverlapping(bytes.as_ptr(), mapped.cast(), bytes.len());
            device.device.unmap_memory(made.memory);
        }
        Ok(made)
    }

    /// Reads the present contents of the buffer.
    pub fn read(&self) -> Result<Vec<u8>, vk::Result> {
        let mut bytes = vec![0u8; self.length];
        // SAFETY: the memory is as large, visible to the host and coherent, and no command is running.
        unsafe {
            let mapped = self
                .device
                .map_memory(self.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?;
            std::ptr::copy_nonoverlapping(mapped.cast(), bytes.as_mut_ptr(), bytes.len());
            self.device.unmap_memory(self.memory);
        }
        Ok(bytes)
    }
}

impl Drop for Bytes<'_> {
    fn drop(&mut self) {
        // SAFETY: no command is running; what was not made is null, which is no error.
        unsafe {
            self.device.destroy_buffer(self.buffer, None);
            self.device.free_memory(self.memory, None);
        }
    }
}

/// An image on the device, and a buffer that it is filled from and read into.
pub(super) struct Texels<'d> {
    device: &'d ash::Device,
    pub image: vk::Image,
    pub view: vk::ImageView,
    memory: vk::DeviceMemory,
    pub staging: Bytes<'d>,
    pub extent: vk::Extent3D,
}

impl<'d> Texels<'d> {
    /// An image that a shader reads, or one that it writes.
    pub fn new(device: &'d Device, image: &Image, is_written: bool) -> Result<Texels<'d>, vk::Result> {
        let copied = vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        let used = match is_written {
            true => vk::ImageUsageFlags::STORAGE,
            false => vk::ImageUsageFlags::SAMPLED,
        };
        let extent = vk::Extent3D {
            width: image.width,
            height: image.height,
            depth: 1,
        };
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(image.format.vulkan())
            .extent(extent)
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(copied | used);
        let mut made = Texels {
            device: &device.device,
            image: vk::Image::null(),
            view: vk::ImageView::null(),
            memory: vk::DeviceMemory::null(),
            staging: Bytes::new(device, &image.bytes)?,
            extent,
        };
        // SAFETY: the handles are new, and the memory is as large as is asked for.
        unsafe {
            made.image = device.device.create_image(&info, None)?;
            let wanted = device.device.get_image_memory_requirements(made.image);
            made.memory = device.allocate(wanted, vk::MemoryPropertyFlags::empty())?;
            device.device.bind_image_memory(made.image, made.memory, 0)?;
            let info = vk::ImageViewCreateInfo::default()
                .image(made.image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(image.format.vulkan())
                .subresource_range(ALL_OF_IT);
            made.view = device.device.create_image_view(&info, None)?;
        }
        Ok(made)
    }

    /// All of it, as a copy to or from its buffer.
    pub fn copy(&self) -> vk::BufferImageCopy {
        vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(self.extent)
    }
}

impl Drop for Texels<'_> {
    fn drop(&mut self) {
        // SAFETY: no command is running; what was not made is null, which is no error.
        unsafe {
            self.device.destroy_image_view(self.view, None);
            self.device.destroy_image(self.image, None);
            self.device.free_memory(self.memory, None);
        }
    }
}

impl Device {
    /// Memory of a kind.
    fn allocate(
        &self,
        wanted: vk::MemoryRequirements,
        kind: vk::MemoryPropertyFlags,
    ) -> Result<vk::DeviceMemory, vk::Result> {
        let fits = |k: &u32| {
            let flags = self.memory.memory_types[*k as usize].property_flags;
            wanted.memory_type_bits & (1 << k) != 0 && flags.contains(kind)
        };
        let found = (0..self.memory.memory_type_count).find(fits);
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(wanted.size)
            .memory_type_index(found.ok_or(vk::Result::ERROR_FEATURE_NOT_PRESENT)?);
        // SAFETY: the kind is one of the device's.
        unsafe { self.device.allocate_memory(&info, None) }
    }
}
