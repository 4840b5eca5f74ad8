//! The functions of every codec of the list, each codec's an object file. Generated: `cargo xtask renew c`.

mod oct8 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct8: 8 bits, at most 17.3633 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct8_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct8>(vector) as u32
    }

    /// The vector of a code of oct8. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct8_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct8>(code.into())
    }
}

mod oct8p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct8p: 8 bits, at most 11.575535 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct8p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise8>(vector) as u32
    }

    /// The vector of a code of oct8p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct8p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise8>(code.into())
    }
}

mod oct12 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct12: 12 bits, at most 3.92079 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct12_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct12>(vector) as u32
    }

    /// The vector of a code of oct12. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct12_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct12>(code.into())
    }
}

mod oct12p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct12p: 12 bits, at most 2.6138601 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct12p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise12>(vector) as u32
    }

    /// The vector of a code of oct12p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct12p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise12>(code.into())
    }
}

mod oct16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct16: 16 bits, at most 0.9570871 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct16>(vector) as u32
    }

    /// The vector of a code of oct16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct16>(code.into())
    }
}

mod oct16p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct16p: 16 bits, at most 0.63805807 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct16p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise16>(vector) as u32
    }

    /// The vector of a code of oct16p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct16p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise16>(code.into())
    }
}

mod oct18 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct18: 18 bits, at most 0.47669604 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct18_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct18>(vector) as u32
    }

    /// The vector of a code of oct18. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct18_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct18>(code.into())
    }
}

mod oct18p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct18p: 18 bits, at most 0.31779736 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct18p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise18>(vector) as u32
    }

    /// The vector of a code of oct18p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct18p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise18>(code.into())
    }
}

mod oct20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct20: 20 bits, at most 0.2379106 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct20>(vector) as u32
    }

    /// The vector of a code of oct20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct20_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct20>(code.into())
    }
}

mod oct20p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct20p: 20 bits, at most 0.15860707 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct20p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise20>(vector) as u32
    }

    /// The vector of a code of oct20p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct20p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise20>(code.into())
    }
}

mod oct22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct22: 22 bits, at most 0.11886802 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct22>(vector) as u32
    }

    /// The vector of a code of oct22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct22_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct22>(code.into())
    }
}

mod oct22p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct22p: 22 bits, at most 0.07924535 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct22p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise22>(vector) as u32
    }

    /// The vector of a code of oct22p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct22p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise22>(code.into())
    }
}

mod oct24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct24: 24 bits, at most 0.05943397 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct24>(vector) as u32
    }

    /// The vector of a code of oct24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct24>(code.into())
    }
}

mod oct24p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct24p: 24 bits, at most 0.03962265 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct24p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise24>(vector) as u32
    }

    /// The vector of a code of oct24p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct24p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise24>(code.into())
    }
}

mod oct32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct32: 32 bits, at most 0.003767258 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Oct32>(vector) as u32
    }

    /// The vector of a code of oct32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Oct32>(code.into())
    }
}

mod oct32p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct32p: 32 bits, at most 0.0025115055 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct32p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::OctPrecise32>(vector) as u32
    }

    /// The vector of a code of oct32p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct32p_decode(code: u32) -> Vec3 {
        decode::<unitvec::OctPrecise32>(code.into())
    }
}

mod hemioct16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hemioct16: 16 bits, directions with z >= 0, at most 0.5525745 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HemiOct16>(vector) as u32
    }

    /// The vector of a code of hemioct16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct16_decode(code: u32) -> Vec3 {
        decode::<unitvec::HemiOct16>(code.into())
    }
}

mod hemioct16p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hemioct16p: 16 bits, directions with z >= 0, at most 0.5525745 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct16p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HemiOctPrecise16>(vector) as u32
    }

    /// The vector of a code of hemioct16p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct16p_decode(code: u32) -> Vec3 {
        decode::<unitvec::HemiOctPrecise16>(code.into())
    }
}

mod hemioct24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hemioct24: 24 bits, directions with z >= 0, at most 0.03431422 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HemiOct24>(vector) as u32
    }

    /// The vector of a code of hemioct24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct24_decode(code: u32) -> Vec3 {
        decode::<unitvec::HemiOct24>(code.into())
    }
}

mod hemioct24p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hemioct24p: 24 bits, directions with z >= 0, at most 0.03431422 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct24p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HemiOctPrecise24>(vector) as u32
    }

    /// The vector of a code of hemioct24p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct24p_decode(code: u32) -> Vec3 {
        decode::<unitvec::HemiOctPrecise24>(code.into())
    }
}

mod hemioct32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hemioct32: 32 bits, directions with z >= 0, at most 0.0021750275 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HemiOct32>(vector) as u32
    }

    /// The vector of a code of hemioct32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct32_decode(code: u32) -> Vec3 {
        decode::<unitvec::HemiOct32>(code.into())
    }
}

