use super::instance::offers;
use super::kernel::{GROUP, MAX_ELEMENT, WORKGROUP};
use super::memory::{allocator, unified_types};
use super::{Error, Instance, Named};
use ash::{khr, vk};
use gpu_allocator::vulkan::Allocator;
use serde::{Deserialize, Serialize};
use std::ffi::CStr;
use std::ops::Deref;
use std::sync::{Arc, Mutex};

/// Description of a device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct DeviceInfo {
    /// Position in Vulkan's list.
    pub index: usize,
    /// Name.
    pub name: String,
    /// Kind.
    pub kind: DeviceKind,
    /// Driver: its own name and version text.
    pub driver: String,
    /// Vulkan version that it implements.
    pub api_version: String,
}

/// Kinds of device, best first.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum DeviceKind {
    /// A GPU of its own.
    Discrete,
    /// A GPU that shares the host's memory.
    Integrated,
    /// A GPU of a virtual machine.
    Virtual,
    /// Anything else.
    Other,
    /// The CPU: lavapipe, SwiftShader.
    Software,
}

/// Choice of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceChoice {
    /// The first of the best kind there is: real GPUs before software.
    Best,
    /// The device at this position in the list, or with this in its name (any case).
    Named(String),
}

impl DeviceChoice {
    /// The device of `devices` that this chooses.
    ///
    /// # Errors
    /// [`Error::NoDevice`] if there is none at all, [`Error::UnknownDevice`] if none fits.
    pub fn choose<'a>(&self, devices: &'a [DeviceInfo]) -> Result<&'a DeviceInfo, Error> {
        match self {
            Self::Best => devices.iter().min_by_key(|device| device.kind).ok_or(Error::NoDevice),
            Self::Named(_) if devices.is_empty() => Err(Error::NoDevice),
            Self::Named(name) => by_index_or_name(name, devices).ok_or_else(|| Error::UnknownDevice {
                wanted: name.clone(),
                available: devices.iter().map(|device| device.name.clone()).collect(),
            }),
        }
    }
}

fn by_index_or_name<'a>(wanted: &str, devices: &'a [DeviceInfo]) -> Option<&'a DeviceInfo> {
    if let Ok(index) = wanted.parse::<usize>() {
        return devices.get(index);
    }
    // lavapipe calls its device llvmpipe; people call it lavapipe.
    let wanted = match wanted.to_lowercase().as_str() {
        "" => return None,
        "lavapipe" => "llvmpipe".to_owned(),
        other => other.to_owned(),
    };
    devices.iter().find(|device| device.name.to_lowercase().contains(&wanted))
}

/// A logical device with one queue for compute or graphics, and for transfer.
pub struct Device {
    // Dropped before the device, whose memory it frees.
    pub(super) allocator: Mutex<Allocator>,
    pub(super) raw: RawDevice,
    pub(super) physical: vk::PhysicalDevice,
    pub(super) limits: vk::PhysicalDeviceLimits,
    /// The kind of work that the queue does.
    pub(super) work: vk::QueueFlags,
    /// The queue, locked around each use, as Vulkan asks.
    pub(super) queue: Mutex<vk::Queue>,
    pub(super) queue_family: u32,
    /// A bit for each type of memory that is unified.
    pub(super) unified_memory_types: u32,
    /// The meaning of a timestamp; `None` if the queue has none.
    pub(super) timestamps: Option<Timestamps>,
    /// The most vectors of one dispatch, whole groups: by workgroups, and by buffer size.
    pub(super) max_vectors: usize,
    info: DeviceInfo,
    pub(super) instance: Arc<Instance>,
}

/// The functions of a device, which is destroyed when this is dropped.
pub(super) struct RawDevice(ash::Device);

impl Deref for RawDevice {
    type Target = ash::Device;

    fn deref(&self) -> &ash::Device {
        &self.0
    }
}

impl Drop for RawDevice {
    fn drop(&mut self) {
        // SAFETY: buffers, kernels and runners keep an Arc to the `Device` that this is in, so none is left.
        unsafe { self.0.destroy_device(None) };
    }
}

