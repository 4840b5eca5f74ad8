//! The names that the GLSL takes from its user: the public functions, and names that begin with `unitvec`.

use super::dither;
use super::formats::FORMATS;
use super::projections::PROJECTIONS;
use std::collections::BTreeSet;
use unitvec_catalogue::{CODECS, Operation};
use unitvec_tests::{glsl_families, repository};

/// The functions besides projections: precise encoders, the survey's bytes, null codes, lengths and caps.
const OTHERS: [(&str, &str); 25] = [
    ("oct.glsl", "float32x3_to_octn_precise"),
    ("eaoct.glsl", "float32x3_to_eaoctn_precise"),
    ("hemioct.glsl", "float32x3_to_hemioctn_precise"),
    ("uoct.glsl", "float32x3_to_uoctn_precise"),
    ("oct.glsl", "octn_to_unorm"),
    ("oct.glsl", "unorm_to_octn"),
    ("oct.glsl", "snorm12x2_to_unorm8x3"),
    ("oct.glsl", "unorm8x3_to_snorm12x2"),
    ("oct.glsl", "snorm12x2_to_uint8x3"),
    ("oct.glsl", "uint8x3_to_snorm12x2"),
    ("or_null.glsl", "code_or_null"),
    ("or_null.glsl", "vector_or_zero"),
    ("or_null.glsl", "code_or_null_wide"),
    ("or_null.glsl", "vector_or_zero_wide"),
    ("with_length.glsl", "code_of_length"),
    ("with_length.glsl", "length_of_code"),
    ("with_length.glsl", "with_reach"),
    ("cap.glsl", "cap_about"),
    ("cap.glsl", "cap_to_hemisphere"),
    ("cap.glsl", "hemisphere_to_cap"),
    ("cap.glsl", "cap_to_sphere"),
    ("cap.glsl", "sphere_to_cap"),
    ("cap.glsl", "dense_about"),
    ("cap.glsl", "dense_to_sphere"),
    ("cap.glsl", "sphere_to_dense"),
];

/// The formats of the wrappers, which encode and decode as codecs do.
const WRAPPERS: [&str; 9] =
    ["axial16", "axial24", "axial32", "angle8", "angle16", "eqangle8", "eqangle16", "vector32", "vector48"];

/// All public functions besides those of the codecs, and their files.
fn besides_codecs() -> Vec<(&'static str, String)> {
    let others = OTHERS.iter().map(|(file, name)| (*file, (*name).to_owned()));
    let of_formats = FORMATS.iter().flat_map(|format| format.functions().map(|name| ("formats.glsl", name)));
    let of_projections =
        PROJECTIONS.iter().flat_map(|projection| projection.functions().map(|name| (projection.file, name)));
    let of_dither = dither::functions().into_iter().map(|name| ("dither.glsl", name));
    others.chain(of_formats).chain(of_projections).chain(of_dither).collect()
}

fn text_of(file: &str) -> String {
    std::fs::read_to_string(repository().join("glsl/unitvec").join(file)).unwrap()
}

/// The prefix that a name needs if it is not public, and the name.
type Name = (&'static str, String);

/// The identifiers in a piece of code.
fn identifiers(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The names that a line declares if it is not indented: a function, constant, struct or macro.
fn declared(line: &str) -> Vec<Name> {
    let words: Vec<&str> = identifiers(line).collect();
    let one = |prefix, name: &str| vec![(prefix, name.to_owned())];
    match (line, words.as_slice()) {
        ("" | "}" | "};" | "precision highp float;" | "precision highp int;", _) => Vec::new(),
        (_, ["define", name, ..]) => one("UNITVEC_", name),
        (_, ["if" | "ifdef" | "ifndef" | "else" | "endif" | "undef" | "include", ..])
            if line.starts_with('#') =>
        {
            Vec::new()
        }
        (_, ["struct", name]) => one("Unitvec", name),
        (_, ["const", _, name, ..]) => one("UNITVEC_", name),
        (_, [kind, name, ..]) if line.starts_with(&format!("{kind} {name}(")) => one("unitvec_", name),
        _ => panic!("what does this declare? {line}"),
    }
}

/// All names that a file of GLSL declares at its top level: there lines are not indented, and below they are.
fn names(file: &str) -> Vec<Name> {
    let text = text_of(file);
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default().trim_end());
    code.filter(|line| !line.starts_with(' ')).flat_map(declared).collect()
}

/// A name that is neither public nor the library's own may be the user's, or that of another library.
#[test]
fn helpers_have_the_prefix() {
    let of_codecs = CODECS.iter().flat_map(|format| Operation::ALL.map(|half| format.function(half)));
    let of_wrappers = WRAPPERS.iter().flat_map(|id| ["encode", "decode"].map(|half| format!("{id}_{half}")));
    let public: BTreeSet<String> =
        of_codecs.chain(of_wrappers).chain(besides_codecs().into_iter().map(|(_, name)| name)).collect();
    let files = glsl_families().into_iter().chain(["arith.glsl".to_owned(), "unitvec.glsl".to_owned()]);
    let mut declared = BTreeSet::new();
    let mut bare = Vec::new();
    for file in files {
        for (prefix, name) in names(&file) {
            if !public.contains(&name) && !name.starts_with(prefix) {
                bare.push(format!("{file}: {name} must begin with {prefix}"));
            }
            declared.insert(name);
        }
    }
    assert!(bare.is_empty(), "{}", bare.join("\n"));
    let missing: Vec<&String> = public.difference(&declared).collect();
    assert!(missing.is_empty(), "the scan does not see {missing:?}");
}

/// The name of a function of an azimuthal projection as that of `stereo`, which stands for all nine, and of a dithered codec as that
/// of `oct16` or, with a precise encoder, `oct16p`, which stand for all.
fn named_once(name: &str) -> String {
    if let Some((id, _)) = name.split_once("_encode_dithered").or_else(|| name.split_once("_decode_dithered"))
    {
        return name
            .replace(id, if id.ends_with('p') && name.contains("encode") { "oct16p" } else { "oct16" });
    }
    let name = ["eqarea", "eqdist"].iter().fold(name.to_owned(), |name, other| name.replace(other, "stereo"));
    ["_concentric", "_ellipse"].iter().fold(name, |name, map| name.replace(map, ""))
}

/// The head of a file names its public functions besides those of codecs.
#[test]
fn functions_of_floats_are_in_the_heads() {
    for (file, name) in besides_codecs().into_iter().map(|(file, name)| (file, named_once(&name))) {
        let text = text_of(file);
        let mut head = text.lines().take_while(|line| line.starts_with("//"));
        assert!(
            head.any(|line| identifiers(line).any(|word| word == name)),
            "the head of {file} lacks {name}"
        );
    }
}
