"""Compares codecs in OpenGL or OpenGL ES with their test vectors, without a window: on EGL's surfaceless platform.

usage: python3 tests/clients/opengl.py gl|es MAJOR.MINOR GLSL_VERSION CODEC...

It reads glsl/flat/ and vectors/ beside it. In OpenGL, codes of oct32 also go through a target of two snorms.
"""

import ctypes
import json
import pathlib
import struct
import sys
from ctypes import byref, c_char_p, c_int, c_uint, c_void_p

REPOSITORY = pathlib.Path(__file__).parents[2]
# The internal format, the format and type of texels in memory, and their bytes.
FORMATS = {"RGBA32UI": (0x8D70, 0x8D99, 0x1405, 16), "RG16_SNORM": (0x8F99, 0x8227, 0x1402, 4)}
# Cases of a codec: texels of a row.
WIDTH = 256
TEXTURE_2D, NEAREST, FRAMEBUFFER, COLOR_ATTACHMENT0 = 0x0DE1, 0x2600, 0x8D40, 0x8CE0
VERTEX = """
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
"""


def require(condition, message):
    if not condition:
        sys.exit(f"opengl.py: {message}")


def gl(name, *arguments):
    """Calls a function of OpenGL."""
    kinds = [c_int if isinstance(value, int) else c_void_p for value in arguments]
    return ctypes.CFUNCTYPE(c_uint, *kinds)(egl.eglGetProcAddress(name.encode()))(*arguments)


def made(kind):
    """A new object."""
    handle = c_uint()
    gl(f"glGen{kind}", 1, byref(handle))
    return handle.value


def make_context(api, version):
    """A context of this version, made current. The end of the process destroys it."""
    display = c_void_p(egl.eglGetPlatformDisplay(0x31DD, None, None))  # EGL_PLATFORM_SURFACELESS_MESA
    require(egl.eglInitialize(display, None, None), "EGL has no surfaceless platform here")
    egl.eglBindAPI({"gl": 0x30A2, "es": 0x30A0}[api])
    major, minor = map(int, version.split("."))
    attributes = (c_int * 5)(0x3098, major, 0x30FB, minor, 0x3038)
    context = c_void_p(egl.eglCreateContext(display, None, None, attributes))
    require(egl.eglMakeCurrent(display, None, None, context), f"no context of {api} {version}")


def program(fragment):
    """Links a fragment shader with a triangle that covers everything, in the fragment shader's version."""
    linked = gl("glCreateProgram")
    for kind, text in (0x8B31, fragment.splitlines()[0] + VERTEX), (0x8B30, fragment):
        shader = gl("glCreateShader", kind)
        gl("glShaderSource", shader, 1, (c_char_p * 1)(text.encode()), None)
        gl("glCompileShader", shader)
        log = ctypes.create_string_buffer(1024)
        gl("glGetShaderInfoLog", shader, len(log), None, log)
        require(not log.value, log.value.decode())
        gl("glAttachShader", linked, shader)
    gl("glLinkProgram", linked)
    gl("glUseProgram", linked)


def texture(name, height, texels):
    """A texture, bound."""
    internal, layout, kind, _ = FORMATS[name]
    handle = made("Textures")
    gl("glBindTexture", TEXTURE_2D, handle)
    for parameter in 0x2800, 0x2801:  # GL_TEXTURE_MAG_FILTER, GL_TEXTURE_MIN_FILTER
        gl("glTexParameteri", TEXTURE_2D, parameter, NEAREST)
    gl("glTexImage2D", TEXTURE_2D, 0, internal, WIDTH, height, 0, layout, kind, texels)
    return handle


