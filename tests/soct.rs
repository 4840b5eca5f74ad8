//! The signed octahedral codecs: the hemisphere's code inside, layout.

use glam::Vec3;
use unitvec::{Codec, SOct17, SOct25, SOct33};
use unitvec_oracle::soct;
use unitvec_tests::directions::{near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

/// The low bits are the code of the hemisphere's codec, for both signs of z.
#[test]
fn holds_the_hemispheres_code() {
    for codec in Tested::family("soct") {
        let hemisphere = Tested::find(&format!("hemioct{}", codec.bits - 1));
        for v in sphere(7, 100_000).chain(near_planes(8, 50_000)) {
            let low = codec.encode(v) & hemisphere.mask();
            assert_eq!(low, hemisphere.encode(Vec3::new(v.x, v.y, v.z.abs())), "{}: {v:?}", codec.id);
        }
    }
}

/// The equator has two codes of each direction, which decode alike; encoding writes the one of sign 0 for a z of 0, -0 or a
/// denormal.
#[test]
fn equator() {
    for codec in Tested::family("soct") {
        let sign = 1u64 << (codec.bits - 1);
        for v in near_planes(11, 10_000) {
            let [code, others @ ..] =
                [0.0, -0.0, -1e-40, 1e-40].map(|z| codec.encode(Vec3::new(v.x, v.y, z)));
            let same = others.iter().all(|&other| other == code);
            assert!(same && code & sign == 0, "{}: {v:?}: {code:#x} {others:x?}", codec.id);
            let [upper, lower] = [code, code | sign].map(|bits| codec.decode(bits));
            assert!(upper == lower && upper.z.to_bits() == 0 && lower.z.to_bits() == 0, "{code:#x}");
            assert!(widen(upper)[2] == 0.0);
        }
    }
}

/// 17 bits are stored in 3 bytes, 25 in 4, 33 in 6 of two words; the sign is the highest bit.
#[test]
fn layout() {
    assert_eq!((SOct17::BYTES, SOct25::BYTES, SOct33::BYTES), (3, 4, 6));
    assert_eq!(SOct17::encode(Vec3::X), 0x7f7f);
    assert_eq!(SOct17::encode(Vec3::NEG_Z), 0x1_0000);
    assert_eq!(SOct25::encode(Vec3::new(-1.0, 0.0, -1e-9)), 0x180_1801);
    assert_eq!(SOct33::encode(Vec3::NEG_Z), [0, 1]);
    assert_eq!(SOct33::encode(Vec3::Y), [0x8001_7fff, 0]);
    assert_eq!(SOct33::decode_vec3([0x8000_8000, 0xffff_fffe]), Vec3::NEG_X);
    assert_eq!(soct::encode([0.0, 1.0, 0.0], 33), 0x8001_7fff);
}
