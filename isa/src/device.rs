//! The GPU that is not there.
#![expect(
    unsafe_code,
    reason = "Vulkan's functions are foreign; each handle is made, used and destroyed by this crate alone"
)]

use ash::{Entry, Instance, khr, vk};
use std::ffi::CStr;

/// A device of the driver that the environment names.
pub struct Device {
    instance: Instance,
    /// Makes pipelines.
    pub device: ash::Device,
    /// Says what became of them.
    pub properties: khr::pipeline_executable_properties::Device,
    /// The GPU's name and the driver's version.
    pub name: String,
    /// The driver, whose names for figures are its own.
    pub driver: vk::DriverId,
    // Unloads the driver's library when it goes, so it goes last.
    _entry: Entry,
}

impl Device {
    /// Opens the first device.
    pub fn open() -> Result<Device, String> {
        let entry = unsafe { Entry::load() }.map_err(|e| format!("no Vulkan loader: {e}"))?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        let instance = unsafe { entry.create_instance(&info, None) }.map_err(|e| format!("no Vulkan driver: {e}"))?;
        match unsafe { open_device(&instance) } {
            Ok(Opened { device, name, driver }) => Ok(Device {
                properties: khr::pipeline_executable_properties::Device::new(&instance, &device),
                instance,
                device,
                name,
                driver,
                _entry: entry,
            }),
            Err(why) => {
                unsafe { instance.destroy_instance(None) };
                Err(why)
            }
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        unsafe {
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}

/// The first device of the driver.
struct Opened {
    device: ash::Device,
    name: String,
    driver: vk::DriverId,
}

unsafe fn open_device(instance: &Instance) -> Result<Opened, String> {
    let all = unsafe { instance.enumerate_physical_devices() }.map_err(|e| format!("no devices: {e}"))?;
    // GPUs before drivers that run on the processor.
    let is_software = |device: &vk::PhysicalDevice| {
        unsafe { instance.get_physical_device_properties(*device) }.device_type == vk::PhysicalDeviceType::CPU
    };
    let physical = all.into_iter().min_by_key(is_software);
    let physical = physical.ok_or("the driver has no device of this family")?;
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut about = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    unsafe { instance.get_physical_device_properties2(physical, &mut about) };
    let about = about.properties;
    let text = |bytes: &[std::ffi::c_char]| unsafe { CStr::from_ptr(bytes.as_ptr()) }.to_string_lossy().into_owned();
    let name = format!("{} ({})", text(&about.device_name).trim(), text(&driver.driver_info));
    let driver = driver.driver_id;
    let reports_on_shaders = unsafe { instance.enumerate_device_extension_properties(physical) }
        .map_err(|e| format!("{name}: {e}"))?
        .iter()
        .any(|extension| extension.extension_name_as_c_str() == Ok(khr::pipeline_executable_properties::NAME));
    if !reports_on_shaders {
        return Err(format!(
            "{name} does not report on what it compiles: it lacks VK_KHR_pipeline_executable_properties"
        ));
    }

    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(0)
        .queue_priorities(&[1.0])];
    let extensions = [khr::pipeline_executable_properties::NAME.as_ptr()];
    let mut reports =
        vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default().pipeline_executable_info(true);
    // All that the driver has: which of it a shader uses is not this crate's business.
    let (mut v11, mut v12, mut v13) = (
        vk::PhysicalDeviceVulkan11Features::default(),
        vk::PhysicalDeviceVulkan12Features::default(),
        vk::PhysicalDeviceVulkan13Features::default(),
    );
    let mut features = vk::PhysicalDeviceFeatures2::default()
        .push_next(&mut v11)
        .push_next(&mut v12)
        .push_next(&mut v13);
    unsafe { instance.get_physical_device_features2(physical, &mut features) };
    let core = features.features;
    let mut features = vk::PhysicalDeviceFeatures2::default()
        .features(core)
        .push_next(&mut reports);
    // They lie in the chain of the question still.
    (v11.p_next, v12.p_next, v13.p_next) = (std::ptr::null_mut(), std::ptr::null_mut(), std::ptr::null_mut());
    features = features.push_next(&mut v11).push_next(&mut v12).push_next(&mut v13);
    let info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&extensions)
        .push_next(&mut features);
    let device = unsafe { instance.create_device(physical, &info, None) };
    device
        .map(|device| Opened { device, name, driver })
        .map_err(|e| format!("no device: {e}"))
}
