//! Codecs that stand for others.

use unitvec_catalogue::{AnyCodec, CODECS};

/// The widest codec of each series: `oct8` to `oct32` differ in their bits alone, and `oct32` stands for them. Codecs of more
/// than 32 bits, whose codes are two words, are a series of their own.
pub fn widest_of_each_series() -> Vec<&'static AnyCodec> {
    let mut widest: Vec<&'static AnyCodec> = Vec::new();
    for format in &CODECS {
        match widest.iter_mut().find(|other| series(other) == series(format)) {
            Some(other) if other.bits < format.bits => *other = format,
            Some(_) => {}
            None => widest.push(format),
        }
    }
    widest
}

/// The identifier without its numbers, and whether codes are two words.
fn series(format: &AnyCodec) -> (String, bool) {
    (format.id.replace(|c: char| c.is_ascii_digit(), ""), format.bits > 32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_codec_has_one_as_wide_in_its_series() {
        let widest = widest_of_each_series();
        let ids: Vec<&str> = widest.iter().map(|format| format.id).collect();
        for id in ["oct32", "oct48", "oct32p", "oct52p", "eaoct32p", "snorm16x3", "latlong32d", "frame32"] {
            assert!(ids.contains(&id), "{id}: {ids:?}");
        }
        for id in ["oct16", "eaoct24p", "snorm8x3"] {
            assert!(!ids.contains(&id), "{id}: {ids:?}");
        }
        for format in &CODECS {
            let mut of = widest.iter().filter(|other| series(other) == series(format));
            assert!(of.next().is_some_and(|other| other.bits >= format.bits) && of.next().is_none());
        }
    }
}
