//! The manifest's words about kernels, modules and tables.

use crate::kernel::Kernel;
use unitvec_catalogue::{AnyCodec, Element, Operation, best_fit_table};
use unitvec_link::{LIBRARY, Signature};
use unitvec_manifest as manifest;
use unitvec_manifest::{
    Binding, Codec, Constant, EntryPoint, Interface, Library, Module, PushConstant, Role,
    SpecializationConstant, Table,
};
use unitvec_vulkan::{GROUP, WORKGROUP};

/// All kernels' buffers.
const STORAGE_BUFFER: &str = "VK_DESCRIPTOR_TYPE_STORAGE_BUFFER";

/// Bytes of a word: kernels read and write no less.
const WORD: u32 = 4;

/// The table of [`unitvec::best_fit`], of these bytes.
pub fn table(bytes: &[u8]) -> Table {
    Table {
        file: manifest::BEST_FIT_TABLE.to_owned(),
        bytes: bytes.len() as u32,
        layout: "words of four lengths of one byte, the best alone lowest; column and row are 640 mid / max and 640 min / max \
                 of a direction's magnitudes, rounded down; word 4 (g (2 g + 1) + row) + column, g = column / 4 rounded \
                 down; to be bound as u32 words, little endian"
            .to_owned(),
        sha256: manifest::sha256_hex(bytes),
    }
}

/// The library of these bytes.
pub fn library(bytes: &[u8]) -> Library {
    Library {
        file: LIBRARY.to_owned(),
        capabilities: ["Linkage", "Shader"].map(str::to_owned).into(),
        sha256: manifest::sha256_hex(bytes),
        functions: Signature::all().map(|signature| signature.to_string()).collect(),
    }
}

/// A module in this file of `spirv/`.
pub fn module(file: &str, kernels: &[Kernel], bytes: &[u8]) -> Module {
    let entry_points = kernels.iter().map(|kernel| EntryPoint {
        name: kernel.name(),
        operation: kernel.operation,
        interface: interface(kernel).0,
    });
    Module {
        file: file.to_owned(),
        codec: kernels.first().and_then(|kernel| kernel.codec).map(codec),
        sha256: manifest::sha256_hex(bytes),
        entry_points: entry_points.collect(),
    }
}

fn codec(format: &AnyCodec) -> Codec {
    let AnyCodec { id, element, bits, bytes, vk_format, is_unit, max_errors_deg, .. } = *format;
    let (id, vk_format) = (id.to_owned(), vk_format.map(str::to_owned));
    let max_error_deg = max_errors_deg.to_vec();
    Codec { id, element, bits, bytes: bytes as u32, vk_format, is_unit, max_error_deg }
}

/// A kernel's interface and the name of that.
pub fn interface(kernel: &Kernel) -> (String, Interface) {
    let [input, output] = buffers(kernel);
    let mut name = format!("{} to {}", input.name, output.name);
    let mut bindings = vec![input.binding(0, Role::Input), output.binding(1, Role::Output)];
    if kernel.name() == manifest::DECODE_BY_TABLE {
        let content = "table: the decoded vectors, of three f32, of the codes 0 to 65535";
        bindings.push(table_binding(content, Element::Vector.bytes() << 16, None));
    } else if kernel.encodes_by_table() {
        bindings.push(table_binding("table", size_of_val(best_fit_table()), Some(manifest::BEST_FIT_TABLE)));
    }
    if bindings.len() > 2 {
        name += " by a table";
    }
    let count = PushConstant { offset: 0, r#type: "u32".to_owned(), content: Constant::Count };
    let interface = Interface {
        workgroup_size: [WORKGROUP as u32, 1, 1],
        vectors_per_workgroup: (WORKGROUP * GROUP) as u32,
        descriptor_set: 0,
        bindings,
        push_constants: vec![count],
        specialization_constants: vec![whole_groups()],
    };
    (name, interface)
}

/// What a buffer of elements or codes holds.
struct Buffer {
    name: String,
    content: &'static str,
    bytes_per_vector: usize,
}

impl Buffer {
    fn new(name: &str, content: &'static str, bytes_per_vector: usize) -> Self {
        Self { name: name.to_owned(), content, bytes_per_vector }
    }

    fn binding(&self, binding: u32, role: Role) -> Binding {
        Binding {
            binding,
            role,
            descriptor_type: STORAGE_BUFFER.to_owned(),
            content: self.content.to_owned(),
            bytes_per_vector: Some(self.bytes_per_vector as u32),
            bytes: None,
            size_multiple: WORD,
            table: None,
        }
    }
}

/// What a kernel reads and what it writes.
fn buffers(kernel: &Kernel) -> [Buffer; 2] {
    let elements = match kernel.codec.map(|codec| codec.element) {
        Some(Element::Frame) => Buffer::new(
            "frames",
            "seven f32 a frame (normal, tangent, handedness), packed",
            Element::Frame.bytes(),
        ),
        _ => Buffer::new("vectors", "three f32 a vector, packed", Element::Vector.bytes()),
    };
    // Codes that are decoded by a table have two bytes.
    let bytes = kernel.codec.map_or(2, |codec| codec.bytes);
    let plural = if bytes == 1 { "" } else { "s" };
    let codes = Buffer::new(&format!("codes of {bytes} byte{plural}"), "codes, little endian, packed", bytes);
    match kernel.operation {
        Operation::Encode => [elements, codes],
        Operation::Decode => [codes, elements],
    }
}

fn table_binding(content: &str, bytes: usize, file: Option<&str>) -> Binding {
    Binding {
        binding: 2,
        role: Role::Table,
        descriptor_type: STORAGE_BUFFER.to_owned(),
        content: content.to_owned(),
        bytes_per_vector: None,
        bytes: Some(bytes as u32),
        size_multiple: WORD,
        table: file.map(str::to_owned),
    }
}

fn whole_groups() -> SpecializationConstant {
    SpecializationConstant {
        id: 0,
        name: "whole_groups".to_owned(),
        r#type: "u32".to_owned(),
        default: 0,
        meaning: format!(
            "0: the kernel keeps to the ranges of both buffers. 1: it looks at no range; the caller promises that the ranges \
             hold whole groups of {GROUP} vectors, all of the push constant's number, and the results beyond that number mean \
             nothing. The range of a table is looked at in either case."
        ),
    }
}
