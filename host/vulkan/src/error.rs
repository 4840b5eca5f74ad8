use ash::vk;

/// The way to install the loader, a driver or the validation layer on this system.
const LOADER: &str = on(
    "Debian: apt-get install libvulkan1 mesa-vulkan-drivers",
    "the GPU's driver has it",
    "brew install vulkan-loader molten-vk, or the Vulkan SDK",
);
const DRIVER: &str = on(
    "Debian: apt-get install mesa-vulkan-drivers",
    "from the GPU's vendor",
    "brew install molten-vk, or the Vulkan SDK",
);
const LAYER: &str = on(
    "Debian: apt-get install vulkan-validationlayers",
    "the Vulkan SDK has it",
    "brew install vulkan-validationlayers, or the Vulkan SDK",
);

/// The words for the system that this is built for.
const fn on(linux: &'static str, windows: &'static str, mac: &'static str) -> &'static str {
    if cfg!(windows) {
        windows
    } else if cfg!(target_os = "macos") {
        mac
    } else {
        linux
    }
}

/// Failures between the program and a Vulkan device.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The Vulkan loader is missing.
    #[error(
        "the Vulkan loader {library} cannot be loaded ({reason}); install it ({LOADER}) or name one in \
         UNITVEC_VULKAN_LOADER"
    )]
    NoLoader {
        /// Library that was tried.
        library: String,
        /// The dynamic linker's words.
        reason: String,
    },
    /// There is a loader, but no device behind it.
    #[error(
        "no Vulkan device: no driver was found; install one ({DRIVER}) and check VK_DRIVER_FILES and VK_ICD_FILENAMES"
    )]
    NoDevice,
    /// No device has this name or index.
    #[error("no Vulkan device is called `{wanted}`; there are: {}", list(.available))]
    UnknownDevice {
        /// Name or index that was asked for.
        wanted: String,
        /// Names of the devices there are.
        available: Vec<String>,
    },
    /// The device lacks something that the kernels or the renderer need.
    #[error("device `{device}` lacks {feature}, which this needs; choose another with --device")]
    MissingFeature {
        /// Device name.
        device: String,
        /// Feature or limit.
        feature: &'static str,
    },
    /// The device does not report its compiler's statistics of kernels.
    #[error(
        "device `{device}` does not tell what its compiler makes of kernels (it lacks VK_KHR_pipeline_executable_properties); \
         {}ask a compiler of Mesa's, which needs no GPU, with --gpu navi21",
        or_one_of(.offering)
    )]
    NoStatistics {
        /// Device name.
        device: String,
        /// Names of the devices that do.
        offering: Vec<String>,
    },
    /// Validation was asked for and is not installed.
    #[error("the validation layer VK_LAYER_KHRONOS_validation is not installed ({LAYER})")]
    NoValidationLayer,
    /// A SPIR-V module is not made of whole words.
    #[error(
        "the SPIR-V of `{entry_point}` is not a module: {reason}; `cargo xtask spirv` rebuilds the modules"
    )]
    NotSpirv {
        /// Entry point sought.
        entry_point: String,
        /// Fault of the module.
        reason: String,
    },
    /// More vectors than a dispatch takes.
    #[error("a dispatch takes 1 to {limit} vectors, not {vectors}")]
    BadCount {
        /// Vectors asked for.
        vectors: usize,
        /// The most a dispatch takes.
        limit: usize,
    },
    /// The device does not take a format for this.
    #[error("device `{device}` does not take {format} {usage}; choose another with --device")]
    UnsupportedFormat {
        /// Device name.
        device: String,
        /// The format's name in Vulkan.
        format: String,
        /// Use of the format: `as a colour attachment`.
        usage: &'static str,
    },
    /// A picture beyond the device's limits.
    #[error(
        "device `{device}` draws 1 x 1 to {limit} x {limit} pixels, not {width} x {height}; choose another size"
    )]
    BadSize {
        /// Device name.
        device: String,
        /// Pixels asked for.
        width: u32,
        /// Pixels asked for.
        height: u32,
        /// The most of either.
        limit: u32,
    },
    /// Parts of a drawing do not fit together: a fault of the caller.
    #[error("this cannot be drawn: {reason}")]
    BadDraw {
        /// Reason why they do not fit.
        reason: &'static str,
    },
    /// A kernel or a table was made by another runner.
    #[error("a kernel and its table work only with the runner that made them; make them again with this one")]
    ForeignKernel,
    /// A Vulkan call failed.
    #[error("Vulkan call {call} failed: {result}")]
    Call {
        /// Name of the call.
        call: &'static str,
        /// Result that it returned.
        result: vk::Result,
    },
}

fn or_one_of(names: &[String]) -> String {
    if names.is_empty() {
        String::new()
    } else {
        format!("--device can name one that does ({}), or ", names.join(", "))
    }
}

fn list(names: &[String]) -> String {
    names.iter().enumerate().map(|(index, name)| format!("{index}: {name}")).collect::<Vec<_>>().join(", ")
}
