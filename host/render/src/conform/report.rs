//! The report of a run.

use super::super::storage::Storage;
use super::{Conversion, HardwareRounding, Options, Projected};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use unitvec_catalogue::AnyCodec;
use unitvec_run::backend::BackendKind;
use unitvec_vulkan::{Device, DeviceInfo, FormatUse, ImageFormat};

/// The outcome for all codecs.
#[derive(Debug, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Report {
    /// Device.
    pub device: DeviceInfo,
    /// Random directions for each codec.
    pub random_directions: usize,
    /// False where the build had no GLSL compiler.
    pub glsl_compared: bool,
    /// The device's behaviour besides codecs.
    pub traits: Traits,
    /// True if all rows agree.
    pub agreed: bool,
    /// One row a codec.
    pub rows: Vec<Row>,
    /// One row for each projection and format that holds its numbers.
    pub projections: Vec<Row>,
}

impl Report {
    /// Makes the report of a run.
    pub fn new(
        device: &DeviceInfo,
        options: &Options,
        traits: Traits,
        rows: Vec<Row>,
        projections: Vec<Row>,
    ) -> Self {
        Self {
            device: device.clone(),
            random_directions: options.count,
            glsl_compared: super::sources().any(|source| source == BackendKind::Glsl),
            agreed: traits.changed == 0 && rows.iter().chain(&projections).all(Row::agrees),
            traits,
            rows,
            projections,
        }
    }
}

/// A device's effect on normals before and after they are codes.
#[derive(Debug, Default, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Traits {
    /// The device's conversions to and from formats of two numbers.
    pub conversions: Vec<Conversion>,
    /// Special and random vectors that went from vertex to fragment shader.
    pub interpolated: u64,
    /// The number of these of which a denormal became zero on the way, or an infinity NaN, as Vulkan allows.
    pub flushed: u64,
    /// The number of these that changed otherwise; zeros of the other sign and other NaN do not count.
    pub changed: u64,
}

impl Traits {
    /// The device's rounding of values written to a format; `None` where the format is no attachment.
    pub fn rounding(&self, format: ImageFormat) -> Option<HardwareRounding> {
        let name = format!("{format:?}");
        // Formats of four numbers are converted as those of two.
        let name = name.replace("R8G8B8A8", "R8G8").replace("R16G16B16A16", "R16G16");
        self.conversions.iter().find(|conversion| conversion.format == name)?.rounding
    }
}

/// The outcome for one codec, or for one projection in one format.
#[derive(Debug, Default, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Row {
    /// Codec or projection.
    pub id: String,
    /// The codec's bits.
    pub bits: u32,
    /// The format of attachments that holds its codes.
    pub texel: String,
    /// The format of vertex attributes.
    pub attribute: String,
    /// Formats that the device does not support, with their uses.
    pub unsupported: Vec<String>,
    /// The checks by the shaders' source.
    pub checks: BTreeMap<BackendKind, Checks>,
    /// The codec's projection, which the hardware rounds, by the shaders' source; for some codecs.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub projected: BTreeMap<BackendKind, Projected>,
    /// The first differences, in words.
    pub examples: Vec<String>,
}

/// The comparisons with the CPU.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize, schemars::JsonSchema)]
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

/// The numbers of elements compared and of those that differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
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
    /// The number of differences that are described in words.
    const EXAMPLES: usize = 3;

    /// Texels and vertices whose codes or normals differ from the CPU's, with shaders of this source.
    pub fn differing(&self, source: BackendKind) -> u64 {
        self.checks.get(&source).map_or(0, |checks| checks.all().iter().map(|tally| tally.differing).sum())
    }

    /// Texels and vertices that were compared with the CPU, with shaders of all sources.
    pub fn compared(&self) -> u64 {
        self.checks.values().flat_map(Checks::all).map(|tally| tally.compared).sum()
    }

    /// Differences of all sources that the device's rounding does not explain.
    pub fn differences(&self) -> u64 {
        self.checks.keys().map(|source| self.differing(*source)).sum::<u64>()
            + self.projected.values().map(|projected| projected.unexplained).sum::<u64>()
    }

    /// True where the device's rounding explains every difference.
    pub fn agrees(&self) -> bool {
        self.compared() > 0 && self.differences() == 0
    }

    /// A row without comparisons yet; codes are drawn to `drawn`.
    pub(super) fn new(device: &Device, format: &AnyCodec, drawn: Storage) -> Self {
        let own = Storage::of(format);
        let uses = [
            (own.own(), FormatUse::Attachment),
            (own.texel(), FormatUse::Attachment),
            (own.texel(), FormatUse::Texture),
            (own.attribute(device), FormatUse::Vertex),
        ];
        let mut unsupported = lacking(device, &uses);
        unsupported.dedup();
        if drawn != own && unsupported.is_empty() {
            let (texel, drawn) = (own.texel(), FormatUse::Attachment.words());
            unsupported.push(format!("{texel:?} {drawn}, rounded to nearest"));
        }
        let [texel, attribute] = [drawn.texel(), own.attribute(device)].map(|format| format!("{format:?}"));
        let (id, bits) = (format.id.to_owned(), format.bits);
        Self { id, bits, texel, attribute, unsupported, ..Self::default() }
    }

    /// A row without comparisons yet, for numbers in this format.
    pub(super) fn of_format(device: &Device, id: &str, bits: u32, format: ImageFormat) -> Self {
        let name = format!("{format:?}");
        let uses = [FormatUse::Attachment, FormatUse::Texture, FormatUse::Vertex];
        let unsupported = lacking(device, &uses.map(|usage| (format, usage)));
        let (id, texel) = (id.to_owned(), name.clone());
        Self { id, bits, texel, attribute: name, unsupported, ..Self::default() }
    }

    /// Counts where two lists of bytes differ, element by element, and describes the first differences in words.
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
        // Elements that the device did not give count as different.
        let mut differing = compared.abs_diff((device.len() / size) as u64);
        for (at, (cpu, device)) in pairs.enumerate().filter(|(_, (cpu, device))| cpu != device) {
            differing += 1;
            if self.examples.len() < Self::EXAMPLES {
                self.examples.push(format!("{what} of {}: cpu {cpu:02x?}, device {device:02x?}", input(at)));
            }
        }
        Tally { compared, differing }
    }

    /// Counts and describes differences in the normals of codes of this size; all NaN are one.
    pub(super) fn compare_normals(
        &mut self,
        what: &str,
        codes: &[u8],
        size: usize,
        cpu: &[[f32; 3]],
        device: &[[f32; 3]],
    ) -> Tally {
        let bytes = |normals: &[[f32; 3]]| -> Vec<u8> {
            let one_nan = |c: &f32| if c.is_nan() { f32::NAN } else { *c };
            normals.iter().flatten().flat_map(|c| one_nan(c).to_le_bytes()).collect()
        };
        self.compare(what, 12, &bytes(cpu), &bytes(device), |at| {
            format!("{:02x?}", &codes[at * size..][..size])
        })
    }
}

/// The formats that the device does not support for these uses, in words.
fn lacking(device: &Device, uses: &[(ImageFormat, FormatUse)]) -> Vec<String> {
    let lacking = uses.iter().filter(|(format, usage)| !device.supports(*format, *usage));
    lacking.map(|(format, usage)| format!("{format:?} {}", usage.words())).collect()
}
