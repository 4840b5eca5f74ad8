//! Codes in texels.

use crate::block::{Compression, compress, decompress};
use crate::format::{Format, field, named};
use crate::{Error, NormalMap, Pair, Result};
use rayon::prelude::*;
use unitvec_catalogue::AnyCodec;

/// The codes of a codec of vectors, in the texels of a format.
#[derive(Clone, Copy, Debug)]
pub struct Coding {
    /// Codec.
    pub codec: &'static AnyCodec,
    /// The format of the texels.
    pub format: &'static Format,
    /// The integer that is added to those of both channels, so that snorms become unorms: they lie in 0 to twice this.
    bias: u32,
    /// The first bit, and the number of the bits, that hold alpha.
    spare: Option<(u32, u32)>,
    /// What compressed blocks hold.
    blocks: Option<(Pair, Compression)>,
}

impl Coding {
    /// The coding of a codec: its own format; with a channel for alpha where that has three; an integer format where there is
    /// none, or where its channels are no numbers to be filtered. With `unorm`, two snorms as unorms, whose axes stay exact: see
    /// `octn_to_unorm` of `oct.glsl`.
    ///
    /// # Errors
    /// [`Error::Codec`] where there are no two snorms.
    pub fn of(codec: &'static AnyCodec, unorm: bool) -> Result<Self> {
        let own = codec.vk_format.map(|name| name.trim_start_matches("VK_FORMAT_"));
        let (name, spare) = match own {
            Some("R8G8_SNORM") if unorm => ("R8G8_UNORM", None),
            Some("R16G16_SNORM") if unorm => ("R16G16_UNORM", None),
            _ if unorm => {
                let what =
                    "does not lie in two SNORM channels; leave --unorm out, or take hemioct16 or oct16p";
                return Err(Error::Codec { codec: codec.id, what: what.to_owned() });
            }
            Some("R8G8B8_UNORM") if !codec.is_unit => ("R8G8B8A8_UNORM", Some((24, 8))),
            Some("R8G8B8_SNORM") if !codec.is_unit => ("R8G8B8A8_SNORM", Some((24, 8))),
            Some("R16G16B16_SNORM") => ("R16G16B16A16_SNORM", Some((48, 16))),
            Some("R16G16B16_SFLOAT") => ("R16G16B16A16_SFLOAT", Some((48, 16))),
            Some(own) if codec.bytes != 3 && named(own).is_some() => (own, None),
            _ if codec.id == "uoct20p" => ("A2B10G10R10_UNORM_PACK32", Some((20, 10))),
            _ => match codec.bytes {
                1 => ("R8_UINT", None),
                2 => ("R16_UINT", None),
                3 => ("R32_UINT", Some((24, 8))),
                4 => ("R32_UINT", None),
                bytes => ("R32G32_UINT", (bytes < 8).then_some((8 * bytes as u32, 8))),
            },
        };
        let Some(format) = named(name) else { unreachable!("a test names the format of each codec") };
        let bias = if unorm { (1 << (format.bits[0] - 1)) - 1 } else { 0 };
        Ok(Self { codec, format, bias, spare, blocks: None })
    }

    /// The coding of a codec's two channels, whatever their width, in compressed blocks.
    ///
    /// # Errors
    /// [`Error::Codec`] for families other than `oct`, `hemioct` and `xyonly`.
    pub fn compressed(codec: &'static AnyCodec, compression: Compression) -> Result<Self> {
        let pair = match codec.id.trim_end_matches(|c: char| c.is_ascii_digit() || c == 'p') {
            "oct" => Pair::Oct,
            "hemioct" => Pair::Hemioct,
            "xyonly" => Pair::Xy,
            _ => {
                let what = "is not made for compression; take hemioct16, xyonly16 or oct16".to_owned();
                return Err(Error::Codec { codec: codec.id, what });
            }
        };
        let Some(format) = named(compression.name()) else { unreachable!("a test compresses to each") };
        Ok(Self { codec, format, bias: 0, spare: None, blocks: Some((pair, compression)) })
    }

    /// The coding that a file in this format has of the codec, if it can have one.
    pub fn reading(codec: &'static AnyCodec, format: &Format) -> Option<Self> {
        let texels = [false, true].into_iter().map(|unorm| Self::of(codec, unorm));
        let blocks = Compression::ALL.map(|compression| Self::compressed(codec, compression));
        texels.chain(blocks).flatten().find(|coding| coding.format.vulkan == format.vulkan)
    }

    /// True where texels have room for alpha.
    pub fn has_alpha(&self) -> bool {
        self.spare.is_some()
    }

    /// The texels of a map. Where they have room for alpha and the map has none, it is 1.
    pub fn pack(&self, map: &NormalMap) -> Vec<u8> {
        if let Some((pair, compression)) = self.blocks {
            return compress(&map.vectors, map.width, map.height, pair, compression);
        }
        let bytes = self.format.bytes();
        let mut texels = vec![0; bytes * map.vectors.len()];
        let pairs = texels.par_chunks_exact_mut(bytes).zip(&map.vectors).enumerate();
        pairs.for_each(|(at, (texel, vector))| {
            let alpha = map.alpha.as_ref().map_or(1.0, |alpha| alpha[at]);
            texel.copy_from_slice(&self.texel(*vector, alpha).to_le_bytes()[..bytes]);
        });
        texels
    }

    fn texel(&self, vector: [f32; 3], alpha: f32) -> u64 {
        let [low, high] = self.codec.encode_one(vector).map(u64::from);
        let code = self.each_channel(low | high << 32, |snorm, bias| (snorm + bias).max(0));
        let alpha =
            self.spare.map_or(0, |(first, bits)| u64::from(self.format.field_of(alpha, bits)) << first);
        code | alpha
    }

    /// The vectors of texels, and their alpha where there is any and it is not 1 throughout.
    pub fn unpack(&self, texels: &[u8], width: u32, height: u32) -> NormalMap {
        if let Some((pair, compression)) = self.blocks {
            let vectors = decompress(texels, width, height, pair, compression).unwrap_or_default();
            return NormalMap { width, height, vectors, alpha: None };
        }
        let chunks = texels.par_chunks_exact(self.format.bytes());
        let vectors = chunks.clone().map(|texel| {
            let code = u64::from(field(texel, 0, 32)) | u64::from(field(texel, 32, 32)) << 32;
            let code = self.each_channel(code, |unorm, bias| (unorm & (2 * bias + 1)).min(2 * bias) - bias);
            self.codec.decode_one([code as u32, (code >> 32) as u32])
        });
        let alpha = self.spare.map(|(first, bits)| {
            chunks.map(|texel| self.format.number(field(texel, first, bits), bits)).collect()
        });
        NormalMap { width, height, vectors: vectors.collect(), alpha }.without_opaque_alpha()
    }

    /// A code, or that of two channels whose integers, which come with their signs, and the bias make others.
    fn each_channel(&self, code: u64, of: impl Fn(i64, i64) -> i64) -> u64 {
        if self.bias == 0 {
            return code;
        }
        let bits = self.format.bits[0];
        let signed = |channel: u64| ((channel << (64 - bits)) as i64) >> (64 - bits);
        let [x, y] = [code, code >> bits].map(|channel| of(signed(channel), self.bias.into()) as u64);
        x & ((1 << bits) - 1) | (y << bits) & ((1 << (2 * bits)) - 1)
    }
}
