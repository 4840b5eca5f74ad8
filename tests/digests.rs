//! A code is a file format: once released, its bits never change. `tests/data/digests.csv` has, for each codec, digests of
//! the codes of fixed vectors and of the vectors of fixed codes. The file is the released format, not a measurement: a
//! difference is a break of every file written so far.

use std::collections::BTreeMap;
use unitvec_catalogue::{CATALOGUE, Coding, FRAMES};
use unitvec_host::manifest::sha256_hex;
use unitvec_tests::directions::Rng;

/// The format, as it was when each codec was first released.
const RELEASED: &str = include_str!("data/digests.csv");

/// Vectors and codes for each digest.
const COUNT: usize = 1 << 16;

/// A number from -1 to 1 with 23 bits after the point: exact.
fn component(rng: &mut Rng) -> f32 {
    (rng.bits() >> 40) as f32 / 8_388_608.0 - 1.0
}

/// The row of a codec: digests of what it encodes and of what it decodes.
fn row<const N: usize>(codec: &impl Coding<N>) -> String {
    let (format, mut rng) = (codec.format(), Rng::new(1));
    let mut elements = vec![[0.0; N]; COUNT];
    elements.iter_mut().flatten().for_each(|c| *c = component(&mut rng));
    let mut codes = vec![0; COUNT * format.bytes];
    codec.encode_cpu(&elements, &mut codes).unwrap();
    let encoded = sha256_hex(&codes);

    codes.iter_mut().for_each(|byte| *byte = rng.bits() as u8);
    codec.decode_cpu(&codes, &mut elements).unwrap();
    let decoded: Vec<u8> = elements.iter().flatten().flat_map(|c| c.to_bits().to_le_bytes()).collect();
    format!("{},{encoded},{}", format.id, sha256_hex(&decoded))
}

/// Every codec writes and reads what it did when it was released. `BLESS=1` adds the rows of new codecs to the file, and
/// changes no other.
#[test]
fn codes_are_the_released_ones() {
    let released: BTreeMap<&str, &str> =
        RELEASED.lines().skip(1).filter_map(|line| Some((line.split(',').next()?, line))).collect();
    let rows: Vec<String> = CATALOGUE.iter().map(row).chain(FRAMES.iter().map(row)).collect();
    for row in &rows {
        let id = row.split(',').next().unwrap_or_default();
        if let Some(released) = released.get(id) {
            assert_eq!(released, row, "{id} has changed");
        } else {
            assert!(std::env::var_os("BLESS").is_some(), "{id} has no digest: BLESS=1 cargo test digests");
        }
    }
    if std::env::var_os("BLESS").is_some() {
        let new = rows.iter().filter(|row| !RELEASED.contains(row.as_str()));
        let text = new.fold(RELEASED.to_owned(), |text, row| text + row + "\n");
        let path = unitvec_tests::repository().join("tests/data/digests.csv");
        unitvec_host::output::write_file(&path, text.as_bytes()).unwrap();
    }
}