mod hemioct32p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hemioct32p: 32 bits, directions with z >= 0, at most 0.0021750275 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct32p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HemiOctPrecise32>(vector) as u32
    }

    /// The vector of a code of hemioct32p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hemioct32p_decode(code: u32) -> Vec3 {
        decode::<unitvec::HemiOctPrecise32>(code.into())
    }
}

mod uoct16p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by uoct16p: 16 bits, at most 0.63555604 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct16p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::UOctPrecise16>(vector) as u32
    }

    /// The vector of a code of uoct16p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct16p_decode(code: u32) -> Vec3 {
        decode::<unitvec::UOctPrecise16>(code.into())
    }
}

mod uoct20p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by uoct20p: 20 bits, at most 0.15845206 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct20p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::UOctPrecise20>(vector) as u32
    }

    /// The vector of a code of uoct20p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct20p_decode(code: u32) -> Vec3 {
        decode::<unitvec::UOctPrecise20>(code.into())
    }
}

mod uoct24p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by uoct24p: 24 bits, at most 0.039612982 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct24p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::UOctPrecise24>(vector) as u32
    }

    /// The vector of a code of uoct24p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct24p_decode(code: u32) -> Vec3 {
        decode::<unitvec::UOctPrecise24>(code.into())
    }
}

mod uoct32p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by uoct32p: 32 bits, at most 0.0025114678 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct32p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::UOctPrecise32>(vector) as u32
    }

    /// The vector of a code of uoct32p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_uoct32p_decode(code: u32) -> Vec3 {
        decode::<unitvec::UOctPrecise32>(code.into())
    }
}

mod eaoct16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct16: 16 bits, at most 0.6779836 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOct16>(vector) as u32
    }

    /// The vector of a code of eaoct16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct16_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOct16>(code.into())
    }
}

mod eaoct16p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct16p: 16 bits, at most 0.5941603 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct16p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOctPrecise16>(vector) as u32
    }

    /// The vector of a code of eaoct16p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct16p_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOctPrecise16>(code.into())
    }
}

mod eaoct20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct20: 20 bits, at most 0.16856754 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOct20>(vector) as u32
    }

    /// The vector of a code of eaoct20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct20_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOct20>(code.into())
    }
}

mod eaoct20p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct20p: 20 bits, at most 0.14773475 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct20p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOctPrecise20>(vector) as u32
    }

    /// The vector of a code of eaoct20p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct20p_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOctPrecise20>(code.into())
    }
}

mod eaoct22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct22: 22 bits, at most 0.084245816 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOct22>(vector) as u32
    }

    /// The vector of a code of eaoct22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct22_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOct22>(code.into())
    }
}

mod eaoct22p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct22p: 22 bits, at most 0.073839605 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct22p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOctPrecise22>(vector) as u32
    }

    /// The vector of a code of eaoct22p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct22p_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOctPrecise22>(code.into())
    }
}

mod eaoct24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct24: 24 bits, at most 0.04214675 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOct24>(vector) as u32
    }

    /// The vector of a code of eaoct24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct24_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOct24>(code.into())
    }
}

mod eaoct24p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct24p: 24 bits, at most 0.036946185 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct24p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOctPrecise24>(vector) as u32
    }

    /// The vector of a code of eaoct24p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct24p_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOctPrecise24>(code.into())
    }
}

mod eaoct32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct32: 32 bits, at most 0.0027162114 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOct32>(vector) as u32
    }

    /// The vector of a code of eaoct32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct32_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOct32>(code.into())
    }
}

mod eaoct32p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eaoct32p: 32 bits, at most 0.002391325 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct32p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EaOctPrecise32>(vector) as u32
    }

    /// The vector of a code of eaoct32p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eaoct32p_decode(code: u32) -> Vec3 {
        decode::<unitvec::EaOctPrecise32>(code.into())
    }
}

mod soct17 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by soct17: 17 bits, at most 0.5525745 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_soct17_encode(vector: Vec3) -> u32 {
        encode::<unitvec::SOct17>(vector) as u32
    }

    /// The vector of a code of soct17. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_soct17_decode(code: u32) -> Vec3 {
        decode::<unitvec::SOct17>(code.into())
    }
}

mod soct25 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by soct25: 25 bits, at most 0.03431422 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_soct25_encode(vector: Vec3) -> u32 {
        encode::<unitvec::SOct25>(vector) as u32
    }

    /// The vector of a code of soct25. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_soct25_decode(code: u32) -> Vec3 {
        decode::<unitvec::SOct25>(code.into())
    }
}

