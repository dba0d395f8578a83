//! The command line's own device, and pictures going to it and coming back.

use crate::args::AdapterArgs;
use crate::failure::Failure;
use glam::{UVec2, Vec3, Vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};
use wgpu::{Backends, Features, TextureFormat, TextureUsages};

/// A device to work on, and what it is.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    /// Whether the device can time passes itself.
    pub timestamps: bool,
}

/// Every adapter that the environment's backends offer.
pub fn adapters() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = Backends::from_env().unwrap_or(Backends::PRIMARY);
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(instance.enumerate_adapters(Backends::all()))
}

impl Gpu {
    /// The adapter asked for, or the fastest kind there is; `None` if there is no adapter at all.
    pub fn open(args: &AdapterArgs) -> Result<Option<Gpu>, Failure> {
        let mut found = adapters();
        found.sort_by_key(|adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Cpu => 3,
            wgpu::DeviceType::Other => 4,
        });
        let Some(text) = &args.adapter else {
            return found.into_iter().next().map(Gpu::of).transpose();
        };
        let wanted = text.to_lowercase();
        let names: Vec<String> = found.iter().map(|a| describe(&a.get_info())).collect();
        match found
            .into_iter()
            .find(|a| describe(&a.get_info()).to_lowercase().contains(&wanted))
        {
            Some(adapter) => Gpu::of(adapter).map(Some),
            None if names.is_empty() => Err(Failure::Failed(format!(
                "there is no adapter at all, so none called `{text}`; {INSTALL}"
            ))),
            None => Err(Failure::Usage(format!(
                "no adapter is called `{text}`; there are: {}",
                names.join("; ")
            ))),
        }
    }

    /// As [`Gpu::open`], where nothing can be done without one.
    pub fn require(args: &AdapterArgs) -> Result<Gpu, Failure> {
        Gpu::open(args)?.ok_or_else(|| {
            Failure::Failed(format!(
                "there is no GPU adapter; {INSTALL}, or use --executor cpu where there is that"
            ))
        })
    }

    fn of(adapter: wgpu::Adapter) -> Result<Gpu, Failure> {
        let info = adapter.get_info();
        // A software driver runs passes on this processor, where the wall clock is exact; lavapipe's timestamps (Mesa
        // 22.3) are not: they may leave out the pass that they stand around.
        let timestamps =
            adapter.features().contains(Features::TIMESTAMP_QUERY) && info.device_type != wgpu::DeviceType::Cpu;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("straightline"),
            required_features: adapter.features() & Features::TIMESTAMP_QUERY,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| Failure::Failed(format!("the adapter {} gives no device: {error}", describe(&info))))?;
        Ok(Gpu {
            device,
            queue,
            info,
            timestamps,
        })
    }

    /// Name, driver and backend, for records.
    pub fn describe(&self) -> String {
        describe(&self.info)
    }

    /// A stack of images as a texture array, `rgba32float`, `r32float` or what `format` says.
    fn upload(
        &self,
        size: UVec2,
        layers: u32,
        format: TextureFormat,
        bytes: &[u8],
    ) -> Result<wgpu::TextureView, Failure> {
        let limits = self.device.limits();
        let largest = limits.max_texture_dimension_2d;
        if size.max_element() > largest || layers > limits.max_texture_array_layers {
            return Err(Failure::Failed(format!(
                "a picture of {}x{} with {layers} layers is more than this adapter holds ({largest}x{largest}, {} layers)",
                size.x, size.y, limits.max_texture_array_layers
            )));
        }
        let extent = wgpu::Extent3d {
            width: size.x,
            height: size.y,
            depth_or_array_layers: layers,
        };
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: extent,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let texel = format.block_copy_size(None).unwrap_or(16);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.x * texel),
            rows_per_image: Some(size.y),
        };
        self.queue.write_texture(texture.as_image_copy(), bytes, layout, extent);
        Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
    }

    /// One image of colours.
    pub fn color(&self, frame: &Frame<Vec4>) -> Result<wgpu::TextureView, Failure> {
        let bytes: Vec<u8> = frame
            .texels()
            .iter()
            .flat_map(|c| c.to_array())
            .flat_map(f32::to_le_bytes)
            .collect();
        self.upload(frame.size(), 1, TextureFormat::Rgba32Float, &bytes)
    }

    /// Depths, a layer a sample.
    pub fn depth(&self, stack: &FrameLayers<f32>) -> Result<wgpu::TextureView, Failure> {
        let bytes: Vec<u8> = stack
            .layers()
            .iter()
            .flat_map(|l| l.texels())
            .flat_map(|d| d.to_le_bytes())
            .collect();
        let view = self.upload(
            stack.layers()[0].size(),
            stack.layers().len() as u32,
            TextureFormat::R32Float,
            &bytes,
        )?;
        Ok(as_array(&view))
    }

    /// Normals, a layer a sample, in full precision.
    pub fn normal(&self, stack: &FrameLayers<Vec3>) -> Result<wgpu::TextureView, Failure> {
        let texels = stack.layers().iter().flat_map(|l| l.texels());
        let bytes: Vec<u8> = texels
            .flat_map(|n| n.extend(0.0).to_array())
            .flat_map(f32::to_le_bytes)
            .collect();
        let view = self.upload(
            stack.layers()[0].size(),
            stack.layers().len() as u32,
            TextureFormat::Rgba32Float,
            &bytes,
        )?;
        Ok(as_array(&view))
    }

    /// A target that either stage can write and that can be read back.
    pub fn target(&self, size: UVec2, format: TextureFormat) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
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
            usage: TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    }

    /// A picture of `rgba32float` texels, read back.
    pub fn download(&self, texture: &wgpu::Texture) -> Result<Frame<Vec4>, Failure> {
        let size = UVec2::new(texture.width(), texture.height());
        let row = (size.x * 16).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(size.y),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let mapped = buffer.get_mapped_range(..).map_err(Failure::of)?;
        let texels = mapped.chunks_exact(row as usize).flat_map(|line| {
            let floats = line[..size.x as usize * 16]
                .chunks_exact(4)
                .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
            let floats: Vec<f32> = floats.collect();
            floats.chunks_exact(4).map(Vec4::from_slice).collect::<Vec<_>>()
        });
        Ok(Frame::new(size, texels.collect()))
    }

    /// Waits until everything submitted is done.
    pub fn wait(&self) -> Result<(), Failure> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_| ())
            .map_err(Failure::of)
    }
}

/// What helps a machine without a GPU.
pub const INSTALL: &str = "install a Vulkan driver (a software one is in Debian's mesa-vulkan-drivers)";

fn as_array(view: &wgpu::TextureView) -> wgpu::TextureView {
    view.texture().create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

fn describe(info: &wgpu::AdapterInfo) -> String {
    let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ");
    format!("{} ({}, {})", info.name, driver.trim(), info.backend)
}
