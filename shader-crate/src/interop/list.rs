//! The formats: a row each.

use super::octahedral::{Lattice, Layout};
use super::plain::{self, Plain};
use core::fmt;

/// The facts of a format that do not depend on its width.
#[derive(Debug)]
pub struct Row {
    /// The name, without a width.
    pub name: &'static str,
    /// The least and the greatest width of a component, in bits.
    pub widths: [u32; 2],
    /// The source of encoder and decoder: repository or package, commit or version, file.
    pub source: &'static str,
    /// The bits of a code, the low ones first.
    pub layout: &'static str,
    /// The original's answer to a vector of length 0.
    pub zero: &'static str,
    /// A code that stands for no vector.
    pub null: Option<u64>,
    pub(super) mapping: Mapping,
    /// Parts of a step by which the middle of the vectors that the original truncates to a number lies above it.
    pub(super) aim: f32,
}

impl Row {
    /// True where the name takes a width: `draco:10`.
    pub fn has_widths(&self) -> bool {
        self.widths[0] < self.widths[1]
    }

    /// The row, with this code for no vector.
    const fn null(self, code: u64) -> Self {
        Self { null: Some(code), ..self }
    }

    /// The row, of an original that truncates: the middle of what it gives a number is half a step above it.
    const fn truncated(self) -> Self {
        Self { aim: 0.5, ..self }
    }
}

/// The name, with the widths: `draco:2-16`.
impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        let [least, most] = self.widths;
        if self.has_widths() { write!(f, ":{least}-{most}") } else { Ok(()) }
    }
}

/// The way from directions to numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mapping {
    /// Octahedral: where `pole_x`, x is the pole, and y and z are the coordinates.
    Octahedral { lattice: Lattice, layout: Layout, pole_x: bool, plain: Plain },
    /// Unity's tetrahedron.
    Tetrahedron,
    /// Three components.
    Snorm,
}

