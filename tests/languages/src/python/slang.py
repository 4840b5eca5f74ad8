"""Compiles Slang to SPIR-V: slang.py LIBRARY FOLDER, with imports from the folder. The package slangpy has the library, and
none has the program slangc."""

import ctypes
import sys

import jobs

POINTER = ctypes.c_void_p
TEXT = ctypes.c_char_p
SPIRV, SLANG, COMPUTE = 6, 1, 6

slang = ctypes.CDLL(sys.argv[1])
for name, result, arguments in [
    ("spCreateSession", POINTER, [TEXT]),
    ("spGetBuildTagString", TEXT, []),
    ("spCreateCompileRequest", POINTER, [POINTER]),
    ("spDestroyCompileRequest", None, [POINTER]),
    ("spFindProfile", ctypes.c_uint, [POINTER, TEXT]),
    ("spSetCodeGenTarget", None, [POINTER, ctypes.c_int]),
    ("spSetTargetProfile", None, [POINTER, ctypes.c_int, ctypes.c_uint]),
    ("spAddSearchPath", None, [POINTER, TEXT]),
    ("spAddTranslationUnit", ctypes.c_int, [POINTER, ctypes.c_int, TEXT]),
    ("spAddTranslationUnitSourceString", None, [POINTER, ctypes.c_int, TEXT, TEXT]),
    ("spAddEntryPoint", ctypes.c_int, [POINTER, ctypes.c_int, TEXT, ctypes.c_int]),
    ("spCompile", ctypes.c_int, [POINTER]),
    ("spGetDiagnosticOutput", TEXT, [POINTER]),
    ("spGetEntryPointCode", POINTER, [POINTER, ctypes.c_int, ctypes.POINTER(ctypes.c_size_t)]),
]:
    function = getattr(slang, name)
    function.restype, function.argtypes = result, arguments

session = slang.spCreateSession(None)
# That of Vulkan 1.1.
profile = slang.spFindProfile(session, b"spirv_1_3")


def compile(name, text):
    request = slang.spCreateCompileRequest(session)
    slang.spSetCodeGenTarget(request, SPIRV)
    slang.spSetTargetProfile(request, 0, profile)
    slang.spAddSearchPath(request, sys.argv[2].encode())
    unit = slang.spAddTranslationUnit(request, SLANG, name.encode())
    slang.spAddTranslationUnitSourceString(request, unit, f"{name}.slang".encode(), text.encode())
    entry = slang.spAddEntryPoint(request, unit, b"main", COMPUTE)
    code = b""
    if slang.spCompile(request) >= 0:
        size = ctypes.c_size_t()
        data = slang.spGetEntryPointCode(request, entry, ctypes.byref(size))
        code = ctypes.string_at(data, size.value)
    said = slang.spGetDiagnosticOutput(request) or b""
    slang.spDestroyCompileRequest(request)
    return said.decode(), code


jobs.run(slang.spGetBuildTagString().decode(), compile)
