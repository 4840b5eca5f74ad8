use super::table::{terminal_columns, wrapped};
use super::{Vulkan, print};
use std::fmt::Write;
use std::process::ExitCode;
use unitvec_host::Result;
use unitvec_vulkan::Device;

pub fn run(vulkan: &Vulkan) -> Result<ExitCode> {
    let devices = Device::list(&*vulkan.instance()?)?;
    let chosen = vulkan.choice().choose(&devices)?;
    let mut text = String::new();
    for device in &devices {
        let mark = if device == chosen { "*" } else { " " };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{mark} {}: {} ({:?}), driver {}, Vulkan {}",
            device.index, device.name, device.kind, device.driver, device.api_version
        );
    }
    text += "* is the device that would be used; choose another with --device or UNITVEC_DEVICE\n";
    print(&wrapped(&text, "    ", terminal_columns()?))
}
