//! The names that the GLSL takes from its user: the public functions, and names that begin with `unitvec`.

use super::dither;
use super::formats::FORMATS;
use super::projections::PROJECTIONS;
use super::versions::assert_valid;
use std::collections::BTreeSet;
use unitvec_catalogue::{CODECS, Operation};
use unitvec_tests::{glsl_families, repository};

/// The functions of floats, after the survey's listings, and of its bytes.
pub const OF_FLOATS: [(&str, &str); 12] = [
    ("oct.glsl", "float32x3_to_oct"),
    ("oct.glsl", "float32x3_to_octn_precise"),
    ("oct.glsl", "oct_to_float32x3"),
    ("oct.glsl", "snorm12x2_to_unorm8x3"),
    ("oct.glsl", "unorm8x3_to_snorm12x2"),
    ("oct.glsl", "snorm12x2_to_uint8x3"),
    ("oct.glsl", "uint8x3_to_snorm12x2"),
    ("eaoct.glsl", "float32x3_to_eaoctn_precise"),
    ("hemioct.glsl", "float32x3_to_hemioct"),
    ("hemioct.glsl", "hemioct_to_float32x3"),
    ("eaoct.glsl", "float32x3_to_eaoct"),
    ("eaoct.glsl", "eaoct_to_float32x3"),
];

/// All public functions besides those of the codecs, and their files.
fn besides_codecs() -> Vec<(&'static str, String)> {
    let of_floats = OF_FLOATS.iter().map(|(file, name)| (*file, (*name).to_owned()));
    let of_formats = FORMATS.iter().flat_map(|format| format.functions().map(|name| ("formats.glsl", name)));
    let of_projections = PROJECTIONS
        .iter()
        .flat_map(|projection| projection.functions().map(|name| (projection.file(), name)))
        .filter(|(_, name)| OF_FLOATS.iter().all(|(_, other)| other != name));
    let of_dither = dither::functions().into_iter().map(|name| ("dither.glsl", name));
    of_floats.chain(of_formats).chain(of_projections).chain(of_dither).collect()
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
    let public: BTreeSet<String> =
        of_codecs.chain(besides_codecs().into_iter().map(|(_, name)| name)).collect();
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

/// Names that users' shaders have.
const OF_A_USER: &str = "
#define snorm_max 1
#define unorm_max 255.0
#define PRECISE
in vec3 frame_tangent;
in vec3 ico_point;
const float EAOCT_LEAST = 0.5;
const uint FIB_SHIFT = 3u;
struct ParallelPlane { vec3 normal; float offset; };
uint snorm_encode(float r, uint bits) { return uint(r) + bits; }
float snorm_decode(uint code, uint bits) { return float(code + bits); }
float unorm_decode(uint code, uint bits) { return float(code + bits); }
uint oct_pack(vec2 e, uint bits) { return uint(e.x) + bits; }
vec2 oct_unpack(uint code, uint bits) { return vec2(code, bits); }
uint oct_encode(vec3 v, uint bits) { return uint(v.x) + bits; }
vec3 oct_decode(uint code, uint bits) { return vec3(code, bits, 1u); }
void frame_basis(vec3 n, out vec3 first, out vec3 second) { first = n; second = n; }
vec3 cube_decode(uint code, uint bits) { return vec3(code, bits, 1u); }
float spherical_wide_length(vec2 v) { return v.x; }
";

/// Each family's file, before the user's own names and after them.
#[test]
fn a_users_names_do_not_collide() {
    for family in glsl_families() {
        let text = std::fs::read_to_string(repository().join("glsl/flat").join(&family)).unwrap();
        let end = "out vec4 color;\nvoid main() { color = vec4(oct_pack(frame_tangent.xy, 1u)); }\n";
        for [first, second] in [[OF_A_USER, &text], [&text, OF_A_USER]] {
            assert_valid(&family, &format!("#version 450\n{first}\n{second}\n{end}"), &[]);
        }
    }
}
