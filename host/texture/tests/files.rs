//! Files of textures: what is written is what other crates read, and comes back as the codecs decode it.

use ddsfile::Dds;
use image::{DynamicImage, ImageFormat, Rgb32FImage, RgbImage};
use std::io::Cursor;
use std::path::Path;
use unitvec::angle_deg;
use unitvec_catalogue::{AnyCodec, Domain, find, vectors};
use unitvec_texture::block::{Compression, compress, decompress};
use unitvec_texture::format::named;
use unitvec_texture::{Coding, Error, NormalMap, Pair, Source, Texture, dds, ktx2, picture, read};

/// Directions spread over the sphere, or over its upper half, by the golden angle; alpha from 0 to 1.
fn map(width: u32, height: u32, domain: Domain) -> NormalMap {
    let count = width * height;
    let vector = |at: u32| {
        let share = (f64::from(at) + 0.5) / f64::from(count);
        let z = if domain == Domain::Hemisphere { share } else { 2.0 * share - 1.0 };
        let (phi, r) = (f64::from(at) * 2.399_963, (1.0 - z * z).sqrt());
        [r * phi.cos(), r * phi.sin(), z].map(|c| c as f32)
    };
    let alpha = (0..count).map(|at| at as f32 / (count - 1) as f32).collect();
    NormalMap { width, height, vectors: (0..count).map(vector).collect(), alpha: Some(alpha) }
}

fn texture(coding: Coding, map: &NormalMap) -> Texture {
    Texture {
        format: coding.format,
        width: map.width,
        height: map.height,
        levels: vec![coding.pack(map)],
        codec: Some(coding.codec.id.to_owned()),
        y: Some("up".to_owned()),
    }
}

/// The map of a file, of which the codec is known or not.
fn back(name: &str, bytes: &[u8], codec: Option<&'static AnyCodec>) -> Source {
    read(Path::new(name), bytes, codec).unwrap_or_else(|error| panic!("{error}"))
}

/// All codecs of vectors, in texels and, of two SNORM channels, as UNORM.
fn codings() -> impl Iterator<Item = Coding> {
    vectors().iter().flat_map(|codec| [false, true].map(|unorm| Coding::of(codec, unorm))).flatten()
}

#[test]
fn maps_come_back_as_the_codecs_decode_them() {
    for coding in codings() {
        let (codec, map) = (coding.codec, map(7, 5, coding.codec.domain));
        let texture = texture(coding, &map);
        let file = ktx2::write(&texture);
        let mut sources = vec![back("a.ktx2", &file, None)];
        if coding.format.dxgi.is_some() {
            sources.push(back("a.dds", &dds::write(&texture).unwrap(), Some(codec)));
        }
        for source in sources {
            assert_eq!((source.codec.unwrap().id, source.filled), (codec.id, 0));
            for (v, found) in map.vectors.iter().zip(&source.map.vectors) {
                let decoded: [f32; 3] = codec.decode_one(codec.encode_one(*v));
                match codec.is_unit {
                    true => assert_eq!(decoded, *found, "{} in {}", codec.id, source.format),
                    false => assert!(angle_deg(decoded, *found) < 1e-5, "{}: {decoded:?}", codec.id),
                }
            }
            let alpha = source.map.alpha;
            assert_eq!(alpha.is_some(), coding.has_alpha(), "{} in {}", codec.id, source.format);
            let kept = alpha.iter().flatten().zip(map.alpha.iter().flatten());
            // SNORM of 8 bits has 127 steps from 0 to 1.
            assert!(
                kept.into_iter().all(|(found, alpha)| (found - alpha).abs() < 0.501 / 127.0),
                "{}",
                codec.id
            );
        }
    }
}

