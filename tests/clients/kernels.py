"""Runs one of the SPIR-V kernels on a Vulkan device: vectors in and codes out, or the other way round.

usage: python3 tests/clients/kernels.py SPIRV_FOLDER KERNEL COUNT [--device PART_OF_NAME] < input > output

All that it knows of the kernels is in SPIRV_FOLDER/manifest.json. It needs 64-bit Python and libvulkan.so.1.
With UNITVEC_VALIDATE set it runs under the validation layer, whose messages go to standard error.
"""

import argparse
import ctypes
import hashlib
import json
import os
import pathlib
import struct
import sys
from ctypes import byref, c_uint64

# VkResult from -1 downwards.
ERRORS = """OUT_OF_HOST_MEMORY OUT_OF_DEVICE_MEMORY INITIALIZATION_FAILED DEVICE_LOST MEMORY_MAP_FAILED
LAYER_NOT_PRESENT EXTENSION_NOT_PRESENT FEATURE_NOT_PRESENT INCOMPATIBLE_DRIVER TOO_MANY_OBJECTS""".split()
STORAGE_BUFFER, USAGE_STORAGE_BUFFER, WHOLE_SIZE = 7, 0x20, 2**64 - 1
HOST_VISIBLE_AND_COHERENT = 0x2 | 0x4
QUEUE_COMPUTE, STAGE_COMPUTE, BIND_POINT_COMPUTE = 0x2, 0x20, 1
PIPELINE_STAGE_COMPUTE, PIPELINE_STAGE_HOST = 0x800, 0x4000
ACCESS_SHADER_WRITE, ACCESS_HOST_READ = 0x40, 0x2000
# Offsets of members of VkPhysicalDeviceProperties.
API_VERSION, DEVICE_NAME, MAX_STORAGE_BUFFER_RANGE, MAX_WORKGROUPS = 0, 20, 324, 516


def fail(message):
    sys.exit(f"kernels.py: {message}")


def require(condition, message):
    if not condition:
        fail(message)


def call(function, *arguments):
    """Calls a function that returns a VkResult."""
    result = getattr(vulkan, function)(*arguments)
    name = f"VK_ERROR_{ERRORS[-1 - result]}" if -len(ERRORS) <= result < 0 else f"VkResult {result}"
    require(result == 0, f"{function}: {name}")


def made(function, *arguments):
    """The handle that a function returns through its last argument. The end of the process destroys it."""
    handle = c_uint64()
    call(function, *arguments, byref(handle))
    return handle


def pack(layout, *values):
    """A C struct. Its layout is in the letters of module `struct`: I uint32_t, i int32_t, N size_t,
    P pointer, Q uint64_t or a handle, 0P padding up to a pointer. Handles go by value, structs by address."""

    def plain(value):
        if isinstance(value, c_uint64):
            return value.value
        return ctypes.addressof(value) if isinstance(value, ctypes.Array) else value

    packed = struct.pack(f"@{layout}0P", *map(plain, values))
    memory = ctypes.create_string_buffer(packed, len(packed))
    memory.pointees = values  # they live as long as the struct
    return memory


def structure(number, layout, *members):
    """A Vulkan structure: the number of its type, and what follows pNext."""
    return pack("IP" + layout, number, 0, *members)


class Kernel:
    """What the manifest says of an entry point, and the files that it names."""

    def __init__(self, folder, name):
        self.folder, self.name = folder, name
        self.manifest = json.loads((folder / "manifest.json").read_bytes())
        entries = [(entry, module) for module in self.manifest["modules"] for entry in module["entry_points"]]
        entry, module = next((pair for pair in entries if pair[0]["name"] == name), (None, None))
        require(entry, f"the manifest has no kernel {name}")
        self.code = self.read(module)
        self.interface = self.manifest["interfaces"][entry["interface"]]
        self.bindings = self.interface["bindings"]
        types = {binding["descriptor_type"] for binding in self.bindings}
        require(types == {"VK_DESCRIPTOR_TYPE_STORAGE_BUFFER"}, f"{name} takes more than storage buffers")
        require(len(self.interface["push_constants"]) == 1, f"{name} takes more than the number of vectors")
        require(not self.manifest["features"], "the kernels need features of the device")

    def read(self, entry):
        """The file of a module or a table."""
        content = (self.folder / entry["file"]).read_bytes()
        agrees = hashlib.sha256(content).hexdigest() == entry["sha256"]
        require(agrees, f"{entry['file']} is not the file of the manifest: its SHA-256 differs")
        return content

    def content(self, binding, count, given):
        """What a buffer holds before the kernel runs, and how many of its bytes count."""
        if binding["role"] == "table":
            tables = [table for table in self.manifest["tables"] if table["file"] == binding.get("table")]
            require(tables, f"{self.name} reads a table that is not in the manifest")
            table = self.read(tables[0])
            return table, len(table)
        length = count * binding["bytes_per_vector"]
        if binding["role"] == "output":
            return b"", length
        require(len(given) == length, f"the input should have {length} bytes and has {len(given)}")
        return given, length


