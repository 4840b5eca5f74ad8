//! `spirv/manifest.json`: what the committed modules are, how to call them and which sources they came from. The types below
//! define the file; [`schema`] is made of them.

#![deny(unsafe_code)]

pub mod modules;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use unitvec_catalogue::{Element, Operation};

/// Name of the manifest file in the modules' folder.
pub const FILE_NAME: &str = "manifest.json";

/// Name of the manifest's JSON schema in the same folder.
pub const SCHEMA: &str = "manifest.schema.json";

/// File of the table of lengths of `unitvec::best_fit`.
pub const BEST_FIT_TABLE: &str = "best_fit_table.bin";

/// The kernel that decodes two-byte codes of any codec by a table.
pub const DECODE_BY_TABLE: &str = "decode_by_table";

/// The kernel that computes what codecs compute, from which to learn how a device rounds.
pub const ARITHMETIC: &str = "arithmetic";

/// SPIR-V modules with compute kernels that encode and decode unit vectors, and how to call them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The JSON schema of this file.
    #[serde(rename = "$schema")]
    pub schema: String,
    /// The least Vulkan version that takes the modules.
    pub vulkan: String,
    /// The version of SPIR-V that they are in.
    pub spirv: String,
    /// All SPIR-V capabilities that they declare.
    pub capabilities: Vec<String>,
    /// Device features that have to be enabled.
    pub features: Vec<String>,
    /// Version of rust-gpu that compiled the modules.
    pub rust_gpu: String,
    /// rust-gpu's target: the SPIR-V environment.
    pub target: String,
    /// How to call a kernel, by the names that entry points refer to.
    pub interfaces: BTreeMap<String, Interface>,
    /// The module to link with.
    pub library: Library,
    /// Tables that some kernels read.
    pub tables: Vec<Table>,
    /// The modules, sorted by file.
    pub modules: Vec<Module>,
}

/// A SPIR-V module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Module {
    /// Path relative to the manifest's folder, with `/`.
    pub file: String,
    /// The codec; null for kernels that serve several.
    pub codec: Option<Codec>,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its kernels.
    pub entry_points: Vec<EntryPoint>,
}

/// A module of functions, without entry points, to link with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Library {
    /// Path relative to the manifest's folder.
    pub file: String,
    /// All SPIR-V capabilities that it declares.
    pub capabilities: Vec<String>,
    /// SHA-256 of the file.
    pub sha256: String,
    /// The functions that it exports under their names, as GLSL would declare them. Parameters are passed by value; UnitvecFrame
    /// is a struct of `vec3 normal` and `vec4 tangent`, whose fourth component is the handedness.
    pub functions: Vec<String>,
}

/// A codec.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Codec {
    /// Identifier.
    pub id: String,
    /// What it encodes: vectors are three packed f32, frames seven, which are normal, tangent and handedness.
    #[schemars(schema_with = "element_names")]
    pub element: Element,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: u32,
    /// The VkFormat that has the code's layout; null where there is none.
    pub vk_format: Option<String>,
    /// True where decoded vectors have unit length. The others are raw components: normalise them.
    pub is_unit: bool,
    /// Upper bound of the error in degrees: of a vector, or of a frame's normal and then of its tangent.
    pub max_error_deg: Vec<f32>,
}

/// A compute kernel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EntryPoint {
    /// Its name, which no other entry point of the manifest has.
    pub name: String,
    /// Whether it encodes or decodes.
    #[schemars(schema_with = "operation_names")]
    pub operation: Operation,
    /// The name of its interface.
    pub interface: String,
}

/// How to call a kernel. A vector is whatever it encodes or decodes: a frame, with codecs of frames.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Interface {
    /// Size of a workgroup.
    pub workgroup_size: [u32; 3],
    /// Vectors that a workgroup takes. Dispatch the number of vectors divided by this, rounded up, in x; 1 in y and z. For no
    /// vectors dispatch nothing.
    pub vectors_per_workgroup: u32,
    /// The descriptor set that has all bindings.
    pub descriptor_set: u32,
    /// The buffers.
    pub bindings: Vec<Binding>,
    /// Push constants, for the compute stage.
    pub push_constants: Vec<PushConstant>,
    /// Specialization constants: values of the pipeline (VkSpecializationInfo), where the defaults are not wanted.
    pub specialization_constants: Vec<SpecializationConstant>,
}

/// A buffer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Binding {
    /// Binding number.
    pub binding: u32,
    /// What it is to the kernel.
    pub role: Role,
    /// Its VkDescriptorType.
    pub descriptor_type: String,
    /// What it holds.
    pub content: String,
    /// Bytes that a vector takes in it; absent for a table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes_per_vector: Option<u32>,
    /// Bytes of a table; absent for others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<u32>,
    /// The descriptor's range is what the vectors or the table take, rounded up to a multiple of these bytes. Kernels process
    /// no vector that lies outside one of the ranges, ignore what rounding adds to the input, and write 0 to what it adds to
    /// the output.
    pub size_multiple: u32,
    /// The file of the table to bind; absent where it is not one of the manifest's tables.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
}

/// What a buffer is to a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// What is encoded or decoded: only read.
    Input,
    /// The result: only written.
    Output,
    /// Constant data: only read.
    Table,
}

/// A file of constant data.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// File name in the manifest's folder.
    pub file: String,
    /// Its size.
    pub bytes: u32,
    /// Its layout.
    pub layout: String,
    /// SHA-256 of the file.
    pub sha256: String,
}

/// A push constant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PushConstant {
    /// Byte offset.
    pub offset: u32,
    /// Type: `u32` or `bool`, either of which takes four bytes.
    pub r#type: String,
    /// What it holds.
    pub content: Constant,
}

/// What a push constant holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Constant {
    /// The number of vectors.
    Count,
}

/// A specialization constant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpecializationConstant {
    /// Its `constantID`.
    pub id: u32,
    /// Its name in the kernels' sources.
    pub name: String,
    /// Type: `u32` or `bool`, either of which takes four bytes.
    pub r#type: String,
    /// The value that it has without VkSpecializationInfo.
    pub default: u32,
    /// What its values mean.
    pub meaning: String,
}

fn element_names(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "string", "enum": Element::ALL })
}

fn operation_names(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "string", "enum": Operation::ALL })
}

/// The JSON schema of the manifest, as text.
pub fn schema() -> String {
    // A schema is plain JSON: serialising it has no way to fail.
    serde_json::to_string_pretty(&schemars::schema_for!(Manifest)).unwrap_or_default() + "\n"
}

/// SHA-256 of `bytes` in hexadecimal.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
