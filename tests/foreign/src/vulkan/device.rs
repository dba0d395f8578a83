//! The device of a driver.
#![expect(unsafe_code, reason = "Vulkan's functions are foreign")]

use super::Driver;
use crate::open;
use ash::{Instance, vk};
use std::ffi::CStr;

/// A driver's only device, with all of its features except robust access.
pub struct Device {
    instance: Instance,
    pub(super) device: ash::Device,
    pub(super) queue: vk::Queue,
    pub(super) memory: vk::PhysicalDeviceMemoryProperties,
    name: String,
}

impl Device {
    /// Opens the device of a driver.
    ///
    /// # Errors
    ///
    /// The driver is not installed, or has no device.
    pub fn open(driver: Driver) -> Result<Device, String> {
        let entry = driver.entry()?;
        let instance = open::instance(&entry, &[])?;
        // SAFETY: the instance is new.
        match unsafe { opened(&instance) } {
            Ok((device, memory, name)) => Ok(Device {
                // SAFETY: the device was made with a queue of this family.
                queue: unsafe { device.get_device_queue(0, 0) },
                instance,
                device,
                memory,
                name,
            }),
            Err(why) => {
                // SAFETY: nothing of it is in use.
                unsafe { instance.destroy_instance(None) };
                Err(format!("{driver}: {why}"))
            }
        }
    }

    /// The device's name, as the driver has it.
    pub fn name(&self) -> &str {
        &self.name
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: each dispatch waits for its end and destroys what it made.
        unsafe {
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}

type Opened = (ash::Device, vk::PhysicalDeviceMemoryProperties, String);

unsafe fn opened(instance: &Instance) -> Result<Opened, String> {
    // SAFETY: the instance is there, and all that is pointed at outlives the calls.
    unsafe {
        let all = instance.enumerate_physical_devices().map_err(|e| e.to_string())?;
        let physical = *all.first().ok_or("no device")?;
        let about = instance.get_physical_device_properties(physical);
        let name = CStr::from_ptr(about.device_name.as_ptr())
            .to_string_lossy()
            .into_owned();
        let families = instance.get_physical_device_queue_family_properties(physical);
        if !families
            .first()
            .is_some_and(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE))
        {
            return Err("its first queues compute nothing".to_owned());
        }
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(0)
            .queue_priorities(&[1.0])];
        let mut features = instance.get_physical_device_features(physical);
        // Hosts need not enable it, and the emitted texts read within bounds.
        features.robust_buffer_access = vk::FALSE;
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_features(&features);
        let device = instance
            .create_device(physical, &info, None)
            .map_err(|e| e.to_string())?;
        Ok((device, instance.get_physical_device_memory_properties(physical), name))
    }
}