mod soct33 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by soct33: 33 bits, at most 0.0021750275 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_soct33_encode(vector: Vec3) -> u64 {
        encode::<unitvec::SOct33>(vector)
    }

    /// The vector of a code of soct33. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_soct33_decode(code: u64) -> Vec3 {
        decode::<unitvec::SOct33>(code)
    }
}

mod oct48 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct48: 48 bits, at most 0.000017514729 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct48_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Oct48>(vector)
    }

    /// The vector of a code of oct48. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct48_decode(code: u64) -> Vec3 {
        decode::<unitvec::Oct48>(code)
    }
}

mod oct48p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct48p: 48 bits, at most 0.000012666191 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct48p_encode(vector: Vec3) -> u64 {
        encode::<unitvec::OctPrecise48>(vector)
    }

    /// The vector of a code of oct48p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct48p_decode(code: u64) -> Vec3 {
        decode::<unitvec::OctPrecise48>(code)
    }
}

mod oct52p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by oct52p: 52 bits, at most 0.000005393381 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct52p_encode(vector: Vec3) -> u64 {
        encode::<unitvec::OctPrecise52>(vector)
    }

    /// The vector of a code of oct52p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_oct52p_decode(code: u64) -> Vec3 {
        decode::<unitvec::OctPrecise52>(code)
    }
}

mod spherical16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spherical16: 16 bits, at most 0.7874757 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spherical16>(vector) as u32
    }

    /// The vector of a code of spherical16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spherical16>(code.into())
    }
}

mod spherical20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spherical20: 20 bits, at most 0.19690342 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spherical20>(vector) as u32
    }

    /// The vector of a code of spherical20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical20_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spherical20>(code.into())
    }
}

mod spherical22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spherical22: 22 bits, at most 0.09847471 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spherical22>(vector) as u32
    }

    /// The vector of a code of spherical22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical22_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spherical22>(code.into())
    }
}

mod spherical24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spherical24: 24 bits, at most 0.049260356 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spherical24>(vector) as u32
    }

    /// The vector of a code of spherical24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spherical24>(code.into())
    }
}

mod spherical32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spherical32: 32 bits, at most 0.003121897 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spherical32>(vector) as u32
    }

    /// The vector of a code of spherical32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spherical32>(code.into())
    }
}

mod spherical48 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spherical48: 48 bits, at most 0.000016 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical48_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Spherical48>(vector)
    }

    /// The vector of a code of spherical48. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spherical48_decode(code: u64) -> Vec3 {
        decode::<unitvec::Spherical48>(code)
    }
}

mod cylindrical16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cylindrical16: 16 bits, at most 5.086054 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cylindrical16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Cylindrical16>(vector) as u32
    }

    /// The vector of a code of cylindrical16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cylindrical16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Cylindrical16>(code.into())
    }
}

mod cylindrical24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cylindrical24: 24 bits, at most 1.2671181 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cylindrical24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Cylindrical24>(vector) as u32
    }

    /// The vector of a code of cylindrical24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cylindrical24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Cylindrical24>(code.into())
    }
}

mod cylindrical32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cylindrical32: 32 bits, at most 0.3190028 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cylindrical32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Cylindrical32>(vector) as u32
    }

    /// The vector of a code of cylindrical32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cylindrical32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Cylindrical32>(code.into())
    }
}

mod latlong16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by latlong16: 16 bits, at most 0.7861637 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::LatLong16>(vector) as u32
    }

    /// The vector of a code of latlong16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong16_decode(code: u32) -> Vec3 {
        decode::<unitvec::LatLong16>(code.into())
    }
}

mod latlong24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by latlong24: 24 bits, at most 0.049178354 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::LatLong24>(vector) as u32
    }

    /// The vector of a code of latlong24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong24_decode(code: u32) -> Vec3 {
        decode::<unitvec::LatLong24>(code.into())
    }
}

mod latlong32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by latlong32: 32 bits, at most 0.003116772 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::LatLong32>(vector) as u32
    }

    /// The vector of a code of latlong32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong32_decode(code: u32) -> Vec3 {
        decode::<unitvec::LatLong32>(code.into())
    }
}

mod latlong16d {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by latlong16d: 16 bits, at most 0.566766 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong16d_encode(vector: Vec3) -> u32 {
        encode::<unitvec::LatLongD16>(vector) as u32
    }

    /// The vector of a code of latlong16d. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong16d_decode(code: u32) -> Vec3 {
        decode::<unitvec::LatLongD16>(code.into())
    }
}

mod latlong24d {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by latlong24d: 24 bits, at most 0.035193 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong24d_encode(vector: Vec3) -> u32 {
        encode::<unitvec::LatLongD24>(vector) as u32
    }

    /// The vector of a code of latlong24d. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong24d_decode(code: u32) -> Vec3 {
        decode::<unitvec::LatLongD24>(code.into())
    }
}

mod latlong32d {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by latlong32d: 32 bits, at most 0.0022411998 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong32d_encode(vector: Vec3) -> u32 {
        encode::<unitvec::LatLongD32>(vector) as u32
    }