/// Purposes that a device is opened for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    Kernels,
    /// Kernels that are compiled to inspect the compiler's result.
    Statistics,
    Graphics,
}

/// The meaning of a queue's timestamps.
pub(super) struct Timestamps {
    valid: u64,
    /// Nanoseconds a tick.
    period: f64,
}

impl Timestamps {
    fn new(bits: u32, period: f32) -> Self {
        Self { valid: u64::MAX >> (64 - bits.min(64)), period: f64::from(period) }
    }

    /// Nanoseconds from one timestamp to a later one, which may have wrapped around once.
    pub(super) fn elapsed(&self, from: u64, to: u64) -> f64 {
        (to.wrapping_sub(from) & self.valid) as f64 * self.period
    }
}

impl Device {
    /// Opens a device, with no feature turned on: neither the modules nor the GLSL kernels need one.
    ///
    /// # Errors
    /// The errors of [`DeviceChoice::choose`], [`Error::MissingFeature`], or a failed call.
    pub fn open(instance: &Arc<Instance>, choice: &DeviceChoice) -> Result<Arc<Self>, Error> {
        Self::open_with(instance, choice, Purpose::Kernels)
    }

    /// Opens a device whose queue does graphics, with no feature turned on.
    ///
    /// # Errors
    /// The errors of [`open`](Self::open).
    pub fn open_for_graphics(instance: &Arc<Instance>, choice: &DeviceChoice) -> Result<Arc<Self>, Error> {
        Self::open_with(instance, choice, Purpose::Graphics)
    }

    pub(super) fn open_with(
        instance: &Arc<Instance>,
        choice: &DeviceChoice,
        purpose: Purpose,
    ) -> Result<Arc<Self>, Error> {
        let has_statistics = purpose == Purpose::Statistics;
        let devices = Self::list(instance)?;
        let info = choice.choose(&devices)?.clone();
        let physicals = physical_devices(instance)?;
        let physical = physicals[info.index];
        if has_statistics && !offers_statistics(instance, physical)? {
            let mut offering = Vec::new();
            for (device, physical) in devices.iter().zip(&physicals) {
                if offers_statistics(instance, *physical)? {
                    offering.push(device.name.clone());
                }
            }
            return Err(Error::NoStatistics { device: info.name, offering });
        }
        // SAFETY: a query of a physical device of the instance.
        let families = unsafe { instance.raw.get_physical_device_queue_family_properties(physical) };
        let work = purpose.work();
        let (queue_family, timestamp_bits) = queue_family(&families, work, &info)?;

        let priorities = [1.0];
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(queue_family)
            .queue_priorities(&priorities)];
        let extensions = extensions(&offered(instance, physical)?, has_statistics);
        let extensions: Vec<_> = extensions.into_iter().map(CStr::as_ptr).collect();
        let mut features = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        let mut create =
            vk::DeviceCreateInfo::default().queue_create_infos(&queues).enabled_extension_names(&extensions);
        if has_statistics {
            create = create.push_next(&mut features);
        }
        // SAFETY: the physical device is the instance's; the queue family, the extensions and the feature are ones it has.
        let raw = unsafe { instance.raw.create_device(physical, &create, None) };
        let raw = RawDevice(raw.named("vkCreateDevice")?);
        // SAFETY: the device was created with one queue of this family.
        let queue = unsafe { raw.get_device_queue(queue_family, 0) };
        // SAFETY: queries of a physical device of the instance.
        let (memory, limits) = unsafe {
            (
                instance.raw.get_physical_device_memory_properties(physical),
                instance.raw.get_physical_device_properties(physical).limits,
            )
        };
        let timestamps =
            (timestamp_bits > 0).then(|| Timestamps::new(timestamp_bits, limits.timestamp_period));
        let max_vectors = (limits.max_compute_work_group_count[0] as usize)
            .saturating_mul(GROUP * WORKGROUP)
            .min(limits.max_storage_buffer_range as usize / (GROUP * MAX_ELEMENT) * GROUP);
        let queue = Mutex::new(queue);
        Ok(Arc::new(Self {
            allocator: allocator(&instance.raw, physical, &raw)?,
            raw,
            physical,
            limits,
            work,
            queue,
            queue_family,
            unified_memory_types: unified_types(&memory),
            timestamps,
            max_vectors,
            info,
            instance: instance.clone(),
        }))
    }

    /// All devices, in Vulkan's order.
    ///
    /// # Errors
    /// A failed call.
    pub fn list(instance: &Instance) -> Result<Vec<DeviceInfo>, Error> {
        let devices = physical_devices(instance)?;
        Ok(devices.into_iter().enumerate().map(|(index, device)| describe(instance, index, device)).collect())
    }

    /// Description of this device.
    pub fn info(&self) -> &DeviceInfo {
        &self.info
    }

    /// The instance it belongs to.
    pub fn instance(&self) -> &Arc<Instance> {
        &self.instance
    }
}