/// The crates `ktx2` and `ddsfile` find the size, the format, and each level's bytes; the descriptor has the format's channels.
#[test]
fn other_readers_agree() {
    let block = compressed(find("hemioct16").unwrap(), Compression::Bc7);
    for coding in codings().chain([block]) {
        let (map, format) = (map(6, 4, coding.codec.domain), coding.format);
        let mut texture = texture(coding, &map);
        let small = NormalMap { width: 3, height: 2, vectors: map.vectors[..6].to_vec(), alpha: None };
        texture.levels.push(coding.pack(&small));
        let file = ktx2::write(&texture);
        let reader = ::ktx2::Reader::new(&file[..]).unwrap();
        let ::ktx2::Header { format: vulkan, pixel_width, pixel_height, .. } = reader.header();
        assert_eq!((vulkan, pixel_width, pixel_height), (Some(format.vulkan), 6, 4));
        let levels: Vec<&[u8]> = reader.levels().map(|level| level.data).collect();
        assert_eq!(levels, texture.levels);
        let place = |level: &&[u8]| level.as_ptr() as usize - file.as_ptr() as usize;
        assert!(levels.iter().map(place).all(|at| at % 4 == 0 && at % format.bytes() == 0));
        let keys: Vec<&str> = reader.key_value_data().map(|(key, _)| key).collect();
        assert_eq!(keys, ["KTXorientation", "KTXwriter", "unitvecCodec", "unitvecY"]);
        let descriptor = reader.basic_dfd().unwrap();
        let bits = descriptor.sample_information.iter().map(|sample| u32::from(sample.bit_length.get()));
        assert_eq!(bits.sum::<u32>(), format.bits.iter().sum::<u32>());
        assert_eq!(usize::from(descriptor.bytes_planes[0]), format.bytes());
        let Some(dxgi) = format.dxgi else { continue };
        let dds = Dds::read(&dds::write(&texture).unwrap()[..]).unwrap();
        assert_eq!((dds.get_dxgi_format(), dds.get_width(), dds.get_height()), (Some(dxgi), 6, 4));
        assert_eq!(dds.get_num_mipmap_levels(), 2);
        assert_eq!(dds.get_data(0).unwrap(), texture.levels.concat());
    }
}

fn compressed(codec: &'static AnyCodec, compression: Compression) -> Coding {
    Coding::compressed(codec, compression).unwrap()
}

/// Blocks come back as the decompressor has them, at a size that they do not fill.
#[test]
fn blocks_come_back() {
    for (id, pair) in [("hemioct16", Pair::Hemioct), ("xyonly16", Pair::Xy), ("oct32p", Pair::Oct)] {
        for compression in [Compression::Bc5Unorm, Compression::Bc5Snorm, Compression::Bc7] {
            let (codec, map) = (find(id).unwrap(), map(6, 9, find(id).unwrap().domain));
            let texture = texture(compressed(codec, compression), &map);
            let blocks = compress(&map.vectors, 6, 9, pair, compression);
            let expected = decompress(&blocks, 6, 9, pair, compression).unwrap();
            assert!(back("a.ktx2", &ktx2::write(&texture), None).map.vectors == expected);
            assert!(back("a.dds", &dds::write(&texture).unwrap(), Some(codec)).map.vectors == expected);
        }
    }
    let error = Coding::compressed(find("ico16").unwrap(), Compression::Bc7).unwrap_err();
    assert!(error.to_string().starts_with("ico16 ") && error.is_usage());
}

/// Numbers of channels by the rules of Vulkan (section "Conversion from normalized fixed-point to floating-point").
#[test]
fn channels_are_vulkans() {
    let channels = |name: &str, texel: &[u8]| named(name).unwrap().channels(texel);
    assert_eq!(channels("R8G8B8A8_UNORM", &[0, 255, 51, 102]), [0.0, 1.0, 0.2, 0.4]);
    assert_eq!(channels("B8G8R8A8_UNORM", &[0, 255, 51, 102]), [0.2, 1.0, 0.0, 0.4]);
    assert_eq!(channels("R8G8B8A8_SNORM", &[0x80, 0x81, 0, 127]), [-1.0, -1.0, 0.0, 1.0]);
    let packed = (0x3ffu32 | 0x201 << 20 | 1 << 30).to_le_bytes();
    assert_eq!(channels("A2B10G10R10_UNORM_PACK32", &packed), [1.0, 0.0, 513.0 / 1023.0, 1.0 / 3.0]);
    assert_eq!(channels("A2B10G10R10_SNORM_PACK32", &packed), [-1.0 / 511.0, 0.0, -1.0, 1.0]);
    let halves = [0x3c00u16, 0xc000, 0x3800, 0].map(u16::to_le_bytes).concat();
    assert_eq!(channels("R16G16B16A16_SFLOAT", &halves), [1.0, -2.0, 0.5, 0.0]);
    let floats = [0.25f32, -1.0, 3.0, 0.5].map(f32::to_le_bytes).concat();
    assert_eq!(channels("R32G32B32A32_SFLOAT", &floats), [0.25, -1.0, 3.0, 0.5]);
}

/// A png holds the integer nearest to each component: half a step of `2 / (2^bits - 1)` in each, so an angle of at most
/// `asin(sqrt(3) / (2^bits - 1))`, and the reader finds it.
#[test]
fn pngs_hold_the_nearest() {
    let map = map(16, 9, Domain::Sphere);
    for (bits, steps) in [(8, 255.0f64), (16, 65535.0)] {
        let source = back("a.png", &picture::write(&map, bits).unwrap(), None);
        assert_eq!(source.format, format!("png of {bits} bits"));
        let most = (3f64.sqrt() / steps).asin().to_degrees() + 1e-5;
        let pairs = map.vectors.iter().zip(&source.map.vectors);
        pairs.for_each(|(v, found)| assert!(angle_deg(*v, *found) <= most));
        let pairs = map.alpha.iter().flatten().zip(source.map.alpha.iter().flatten());
        pairs.for_each(|(alpha, found)| assert!(f64::from(alpha - found).abs() <= 0.5 / steps + 1e-6));
    }
}

