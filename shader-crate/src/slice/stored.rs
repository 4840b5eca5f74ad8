//! Codes as they are stored: as so many bytes, little endian.

/// A stored code: an array of as many bytes as [`Codec::BYTES`](crate::Codec::BYTES) says.
pub trait Stored {
    /// The low bytes of a code's two words.
    fn of_words(words: [u32; 2]) -> Self;

    /// The words of the code, the low one first.
    fn words(self) -> [u32; 2];
}

/// Implements [`Stored`]. For each word: its bytes that are stored, and in parentheses those that are not.
macro_rules! stored {
    ($size:literal: $($low:ident)* ($($no_low:ident)*) $(, $($high:ident)* ($($no_high:ident)*))?) => {
        impl Stored for [u8; $size] {
            #[inline(always)]
            fn of_words(words: [u32; 2]) -> Self {
                let [$($low,)* ..] = words[0].to_le_bytes();
                $(let [$($high,)* ..] = words[1].to_le_bytes();)?
                [$($low,)* $($($high),*)?]
            }

            #[inline(always)]
            fn words(self) -> [u32; 2] {
                let [$($low,)* $($($high),*)?] = self;
                $(let $no_low = 0;)*
                $($(let $no_high = 0;)*)?
                [u32::from_le_bytes([$($low,)* $($no_low),*]), 0 $(| u32::from_le_bytes([$($high,)* $($no_high),*]))?]
            }
        }
    };
}

stored!(1: a (b c d));
stored!(2: a b (c d));
stored!(3: a b c (d));
stored!(4: a b c d ());
stored!(6: a b c d (), e f (g h));
stored!(8: a b c d (), e f g h ());

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
