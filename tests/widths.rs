//! The widths of the public types with const parameters: others are no codecs, so that they do not compile.

use std::marker::PhantomData;
use unitvec::azimuthal::{Azimuthal, Plain, Stereo};
use unitvec::*;

struct Probe<C>(PhantomData<C>);

/// The compiler takes this constant where it can, since it is the type's own, and else the trait's.
impl<C: Codec> Probe<C> {
    const IS_CODEC: bool = true;
}

trait NoCodec {
    const IS_CODEC: bool = false;
}

impl<C> NoCodec for Probe<C> {}

/// Asserts which numbers, of many, make codecs of these types.
macro_rules! assert_widths {
    ($($codec:ident)*: $expected:expr) => {$(
        assert_widths!($codec, $expected, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28
            29 30 31 32 33 34 36 40 42 44 47 48 49 50 51 52 53 54 56 60 63 64 65 128);
    )*};
    ($codec:ident, $expected:expr, $($bits:literal)*) => {
        let tried = [$(($bits, <Probe<$codec<$bits>>>::IS_CODEC)),*];
        let codecs = tried.into_iter().filter(|(_, is_codec)| *is_codec).map(|(bits, _)| bits);
        assert_eq!(codecs.collect::<Vec<u32>>(), $expected, stringify!($codec));
    };
}

type Stereographic<const BITS: u32> = Azimuthal<Stereo, Plain, BITS>;
type SOctWide<const BITS: u32> = soct::SOct<BITS, [u32; 2]>;
type PpWide<const BITS: u32> = parallel::Pp<BITS, [u32; 2]>;
type SppWide<const BITS: u32> = parallel::Spp<BITS, [u32; 2]>;

#[test]
fn only_widths_that_work_compile() {
    use {
        cube::*, cylindrical::*, eaoct::*, fib::*, hemioct::*, hexcube::*, ico::*, latlong::*, oct::*,
        oct_wide::*,
    };
    use {parallel::*, snorm::*, soct::*, spherical::*, uoct::*};
    assert_widths!(Oct OctPrecise UOctPrecise: (4..=32).step_by(2).collect::<Vec<_>>());
    assert_widths!(EaOct EaOctPrecise Spherical Stereographic: [16, 20, 22, 24, 32]);
    assert_widths!(HemiOct HemiOctPrecise Cylindrical LatLong LatLongD Fib Ico HexCube Cube WarpedCube XyOnly Pp Spp: [16, 24, 32]);
    assert_widths!(OctWide PpWide SppWide: [48]);
    assert_widths!(OctWidePrecise: [48, 52]);
    assert_widths!(SOct: [17, 25]);
    assert_widths!(SOctWide: [33]);
    assert_widths!(Snorm3: [15, 24, 30, 32]);
}