fn saved(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    image.into().write_to(&mut file, format).unwrap();
    file.into_inner()
}

/// Integers are biased, floats are not; what has no direction is counted and becomes +Z.
#[test]
fn pictures_of_other_programs() {
    let rgb = [255, 128, 128, 128, 0, 128, 127, 128, 127, 0, 0, 0];
    let tga = saved(RgbImage::from_raw(2, 2, rgb.to_vec()).unwrap(), ImageFormat::Tga);
    let source = back("a.TGA", &tga, None);
    assert_eq!((source.filled, &source.map.vectors[2..]), (2, &[[0.0, 0.0, 1.0]; 2][..]));
    // (255, 1, 1) / 255 and its like.
    let [x, y] = [source.map.vectors[0], source.map.vectors[1]];
    let tilt = (2f64.sqrt() / 255.0).atan().to_degrees();
    assert!(
        (angle_deg(x, [1.0, 0.0, 0.0]) - tilt).abs() < 1e-4
            && (angle_deg(y, [0.0, -1.0, 0.0]) - tilt).abs() < 1e-4
    );
    let floats = vec![0.0, -3.0, 4.0, f32::NAN, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0];
    let exr = saved(Rgb32FImage::from_raw(4, 1, floats).unwrap(), ImageFormat::OpenExr);
    let source = back("a.exr", &exr, None);
    let expected = [[0.0, -0.6, 0.8], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    assert_eq!(
        (source.filled, source.lengths, &source.map.vectors[..]),
        (2, Some([1.0, 5.0]), &expected[..])
    );
}

/// Headers that lie, and files that are something else, are told in a line, before memory is taken for them.
#[test]
fn headers_that_lie() {
    let (codec, map) = (find("hemioct16").unwrap(), map(8, 8, Domain::Hemisphere));
    let texture = texture(Coding::of(codec, false).unwrap(), &map);
    let (ktx, dds, png) =
        (ktx2::write(&texture), dds::write(&texture).unwrap(), picture::write(&map, 8).unwrap());
    let gray = saved(DynamicImage::new_luma8(4, 4), ImageFormat::Png);
    let with = |file: &[u8], at: usize, bytes: &[u8]| {
        let mut file = file.to_vec();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    };
    let huge = 0x4000_0000u32;
    for (name, file, words) in [
        ("width.ktx2", with(&ktx, 20, &huge.to_le_bytes()), "as long as its size"),
        ("layers.ktx2", with(&ktx, 32, &[6]), "extract one image"),
        ("packed.ktx2", with(&ktx, 44, &[2]), "supercompressed"),
        ("format.ktx2", with(&ktx, 12, &[43]), "R8G8B8A8_SRGB"),
        ("level.ktx2", with(&ktx, 80, &[0xff; 8]), "lies beyond its end"),
        ("cut.ktx2", ktx[..ktx.len() - 1].to_vec(), "check that the file is whole"),
        ("height.dds", with(&dds, 12, &huge.to_le_bytes()), "fewer bytes"),
        ("format.dds", with(&dds, 128, &[29]), "R8G8B8A8_UNorm_sRGB"),
        ("codec.dds", dds.clone(), "--from"),
        ("cut.png", png[..png.len() / 2].to_vec(), "check that the file is whole"),
        ("size.png", with(&png, 16, &huge.to_be_bytes()), "check that the file is whole"),
        ("gray.png", gray, "is gray"),
        ("a.txt", b"text".to_vec(), "is no png"),
        ("a.tga", vec![0; 40], "a.tga"),
    ] {
        let error = read(Path::new(name), &file, None).map(drop).unwrap_err().to_string();
        assert!(
            error.contains(name) && error.contains(words) && error.lines().count() == 1,
            "{name}: {error}"
        );
    }
    let oct48 = read(Path::new("a.ktx2"), &ktx, find("oct48").ok()).map(drop).unwrap_err().to_string();
    assert!(oct48.contains("R8G8_SNORM") && oct48.contains("R32G32_UINT"), "{oct48}");
    let snorm10 = find("snorm10x3").unwrap();
    let refused = dds::write(&self::texture(Coding::of(snorm10, false).unwrap(), &map));
    assert!(matches!(refused, Err(Error::Output { .. })));
}
