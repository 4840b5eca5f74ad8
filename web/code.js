// Code to copy: the functions of a shading language, or the calls of a package.

const calls = {
  Rust: ({ rust_type: type, frame, dither }) =>
    frame
      ? `use unitvec::{Frame, ${type}, FrameCodec};

// normal: [f32; 3]; tangent: [f32; 4], with the handedness last, as in glTF
let code = ${type}::encode(Frame::from_gltf(normal, tangent));
let frame = ${type}::decode(code);
`
      : dither
        ? `use unitvec::dither::{Dithered, dither_from_key};
use unitvec::${type};

let offset = dither_from_key(index); // both sides need the same key
let code = ${type}::encode_dithered(normal, offset);
let back: [f32; 3] = ${type}::decode_dithered(code, offset);
`
        : `use unitvec::{Codec, ${type}};

let code = ${type}::encode(normal); // [f32; 3], or the Vec3 of any library
let back: [f32; 3] = ${type}::decode(code);
`,
  Python: ({ id, frame, dither }) => `import numpy as np, unitvec

# float32 or float64 of shape (..., ${frame ? "7): normal, tangent, handedness" : "3)"}
${dither ? "keys = np.arange(len(normals)) # both sides need the same\n" : ""}codes = unitvec.encode(${frame ? "frames" : "normals"}, "${id}"${dither ? ", dither=keys" : ""})
back = unitvec.decode(codes, "${id}"${dither ? ", dither=keys" : ""})
`,
  JavaScript: ({ id, frame, dither }) => `import { encode, decode } from "unitvec";
${dither ? "\n// Without dither, which the other languages have" : ""}
// Float32Array, ${frame ? "7 numbers a frame: normal, tangent, handedness" : "3 numbers a vector"}
const codes = encode(${frame ? "frames" : "normals"}, "${id}");
const back = decode(codes, "${id}");
`,
};

// Names of the languages, by the keys of texts and calls.
export const LANGUAGES = {
  glsl: "GLSL",
  "glsl-es": "GLSL ES",
  hlsl: "HLSL",
  wgsl: "WGSL",
  msl: "Metal",
  slang: "Slang",
  godot: "Godot",
  cpp: "C++, CUDA",
  Rust: "Rust",
  Python: "Python",
  JavaScript: "JavaScript",
};

// The content of the page's compressed element of this id.
export async function unpacked(id) {
  const packed = Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export const json = async (id) => JSON.parse(new TextDecoder().decode(await unpacked(id)));

const loaded = new Map();

// The text for a codec, with `dither` of its functions with offsets.
export async function textOf(language, codec, dither) {
  if (calls[language]) return calls[language]({ ...codec, dither });
  if (!loaded.has(language)) loaded.set(language, json(`data-${language}`));
  const { paragraphs, codecs } = await loaded.get(language);
  return codecs[dither ? `${codec.id} dithered` : codec.id].map((at) => paragraphs[at]).join("\n\n");
}
