/**
 * What the engines and files share about codes as vertex attributes: names, layout, and the shading texts' functions.
 * @module
 */

import * as glsl from "unitvec/glsl-es";
import * as wgsl from "unitvec/wgsl";

/**
 * A codec that vertex attributes can hold.
 * @typedef {"oct16p" | "oct24p" | "oct32p" | "frame32"} AttributeCodec
 */

/**
 * Each codec's attribute in glTF files: an application-specific one (glTF 2.0, 3.7.2.1), so that loaders without the
 * package skip it. glTF forbids 32-bit integers there, so an element is the code's bits in smaller ones, low bits first.
 * `codes` is the array that `encode` gives.
 * @typedef {{
 *   attribute: string, type: "SCALAR" | "VEC2" | "VEC3", array: typeof Uint8Array | typeof Uint16Array,
 *   codes: typeof Uint16Array | typeof Uint32Array,
 * }} Row
 * @type {Record<AttributeCodec, Row>}
 */
export const STORED = {
  oct16p: { attribute: "_NORMAL_OCT16P", type: "SCALAR", array: Uint16Array, codes: Uint16Array },
  oct24p: { attribute: "_NORMAL_OCT24P", type: "VEC3", array: Uint8Array, codes: Uint32Array },
  oct32p: { attribute: "_NORMAL_OCT32P", type: "VEC2", array: Uint16Array, codes: Uint32Array },
  frame32: { attribute: "_FRAME32", type: "VEC2", array: Uint16Array, codes: Uint32Array },
};

/** The codecs that vertex attributes can hold. */
export const CODECS = /** @type {AttributeCodec[]} */ (Object.keys(STORED));

/** Name of a codec's attribute in shaders: three.js makes it from the file's in the same way. */
export const attributeName = (/** @type {AttributeCodec} */ codec) => row(codec).attribute.toLowerCase();

/** True for codecs of frames, which have a tangent and a handedness beside the normal. */
export const isFrame = (/** @type {AttributeCodec} */ codec) => codec === "frame32";

/** A codec's row of `STORED`. Throws a RangeError for other codecs. */
export function row(/** @type {AttributeCodec} */ codec) {
  if (!Object.hasOwn(STORED, codec)) {
    throw new RangeError(`vertex attributes hold the codecs ${CODECS.join(", ")}, not "${codec}"`);
  }
  return STORED[codec];
}

/** The codes as integers of a file's elements, a number of them each: the inverse of `joined`. */
export function split(/** @type {ArrayLike<number>} */ codes, /** @type {AttributeCodec} */ codec) {
  const { array } = row(codec);
  const size = components(codec);
  const bits = 8 * array.BYTES_PER_ELEMENT;
  const parts = new array(codes.length * size);
  for (let i = 0; i < parts.length; i++) parts[i] = codes[Math.floor(i / size)] >>> (bits * (i % size));
  return parts;
}

/**
 * The codes of `count` elements of a file: a Uint16Array for codes of 16 bits, else a Uint32Array.
 * @param {(element: number, component: number) => number} component reads an integer of the file
 * @param {number} count
 * @param {AttributeCodec} codec
 */
export function joined(component, count, codec) {
  const { array } = row(codec);
  const size = components(codec);
  const bits = 8 * array.BYTES_PER_ELEMENT;
  const codes = new (row(codec).codes)(count);
  for (let i = 0; i < count; i++) {
    for (let c = 0; c < size; c++) codes[i] |= component(i, c) << (bits * c);
  }
  return codes;
}

/**
 * Throws a TypeError unless the codes are those that `encode` gives for the codec: a typed array of 16 or 32 bits.
 * @param {Uint16Array | Uint32Array} codes
 * @param {AttributeCodec} codec
 */
export function checkCodes(codes, codec) {
  const array = row(codec).codes;
  if (!(codes instanceof array)) {
    throw new TypeError(`codes of ${codec} must be a ${array.name}, as encode() gives them`);
  }
  return codes;
}

/** How many integers an element has in a file. */
export const components = (/** @type {AttributeCodec} */ codec) => ({ SCALAR: 1, VEC2: 2, VEC3: 3 })[row(codec).type];

/**
 * Text in GLSL ES of the functions that shaders call: `normal_of_code` and, for frames, `tangent_of_code`, whose w is the handedness.
 */
export function glslText(/** @type {AttributeCodec} */ codec) {
  // Named one by one, so that bundlers leave the other texts out.
  const [oct16p, oct24p, oct32p, frame32] = [glsl.oct16p_decode, glsl.oct24p_decode, glsl.oct32p_decode, glsl.frame32_decode];
  const decoded = isFrame(codec)
    ? "vec3 normal; vec4 tangent; frame32_decode(code, normal, tangent);"
    : `vec3 normal = ${codec}_decode(code);`;
  const tangent = isFrame(codec) ? `vec4 tangent_of_code(uint code) { ${decoded} return tangent; }\n` : "";
  return (
    row(codec) &&
    `${{ oct16p, oct24p, oct32p, frame32 }[codec]}\nvec3 normal_of_code(uint code) { ${decoded} return normal; }\n${tangent}`
  );
}

/** The same in WGSL. */
export function wgslText(/** @type {AttributeCodec} */ codec) {
  const [oct16p, oct24p, oct32p, frame32] = [wgsl.oct16p_decode, wgsl.oct24p_decode, wgsl.oct32p_decode, wgsl.frame32_decode];
  const locals = "var normal: vec3f; var tangent: vec4f; frame32_decode(code, &normal, &tangent);";
  const decoded = isFrame(codec) ? locals : `let normal = ${codec}_decode(code);`;
  const tangent = isFrame(codec) ? `fn tangent_of_code(code: u32) -> vec4f { ${decoded} return tangent; }\n` : "";
  return (
    row(codec) &&
    `${{ oct16p, oct24p, oct32p, frame32 }[codec]}\nfn normal_of_code(code: u32) -> vec3f { ${decoded} return normal; }\n${tangent}`
  );
}