    /// The vector of a code of latlong32d. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_latlong32d_decode(code: u32) -> Vec3 {
        decode::<unitvec::LatLongD32>(code.into())
    }
}

mod fib16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by fib16: 16 bits, at most 0.6106119 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_fib16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Fib16>(vector) as u32
    }

    /// The vector of a code of fib16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_fib16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Fib16>(code.into())
    }
}

mod fib24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by fib24: 24 bits, at most 0.03818574 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_fib24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Fib24>(vector) as u32
    }

    /// The vector of a code of fib24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_fib24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Fib24>(code.into())
    }
}

mod fib32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by fib32: 32 bits, at most 0.002409109 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_fib32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Fib32>(vector) as u32
    }

    /// The vector of a code of fib32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_fib32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Fib32>(code.into())
    }
}

mod hexcube16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hexcube16: 16 bits, at most 0.547 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hexcube16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HexCube16>(vector) as u32
    }

    /// The vector of a code of hexcube16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hexcube16_decode(code: u32) -> Vec3 {
        decode::<unitvec::HexCube16>(code.into())
    }
}

mod hexcube24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hexcube24: 24 bits, at most 0.0336 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hexcube24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HexCube24>(vector) as u32
    }

    /// The vector of a code of hexcube24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hexcube24_decode(code: u32) -> Vec3 {
        decode::<unitvec::HexCube24>(code.into())
    }
}

mod hexcube32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by hexcube32: 32 bits, at most 0.00211 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hexcube32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::HexCube32>(vector) as u32
    }

    /// The vector of a code of hexcube32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_hexcube32_decode(code: u32) -> Vec3 {
        decode::<unitvec::HexCube32>(code.into())
    }
}

mod ico16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by ico16: 16 bits, at most 0.508983 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_ico16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Ico16>(vector) as u32
    }

    /// The vector of a code of ico16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_ico16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Ico16>(code.into())
    }
}

mod ico24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by ico24: 24 bits, at most 0.0312244 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_ico24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Ico24>(vector) as u32
    }

    /// The vector of a code of ico24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_ico24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Ico24>(code.into())
    }
}

mod ico32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by ico32: 32 bits, at most 0.00196072 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_ico32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Ico32>(vector) as u32
    }

    /// The vector of a code of ico32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_ico32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Ico32>(code.into())
    }
}

mod snorm8x3p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm8x3p: 24 bits, at most 0.33764777 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm8x3p_encode(vector: Vec3) -> u32 {
        encode::<unitvec::SnormBest8>(vector) as u32
    }

    /// The vector of a code of snorm8x3p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm8x3p_decode(code: u32) -> Vec3 {
        decode::<unitvec::SnormBest8>(code.into())
    }
}

mod snorm8x3_nearest {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm8x3_nearest: 24 bits, at most 0.31903726 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm8x3_nearest_encode(vector: Vec3) -> u32 {
        encode::<unitvec::SnormNearest8>(vector) as u32
    }

    /// The vector of a code of snorm8x3_nearest. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm8x3_nearest_decode(code: u32) -> Vec3 {
        decode::<unitvec::SnormNearest8>(code.into())
    }
}

mod snorm16x3p {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm16x3p: 48 bits, at most 0.0012500949 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm16x3p_encode(vector: Vec3) -> u64 {
        encode::<unitvec::SnormBest16>(vector)
    }

    /// The vector of a code of snorm16x3p. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm16x3p_decode(code: u64) -> Vec3 {
        decode::<unitvec::SnormBest16>(code)
    }
}

mod crytek_bfn24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by crytek_bfn24: 24 bits, at most 0.63308954 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_crytek_bfn24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::CrytekBfn24>(vector) as u32
    }

    /// The vector of a code of crytek_bfn24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_crytek_bfn24_decode(code: u32) -> Vec3 {
        decode::<unitvec::CrytekBfn24>(code.into())
    }
}

mod stereo16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo16: 16 bits, at most 1.0027986 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Stereo16>(vector) as u32
    }

    /// The vector of a code of stereo16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Stereo16>(code.into())
    }
}

mod stereo20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo20: 20 bits, at most 0.25079146 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Stereo20>(vector) as u32
    }

    /// The vector of a code of stereo20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo20_decode(code: u32) -> Vec3 {
        decode::<unitvec::Stereo20>(code.into())
    }
}

mod stereo22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo22: 22 bits, at most 0.12545691 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Stereo22>(vector) as u32
    }

    /// The vector of a code of stereo22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo22_decode(code: u32) -> Vec3 {
        decode::<unitvec::Stereo22>(code.into())
    }
}

mod stereo24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo24: 24 bits, at most 0.062789656 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Stereo24>(vector) as u32
    }

    /// The vector of a code of stereo24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Stereo24>(code.into())
    }
}

mod stereo32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo32: 32 bits, at most 0.004039101 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Stereo32>(vector) as u32
    }

    /// The vector of a code of stereo32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Stereo32>(code.into())
    }
}

