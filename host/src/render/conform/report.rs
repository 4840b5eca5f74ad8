//! What a run found.

use super::super::storage::Storage;
use super::{HardwareRounding, Projected};
use crate::backend::BackendKind;
use crate::catalogue::Format;
use crate::vulkan::{Device, DeviceInfo, FormatUse, ImageFormat};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The outcome for all codecs.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Device.
    pub device: DeviceInfo,
    /// Random directions for each codec.
    pub random_directions: usize,
    /// False where the build had no GLSL compiler.
    pub glsl_compared: bool,
    /// What the device does besides codecs.
    pub traits: Traits,
    /// True if all rows agree.
    pub agreed: bool,
    /// One row a codec.
    pub rows: Vec<Row>,
}

/// What a device does to normals before and after they are codes.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Traits {
    /// How it rounds what is written to R8G8_SNORM; `None` where that is no attachment.
    pub rounding_8: Option<HardwareRounding>,
    /// The same for A2B10G10R10_SNORM_PACK32.
    pub rounding_10: Option<HardwareRounding>,
    /// The same for R16G16_SNORM.
    pub rounding_16: Option<HardwareRounding>,
    /// Special and random vectors that went from vertex to fragment shader.
    pub interpolated: u64,
    /// Those of which a denormal became zero on the way, or an infinity NaN, as Vulkan allows.
    pub flushed: u64,
    /// Those that changed otherwise; zeros of the other sign and other NaN do not count.
    pub changed: u64,
}

/// The outcome for one codec.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Codec.
    pub id: &'static str,
    /// Its bits.
    pub bits: u32,
    /// The format of attachments that holds its codes.
    pub texel: String,
    /// The format of vertex attributes.
    pub attribute: String,
    /// Formats that the device does not take, and what for.
    pub unsupported: Vec<String>,
    /// By the shaders' source.
    pub checks: BTreeMap<BackendKind, Checks>,
    /// The codec's projection, which the hardware rounds, by the shaders' source; for some codecs.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub projected: BTreeMap<BackendKind, Projected>,
    /// The first differences, in words.
    pub examples: Vec<String>,
}

/// What was compared with the CPU.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Checks {
    /// Codes in an attachment, with those that the CPU encodes the same normals to.
    pub attachment: Tally,
    /// Normals that the lighting pass decodes texels to.
    pub texture: Tally,
    /// Normals that the vertex shader decodes attributes to.
    pub vertex: Tally,
    /// Codes in a picture of the scene.
    pub scene: Tally,
}

/// How many were compared, and how many differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Compared.
    pub compared: u64,
    /// Different.
    pub differing: u64,
}

impl Checks {
    /// All four.
    pub fn all(&self) -> [Tally; 4] {
        [self.attachment, self.texture, self.vertex, self.scene]
    }
}

impl Row {
    /// Differences that are told in words.
    const EXAMPLES: usize = 3;

    /// Texels and vertices whose codes or normals differ from the CPU's, with shaders of this source.
    pub fn differing(&self, source: BackendKind) -> u64 {
        self.checks.get(&source).map_or(0, |checks| checks.all().iter().map(|tally| tally.differing).sum())
    }

    /// Texels and vertices that were compared with the CPU, with shaders of all sources.
    pub fn compared(&self) -> u64 {
        self.checks.values().flat_map(Checks::all).map(|tally| tally.compared).sum()
    }

    /// True where nothing differs but by what the device's rounding explains.
    pub fn agrees(&self) -> bool {
        self.compared() > 0
            && self.checks.keys().all(|source| self.differing(*source) == 0)
            && self.projected.values().all(|projected| projected.unexplained == 0)
    }

    /// Nothing compared yet; codes are drawn to `drawn`.
    pub(super) fn new(device: &Device, format: &Format, drawn: Storage) -> Self {
        let own = Storage::of(format);
        let named = |format: ImageFormat| format!("{format:?}");
        let uses = [
            (own.three().unwrap_or(own.texel()), FormatUse::Attachment),
            (own.texel(), FormatUse::Attachment),
            (own.texel(), FormatUse::Texture),
            (own.attribute(device), FormatUse::Vertex),
        ];
        let lacking = uses.iter().filter(|(format, usage)| !device.supports(*format, *usage));
        let mut unsupported: Vec<String> =
            lacking.map(|(format, usage)| format!("{} {}", named(*format), usage.words())).collect();
        unsupported.dedup();
        if drawn != own && unsupported.is_empty() {
            unsupported.push(format!(
                "{} {}, rounded to nearest",
                named(own.texel()),
                FormatUse::Attachment.words()
            ));
        }
        Self {
            id: format.id,
            bits: format.bits,
            texel: named(drawn.texel()),
            attribute: named(own.attribute(device)),
            unsupported,
            checks: BTreeMap::new(),
            projected: BTreeMap::new(),
            examples: Vec::new(),
        }
    }

    /// Counts where two lists of bytes differ, element by element, and tells the first differences in words.
    pub(super) fn compare(
        &mut self,
        what: &str,
        size: usize,
        cpu: &[u8],
        device: &[u8],
        input: impl Fn(usize) -> String,
    ) -> Tally {
        let pairs = cpu.chunks_exact(size).zip(device.chunks_exact(size));
        let compared = (cpu.len() / size) as u64;
        // Where the device gave fewer, each of those that lack counts.
        let mut differing = compared.abs_diff((device.len() / size) as u64);
        for (at, (cpu, device)) in pairs.enumerate().filter(|(_, (cpu, device))| cpu != device) {
            differing += 1;
            if self.examples.len() < Self::EXAMPLES {
                self.examples.push(format!("{what} of {}: cpu {cpu:02x?}, device {device:02x?}", input(at)));
            }
        }
        Tally { compared, differing }
    }
}