class Device:
    """A device without features, and a queue of it."""

    def __init__(self, version, part_of_name):
        major, minor = map(int, version.split("."))
        version = major << 22 | minor << 12
        self.physical = self.choose(version, part_of_name)
        require(self.property(API_VERSION) >= version, "the device's Vulkan is too old for the kernels")
        self.family = self.compute_family()
        queues = structure(2, "IIIP", 0, self.family, 1, pack("f", 1.0))  # VkDeviceQueueCreateInfo
        info = structure(3, "IIPIPIPP", 0, 1, queues, 0, 0, 0, 0, 0)  # VkDeviceCreateInfo
        self.handle = made("vkCreateDevice", self.physical, info, None)

    def choose(self, version, part_of_name):
        """The first device that has the text in its name."""
        layers = [b"VK_LAYER_KHRONOS_validation"] if os.environ.get("UNITVEC_VALIDATE") else []
        names = pack("P" * len(layers), *map(ctypes.create_string_buffer, layers))
        application = structure(0, "PIPII", 0, 0, 0, 0, version)  # VkApplicationInfo
        info = structure(1, "IPIPIP", 0, application, len(layers), names, 0, 0)  # VkInstanceCreateInfo
        instance = made("vkCreateInstance", info, None)
        count = ctypes.c_uint32()
        call("vkEnumeratePhysicalDevices", instance, byref(count), None)
        handles = (c_uint64 * count.value)()
        call("vkEnumeratePhysicalDevices", instance, byref(count), handles)
        for handle in map(c_uint64, handles):
            self.properties = ctypes.create_string_buffer(4096)
            vulkan.vkGetPhysicalDeviceProperties(handle, self.properties)
            if part_of_name.encode() in self.properties[DEVICE_NAME : DEVICE_NAME + 256]:
                return handle
        fail(f"no Vulkan device has {part_of_name!r} in its name")

    def property(self, offset):
        return struct.unpack_from("I", self.properties, offset)[0]

    def compute_family(self):
        count = ctypes.c_uint32(64)
        families = ctypes.create_string_buffer(24 * count.value)
        vulkan.vkGetPhysicalDeviceQueueFamilyProperties(self.physical, byref(count), families)
        for index in range(count.value):
            if struct.unpack_from("I", families, 24 * index)[0] & QUEUE_COMPUTE:
                return index
        fail("the device has no queue for compute")

    def create(self, kind, *members):
        """What vkCreate<kind> makes of a Vk<kind>CreateInfo with these members."""
        return made(f"vkCreate{kind}", self.handle, structure(*members), None)

    def memory_type(self, allowed):
        properties = ctypes.create_string_buffer(1024)
        vulkan.vkGetPhysicalDeviceMemoryProperties(self.physical, properties)
        for index in range(struct.unpack_from("I", properties)[0]):
            flags = struct.unpack_from("I", properties, 4 + 8 * index)[0]
            if allowed >> index & 1 and not HOST_VISIBLE_AND_COHERENT & ~flags:
                return index
        fail("the device has no memory that is host-visible and coherent")

    def buffer(self, size, content):
        """A storage buffer of exactly this size, with the content at its start, and its address."""
        require(size <= self.property(MAX_STORAGE_BUFFER_RANGE), f"too large for the device: {size} bytes")
        buffer = self.create("Buffer", 12, "IQIIIP", 0, size, USAGE_STORAGE_BUFFER, 0, 0, 0)
        requirements = ctypes.create_string_buffer(24)
        vulkan.vkGetBufferMemoryRequirements(self.handle, buffer, requirements)
        needed, _, allowed = struct.unpack_from("QQI", requirements)
        info = structure(5, "QI", needed, self.memory_type(allowed))  # VkMemoryAllocateInfo
        memory = made("vkAllocateMemory", self.handle, info, None)
        call("vkBindBufferMemory", self.handle, buffer, memory, c_uint64(0))
        address = ctypes.c_void_p()
        call("vkMapMemory", self.handle, memory, c_uint64(0), c_uint64(size), 0, byref(address))
        ctypes.memset(address, 0xA5, size)  # no kernel may count on zeros
        ctypes.memmove(address, content, len(content))
        return buffer, address

    def descriptor_set(self, numbers, buffers):
        """A set of storage buffers, each bound as a whole, and its layout."""
        slots = [member for number in numbers for member in (number, STORAGE_BUFFER, 1, STAGE_COMPUTE, 0)]
        slots = pack("IIIIP" * len(numbers), *slots)
        layout = self.create("DescriptorSetLayout", 32, "IIP", 0, len(numbers), slots)
        sizes = pack("II", STORAGE_BUFFER, len(numbers))
        pool = self.create("DescriptorPool", 33, "IIIP", 0, 1, 1, sizes)
        info = structure(34, "QIP", pool, 1, pack("Q", layout))  # VkDescriptorSetAllocateInfo
        descriptors = made("vkAllocateDescriptorSets", self.handle, info)
        for number, buffer in zip(numbers, buffers):
            members = (descriptors, number, 0, 1, STORAGE_BUFFER, 0, pack("QQQ", buffer, 0, WHOLE_SIZE), 0)
            vulkan.vkUpdateDescriptorSets(self.handle, 1, structure(35, "QIIIIPPP", *members), 0, None)
        return descriptors, layout

    def pipeline(self, code, entry_point, layout):
        code = ctypes.create_string_buffer(code, len(code))
        module = self.create("ShaderModule", 16, "INP", 0, len(code), code)
        name = ctypes.create_string_buffer(entry_point.encode())
        stage = structure(18, "IIQPP", 0, STAGE_COMPUTE, module, name, 0)  # VkPipelineShaderStageCreateInfo
        info = structure(29, "I0P48sQQi", 0, stage.raw, layout, 0, -1)  # VkComputePipelineCreateInfo
        return made("vkCreateComputePipelines", self.handle, c_uint64(0), 1, info, None)

    def submit(self, record):
        """Records commands, submits them and waits."""
        pool = self.create("CommandPool", 39, "II", 0, self.family)
        info = structure(40, "QII", pool, 0, 1)  # VkCommandBufferAllocateInfo
        commands = made("vkAllocateCommandBuffers", self.handle, info)
        call("vkBeginCommandBuffer", commands, structure(42, "IP", 0, 0))
        record(commands)
        call("vkEndCommandBuffer", commands)
        queue = c_uint64()
        vulkan.vkGetDeviceQueue(self.handle, self.family, 0, byref(queue))
        info = structure(4, "IPPIPIP", 0, 0, 0, 1, pack("Q", commands), 0, 0)  # VkSubmitInfo
        call("vkQueueSubmit", queue, 1, info, c_uint64(0))
        call("vkQueueWaitIdle", queue)