mod stereo_concentric16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_concentric16: 16 bits, at most 1.3858317 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoConcentric16>(vector) as u32
    }

    /// The vector of a code of stereo_concentric16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric16_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoConcentric16>(code.into())
    }
}

mod stereo_concentric20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_concentric20: 20 bits, at most 0.3465848 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoConcentric20>(vector) as u32
    }

    /// The vector of a code of stereo_concentric20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric20_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoConcentric20>(code.into())
    }
}

mod stereo_concentric22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_concentric22: 22 bits, at most 0.17337698 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoConcentric22>(vector) as u32
    }

    /// The vector of a code of stereo_concentric22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric22_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoConcentric22>(code.into())
    }
}

mod stereo_concentric24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_concentric24: 24 bits, at most 0.08677306 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoConcentric24>(vector) as u32
    }

    /// The vector of a code of stereo_concentric24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric24_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoConcentric24>(code.into())
    }
}

mod stereo_concentric32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_concentric32: 32 bits, at most 0.0055818926 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoConcentric32>(vector) as u32
    }

    /// The vector of a code of stereo_concentric32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_concentric32_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoConcentric32>(code.into())
    }
}

mod stereo_ellipse16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_ellipse16: 16 bits, at most 1.0027986 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoEllipse16>(vector) as u32
    }

    /// The vector of a code of stereo_ellipse16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse16_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoEllipse16>(code.into())
    }
}

mod stereo_ellipse20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_ellipse20: 20 bits, at most 0.25079146 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoEllipse20>(vector) as u32
    }

    /// The vector of a code of stereo_ellipse20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse20_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoEllipse20>(code.into())
    }
}

mod stereo_ellipse22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_ellipse22: 22 bits, at most 0.12545691 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoEllipse22>(vector) as u32
    }

    /// The vector of a code of stereo_ellipse22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse22_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoEllipse22>(code.into())
    }
}

mod stereo_ellipse24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_ellipse24: 24 bits, at most 0.062789656 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoEllipse24>(vector) as u32
    }

    /// The vector of a code of stereo_ellipse24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse24_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoEllipse24>(code.into())
    }
}

mod stereo_ellipse32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by stereo_ellipse32: 32 bits, at most 0.004039101 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::StereoEllipse32>(vector) as u32
    }

    /// The vector of a code of stereo_ellipse32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_stereo_ellipse32_decode(code: u32) -> Vec3 {
        decode::<unitvec::StereoEllipse32>(code.into())
    }
}

mod eqarea16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea16: 16 bits, at most 1.0340464 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqarea16>(vector) as u32
    }

    /// The vector of a code of eqarea16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqarea16>(code.into())
    }
}

mod eqarea20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea20: 20 bits, at most 0.25860626 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqarea20>(vector) as u32
    }

    /// The vector of a code of eqarea20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea20_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqarea20>(code.into())
    }
}

mod eqarea22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea22: 22 bits, at most 0.12936623 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqarea22>(vector) as u32
    }

    /// The vector of a code of eqarea22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea22_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqarea22>(code.into())
    }
}

mod eqarea24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea24: 24 bits, at most 0.06474622 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqarea24>(vector) as u32
    }

    /// The vector of a code of eqarea24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqarea24>(code.into())
    }
}

mod eqarea32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea32: 32 bits, at most 0.0041649616 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqarea32>(vector) as u32
    }

    /// The vector of a code of eqarea32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqarea32>(code.into())
    }
}

mod eqarea_concentric16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_concentric16: 16 bits, at most 1.0404035 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaConcentric16>(vector) as u32
    }

    /// The vector of a code of eqarea_concentric16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric16_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaConcentric16>(code.into())
    }
}

mod eqarea_concentric20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_concentric20: 20 bits, at most 0.26019612 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaConcentric20>(vector) as u32
    }

    /// The vector of a code of eqarea_concentric20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric20_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaConcentric20>(code.into())
    }
}

mod eqarea_concentric22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_concentric22: 22 bits, at most 0.13016154 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaConcentric22>(vector) as u32
    }

    /// The vector of a code of eqarea_concentric22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric22_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaConcentric22>(code.into())
    }
}

mod eqarea_concentric24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_concentric24: 24 bits, at most 0.06514426 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaConcentric24>(vector) as u32
    }

    /// The vector of a code of eqarea_concentric24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric24_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaConcentric24>(code.into())
    }
}

mod eqarea_concentric32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_concentric32: 32 bits, at most 0.0041905665 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaConcentric32>(vector) as u32
    }

    /// The vector of a code of eqarea_concentric32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_concentric32_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaConcentric32>(code.into())
    }
}

mod eqarea_ellipse16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_ellipse16: 16 bits, at most 0.91505367 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaEllipse16>(vector) as u32
    }

    /// The vector of a code of eqarea_ellipse16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse16_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaEllipse16>(code.into())
    }
}