/// All formats.
pub static ROWS: [Row; 17] = {
    use Lattice::{Biased, Of126, Snorm, Unorm};
    use Layout::{Bytes888, Lanes8, Lanes16, Octant, Pair, Signs};
    type Text = &'static str;
    const fn of(name: Text, widths: [u32; 2], mapping: Mapping, texts: [Text; 3]) -> Row {
        let [source, layout, zero] = texts;
        Row { name, widths, source, layout, zero, null: None, mapping, aim: 0.0 }
    }
    const fn oct(lattice: Lattice, layout: Layout, plain: Plain) -> Mapping {
        Mapping::Octahedral { lattice, layout, pole_x: false, plain }
    }
    const OF_DRACO: Mapping =
        Mapping::Octahedral { lattice: Biased, layout: Pair, pole_x: true, plain: plain::draco };
    const BY_CESIUM: Text = "CesiumGS/cesium 09a719b8, Core/AttributeCompression.js; 3d-tiles 01001ec8, specification/TileFormats";
    const BY_GODOT: Text =
        "godotengine/godot 0208728e, core/math/vector3.cpp, servers/rendering/rendering_server.cpp";
    const BY_BEVY: Text = "bevy_mesh 0.20.1, src/vertex.rs, src/mesh.rs";
    const BY_EPIC: Text =
        "Unreal Engine 5, NaniteEncodeGeometryData.cpp; CUE4Parse, UE4/Assets/Exports/Nanite";
    const BY_HDRP: Text = "Unity-Technologies/Graphics 0279aa47, HDRP's NormalBuffer.hlsl, Packing.hlsl";
    const BY_HDRP_2017: Text = "Unity's HDRP of 2017, Lit.hlsl";
    const BY_UNITY: Text = "Unity-Technologies/Graphics 0279aa47, Packing.hlsl";
    const BY_BLENDER: Text = "blender/blender 9b8810a3, intern/cycles/util/types_normal.h";
    const BY_BRANCH: Text = "Tony7466/BLENDER b9e87623, intern/cycles/util/octahedral_normal.h";
    const BY_GOOGLE: Text = "google/draco 47238930, compression/attributes/normal_compression_utils.h";
    const BY_MESHOPT: Text =
        "zeux/meshoptimizer b5b2c439, src/vertexfilter.cpp; KHR_meshopt_compression, appendix B";
    const BY_OPENVDB: Text = "AcademySoftwareFoundation/openvdb 568538e9, math/QuantizedUnitVec.h";
    const BY_GLTF: Text = "glTF's KHR_mesh_quantization; zeux/meshoptimizer b5b2c439, gltf/stream.cpp";
    const OCT16P: Text = "x and y, unsigned bytes (NORMAL_OCT16P)";
    const OCT32P: Text = "x and y, unsigned words (NORMAL_UP_OCT32P, NORMAL_RIGHT_OCT32P)";
    const VERTEX: Text = "x and y, unsigned bytes (octvertexnormals)";
    const PAIR: Text = "x and y, unsigned";
    const WORDS: Text = "x and y, unsigned words";
    const SIGNED_WORDS: Text = "x and y, signed words";
    const PARTED: Text = "the low bytes of x and y, then their high 4 bits";
    const SIGNS: Text = "the magnitudes of x and y, 10 bits each, then a bit for each that is positive";
    const FACE: Text = "x and y on the face, 10 bits each, then the face, 2 bits";
    const S_T: Text = "s (of y) and t (of z), unsigned; the pole is x";
    const LANES8: Text = "x, y, the largest number, and w (0), signed bytes";
    const LANES16: Text = "x, y, the largest number, and w (0), signed words";
    const OCTANT: Text = "y in 7 bits, x in 6 of the octant, then the signs of z, y and x";
    const BYTES_XYZ: Text = "x, y, z and 0, signed bytes";
    const WORDS_XYZ: Text = "x, y, z and 0, signed words";
    const NO_VECTOR: Text = "code 0, which its shaders decode to no vector";
    const REFUSED: Text = "0, which the validator refuses";
    const UNDEFINED: Text = "NaN: no defined code";
    [
        of("tiles3d-oct16", [8; 2], oct(Unorm, Pair, plain::cesium), [BY_CESIUM, OCT16P, NO_VECTOR]).null(0),
        of("tiles3d-oct32", [16; 2], oct(Unorm, Pair, plain::cesium), [BY_CESIUM, OCT32P, NO_VECTOR]).null(0),
        of("quantized-mesh", [8; 2], oct(Unorm, Pair, plain::cesium), [BY_CESIUM, VERTEX, NO_VECTOR]).null(0),
        of("godot4", [16; 2], oct(Unorm, Pair, plain::godot), [BY_GODOT, WORDS, UNDEFINED]).truncated(),
        of("bevy", [16; 2], oct(Snorm, Pair, plain::bevy), [BY_BEVY, SIGNED_WORDS, "+Z"]).null(0x8000),
        of("nanite", [2, 15], oct(Unorm, Pair, plain::nanite), [BY_EPIC, PAIR, UNDEFINED]),
        of("hdrp-oct24", [12; 2], oct(Unorm, Bytes888, plain::hdrp), [BY_HDRP, PARTED, "+Z"]).truncated(),
        of("hdrp-oct22", [11; 2], oct(Snorm, Signs, plain::hdrp_2017), [BY_HDRP_2017, SIGNS, UNDEFINED]),
        of("hdrp-tetra", [10; 2], Mapping::Tetrahedron, [BY_UNITY, FACE, UNDEFINED]),
        of("cycles-packed", [16; 2], oct(Unorm, Pair, plain::cycles_packed), [BY_BLENDER, WORDS, "+Z"]),
        of("cycles", [2, 16], oct(Unorm, Pair, plain::cycles), [BY_BRANCH, PAIR, UNDEFINED]),
        of("draco", [2, 16], OF_DRACO, [BY_GOOGLE, S_T, "+X"]),
        of("meshopt-oct", [2, 8], oct(Snorm, Lanes8, plain::meshopt), [BY_MESHOPT, LANES8, "+Z"]),
        of("meshopt-oct16", [2, 16], oct(Snorm, Lanes16, plain::meshopt), [BY_MESHOPT, LANES16, "+Z"]),
        of("openvdb", [7; 2], oct(Of126, Octant, plain::openvdb), [BY_OPENVDB, OCTANT, "+Z"]),
        of("gltf-snorm8", [8; 2], Mapping::Snorm, [BY_GLTF, BYTES_XYZ, REFUSED]).null(0),
        of("gltf-snorm16", [16; 2], Mapping::Snorm, [BY_GLTF, WORDS_XYZ, REFUSED]).null(0),
    ]
};
