//! The parts of a document that hold geometry and rotations, as its JSON has them.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::Path;

use ::gltf::accessor::Dimensions;
use ::gltf::json;
use ::gltf::json::validation::{Checked, Error, Validate};
use ::gltf::mesh::Mode;
use ::gltf::{Document, Semantic};

use super::FORMAT;
use crate::{MeshError, parse_error};

/// A mesh of a document. That of the `gltf` crate takes fifty times the text of many primitives.
#[derive(serde::Deserialize)]
pub(crate) struct Primitives {
    pub(crate) name: Option<Box<str>>,
    pub(crate) primitives: Vec<Primitive>,
}

/// A primitive, as far as normals and tangents depend on it.
#[derive(serde::Deserialize)]
pub(crate) struct Primitive {
    attributes: Attributes,
    pub(super) indices: Option<u32>,
    pub(super) material: Option<u32>,
    #[serde(default)]
    pub(super) mode: Checked<Mode>,
}

/// The accessors of a primitive's attributes.
#[derive(serde::Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Attributes {
    position: Option<u32>,
    normal: Option<u32>,
    tangent: Option<u32>,
    texcoord_0: Option<u32>,
    texcoord_1: Option<u32>,
    #[serde(rename = "KHR_gaussian_splatting:ROTATION")]
    rotation: Option<u32>,
}

impl Primitive {
    /// The accessor of an attribute.
    pub(crate) fn get(&self, semantic: &Semantic) -> Option<u32> {
        match semantic {
            Semantic::Positions => self.attributes.position,
            Semantic::Normals => self.attributes.normal,
            Semantic::Tangents => self.attributes.tangent,
            Semantic::TexCoords(0) => self.attributes.texcoord_0,
            Semantic::TexCoords(1) => self.attributes.texcoord_1,
            _ => None,
        }
    }

    /// The accessor of the rotations of Gaussian splats.
    pub(crate) fn rotations(&self) -> Option<u32> {
        self.attributes.rotation
    }
}

/// An animation, as far as rotations depend on it.
#[derive(serde::Deserialize)]
pub(super) struct Animation {
    pub(super) name: Option<Box<str>>,
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

#[derive(serde::Deserialize)]
struct Channel {
    sampler: usize,
    target: Target,
}

#[derive(serde::Deserialize)]
struct Target {
    path: Box<str>,
}

#[derive(serde::Deserialize)]
struct Sampler {
    output: u32,
    interpolation: Option<Box<str>>,
}

impl Animation {
    /// The samplers of rotations, each once: its place, the accessor of its values, and whether these have tangents beside them.
    pub(super) fn rotations(&self) -> impl Iterator<Item = (usize, u32, bool)> {
        let of_rotations = self.channels.iter().filter(|channel| &*channel.target.path == "rotation");
        let samplers: BTreeSet<usize> = of_rotations.map(|channel| channel.sampler).collect();
        samplers.into_iter().filter_map(|at| {
            let sampler = self.samplers.get(at)?;
            Some((at, sampler.output, sampler.interpolation.as_deref() == Some("CUBICSPLINE")))
        })
    }
}

/// The part of a document that normals, tangents and rotations depend on. The rest is skipped.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Geometry {
    pub(super) asset: json::Asset,
    #[serde(default)]
    accessors: Vec<AccessorText>,
    #[serde(default)]
    buffers: Vec<json::Buffer>,
    #[serde(default)]
    buffer_views: Vec<json::buffer::View>,
    #[serde(default)]
    meshes: Vec<Primitives>,
    #[serde(default)]
    animations: Vec<Animation>,
    #[serde(default)]
    extensions_used: Vec<String>,
    #[serde(default)]
    extensions_required: Vec<String>,
}

/// An accessor without its bounds and its name, which may be anything.
#[derive(serde::Deserialize)]
#[serde(from = "Layout")]
struct AccessorText(json::Accessor);

#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
struct Layout {
    buffer_view: Option<json::Index<json::buffer::View>>,
    byte_offset: Option<json::validation::USize64>,
    count: json::validation::USize64,
    component_type: Checked<json::accessor::GenericComponentType>,
    r#type: Checked<Dimensions>,
    #[serde(default)]
    normalized: bool,
    sparse: Option<json::accessor::sparse::Sparse>,
}

