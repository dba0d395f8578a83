//! The device for all drawing.

use crate::Failure;
use straightline_sraa::wgpu;

#[cfg(not(target_arch = "wasm32"))]
const NO_ADAPTER: &str = "no GPU adapter: install a Vulkan driver (a software one is in Debian's mesa-vulkan-drivers)";
#[cfg(target_arch = "wasm32")]
const NO_ADAPTER: &str = "this browser offers no WebGPU adapter: see https://caniuse.com/webgpu for those that do";

pub struct Gpu {
    pub adapter: wgpu::Adapter,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Creates a device that can draw to `surface`, with timestamps where they are reliable, or wherever they exist if `always`.
    pub async fn new(
        instance: &wgpu::Instance,
        surface: Option<&wgpu::Surface<'_>>,
        always: bool,
    ) -> Result<Gpu, Failure> {
        let options = wgpu::RequestAdapterOptions { compatible_surface: surface, ..Default::default() };
        let adapter = instance.request_adapter(&options).await.map_err(|error| format!("{NO_ADAPTER}: {error}"))?;
        let timestamps = match is_processor(&adapter) && !always {
            // Software drivers can omit a pass from the span around it.
            true => wgpu::Features::empty(),
            false => adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
        };
        let descriptor = wgpu::DeviceDescriptor { required_features: timestamps, ..Default::default() };
        let (device, queue) = adapter.request_device(&descriptor).await?;
        Ok(Gpu { adapter, device, queue })
    }

    /// Creates a device without a surface.
    pub async fn headless(always: bool) -> Result<Gpu, Failure> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        Gpu::new(&instance, None, always).await
    }

    /// Describes what a wall-clock time includes on this device.
    pub fn clock(&self) -> String {
        let name = self.adapter.get_info().name;
        match (is_processor(&self.adapter), self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)) {
            (true, _) if name.is_empty() => "by the wall clock; the processor does the GPU's work".to_owned(),
            (true, _) => format!("by the wall clock; {name} does the GPU's work on the processor"),
            (false, true) => "by the wall clock".to_owned(),
            (false, false) => "by the wall clock; the device has no timestamps".to_owned(),
        }
    }
}

fn is_processor(adapter: &wgpu::Adapter) -> bool {
    adapter.get_info().device_type == wgpu::DeviceType::Cpu
}
