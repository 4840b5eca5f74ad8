//! Codes as they are stored: as so many bytes, little endian, or as integers.

/// A stored code: an array of as many bytes as [`Codec::BYTES`](crate::Codec::BYTES) says, or of integers, the low one
/// first.
pub trait Stored: Copy + Send + Sync {
    /// True for the two components of a code.
    const IS_PAIR: bool = false;

    /// The low bytes of a code's two words.
    fn of_words(words: [u32; 2]) -> Self;

    /// The low and the high word of the code.
    fn words(self) -> (u32, u32);
}

/// Implements [`Stored`].
macro_rules! stored {
    ($stored:ty $(, $is_pair:literal)?: $words:ident => $of_words:expr, $bytes:ident => $to_words:expr) => {
        impl Stored for $stored {
            $(const IS_PAIR: bool = $is_pair;)?

            #[inline(always)]
            fn of_words($words: [u32; 2]) -> Self {
                $of_words
            }

            #[inline(always)]
            fn words(self) -> (u32, u32) {
                let $bytes = self;
                $to_words
            }
        }
    };
}

// Bytes are converted together where possible: without optimisation a word that is loaded just after its bytes were
// stored one by one makes the processor wait.
stored!([u8; 1]: words => [words[0] as u8], bytes => (bytes[0] as u32, 0));
stored!([u8; 2]: words => (words[0] as u16).to_le_bytes(), bytes => (u16::from_le_bytes(bytes) as u32, 0));
stored!([u8; 4]: words => words[0].to_le_bytes(), bytes => (u32::from_le_bytes(bytes), 0));
stored!([u8; 3]:
    words => {
        let [a, b, c, _] = words[0].to_le_bytes();
        [a, b, c]
    },
    bytes => (bytes[0] as u32 | (bytes[1] as u32) << 8 | (bytes[2] as u32) << 16, 0)
);
stored!([u8; 6]:
    words => {
        let ([a, b, c, d], [e, f, ..]) = (words[0].to_le_bytes(), words[1].to_le_bytes());
        [a, b, c, d, e, f]
    },
    bytes => {
        let [a, b, c, d, e, f] = bytes;
        (u32::from_le_bytes([a, b, c, d]), u16::from_le_bytes([e, f]) as u32)
    }
);
stored!([u8; 8]:
    words => ((words[1] as u64) << 32 | words[0] as u64).to_le_bytes(),
    bytes => {
        let word = u64::from_le_bytes(bytes);
        (word as u32, (word >> 32) as u32)
    }
);

stored!(u16: words => words[0] as u16, code => (code as u32, 0));
stored!(u32: words => words[0], code => (code, 0));
stored!(u64: words => u64::from(words[1]) << 32 | u64::from(words[0]), code => (code as u32, (code >> 32) as u32));
stored!([u32; 2]: words => words, code => (code[0], code[1]));
stored!([i8; 2], true: words => [words[0] as i8, (words[0] >> 8) as i8], code =>
    (code[0] as u8 as u32 | (code[1] as u8 as u32) << 8, 0));
stored!([i16; 2], true: words => [words[0] as i16, (words[0] >> 16) as i16], code =>
    (code[0] as u16 as u32 | (code[1] as u16 as u32) << 16, 0));

/// `$call`, in which `$size` is the constant `$bytes`: a size of stored codes.
macro_rules! with_size {
    ($bytes:expr, $size:ident => $call:expr) => {
        match $bytes {
            1 => with_size!(1 $size $call),
            2 => with_size!(2 $size $call),
            3 => with_size!(3 $size $call),
            4 => with_size!(4 $size $call),
            6 => with_size!(6 $size $call),
            _ => with_size!(8 $size $call),
        }
    };
    ($bytes:literal $size:ident $call:expr) => {{
        const $size: usize = $bytes;
        $call
    }};
}

pub(crate) use with_size;