mod eqarea_ellipse20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_ellipse20: 20 bits, at most 0.22884718 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaEllipse20>(vector) as u32
    }

    /// The vector of a code of eqarea_ellipse20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse20_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaEllipse20>(code.into())
    }
}

mod eqarea_ellipse22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_ellipse22: 22 bits, at most 0.11447943 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaEllipse22>(vector) as u32
    }

    /// The vector of a code of eqarea_ellipse22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse22_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaEllipse22>(code.into())
    }
}

mod eqarea_ellipse24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_ellipse24: 24 bits, at most 0.057295557 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaEllipse24>(vector) as u32
    }

    /// The vector of a code of eqarea_ellipse24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse24_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaEllipse24>(code.into())
    }
}

mod eqarea_ellipse32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqarea_ellipse32: 32 bits, at most 0.0036856793 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqareaEllipse32>(vector) as u32
    }

    /// The vector of a code of eqarea_ellipse32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqarea_ellipse32_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqareaEllipse32>(code.into())
    }
}

mod eqdist16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist16: 16 bits, at most 0.8121773 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqdist16>(vector) as u32
    }

    /// The vector of a code of eqdist16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqdist16>(code.into())
    }
}

mod eqdist20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist20: 20 bits, at most 0.20311868 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqdist20>(vector) as u32
    }

    /// The vector of a code of eqdist20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist20_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqdist20>(code.into())
    }
}

mod eqdist22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist22: 22 bits, at most 0.1016089 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqdist22>(vector) as u32
    }

    /// The vector of a code of eqdist22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist22_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqdist22>(code.into())
    }
}

mod eqdist24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist24: 24 bits, at most 0.050854016 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqdist24>(vector) as u32
    }

    /// The vector of a code of eqdist24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqdist24>(code.into())
    }
}

mod eqdist32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist32: 32 bits, at most 0.003271311 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Eqdist32>(vector) as u32
    }

    /// The vector of a code of eqdist32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Eqdist32>(code.into())
    }
}

mod eqdist_concentric16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_concentric16: 16 bits, at most 1.0884842 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistConcentric16>(vector) as u32
    }

    /// The vector of a code of eqdist_concentric16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric16_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistConcentric16>(code.into())
    }
}

mod eqdist_concentric20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_concentric20: 20 bits, at most 0.2722207 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistConcentric20>(vector) as u32
    }

    /// The vector of a code of eqdist_concentric20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric20_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistConcentric20>(code.into())
    }
}

mod eqdist_concentric22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_concentric22: 22 bits, at most 0.13617676 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistConcentric22>(vector) as u32
    }

    /// The vector of a code of eqdist_concentric22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric22_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistConcentric22>(code.into())
    }
}

mod eqdist_concentric24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_concentric24: 24 bits, at most 0.06815481 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistConcentric24>(vector) as u32
    }

    /// The vector of a code of eqdist_concentric24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric24_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistConcentric24>(code.into())
    }
}

mod eqdist_concentric32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_concentric32: 32 bits, at most 0.0043842276 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistConcentric32>(vector) as u32
    }

    /// The vector of a code of eqdist_concentric32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_concentric32_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistConcentric32>(code.into())
    }
}

mod eqdist_ellipse16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_ellipse16: 16 bits, at most 0.787555 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistEllipse16>(vector) as u32
    }

    /// The vector of a code of eqdist_ellipse16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse16_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistEllipse16>(code.into())
    }
}

mod eqdist_ellipse20 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_ellipse20: 20 bits, at most 0.19696085 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse20_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistEllipse20>(vector) as u32
    }

    /// The vector of a code of eqdist_ellipse20. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse20_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistEllipse20>(code.into())
    }
}

mod eqdist_ellipse22 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_ellipse22: 22 bits, at most 0.09852848 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse22_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistEllipse22>(vector) as u32
    }

    /// The vector of a code of eqdist_ellipse22. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse22_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistEllipse22>(code.into())
    }
}

mod eqdist_ellipse24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_ellipse24: 24 bits, at most 0.049312305 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistEllipse24>(vector) as u32
    }

    /// The vector of a code of eqdist_ellipse24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse24_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistEllipse24>(code.into())
    }
}

mod eqdist_ellipse32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by eqdist_ellipse32: 32 bits, at most 0.0031721366 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::EqdistEllipse32>(vector) as u32
    }

    /// The vector of a code of eqdist_ellipse32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_eqdist_ellipse32_decode(code: u32) -> Vec3 {
        decode::<unitvec::EqdistEllipse32>(code.into())
    }
}

mod snorm5x3 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm5x3: 15 bits, at most 3.31 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm5x3_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Snorm5x3>(vector) as u32
    }

    /// The vector of a code of snorm5x3. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm5x3_decode(code: u32) -> Vec3 {
        decode::<unitvec::Snorm5x3>(code.into())
    }
}

