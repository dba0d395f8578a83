//! The command line's GPU device.

use crate::args::AdapterArgs;
use crate::failure::Failure;
use straightline_bench::execute::Bench;
use wgpu::{Backends, Features};

/// A device, and the description of its adapter.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    /// `true` if the device can time passes.
    pub timestamps: bool,
}

/// Lists every adapter of the environment's backends.
pub fn list_adapters() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = Backends::from_env().unwrap_or(Backends::PRIMARY);
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(instance.enumerate_adapters(Backends::all()))
}

impl Gpu {
    /// Opens the requested adapter, or the fastest kind available. Returns `None` if there is no adapter at all.
    pub fn open(args: &AdapterArgs) -> Result<Option<Gpu>, Failure> {
        let mut found = list_adapters();
        found.sort_by_key(|adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Cpu => 3,
            wgpu::DeviceType::Other => 4,
        });
        let Some(text) = &args.adapter else {
            return found.into_iter().next().map(Gpu::from_adapter).transpose();
        };
        let wanted = text.to_lowercase();
        let names: Vec<String> = found.iter().map(|a| describe_adapter(&a.get_info())).collect();
        match found
            .into_iter()
            .find(|a| describe_adapter(&a.get_info()).to_lowercase().contains(&wanted))
        {
            Some(adapter) => Gpu::from_adapter(adapter).map(Some),
            None if names.is_empty() => Err(Failure::Failed(format!(
                "there is no adapter at all, so none called `{text}`; {INSTALL}"
            ))),
            None => Err(Failure::Usage(format!(
                "no adapter is called `{text}`; there are: {}",
                names.join("; ")
            ))),
        }
    }

    /// Opens a device as [`Gpu::open`], and fails without one.
    pub fn require(args: &AdapterArgs) -> Result<Gpu, Failure> {
        Gpu::open(args)?.ok_or_else(|| {
            Failure::Failed(format!(
                "there is no GPU adapter; {INSTALL}, or use --executor cpu where there is that"
            ))
        })
    }

    fn from_adapter(adapter: wgpu::Adapter) -> Result<Gpu, Failure> {
        let info = adapter.get_info();
        // A software driver runs passes on the CPU, so the wall clock is exact. The timestamps of lavapipe (Mesa 22.3) are
        // not: they may omit the pass that they surround.
        let timestamps =
            adapter.features().contains(Features::TIMESTAMP_QUERY) && info.device_type != wgpu::DeviceType::Cpu;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("straightline"),
            required_features: adapter.features()
                & (Features::TIMESTAMP_QUERY
                    | Features::FLOAT32_FILTERABLE
                    | Features::SUBGROUP
                    | Features::SHADER_F16
                    | Features::IMMEDIATES),
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
            Failure::Failed(format!(
                "the adapter {} gives no device: {error}",
                describe_adapter(&info)
            ))
        })?;
        Ok(Gpu {
            device,
            queue,
            info,
            timestamps,
        })
    }

    /// Returns name, driver and backend, for records.
    pub fn describe(&self) -> String {
        describe_adapter(&self.info)
    }

    /// Returns whether shaders can compute in half precision.
    pub fn has_half(&self) -> bool {
        self.device.features().contains(Features::SHADER_F16)
    }

    /// Returns a bench that runs kernels on the device.
    pub fn bench(&self) -> Bench {
        Bench::new(&self.device, &self.queue, self.timestamps)
    }
}

/// Help for a machine without a GPU.
pub const INSTALL: &str = "install a Vulkan driver (a software one is in Debian's mesa-vulkan-drivers)";

fn describe_adapter(info: &wgpu::AdapterInfo) -> String {
    let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ");
    format!("{} ({}, {})", info.name, driver.trim(), info.backend)
}
