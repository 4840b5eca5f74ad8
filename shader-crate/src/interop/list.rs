//! The formats: a row each.

use super::octahedral::{Lattice, Layout};
use super::plain::{self, Plain};
use core::fmt;

/// The facts of a format that do not depend on its width.
#[derive(Debug)]
pub struct Row {
    /// The name, without a width.
    pub name: &'static str,
    /// The least width of a component, in bits.
    pub least: u32,
    /// The greatest.
    pub most: u32,
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
        self.least != self.most
    }
}

/// The name, with the widths: `draco:2-16`.
impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        if self.has_widths() { write!(f, ":{}-{}", self.least, self.most) } else { Ok(()) }
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

/// An octahedral format with the pole z.
const fn oct(lattice: Lattice, layout: Layout, plain: Plain) -> Mapping {
    Mapping::Octahedral { lattice, layout, pole_x: false, plain }
}

const CESIUM: &str =
    "CesiumGS/cesium 09a719b8, Core/AttributeCompression.js; 3d-tiles 01001ec8, specification/TileFormats";
const MESHOPT: &str =
    "zeux/meshoptimizer b5b2c439, src/vertexfilter.cpp; KHR_meshopt_compression, appendix B";
const GLTF: &str = "glTF's KHR_mesh_quantization; zeux/meshoptimizer b5b2c439, gltf/stream.cpp";
const UNORM_16: &str = "x and y, unsigned words";
const UNDEFINED: &str = "NaN: no defined code";

/// What most rows have.
const BASE: Row = Row {
    name: "",
    least: 0,
    most: 0,
    source: "",
    layout: "",
    zero: UNDEFINED,
    null: None,
    mapping: Mapping::Snorm,
    aim: 0.0,
};

/// What the formats of CesiumGS have in common.
const OF_CESIUM: Row = Row {
    source: CESIUM,
    zero: "code 0, which its shaders decode to no vector",
    null: Some(0),
    mapping: oct(Lattice::Unorm, Layout::Pair, plain::cesium),
    ..BASE
};

/// What glTF's formats have in common.
const OF_GLTF: Row = Row { source: GLTF, zero: "0, which the validator refuses", null: Some(0), ..BASE };

/// All formats.
pub static ROWS: [Row; 17] = [
    Row {
        name: "tiles3d-oct16",
        least: 8,
        most: 8,
        layout: "x and y, unsigned bytes (NORMAL_OCT16P)",
        ..OF_CESIUM
    },
    Row {
        name: "tiles3d-oct32",
        least: 16,
        most: 16,
        layout: "x and y, unsigned words (NORMAL_UP_OCT32P, NORMAL_RIGHT_OCT32P)",
        ..OF_CESIUM
    },
    Row {
        name: "quantized-mesh",
        least: 8,
        most: 8,
        layout: "x and y, unsigned bytes (octvertexnormals)",
        ..OF_CESIUM
    },
    Row {
        name: "godot4",
        least: 16,
        most: 16,
        source: "godotengine/godot 0208728e, core/math/vector3.cpp, servers/rendering/rendering_server.cpp",
        layout: UNORM_16,
        mapping: oct(Lattice::Unorm, Layout::Pair, plain::godot),
        aim: 0.5,
        ..BASE
    },
    Row {
        name: "bevy",
        least: 16,
        most: 16,
        source: "bevy_mesh 0.20.1, src/vertex.rs, src/mesh.rs",
        layout: "x and y, signed words",
        zero: "+Z",
        null: Some(0x8000),
        mapping: oct(Lattice::Snorm, Layout::Pair, plain::bevy),
        ..BASE
    },
    Row {
        name: "nanite",
        least: 2,
        most: 15,
        source: "Unreal Engine 5, NaniteEncodeGeometryData.cpp; CUE4Parse, UE4/Assets/Exports/Nanite",
        layout: "x and y, unsigned",
        mapping: oct(Lattice::Unorm, Layout::Pair, plain::nanite),
        ..BASE
    },
    Row {
        name: "hdrp-oct24",
        least: 12,
        most: 12,
        source: "Unity-Technologies/Graphics 0279aa47, HDRP's NormalBuffer.hlsl, Packing.hlsl",
        layout: "the low bytes of x and y, then their high 4 bits",
        zero: "+Z",
        mapping: oct(Lattice::Unorm, Layout::Bytes888, plain::hdrp),
        aim: 0.5,
        ..BASE
    },
    Row {
        name: "hdrp-oct22",
        least: 11,
        most: 11,
        source: "Unity's HDRP of 2017, Lit.hlsl",
        layout: "the magnitudes of x and y, 10 bits each, then a bit for each that is positive",
        mapping: oct(Lattice::Snorm, Layout::Signs, plain::hdrp_2017),
        ..BASE
    },
    Row {
        name: "hdrp-tetra",
        least: 10,
        most: 10,
        source: "Unity-Technologies/Graphics 0279aa47, Packing.hlsl",
        layout: "x and y on the face, 10 bits each, then the face, 2 bits",
        mapping: Mapping::Tetrahedron,
        ..BASE
    },
    Row {
        name: "cycles-packed",
        least: 16,
        most: 16,
        source: "blender/blender 9b8810a3, intern/cycles/util/types_normal.h",
        layout: UNORM_16,
        zero: "+Z",
        mapping: oct(Lattice::Unorm, Layout::Pair, plain::cycles_packed),
        ..BASE
    },
    Row {
        name: "cycles",
        least: 2,
        most: 16,
        source: "Tony7466/BLENDER b9e87623, intern/cycles/util/octahedral_normal.h",
        layout: "x and y, unsigned",
        mapping: oct(Lattice::Unorm, Layout::Pair, plain::cycles),
        ..BASE
    },
    Row {
        name: "draco",
        least: 2,
        most: 16,
        source: "google/draco 47238930, compression/attributes/normal_compression_utils.h",
        layout: "s (of y) and t (of z), unsigned; the pole is x",
        zero: "+X",
        mapping: Mapping::Octahedral {
            lattice: Lattice::Biased,
            layout: Layout::Pair,
            pole_x: true,
            plain: plain::draco,
        },
        ..BASE
    },
    Row {
        name: "meshopt-oct",
        least: 2,
        most: 8,
        source: MESHOPT,
        layout: "x, y, the largest number, and w (0), signed bytes",
        zero: "+Z",
        mapping: oct(Lattice::Snorm, Layout::Lanes8, plain::meshopt),
        ..BASE
    },
    Row {
        name: "meshopt-oct16",
        least: 2,
        most: 16,
        source: MESHOPT,
        layout: "x, y, the largest number, and w (0), signed words",
        zero: "+Z",
        mapping: oct(Lattice::Snorm, Layout::Lanes16, plain::meshopt),
        ..BASE
    },
    Row {
        name: "openvdb",
        least: 7,
        most: 7,
        source: "AcademySoftwareFoundation/openvdb 568538e9, math/QuantizedUnitVec.h",
        layout: "y in 7 bits, x in 6 of the octant, then the signs of z, y and x",
        zero: "+Z",
        mapping: oct(Lattice::Of126, Layout::Octant, plain::openvdb),
        ..BASE
    },
    Row { name: "gltf-snorm8", least: 8, most: 8, layout: "x, y, z and 0, signed bytes", ..OF_GLTF },
    Row { name: "gltf-snorm16", least: 16, most: 16, layout: "x, y, z and 0, signed words", ..OF_GLTF },
];