impl From<Layout> for AccessorText {
    fn from(layout: Layout) -> Self {
        let Layout { buffer_view, byte_offset, count, component_type, r#type, normalized, sparse } = layout;
        Self(json::Accessor {
            buffer_view,
            byte_offset,
            count,
            component_type,
            type_: r#type,
            normalized,
            sparse,
            min: None,
            max: None,
            name: None,
            extensions: None,
            extras: Default::default(),
        })
    }
}

/// The version of a document of any version.
#[derive(serde::Deserialize)]
struct Versioned {
    asset: Version,
}

#[derive(serde::Deserialize)]
struct Version {
    version: Box<str>,
}

impl Geometry {
    pub(super) fn of(path: &Path, json: &[u8]) -> Result<Self, MeshError> {
        // Version 1 has other types everywhere, so that the version is looked for where these fail.
        let read = json::deserialize::from_slice::<Self>(json);
        let version = match &read {
            Ok(geometry) => Some(geometry.asset.version.as_str().into()),
            Err(_) => json::deserialize::from_slice(json).ok().map(|Versioned { asset }| asset.version),
        };
        match version {
            Some(version) if !version.starts_with("2.") => Err(wrong_version(path, version)),
            _ => read.map_err(|error| parse_error(path, FORMAT, error)),
        }
    }

    /// A document without what these do not depend on, so that an unknown extension of a material does not fail
    /// the validation of a mesh that can be read; its meshes; and its animations.
    pub(super) fn into_root(self) -> (json::Root, Vec<Primitives>, Vec<Animation>) {
        /// Beginnings of extensions that change no vertex of a mesh, but its looks, where it stands, how often, or when.
        const BESIDE: [&str; 12] = [
            "KHR_materials_",
            "KHR_texture_",
            "EXT_texture_",
            "MSFT_texture_",
            "KHR_techniques_",
            "KHR_lights_",
            "EXT_lights_",
            "KHR_node_",
            "KHR_animation_",
            "EXT_mesh_gpu_instancing",
            "CESIUM_RTC",
            "CESIUM_primitive_outline",
        ];
        /// Attributes in integers, and those of splats, which are read here.
        const READ: [&str; 2] = ["KHR_mesh_quantization", "KHR_gaussian_splatting"];
        let Self { asset, accessors, buffers, buffer_views, meshes, animations, .. } = self;
        let (extensions_used, mut extensions_required) = (self.extensions_used, self.extensions_required);
        // The validation has a message for each extension that it does not know.
        extensions_required.sort_unstable();
        extensions_required.dedup();
        extensions_required
            .retain(|name| !READ.contains(&&**name) && !BESIDE.iter().any(|prefix| name.starts_with(prefix)));
        let accessors = accessors.into_iter().map(|AccessorText(accessor)| accessor).collect();
        let root = json::Root {
            accessors,
            asset,
            buffers,
            buffer_views,
            extensions_used,
            extensions_required,
            ..Default::default()
        };
        (root, meshes, animations)
    }
}

/// Checks a document. An accessor without a place in a buffer is left alone: it has zeros, as the specification says.
pub(super) fn validated(root: json::Root) -> Result<Document, ::gltf::Error> {
    let mut errors = Vec::new();
    root.validate(&root, json::Path::new, &mut |at, error| match (at(), error) {
        (at, Error::Missing) if at.as_str().ends_with("].bufferView") => {}
        fault => errors.push(fault),
    });
    match errors.is_empty() {
        true => Ok(Document::from_json_without_validation(root)),
        false => Err(::gltf::Error::Validation(errors)),
    }
}

/// The error of a file of another version.
pub(super) fn wrong_version(path: &Path, version: impl Display) -> MeshError {
    parse_error(path, FORMAT, format!("its version is {version}, and 2.0 is read"))
}

/// Refuses geometry that only a decompressor can read. Where an extension is used but not required, the file has the
/// geometry uncompressed as well.
pub(crate) fn check_not_compressed(path: &Path, extensions: &[String]) -> Result<(), MeshError> {
    /// Extension, what it is, and whether glTF-Transform decompresses it.
    const COMPRESSIONS: [(&str, &str, bool); 4] = [
        ("KHR_draco_mesh_compression", "Draco", true),
        ("EXT_meshopt_compression", "meshoptimizer", true),
        ("KHR_meshopt_compression", "meshoptimizer", false),
        ("KHR_gaussian_splatting_compression_spz_2", "SPZ", false),
    ];
    let is_there = |name: &str| extensions.iter().any(|extension| extension == name);
    let Some((extension, method, decompresses)) = COMPRESSIONS.into_iter().find(|c| is_there(c.0)) else {
        return Ok(());
    };
    let remedy = match decompresses {
        true => format!(
            "decompress it first, for example with `gltf-transform copy {} uncompressed.glb` (npm package \
             @gltf-transform/cli)",
            quoted(path)
        ),
        false => "export it without compression".to_owned(),
    };
    Err(MeshError::Compressed { path: path.into(), extension, method, remedy })
}

/// A path as a shell takes it.
pub(super) fn quoted(path: &Path) -> String {
    let path = path.display().to_string();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
    if path.chars().all(is_plain) { path } else { format!("'{}'", path.replace('\'', r"'\''")) }
}
