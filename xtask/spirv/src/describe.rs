//! The manifest's words about kernels, modules and tables.

use crate::kernel::Kernel;
use crate::passes;
use unitvec_catalogue::{AnyCodec, Element, Operation, best_fit_table};
use unitvec_link::{LIBRARY, Signature};
use unitvec_manifest as manifest;
use unitvec_manifest::{
    Binding, Codec, Constant, EntryPoint, Interface, Library, Module, PushConstant, Role,
    SpecializationConstant, Table,
};
use unitvec_vulkan::{GROUP, WORKGROUP};

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
        name: kernel.name.clone(),
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
    let [(input, reads), (output, writes)] = buffers(kernel);
    let mut name = format!("{input} to {output}");
    let mut bindings = vec![reads, writes];
    if kernel.name == manifest::DECODE_BY_TABLE {
        let content = "table: the decoded vectors, of three f32, of the codes 0 to 65535";
        let bytes = Some((Element::Vector.bytes() << 16) as u32);
        bindings.push(Binding { bytes, ..storage_buffer(2, Role::Table, content) });
    } else if kernel.encodes_by_table() {
        let bytes = Some(size_of_val(best_fit_table()) as u32);
        let table = Some(manifest::BEST_FIT_TABLE.to_owned());
        bindings.push(Binding { bytes, table, ..storage_buffer(2, Role::Table, "table") });
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
        specialization_constants: vec![whole_groups(), fast()],
    };
    (name, interface)
}

/// The buffers that a kernel reads and writes, with the names of their contents.
fn buffers(kernel: &Kernel) -> [(String, Binding); 2] {
    // `arithmetic` reads two floats as if they were a code, and writes seven.
    let (element, bytes) = match kernel.codec {
        Some(codec) => (codec.element, codec.bytes),
        None if kernel.name == manifest::ARITHMETIC => (Element::Frame, 8),
        None => (Element::Vector, 2),
    };
    let (elements, content) = match element {
        Element::Frame => ("frames", "seven f32 a frame (normal, tangent, handedness), packed"),
        Element::Rotation => ("rotations", "four f32 a rotation (the quaternion x, y, z, w), packed"),
        Element::Vector => ("vectors", "three f32 a vector, packed"),
    };
    let plural = if bytes == 1 { "" } else { "s" };
    let elements = (elements.to_owned(), content, element.bytes());
    let codes = (format!("codes of {bytes} byte{plural}"), "codes, little endian, packed", bytes);
    let [input, output] = match kernel.operation {
        Operation::Encode => [elements, codes],
        Operation::Decode => [codes, elements],
    };
    [(0, Role::Input, input), (1, Role::Output, output)].map(|(binding, role, (name, content, bytes))| {
        let bytes_per_vector = Some(bytes as u32);
        (name, Binding { bytes_per_vector, ..storage_buffer(binding, role, content) })
    })
}

fn storage_buffer(binding: u32, role: Role, content: &str) -> Binding {
    Binding {
        binding,
        role,
        descriptor_type: "VK_DESCRIPTOR_TYPE_STORAGE_BUFFER".to_owned(),
        content: content.to_owned(),
        bytes_per_vector: None,
        bytes: None,
        // Kernels read and write no less than words.
        size_multiple: 4,
        table: None,
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

fn fast() -> SpecializationConstant {
    SpecializationConstant {
        id: passes::FAST,
        name: "fast".to_owned(),
        r#type: "bool".to_owned(),
        default: 0,
        meaning: "false: results are the CPU's, to the bit, on every device. true: the kernel takes the device's own division and \
                  square root, which may change the last bit. Kernels without either have no such constant."
            .to_owned(),
    }
}
