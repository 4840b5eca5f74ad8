"""Compiles HLSL to SPIR-V or DXIL: dxc.py LIBRARY FOLDER ARGUMENT..., with includes from the folder. The package compushady has
the library for Linux, and none has the program dxc."""

import ctypes
import sys
import uuid

import jobs

POINTER = ctypes.c_void_p
UTF8 = 65001
# Places in the tables of methods: interfaces inherit IUnknown's three methods and, in this library, its two destructors.
QUERY_INTERFACE, RELEASE, FIRST = 0, 2, 5


class Buffer(ctypes.Structure):
    _fields_ = [("data", ctypes.c_char_p), ("size", ctypes.c_size_t), ("encoding", ctypes.c_uint32)]


def identifier(text):
    return uuid.UUID(text).bytes_le


COMPILER_CLASS = identifier("73e22d93-e6ce-47f3-b5bf-f0664f39c1b0")
COMPILER = identifier("228b4687-5a6a-4730-900c-9702b2203f54")
RESULT = identifier("58346cda-dde7-4497-9461-6f87af5e0659")
VERSION = identifier("b04f5b50-2059-4f12-a8ff-a1e0cde1cc7e")
UTILS_CLASS = identifier("6245d6af-66e0-48fd-80b4-4d271796748c")
UTILS = identifier("4605c4cb-2019-492a-ada4-65f20bb7d67f")
# The method of IDxcUtils that makes what reads files.
INCLUDE_HANDLER = FIRST + 6


def call(this, slot, *arguments, result=ctypes.c_int32):
    """Calls a method of an object."""
    methods = ctypes.cast(this, ctypes.POINTER(ctypes.POINTER(POINTER))).contents
    kinds = [type(argument) if isinstance(argument, ctypes._SimpleCData) else POINTER for argument in arguments]
    return ctypes.CFUNCTYPE(result, POINTER, *kinds)(methods[slot])(this, *arguments)


def checked(status):
    if status < 0:
        sys.exit(f"DXC: error {status & 0xFFFFFFFF:08x}")


def made(this, slot, *arguments):
    """What a method makes, whose last argument says where."""
    new = POINTER()
    checked(call(this, slot, *arguments, ctypes.cast(ctypes.byref(new), POINTER)))
    return new


def contents(blob):
    if not blob:
        return b""
    data = call(blob, FIRST, result=POINTER)
    return ctypes.string_at(data, call(blob, FIRST + 1, result=ctypes.c_size_t))


library = ctypes.CDLL(sys.argv[1])
compiler = POINTER()
checked(library.DxcCreateInstance(COMPILER_CLASS, COMPILER, ctypes.byref(compiler)))
utils = POINTER()
checked(library.DxcCreateInstance(UTILS_CLASS, UTILS, ctypes.byref(utils)))
includes = made(utils, INCLUDE_HANDLER)


def version():
    info = made(compiler, QUERY_INTERFACE, ctypes.cast(VERSION, POINTER))
    numbers = [ctypes.c_uint32(), ctypes.c_uint32()]
    checked(call(info, FIRST, *(ctypes.cast(ctypes.byref(number), POINTER) for number in numbers)))
    return ".".join(str(number.value) for number in numbers)


def compile(name, text):
    source = text.encode()
    buffer = Buffer(source, len(source), UTF8)
    words = [f"{name}.hlsl", "-E", "main", "-T", "cs_6_0", "-HV", "2021", "-I", sys.argv[2], *sys.argv[3:]]
    arguments = (ctypes.c_wchar_p * len(words))(*words)
    result = made(
        compiler,
        FIRST,
        ctypes.cast(ctypes.byref(buffer), POINTER),
        ctypes.cast(arguments, POINTER),
        ctypes.c_uint32(len(words)),
        includes,
        ctypes.cast(RESULT, POINTER),
    )
    status = ctypes.c_int32()
    checked(call(result, FIRST, ctypes.cast(ctypes.byref(status), POINTER)))
    said = contents(made(result, FIRST + 2)).rstrip(b"\0")
    code = contents(made(result, FIRST + 1)) if status.value >= 0 else b""
    call(result, RELEASE, result=ctypes.c_uint32)
    return said.decode(), code


jobs.run(version(), compile)
