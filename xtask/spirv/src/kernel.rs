//! What a kernel is, by the name that rust-gpu gives its entry point.

use anyhow::{Context, Result};
use unitvec_catalogue::{AnyCodec, CODECS, Operation};
use unitvec_manifest::{ARITHMETIC, DECODE_BY_TABLE};

/// Stands for a codec in the names of the kernels that measure what the others do besides encoding or decoding.
const BASELINE: &str = "baseline";

/// The kernels besides those of codecs. Both decode.
const OF_NO_CODEC: [&str; 2] = [DECODE_BY_TABLE, ARITHMETIC];

/// A kernel.
#[derive(Debug)]
pub struct Kernel {
    /// Its entry point's name in the module: `oct16_encode`, `oct16_encode_cost`.
    pub name: String,
    /// The codec, if it belongs to one. [`BASELINE`] and [`OF_NO_CODEC`] belong to none.
    pub codec: Option<&'static AnyCodec>,
    /// What it does.
    pub operation: Operation,
    /// True of those that measure arithmetic.
    is_cost: bool,
}

impl Kernel {
    /// The kernel with this entry point: `kernels::oct16::encode` or `oct16_encode`.
    pub fn of_entry_point(entry_point: &str) -> Result<Self> {
        let name = name_of_path(entry_point);
        if OF_NO_CODEC.contains(&&*name) {
            return Ok(Self { name, codec: None, operation: Operation::Decode, is_cost: false });
        }
        let (function, is_cost) = name.strip_suffix("_cost").map_or((&*name, false), |name| (name, true));
        let of_operation = |operation| {
            let id = function.strip_suffix(&format!("_{operation}"))?;
            let codec = CODECS.iter().find(|codec| codec.id == id);
            (codec.is_some() || (id == BASELINE && is_cost)).then_some((codec, operation))
        };
        let (codec, operation) = Operation::ALL
            .into_iter()
            .find_map(of_operation)
            .with_context(|| format!("entry point {entry_point} belongs to no codec of the catalogue"))?;
        Ok(Self { codec, operation, is_cost, name })
    }

    /// Path, in `spirv/`, of the module that it is part of. Kernels that measure lie in a folder of their own, a module each.
    pub fn file(&self) -> String {
        match self.codec {
            _ if self.is_cost => format!("{}.spv", self.name),
            Some(codec) => format!("kernels/{}.spv", codec.id),
            None => format!("kernels/{}.spv", self.name),
        }
    }

    /// True of those that look up lengths in the table of [`unitvec::best_fit`].
    pub fn encodes_by_table(&self) -> bool {
        self.operation == Operation::Encode && self.codec.is_some_and(|codec| codec.encodes_by_table)
    }
}

/// `oct16_encode` of `kernels::oct16::encode`; what is no path stays.
pub fn name_of_path(entry_point: &str) -> String {
    let mut parts = entry_point.rsplit("::");
    match (parts.next(), parts.next()) {
        (Some(function), Some(module)) if !OF_NO_CODEC.contains(&function) => format!("{module}_{function}"),
        (Some(function), _) => function.to_owned(),
        (None, _) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entry_points_are_named_after_codec_and_operation() {
        for (entry_point, name, file) in [
            ("kernels::oct16::encode", "oct16_encode", "kernels/oct16.spv"),
            ("oct16_decode", "oct16_decode", "kernels/oct16.spv"),
            ("kernels::frames::frame32::decode", "frame32_decode", "kernels/frame32.spv"),
            (
                "kernels::snorm8x3_nearest::encode_cost",
                "snorm8x3_nearest_encode_cost",
                "snorm8x3_nearest_encode_cost.spv",
            ),
            ("kernels::baseline::decode_cost", "baseline_decode_cost", "baseline_decode_cost.spv"),
            ("kernels::decode_by_table", "decode_by_table", "kernels/decode_by_table.spv"),
            ("decode_by_table", "decode_by_table", "kernels/decode_by_table.spv"),
            ("kernels::convert::arithmetic", "arithmetic", "kernels/arithmetic.spv"),
        ] {
            let kernel = Kernel::of_entry_point(entry_point).unwrap();
            assert_eq!((kernel.name.as_str(), kernel.file().as_str()), (name, file));
        }
    }

    #[test]
    fn entry_points_of_no_codec_are_refused() {
        for entry_point in
            ["oct15_encode", "kernels::oct16::transcode", "oct16", "baseline_encode", "encode", ""]
        {
            let error = Kernel::of_entry_point(entry_point).unwrap_err();
            assert!(error.to_string().contains("belongs to no codec"), "{entry_point}: {error}");
        }
    }
}
