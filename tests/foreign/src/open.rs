//! Opening a driver's library.
#![expect(unsafe_code, reason = "the library and Vulkan's functions are foreign")]

use ash::{Entry, StaticFn, vk};
use libloading::Library;
use std::ffi::CStr;
use std::path::Path;

/// The functions of a driver's library, which stays loaded while the process runs.
pub fn entry(library: &Path) -> Result<Entry, String> {
    let failed = |e| format!("{}: {e}", library.display());
    // SAFETY: drivers do nothing but initialise themselves when they are loaded; the names and types are those of Vulkan's
    // interface between loader and drivers.
    unsafe {
        let loaded = Library::new(library).map_err(failed)?;
        if let Ok(negotiate) = loaded.get::<Negotiate>(b"vk_icdNegotiateLoaderICDInterfaceVersion\0") {
            let mut version = 5;
            // A driver that does not know the version says which it knows.
            let _ = negotiate(&mut version);
        }
        let get = *loaded
            .get::<vk::PFN_vkGetInstanceProcAddr>(b"vk_icdGetInstanceProcAddr\0")
            .map_err(failed)?;
        std::mem::forget(loaded);
        Ok(Entry::from_static_fn(StaticFn {
            get_instance_proc_addr: get,
        }))
    }
}

type Negotiate = unsafe extern "C" fn(*mut u32) -> vk::Result;

/// The version of Vulkan that is asked for.
pub const VERSION: u32 = vk::API_VERSION_1_3;

/// An instance of a driver, with these extensions.
pub fn instance(entry: &Entry, extensions: &[&CStr]) -> Result<ash::Instance, String> {
    let names: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
    let application = vk::ApplicationInfo::default().api_version(VERSION);
    let info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_extension_names(&names);
    // SAFETY: all that is pointed at outlives the call.
    unsafe { entry.create_instance(&info, None) }.map_err(|e| format!("no instance: {e}"))
}

/// wgpu has no Vulkan there.
#[cfg(target_vendor = "apple")]
pub fn adapter(_: Entry) -> Result<wgpu::Adapter, String> {
    Err("wgpu runs no driver of Vulkan on this system".to_owned())
}

/// The one adapter of wgpu on a driver.
#[cfg(not(target_vendor = "apple"))]
pub fn adapter(entry: Entry) -> Result<wgpu::Adapter, String> {
    use wgpu::hal::vulkan;
    let flags = wgpu::InstanceFlags::empty();
    let extensions = vulkan::Instance::desired_extensions(&entry, VERSION, flags).map_err(|e| e.to_string())?;
    let raw = instance(&entry, &extensions)?;
    // SAFETY: the instance is made from this entry, with the version, the extensions and the flags that are named, and
    // becomes wgpu's.
    let instance = unsafe {
        let thresholds = wgpu::MemoryBudgetThresholds::default();
        let made = vulkan::Instance::from_raw(entry, raw, VERSION, 0, None, extensions, flags, thresholds, false, None);
        wgpu::Instance::from_hal::<wgpu::hal::api::Vulkan>(made.map_err(|e| e.to_string())?)
    };
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
    adapters.into_iter().next().ok_or_else(|| "no adapter".to_owned())
}