mod snorm8x3 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm8x3: 24 bits, at most 0.3908 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm8x3_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Snorm8x3>(vector) as u32
    }

    /// The vector of a code of snorm8x3. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm8x3_decode(code: u32) -> Vec3 {
        decode::<unitvec::Snorm8x3>(code.into())
    }
}

mod snorm10x3 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm10x3: 30 bits, at most 0.0972 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm10x3_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Snorm10x3>(vector) as u32
    }

    /// The vector of a code of snorm10x3. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm10x3_decode(code: u32) -> Vec3 {
        decode::<unitvec::Snorm10x3>(code.into())
    }
}

mod snorm11_11_10 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm11_11_10: 32 bits, at most 0.0687 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm11_11_10_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Snorm11x11x10>(vector) as u32
    }

    /// The vector of a code of snorm11_11_10. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm11_11_10_decode(code: u32) -> Vec3 {
        decode::<unitvec::Snorm11x11x10>(code.into())
    }
}

mod snorm16x3 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by snorm16x3: 48 bits, at most 0.00153 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm16x3_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Snorm16x3>(vector)
    }

    /// The vector of a code of snorm16x3. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_snorm16x3_decode(code: u64) -> Vec3 {
        decode::<unitvec::Snorm16x3>(code)
    }
}

mod unorm8x3 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by unorm8x3: 24 bits, at most 0.3893 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_unorm8x3_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Unorm8x3>(vector) as u32
    }

    /// The vector of a code of unorm8x3. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_unorm8x3_decode(code: u32) -> Vec3 {
        decode::<unitvec::Unorm8x3>(code.into())
    }
}

mod float16x3 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by float16x3: 48 bits, at most 0.0264 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_float16x3_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Float16x3>(vector)
    }

    /// The vector of a code of float16x3. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_float16x3_decode(code: u64) -> Vec3 {
        decode::<unitvec::Float16x3>(code)
    }
}

mod cube16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cube16: 16 bits, at most 1.016 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Cube16>(vector) as u32
    }

    /// The vector of a code of cube16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Cube16>(code.into())
    }
}

mod cube24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cube24: 24 bits, at most 0.0627 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Cube24>(vector) as u32
    }

    /// The vector of a code of cube24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Cube24>(code.into())
    }
}

mod cube32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cube32: 32 bits, at most 0.00392 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Cube32>(vector) as u32
    }

    /// The vector of a code of cube32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Cube32>(code.into())
    }
}

mod cube48 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by cube48: 48 bits, at most 0.0000183 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube48_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Cube48>(vector)
    }

    /// The vector of a code of cube48. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_cube48_decode(code: u64) -> Vec3 {
        decode::<unitvec::Cube48>(code)
    }
}

mod warpedcube16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by warpedcube16: 16 bits, at most 0.893 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_warpedcube16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::WarpedCube16>(vector) as u32
    }

    /// The vector of a code of warpedcube16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_warpedcube16_decode(code: u32) -> Vec3 {
        decode::<unitvec::WarpedCube16>(code.into())
    }
}

mod warpedcube24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by warpedcube24: 24 bits, at most 0.055 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_warpedcube24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::WarpedCube24>(vector) as u32
    }

    /// The vector of a code of warpedcube24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_warpedcube24_decode(code: u32) -> Vec3 {
        decode::<unitvec::WarpedCube24>(code.into())
    }
}

mod warpedcube32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by warpedcube32: 32 bits, at most 0.00344 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_warpedcube32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::WarpedCube32>(vector) as u32
    }

    /// The vector of a code of warpedcube32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_warpedcube32_decode(code: u32) -> Vec3 {
        decode::<unitvec::WarpedCube32>(code.into())
    }
}

mod xyonly16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by xyonly16: 16 bits, directions with z >= 0, at most 6.1 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::XyOnly16>(vector) as u32
    }

    /// The vector of a code of xyonly16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly16_decode(code: u32) -> Vec3 {
        decode::<unitvec::XyOnly16>(code.into())
    }
}

mod xyonly24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by xyonly24: 24 bits, directions with z >= 0, at most 1.52 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::XyOnly24>(vector) as u32
    }

    /// The vector of a code of xyonly24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly24_decode(code: u32) -> Vec3 {
        decode::<unitvec::XyOnly24>(code.into())
    }
}

mod xyonly32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by xyonly32: 32 bits, directions with z >= 0, at most 0.39 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::XyOnly32>(vector) as u32
    }

    /// The vector of a code of xyonly32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly32_decode(code: u32) -> Vec3 {
        decode::<unitvec::XyOnly32>(code.into())
    }
}

mod xyonly32f {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by xyonly32f: 32 bits, directions with z >= 0, at most 1.53 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly32f_encode(vector: Vec3) -> u32 {
        encode::<unitvec::XyOnly32F>(vector) as u32
    }

