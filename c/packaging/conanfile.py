"""Builds the checkout that this file lies in, through its CMake package: conan create c/packaging"""

import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

# Cargo reads all of the workspace, and compiles little of it. The last two are of `cargo vendor`.
SOURCES = ["Cargo.*", "*/Cargo.toml", "*.rs", "LICENSE-*", "c/*", "catalogue/*", "shader-crate/*"]
SOURCES += [".cargo/*", "vendor/*"]
BUILT = ["target/*", "host/render/shaders/rust/target/*", "c/packaging/test_package/build/*"]


class Unitvec(ConanFile):
    name = "unitvec"
    description = "Unit-vector codecs: normals, tangents and directions in 8 to 52 bits, tangent frames in 32 or 64"
    license = "MIT OR Apache-2.0"
    package_type = "static-library"
    languages = "C"
    settings = "os", "arch", "compiler", "build_type"
    options = {"offline": [True, False]}
    default_options = {"offline": False}

    def root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        self.version = re.search(r'^version = "(.*)"', load(self, os.path.join(self.root(), "Cargo.toml")), re.M)[1]

    def export_sources(self):
        for pattern in SOURCES:
            copy(self, pattern, self.root(), self.export_sources_folder, excludes=BUILT)

    def package_id(self):
        del self.info.options.offline

    def layout(self):
        cmake_layout(self, src_folder=".")

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["UNITVEC_OFFLINE"] = bool(self.options.offline)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder="c")
        cmake.build()

    def package(self):
        copy(self, "LICENSE-*", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.libs = ["unitvec"]
        if self.settings.os == "Windows":
            self.cpp_info.system_libs = ["ntdll", "userenv", "ws2_32", "dbghelp"]
        elif self.settings.os == "Macos":
            self.cpp_info.exelinkflags = self.cpp_info.sharedlinkflags = ["-Wl,-dead_strip"]
        else:
            self.cpp_info.system_libs = ["pthread", "dl", "m"]
            self.cpp_info.exelinkflags = self.cpp_info.sharedlinkflags = ["-Wl,--gc-sections"]