def run(kernel, device, count, given):
    """Calls the kernel as its interface says, and returns the output's bytes."""
    interface, bindings = kernel.interface, kernel.bindings
    groups = -(-count // interface["vectors_per_workgroup"])
    require(groups <= device.property(MAX_WORKGROUPS), f"too many vectors for a dispatch: {count}")
    buffers = []
    for binding in bindings:
        content, length = kernel.content(binding, count, given)
        buffer, address = device.buffer(length + -length % binding["size_multiple"], content)
        buffers.append(buffer)
        if binding["role"] == "output":
            output = address, length
    descriptors, set_layout = device.descriptor_set([binding["binding"] for binding in bindings], buffers)
    offset = interface["push_constants"][0]["offset"]
    pushed = pack("III", STAGE_COMPUTE, offset, 4)
    layout = device.create("PipelineLayout", 30, "IIPIP", 0, 1, pack("Q", set_layout), 1, pushed)
    pipeline = device.pipeline(kernel.code, kernel.name, layout)

    def record(commands):
        vulkan.vkCmdBindPipeline(commands, BIND_POINT_COMPUTE, pipeline)
        sets = (interface["descriptor_set"], 1, byref(descriptors), 0, None)
        vulkan.vkCmdBindDescriptorSets(commands, BIND_POINT_COMPUTE, layout, *sets)
        vulkan.vkCmdPushConstants(commands, layout, STAGE_COMPUTE, offset, 4, pack("I", count))
        vulkan.vkCmdDispatch(commands, groups, 1, 1)
        barrier = structure(46, "II", ACCESS_SHADER_WRITE, ACCESS_HOST_READ)
        stages = (PIPELINE_STAGE_COMPUTE, PIPELINE_STAGE_HOST)
        vulkan.vkCmdPipelineBarrier(commands, *stages, 0, 1, barrier, 0, None, 0, None)

    device.submit(record)
    return ctypes.string_at(*output)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.error = fail
    parser.add_argument("folder", type=pathlib.Path, help="folder of manifest.json")
    parser.add_argument("kernel", help="such as oct24_encode")
    parser.add_argument("count", type=int, help="number of vectors, at least 1")
    parser.add_argument("--device", default="", help="part of the device's name")
    arguments = parser.parse_args()
    require(arguments.count > 0, "the number of vectors is not positive")
    kernel = Kernel(arguments.folder, arguments.kernel)
    device = Device(kernel.manifest["vulkan"], arguments.device)
    return run(kernel, device, arguments.count, sys.stdin.buffer.read())


if __name__ == "__main__":
    # Layers print to standard output: make that standard error, and keep the former for the result.
    standard_output = os.dup(1)
    os.dup2(2, 1)
    try:
        vulkan = ctypes.CDLL("libvulkan.so.1")
        result = main()
        with open(standard_output, "wb") as output:
            output.write(result)
    except (OSError, ValueError) as failure:
        fail(failure)