    /// The vector of a code of xyonly32f. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_xyonly32f_decode(code: u32) -> Vec3 {
        decode::<unitvec::XyOnly32F>(code.into())
    }
}

mod pp16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by pp16: 16 bits, at most 7.7 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Pp16>(vector) as u32
    }

    /// The vector of a code of pp16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Pp16>(code.into())
    }
}

mod pp24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by pp24: 24 bits, at most 1.91 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Pp24>(vector) as u32
    }

    /// The vector of a code of pp24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Pp24>(code.into())
    }
}

mod pp32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by pp32: 32 bits, at most 0.49 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Pp32>(vector) as u32
    }

    /// The vector of a code of pp32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Pp32>(code.into())
    }
}

mod pp48 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by pp48: 48 bits, at most 0.071 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp48_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Pp48>(vector)
    }

    /// The vector of a code of pp48. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_pp48_decode(code: u64) -> Vec3 {
        decode::<unitvec::Pp48>(code)
    }
}

mod spp16 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spp16: 16 bits, at most 1.32 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp16_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spp16>(vector) as u32
    }

    /// The vector of a code of spp16. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp16_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spp16>(code.into())
    }
}

mod spp24 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spp24: 24 bits, at most 0.077 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp24_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spp24>(vector) as u32
    }

    /// The vector of a code of spp24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp24_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spp24>(code.into())
    }
}

mod spp32 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spp32: 32 bits, at most 0.0048 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp32_encode(vector: Vec3) -> u32 {
        encode::<unitvec::Spp32>(vector) as u32
    }

    /// The vector of a code of spp32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp32_decode(code: u32) -> Vec3 {
        decode::<unitvec::Spp32>(code.into())
    }
}

mod spp48 {
    use crate::single::{Vec3, decode, encode};

    /// The code of a vector by spp48: 48 bits, at most 0.00008 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp48_encode(vector: Vec3) -> u64 {
        encode::<unitvec::Spp48>(vector)
    }

    /// The vector of a code of spp48. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_spp48_decode(code: u64) -> Vec3 {
        decode::<unitvec::Spp48>(code)
    }
}

mod frame32 {
    use crate::single::{Frame, decode_frame, encode_frame};

    /// The code of a frame by frame32: 32 bits, normal at most 0.07924535, tangent 0.36266392 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_frame32_encode(frame: Frame) -> u32 {
        encode_frame::<unitvec::Frame32>(frame) as u32
    }

    /// The frame of a code of frame32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_frame32_decode(code: u32) -> Frame {
        decode_frame::<unitvec::Frame32>(code.into())
    }
}

mod frame64 {
    use crate::single::{Frame, decode_frame, encode_frame};

    /// The code of a frame by frame64: 64 bits, normal at most 0.00008410503, tangent 0.0001304478 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_frame64_encode(frame: Frame) -> u64 {
        encode_frame::<unitvec::Frame64>(frame)
    }

    /// The frame of a code of frame64. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_frame64_decode(code: u64) -> Frame {
        decode_frame::<unitvec::Frame64>(code)
    }
}

mod quat24 {
    use crate::single::{Quat, decode_rotation, encode_rotation};

    /// The code of a rotation by quat24: 24 bits, at most 0.77 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat24_encode(rotation: Quat) -> u32 {
        encode_rotation::<unitvec::Quat24>(rotation) as u32
    }

    /// The rotation of a code of quat24. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat24_decode(code: u32) -> Quat {
        decode_rotation::<unitvec::Quat24>(code.into())
    }
}

mod quat32 {
    use crate::single::{Quat, decode_rotation, encode_rotation};

    /// The code of a rotation by quat32: 32 bits, at most 0.119 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat32_encode(rotation: Quat) -> u32 {
        encode_rotation::<unitvec::Quat32>(rotation) as u32
    }

    /// The rotation of a code of quat32. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat32_decode(code: u32) -> Quat {
        decode_rotation::<unitvec::Quat32>(code.into())
    }
}

mod quat48 {
    use crate::single::{Quat, decode_rotation, encode_rotation};

    /// The code of a rotation by quat48: 48 bits, at most 0.00296 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat48_encode(rotation: Quat) -> u64 {
        encode_rotation::<unitvec::Quat48>(rotation)
    }

    /// The rotation of a code of quat48. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat48_decode(code: u64) -> Quat {
        decode_rotation::<unitvec::Quat48>(code)
    }
}

mod quat64 {
    use crate::single::{Quat, decode_rotation, encode_rotation};

    /// The code of a rotation by quat64: 64 bits, at most 0.000088 degrees off.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat64_encode(rotation: Quat) -> u64 {
        encode_rotation::<unitvec::Quat64>(rotation)
    }

    /// The rotation of a code of quat64. Higher bits are ignored.
    #[unsafe(no_mangle)]
    pub extern "C" fn unitvec_quat64_decode(code: u64) -> Quat {
        decode_rotation::<unitvec::Quat64>(code)
    }
}
