use super::{Error, Named};
use ash::{Entry, ext, khr, vk};
use std::ffi::{CStr, c_void};
use std::sync::{Mutex, PoisonError};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Further places of a loader, or of MoltenVK, which serves without one. macOS looks into none of Homebrew's folders by itself.
const OTHER_LOADERS: &[&str] = if cfg!(target_os = "macos") {
    &[
        "/opt/homebrew/lib/libvulkan.dylib",
        "/usr/local/lib/libvulkan.dylib",
        "libMoltenVK.dylib",
        "/opt/homebrew/lib/libMoltenVK.dylib",
        "/usr/local/lib/libMoltenVK.dylib",
    ]
} else {
    &[]
};

/// A Vulkan instance, with the validation layer's messages collected where that was asked for.
pub struct Instance {
    pub(super) raw: ash::Instance,
    validation: Option<Validation>,
    // Keeps the loader's library open for as long as its functions are in use.
    _entry: Entry,
}

struct Validation {
    functions: ext::debug_utils::Instance,
    messenger: vk::DebugUtilsMessengerEXT,
    // Boxed, since the messenger holds its address.
    messages: Box<Mutex<Vec<String>>>,
}

impl Instance {
    /// Loads Vulkan and creates an instance. `loader` names another loader library than the system's.
    ///
    /// # Errors
    /// [`Error::NoLoader`], [`Error::NoDevice`] (the loader finds no driver), [`Error::NoValidationLayer`] or a
    /// failed call.
    pub fn new(loader: Option<&str>, validate: bool) -> Result<Self, Error> {
        let entry = load(loader)?;
        if validate && !has_validation_layer(&entry)? {
            return Err(Error::NoValidationLayer);
        }
        let layers = [VALIDATION_LAYER.as_ptr()];
        // SAFETY: a query without preconditions.
        let offered = unsafe { entry.enumerate_instance_extension_properties(None) }
            .named("vkEnumerateInstanceExtensionProperties")?;
        let (extensions, flags) = extensions(&offered, validate);
        let extensions: Vec<_> = extensions.into_iter().map(CStr::as_ptr).collect();
        let features = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut validation_features =
            vk::ValidationFeaturesEXT::default().enabled_validation_features(&features);
        let application =
            vk::ApplicationInfo::default().application_name(c"unitvec").api_version(vk::API_VERSION_1_1);
        let mut create = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .flags(flags)
            .enabled_extension_names(&extensions);
        if validate {
            create = create.enabled_layer_names(&layers).push_next(&mut validation_features);
        }
        // SAFETY: `create` and all it points to outlive the call.
        let raw = match unsafe { entry.create_instance(&create, None) } {
            Err(vk::Result::ERROR_INCOMPATIBLE_DRIVER) => return Err(Error::NoDevice),
            result => result.named("vkCreateInstance")?,
        };
        let mut instance = Self { raw, validation: None, _entry: entry };
        if validate {
            instance.validation = Some(Validation::new(&instance)?);
        }
        Ok(instance)
    }

    /// Messages of the validation layer so far, warnings included; none without validation.
    pub fn validation_messages(&self) -> Vec<String> {
        self.validation.as_ref().map_or_else(Vec::new, |validation| {
            validation.messages.lock().unwrap_or_else(PoisonError::into_inner).clone()
        })
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Some(validation) = self.validation.take() {
            // SAFETY: the messenger is this instance's and is destroyed once.
            unsafe { validation.functions.destroy_debug_utils_messenger(validation.messenger, None) };
        }
        // SAFETY: everything made from the instance keeps an Arc to it, so nothing is left.
        unsafe { self.raw.destroy_instance(None) };
    }
}

impl Validation {
    fn new(instance: &Instance) -> Result<Self, Error> {
        let functions = ext::debug_utils::Instance::new(&instance._entry, &instance.raw);
        let messages = Box::new(Mutex::new(Vec::new()));
        let user_data: *const Mutex<Vec<String>> = &raw const *messages;
        let create = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
            )
            .message_type(
                vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                    | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
            )
            .pfn_user_callback(Some(collect))
            .user_data(user_data.cast_mut().cast());
        // SAFETY: `create` outlives the call; the user data lives as long as the messenger, in the same struct.
        let messenger = unsafe { functions.create_debug_utils_messenger(&create, None) }
            .named("vkCreateDebugUtilsMessengerEXT")?;
        Ok(Self { functions, messenger, messages })
    }
}

/// Appends a message to the list that `user_data` points to.
unsafe extern "system" fn collect(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _type: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: Vulkan passes valid callback data and the user data given at creation, a Mutex<Vec<String>>.
    let (message, messages) =
        unsafe { ((*data).message_as_c_str(), &*user_data.cast::<Mutex<Vec<String>>>()) };
    let text =
        message.map_or_else(|| "message without text".into(), |text| text.to_string_lossy().into_owned());
    messages.lock().unwrap_or_else(PoisonError::into_inner).push(text);
    vk::FALSE
}

fn load(loader: Option<&str>) -> Result<Entry, Error> {
    let library = loader.unwrap_or("of the system");
    // SAFETY: loading a Vulkan loader runs its initialisers, which have no preconditions; the library is the system's
    // own or the one the user named.
    let load_from = |library: &&str| unsafe { Entry::load_from(*library) };
    let loaded = match &loader {
        Some(library) => load_from(library),
        // SAFETY: as above.
        None => OTHER_LOADERS.iter().fold(unsafe { Entry::load() }, |found, library| {
            found.or_else(|first| load_from(library).map_err(|_| first))
        }),
    };
    loaded.map_err(|error| Error::NoLoader { library: library.to_owned(), reason: error.to_string() })
}

/// True where an extension is among those offered.
pub(super) fn offers(offered: &[vk::ExtensionProperties], name: &CStr) -> bool {
    offered.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name))
}

/// The extensions of an instance, and its flags. Loaders hide devices that lack parts of Vulkan, such as those of MoltenVK, from
/// programs that do not ask for them.
fn extensions(
    offered: &[vk::ExtensionProperties],
    validate: bool,
) -> (Vec<&'static CStr>, vk::InstanceCreateFlags) {
    let mut names = Vec::new();
    let mut flags = vk::InstanceCreateFlags::empty();
    if offers(offered, khr::portability_enumeration::NAME) {
        names.push(khr::portability_enumeration::NAME);
        flags = vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR;
    }
    if validate {
        names.push(ext::debug_utils::NAME);
    }
    (names, flags)
}

fn has_validation_layer(entry: &Entry) -> Result<bool, Error> {
    // SAFETY: a query without preconditions.
    let layers =
        unsafe { entry.enumerate_instance_layer_properties() }.named("vkEnumerateInstanceLayerProperties")?;
    Ok(layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_that_lack_parts_are_asked_for_where_they_can_be() {
        let portability = khr::portability_enumeration::NAME;
        let offered = [vk::ExtensionProperties::default().extension_name(portability).unwrap()];
        let debug = ext::debug_utils::NAME;
        let flags = vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR;
        assert_eq!(extensions(&offered, true), (vec![portability, debug], flags));
        assert_eq!(extensions(&offered, false), (vec![portability], flags));
        assert_eq!(extensions(&[], true), (vec![debug], vk::InstanceCreateFlags::empty()));
    }
}
