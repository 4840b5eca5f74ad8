//! `vectors/` has a file for each codec: inputs, their codes and what these decode to, for those who port a codec by hand. It
//! is the released format, as `vectors/digests.csv` is.

mod inputs;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use unitvec_catalogue::{AnyCodec, CODECS, Domain, Element};
use unitvec_files::write_file;
use unitvec_tests::repository;

/// The format's version, the same for all codecs. A codec with another layout would be another codec.
const FORMAT_VERSION: u32 = 1;

/// Cases in a file.
const CASES: usize = 256;

/// The committed files hold the codecs' results, which the suite and the tests of frames compare with the oracle; each
/// that is missing or has no codec is named. `cargo xtask renew vectors` writes files that are missing, and changes no
/// other.
#[test]
fn test_vectors_are_the_released_ones() {
    let folder = repository().join("vectors");
    let mut wrong = Vec::new();
    for format in &CODECS {
        let text = text(format);
        let path = folder.join(format.id).with_extension("json");
        if !path.exists() && std::env::var_os("BLESS").is_some() {
            write_file(&path, text.as_bytes()).unwrap();
        }
        match std::fs::read_to_string(&path) {
            Ok(committed) => wrong.extend(difference(format.id, &committed, &text)),
            Err(_) => wrong.push(format!("vectors/{}.json is missing: cargo xtask renew vectors", format.id)),
        }
    }
    wrong.extend(without_a_codec(&folder));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The README's excerpt of a file agrees with it.
#[test]
fn readme_shows_a_file() {
    let [readme, file] = ["README.md", "oct16.json"]
        .map(|name| std::fs::read_to_string(repository().join("vectors").join(name)).unwrap());
    let shown = readme.split("```json\n").nth(1).unwrap().split("```").next().unwrap();
    assert!(file.starts_with(shown) && shown.contains("cases"), "{shown}");
}

/// The first line in which a file differs from the codec's results.
fn difference(id: &str, committed: &str, text: &str) -> Option<String> {
    let lines = committed.lines().map(Some).chain(std::iter::repeat(None));
    let (line, (old, new)) = lines.zip(text.lines()).enumerate().find(|(_, (old, new))| *old != Some(new))?;
    let old = old.unwrap_or("nothing");
    Some(format!(
        "vectors/{id}.json, line {}, has {old}, but the codec gives {new}: this breaks files people have stored",
        line + 1
    ))
}

/// Files of codecs that the list does not have.
fn without_a_codec(folder: &Path) -> Vec<String> {
    let ids: BTreeSet<&str> = CODECS.iter().map(|format| format.id).collect();
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_of_none = |path: &PathBuf| {
        path.extension().is_some_and(|extension| extension == "json")
            && !path.file_stem().is_some_and(|stem| ids.contains(&*stem.to_string_lossy()))
    };
    files
        .filter(is_of_none)
        .map(|path| format!("{} is of no codec: what was released stays", path.display()))
        .collect()
}

/// A line of a file: the bits of an element, its code, and the bits of what this decodes to, in hexadecimal.
fn line<const N: usize>(codec: &AnyCodec, element: [f32; N]) -> String {
    let words @ [low, high] = codec.encode_one(element);
    let (code, digits) = (u64::from(low) | (u64::from(high) << 32), 2 * codec.bytes);
    let bits = |floats: [f32; N]| floats.map(|f| format!("{:08x}", f.to_bits())).join(" ");
    format!("[\"{}\", \"{code:0digits$x}\", \"{}\"]", bits(element), bits(codec.decode_one(words)))
}

/// The file of a codec.
fn text(codec: &AnyCodec) -> String {
    let (element, lines): (_, Vec<String>) = match codec.element {
        Element::Vector => ("x y z", inputs::vectors().into_iter().map(|v| line(codec, v)).collect()),
        Element::Frame => (
            "normal.x normal.y normal.z tangent.x tangent.y tangent.z handedness",
            inputs::frames().into_iter().map(|frame| line(codec, frame)).collect(),
        ),
        Element::Rotation => ("x y z w", inputs::rotations().into_iter().map(|q| line(codec, q)).collect()),
    };
    let AnyCodec { id, bits, bytes, domain, .. } = *codec;
    let domain = if domain == Domain::Hemisphere { "hemisphere" } else { "sphere" };
    let mut text = format!(
        "{{\n\"codec\": \"{id}\",\n\"format_version\": {FORMAT_VERSION},\n\"bits\": {bits},\n\"bytes\": {bytes},\n\
         \"words\": {},\n\"domain\": \"{domain}\",\n\"element\": \"{element}\",\n\"cases\": [\n",
        bits.div_ceil(32),
    );
    write!(text, "{}\n]\n}}\n", lines.join(",\n")).unwrap();
    text
}