fn physical_devices(instance: &Instance) -> Result<Vec<vk::PhysicalDevice>, Error> {
    // SAFETY: a query of a live instance.
    match unsafe { instance.raw.enumerate_physical_devices() } {
        Err(vk::Result::ERROR_INITIALIZATION_FAILED | vk::Result::ERROR_INCOMPATIBLE_DRIVER) => {
            Err(Error::NoDevice)
        }
        result => result.named("vkEnumeratePhysicalDevices"),
    }
}

/// The extensions that a device has.
fn offered(instance: &Instance, device: vk::PhysicalDevice) -> Result<Vec<vk::ExtensionProperties>, Error> {
    // SAFETY: a query of a physical device of the instance.
    unsafe { instance.raw.enumerate_device_extension_properties(device) }
        .named("vkEnumerateDeviceExtensionProperties")
}

/// The extensions to enable. Vulkan demands the first where a device has it: one that lacks parts of Vulkan.
fn extensions(offered: &[vk::ExtensionProperties], has_statistics: bool) -> Vec<&'static CStr> {
    let portability = khr::portability_subset::NAME;
    let mut names: Vec<_> = offers(offered, portability).then_some(portability).into_iter().collect();
    names.extend(has_statistics.then_some(khr::pipeline_executable_properties::NAME));
    names
}

/// True where the device has VK_KHR_pipeline_executable_properties.
fn offers_statistics(instance: &Instance, device: vk::PhysicalDevice) -> Result<bool, Error> {
    if !offers(&offered(instance, device)?, khr::pipeline_executable_properties::NAME) {
        return Ok(false);
    }
    let mut statistics = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut statistics);
    // SAFETY: as above; the device knows the chained struct, which is its extension's.
    unsafe { instance.raw.get_physical_device_features2(device, &mut features) };
    Ok(statistics.pipeline_executable_info == vk::TRUE)
}

fn describe(instance: &Instance, index: usize, device: vk::PhysicalDevice) -> DeviceInfo {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: the device is the instance's; a driver skips a chained struct that it does not know.
    unsafe { instance.raw.get_physical_device_properties2(device, &mut properties) };
    let properties = properties.properties;
    let text = |name: Result<&std::ffi::CStr, _>| {
        name.map_or_else(|_| String::new(), |s| s.to_string_lossy().into_owned())
    };
    let version = properties.api_version;
    let (driver_name, driver_info) = (driver.driver_name_as_c_str(), driver.driver_info_as_c_str());
    DeviceInfo {
        index,
        name: text(properties.device_name_as_c_str()),
        kind: kind(properties.device_type),
        // SwiftShader's info is empty.
        driver: format!("{} {}", text(driver_name), text(driver_info)).trim().to_owned(),
        api_version: format!(
            "{}.{}.{}",
            vk::api_version_major(version),
            vk::api_version_minor(version),
            vk::api_version_patch(version)
        ),
    }
}

fn kind(device_type: vk::PhysicalDeviceType) -> DeviceKind {
    match device_type {
        vk::PhysicalDeviceType::DISCRETE_GPU => DeviceKind::Discrete,
        vk::PhysicalDeviceType::INTEGRATED_GPU => DeviceKind::Integrated,
        vk::PhysicalDeviceType::VIRTUAL_GPU => DeviceKind::Virtual,
        vk::PhysicalDeviceType::CPU => DeviceKind::Software,
        _ => DeviceKind::Other,
    }
}