def draw(source, target, text, texels):
    """The texels of a format that a shader, of declarations and `result = ...` for the texel `w`, makes of others."""
    (_, layout, kind, size), height = FORMATS[target], len(texels) // WIDTH // FORMATS[source][3]
    gl("glBindFramebuffer", FRAMEBUFFER, made("Framebuffers"))
    drawn = texture(target, height, None)
    gl("glFramebufferTexture2D", FRAMEBUFFER, COLOR_ATTACHMENT0, TEXTURE_2D, drawn, 0)
    complete = gl("glCheckFramebufferStatus", FRAMEBUFFER) == 0x8CD5
    require(complete, f"{api} {version} does not draw to {target}")
    texture(source, height, texels)
    prefix, written = "" if "NORM" in source else "u", "vec2" if "NORM" in target else "uvec4"
    file, body = text
    program(
        f"#version {glsl_version}\n{file}\nuniform highp {prefix}sampler2D source;\nout highp {written} result;\n"
        f"void main() {{ {prefix}vec4 w = texelFetch(source, ivec2(gl_FragCoord.xy), 0); {body} }}"
    )
    gl("glViewport", 0, 0, WIDTH, height)
    gl("glDrawArrays", 4, 0, 3)
    pixels = ctypes.create_string_buffer(WIDTH * height * size)
    gl("glReadPixels", 0, 0, WIDTH, height, layout, kind, pixels)
    error = gl("glGetError")
    require(error == 0, f"OpenGL error {error:#x}")
    return pixels.raw


class Codec:
    """A codec's text, and its test vectors as texels: vectors, codes, decoded vectors."""

    def __init__(self, name):
        texts = (path.read_text() for path in (REPOSITORY / "glsl/flat").iterdir())
        self.text = next(text for text in texts if f" {name}_encode(vec3 v)" in text)
        vectors = json.loads((REPOSITORY / f"vectors/{name}.json").read_text())
        self.is_wide = vectors["words"] == 2

        def texels(column):
            cases = ([int(word, 16) for word in case[column].split()] for case in vectors["cases"])
            return b"".join(struct.pack("<2Q", *c, 0) if len(c) == 1 else struct.pack("<4I", *c, 0) for c in cases)

        self.given, self.codes, self.decoded = map(texels, range(3))


def compare(name):
    """One row encodes, the other decodes."""
    codec = Codec(name)
    code, zeros = ("w.xy", "0u, 0u") if codec.is_wide else ("w.x", "0u, 0u, 0u")
    body = f"""if (gl_FragCoord.y < 1.0) result = uvec4({name}_encode(uintBitsToFloat(w.xyz)), {zeros});
    else result = uvec4(floatBitsToUint({name}_decode({code})), 0u);"""
    found = draw("RGBA32UI", "RGBA32UI", (codec.text, body), codec.given + codec.codes)
    rows = zip(*(struct.iter_unpack("16s", row) for row in (found, codec.codes + codec.decoded)))
    differ = sum(a != b for a, b in rows)
    require(differ == 0, f"{name}: {differ} of {2 * WIDTH} results differ from the test vectors")


def compare_pairs():
    """README's pair through a target of two snorms: the codes of oct32, but for a few that are a step off, and back."""
    oct32 = Codec("oct32")
    body = "result = float32x3_to_oct(uintBitsToFloat(w.xyz));"
    pairs = draw("RGBA32UI", "RG16_SNORM", (oct32.text, body), oct32.given)
    found, codes = (list(struct.iter_unpack(layout, row)) for layout, row in (("<2h", pairs), ("<2h12x", oct32.codes)))
    steps = [max(abs(a - b) for a, b in zip(*pair)) for pair in zip(found, codes)]
    require(max(steps) <= 1 and sum(steps) <= 3, f"{sum(steps)} codes differ, by {max(steps)} steps")
    body = "result = uvec4(floatBitsToUint(oct_to_float32x3(w.xy)), 0u);"
    back = draw("RG16_SNORM", "RGBA32UI", (oct32.text, body), pairs)
    vectors = [[c for vector in struct.iter_unpack("<3f4x", row) for c in vector] for row in (back, oct32.decoded)]
    furthest = max(abs(a - b) for a, b in zip(*vectors))
    require(furthest < 1e-4, f"a component is {furthest} off")


if __name__ == "__main__":
    require(len(sys.argv) > 4, __doc__)
    api, version, glsl_version, *codecs = sys.argv[1:]
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError as failure:
        require(False, failure)
    for function in egl.eglGetProcAddress, egl.eglGetPlatformDisplay, egl.eglCreateContext:
        function.restype = c_void_p
    make_context(api, version)
    if api == "gl":
        gl("glBindVertexArray", made("VertexArrays"))
        gl("glClampColor", 0x891C, 0)  # or glReadPixels makes negative numbers 0
        compare_pairs()
    for codec in codecs:
        compare(codec)
