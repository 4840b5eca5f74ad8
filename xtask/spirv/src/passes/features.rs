//! Modules that need no feature of a device.
//!
//! rust-gpu declares Vulkan's memory model, for which a device needs a feature that many engines do not turn on. The
//! kernels use nothing of it: no atomics, no barriers, no availability of a single access. With GLSL's memory model they
//! are the same.

use rspirv::dr::{Module, Operand};
use rspirv::spirv::{Capability, MemoryModel};

const EXTENSION: &str = "SPV_KHR_vulkan_memory_model";

/// Replaces Vulkan's memory model by GLSL's. (spirv-val objects where an instruction does use it.)
pub fn remove(module: &mut Module) {
    let capability = Operand::Capability(Capability::VulkanMemoryModel);
    module.capabilities.retain(|declared| !declared.operands.contains(&capability));
    let extension = Operand::LiteralString(EXTENSION.to_owned());
    module.extensions.retain(|declared| !declared.operands.contains(&extension));
    for operand in module.memory_model.iter_mut().flat_map(|model| &mut model.operands) {
        if *operand == Operand::MemoryModel(MemoryModel::Vulkan) {
            *operand = Operand::MemoryModel(MemoryModel::GLSL450);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::snippet;
    use super::*;
    use rspirv::binary::Assemble;
    use rspirv::dr::Instruction;
    use rspirv::spirv::Op;

    #[test]
    fn the_memory_model_of_vulkan_becomes_that_of_glsl() {
        let expected = snippet::module("OpStore %6 %f1");
        let mut module = expected.clone();
        let capability = vec![Operand::Capability(Capability::VulkanMemoryModel)];
        module.capabilities.push(Instruction::new(Op::Capability, None, None, capability));
        let extension = vec![Operand::LiteralString(EXTENSION.to_owned())];
        module.extensions.push(Instruction::new(Op::Extension, None, None, extension));
        module.memory_model.as_mut().unwrap().operands[1] = Operand::MemoryModel(MemoryModel::Vulkan);
        remove(&mut module);
        assert_eq!(module.assemble(), expected.assemble());
    }
}