impl Purpose {
    /// The kind of work that the queue does.
    fn work(self) -> vk::QueueFlags {
        match self {
            Self::Kernels | Self::Statistics => vk::QueueFlags::COMPUTE,
            Self::Graphics => vk::QueueFlags::GRAPHICS,
        }
    }
}

/// The first queue family that does this work, and the valid bits of its timestamps.
fn queue_family(
    families: &[vk::QueueFamilyProperties],
    work: vk::QueueFlags,
    info: &DeviceInfo,
) -> Result<(u32, u32), Error> {
    let mut families = families.iter().zip(0..);
    let found = families.find(|(family, _)| family.queue_flags.contains(work));
    found.map(|(family, index)| (index, family.timestamp_valid_bits)).ok_or_else(|| Error::MissingFeature {
        device: info.name.clone(),
        feature: if work == vk::QueueFlags::GRAPHICS { "a graphics queue" } else { "a compute queue" },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(index: usize, name: &str, kind: DeviceKind) -> DeviceInfo {
        DeviceInfo { index, name: name.into(), kind, driver: String::new(), api_version: String::new() }
    }

    fn three() -> Vec<DeviceInfo> {
        vec![
            device(0, "llvmpipe (LLVM 15.0.6, 256 bits)", DeviceKind::Software),
            device(1, "Some Integrated GPU", DeviceKind::Integrated),
            device(2, "Some Discrete GPU", DeviceKind::Discrete),
        ]
    }

    #[test]
    fn real_gpus_come_before_software() {
        assert_eq!(DeviceChoice::Best.choose(&three()).map(|device| device.index).ok(), Some(2));
        assert_eq!(DeviceChoice::Best.choose(&three()[..1]).map(|device| device.index).ok(), Some(0));
        assert!(matches!(DeviceChoice::Best.choose(&[]), Err(Error::NoDevice)));
    }

    #[test]
    fn a_device_is_named_by_index_or_part_of_its_name() {
        let devices = three();
        let choose =
            |name: &str| DeviceChoice::Named(name.into()).choose(&devices).map(|device| device.index).ok();
        assert_eq!(choose("1"), Some(1));
        assert_eq!(choose("discrete"), Some(2));
        assert_eq!(choose("lavapipe"), Some(0));
        assert_eq!(choose("3"), None);
        assert_eq!(choose("voodoo"), None);
        assert_eq!(choose(""), None);
    }

    #[test]
    fn what_a_device_lacks_is_admitted() {
        let (portability, statistics) =
            (khr::portability_subset::NAME, khr::pipeline_executable_properties::NAME);
        let offered = [vk::ExtensionProperties::default().extension_name(portability).unwrap()];
        assert_eq!(extensions(&offered, false), [portability]);
        assert_eq!(extensions(&offered, true), [portability, statistics]);
        assert!(extensions(&[], false).is_empty());
    }

    /// A device that only computes runs kernels and draws nothing; one that does both in different families draws in the
    /// second.
    #[test]
    fn the_queue_does_what_the_device_is_opened_for() {
        let family = |flags| vk::QueueFamilyProperties::default().queue_flags(flags).timestamp_valid_bits(36);
        let computing = family(vk::QueueFlags::COMPUTE | vk::QueueFlags::TRANSFER);
        let drawing = family(vk::QueueFlags::GRAPHICS | vk::QueueFlags::TRANSFER);
        let info = device(0, "Accelerator", DeviceKind::Other);
        let choose = |families: &[_], purpose: Purpose| queue_family(families, purpose.work(), &info);

        assert_eq!(choose(&[computing], Purpose::Kernels).ok(), Some((0, 36)));
        assert_eq!(choose(&[computing, drawing], Purpose::Graphics).ok(), Some((1, 36)));
        let error = choose(&[computing], Purpose::Graphics).unwrap_err().to_string();
        assert!(error.contains("`Accelerator` lacks a graphics queue"), "{error}");
        let error = choose(&[drawing], Purpose::Kernels).unwrap_err().to_string();
        assert!(error.contains("lacks a compute queue"), "{error}");
    }
}
