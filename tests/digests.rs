//! A code is a file format: once released, its bits never change. `vectors/digests.csv` has, for each codec, digests of
//! the codes of fixed vectors and of the vectors of fixed codes. The file is the released format, not a measurement: a
//! difference is a break of every file written so far.

use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, frames, rotations, vectors};
use unitvec_processors::{COUNT, Coder};

/// The format, as it was when each codec was first released.
const RELEASED: &str = include_str!("../vectors/digests.csv");

/// The row of a codec: digests of its encoded and of its decoded values, on all cores.
fn row<const N: usize>(codec: &AnyCodec) -> String {
    let encode =
        |elements: &[[f32; N]], codes: &mut [_]| codec.encode_cpu(elements.as_flattened(), codes).unwrap();
    let decode = |codes: &[_], elements: &mut [[f32; N]]| {
        codec.decode_cpu(codes, elements.as_flattened_mut()).unwrap()
    };
    let AnyCodec { id, bits, bytes, .. } = *codec;
    Coder { id, bits, bytes, encode: &encode, decode: &decode }.released(COUNT)
}

/// Every codec writes and reads the same bits as when it was released. `cargo xtask renew vectors` adds the rows of new
/// codecs to the file, and changes no other.
#[test]
fn codes_are_the_released_ones() {
    let released: BTreeMap<&str, &str> =
        RELEASED.lines().skip(1).filter_map(|line| Some((line.split(',').next()?, line))).collect();
    let (of_frames, of_rotations) = (frames().iter().map(row::<7>), rotations().iter().map(row::<4>));
    let rows: Vec<String> = vectors().iter().map(row::<3>).chain(of_frames).chain(of_rotations).collect();
    for row in &rows {
        let id = row.split(',').next().unwrap_or_default();
        if let Some(released) = released.get(id) {
            assert_eq!(released, row, "{id} has changed: this breaks files people have stored");
        } else {
            assert!(std::env::var_os("BLESS").is_some(), "{id} has no digest: cargo xtask renew vectors");
        }
    }
    if std::env::var_os("BLESS").is_some() {
        let new = rows.iter().filter(|row| !RELEASED.contains(row.as_str()));
        let text = new.fold(RELEASED.to_owned(), |text, row| text + row + "\n");
        let path = unitvec_tests::repository().join("vectors/digests.csv");
        unitvec_files::write_file(&path, text.as_bytes()).unwrap();
    }
}
