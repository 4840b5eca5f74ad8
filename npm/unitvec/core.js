/**
 * Unit vectors, tangent frames and rotations in 8 to 64 bits, for typed arrays: the functions of the package, and `load`, which must
 * come before them; `import … from "unitvec"` loads by itself. Codes are those of the Rust crate, the shaders and the program
 * `unitvec`, bit for bit.
 */

import init, * as native from "../dist/unitvec.js";

/** Elements in the module's memory at a time: few enough for a core's cache. */
const PORTION = 1 << 14;

/** The arrays of codes of 1 byte, 2 bytes, and so on. */
const TYPES = [Uint8Array, Uint16Array, Uint32Array, Uint32Array, BigUint64Array, BigUint64Array, BigUint64Array, BigUint64Array];

/** @typedef {Float32Array | Float64Array} Elements */
/** @typedef {Uint8Array | Uint16Array | Uint32Array | BigUint64Array} Codes */
/** @typedef {import("../dist/unitvec.js").InitInput} Source */

/**
 * A constructor of arrays of codes.
 *
 * @typedef {{
 *   new (length: number): Codes; new (buffer: ArrayBufferLike, byteOffset?: number, length?: number): Codes;
 *   readonly name: string; readonly BYTES_PER_ELEMENT: number;
 * }} CodesType
 */

/**
 * The facts of a codec, or of a format of other software.
 *
 * @typedef {object} Codec
 * @property {string} id Its name, as the functions take it.
 * @property {"vectors" | "frames" | "rotations"} element What it encodes.
 * @property {number} bits Significant bits of a code, the low ones.
 * @property {number} bytes Bytes of a code in the files of the program `unitvec`.
 * @property {number} floats Numbers of an element: 3 of vectors, 7 of frames (normal, tangent, handedness), 4 of rotations (x, y, z, w).
 * @property {"sphere" | "hemisphere"} domain `hemisphere` for directions with z >= 0.
 * @property {readonly number[]} maxErrorsDeg Upper bounds of the errors in degrees; of frames the normal's and the tangent's.
 * @property {number | bigint | null} null The code for vectors without a direction; null where there is none to spare.
 * @property {number} meanDeg Measured mean error in degrees, over 10^6 random directions; of frames the normal's. NaN for formats.
 * @property {number} maxDeg Measured maximum error in degrees, likewise.
 * @property {readonly number[]} costs Costs of encoding and decoding on a GPU (RDNA 2, by its compiler) as multiples of `oct32`'s; NaN where
 *   they are not known.
 * @property {boolean} isUnit True where vectors are decoded to unit vectors.
 * @property {CodesType} ArrayType The type of an array of codes: the smallest unsigned integers that hold one.
 */

/**
 * The place of elements among other numbers: that of the first one's first number, 0 unless said, and the numbers from one element to
 * the next, those of an element unless said.
 *
 * @typedef {{ offset?: number, stride?: number }} Layout
 */

/** @type {Map<string, Codec>} */
const known = new Map();
let isLoaded = false;

/**
 * Compiles the module.
 *
 * @param {Source | Promise<Source>} source The bytes of `unitvec/unitvec.wasm`, a compiled module, or where to fetch it: a URL or a response.
 */
export async function load(source) {
  await init({ module_or_path: source });
  isLoaded = true;
}

function checkLoaded() {
  if (!isLoaded) throw new Error('unitvec is not loaded: await load(…) first, or import from "unitvec"');
}

/** The version of the package. */
export function version() {
  checkLoaded();
  return native.version();
}

/**
 * The facts of the codec or format of this name.
 *
 * @param {string} name
 * @returns {Codec}
 * @throws {RangeError} There is none; similar names are in the message.
 */
export function codec(name) {
  checkLoaded();
  if (typeof name !== "string") throw new TypeError(`a codec is named by a string, as "oct32p", not by ${typeOf(name)}`);
  const found = known.get(name);
  if (found) return found;
  const [id, element, bits, bytes, floats, domain, maxErrorsDeg, none, meanDeg, maxDeg, costs, isUnit] = native.codec(name);
  const ArrayType = /** @type {CodesType} */ (TYPES[bytes - 1]);
  Object.freeze(maxErrorsDeg);
  Object.freeze(costs);
  const facts = { id, element, bits, bytes, floats, domain, maxErrorsDeg, null: none, meanDeg, maxDeg, costs, isUnit, ArrayType };
  known.set(name, Object.freeze(facts));
  return facts;
}

/** All codecs, by family and width. */
export function codecs() {
  checkLoaded();
  return native.names(false).map(codec);
}

/**
 * All formats of other software, as `tiles3d-oct16` or `draco:10`: each with the encoder that finds the nearest code and, where the name
 * ends in ` plain`, with that software's own rounding.
 */
export function formats() {
  checkLoaded();
  return native.names(true).map(codec);
}

/**
 * The codec of the fewest bytes whose error is never above `maxErrorDeg` degrees. Of those the one that costs a GPU least, as `unitvec choose`
 * of the program finds it; of equal ones the one of least mean error.
 *
 * @param {number} maxErrorDeg
 * @param {{ element?: Codec["element"], domain?: Codec["domain"] }} [options] The domain is `hemisphere` where every direction has z >= 0.
 * @throws {RangeError} No codec is so fine, or there is no such element or domain.
 */
export function choose(maxErrorDeg, { element = "vectors", domain = "sphere" } = {}) {
  const found = codecs().filter((c) => c.element === element && ["sphere", domain].includes(c.domain) && c.isUnit && c.maxDeg > 0);
  if (found.length === 0 || !["sphere", "hemisphere"].includes(domain)) {
    const known = 'elements are "vectors", "frames" and "rotations", domains "sphere" and "hemisphere"';
    throw new RangeError(`there are no "${shown(element)}" over a "${shown(domain)}"; ${known}`);
  }
  /** @param {Codec} c */
  const bound = (c) => Math.max(...c.maxErrorsDeg);
  const fits = typeof maxErrorDeg === "number" ? found.filter((c) => bound(c) <= maxErrorDeg) : [];
  if (fits.length === 0) {
    const finest = Math.min(...found.map(bound));
    throw new RangeError(`no codec of ${element} is within ${shown(maxErrorDeg)} degrees; the finest reaches ${finest}`);
  }
  /** @param {Codec} c */
  const cost = ({ costs: [encoding, decoding] }) => (encoding + decoding >= 0 ? encoding + decoding : Number.MAX_VALUE);
  return fits.reduce((a, b) => ((b.bytes - a.bytes || cost(b) - cost(a) || b.meanDeg - a.meanDeg) < 0 ? b : a));
}

/**
 * Encodes vectors, frames or rotations to integers.
 *
 * @template {Codes} [T=Codes]
 * @param {Elements} elements Numbers of one element after the other: of frames normal, tangent, and handedness of 1 or -1; of rotations
 *   the quaternion x, y, z, w. Lengths do not matter, but to codecs of components (`snorm…`) and `vector…`. Doubles are rounded to floats.
 * @param {string | Codec} by The codec or format, or its name.
 * @param {Layout & { null?: boolean, out?: T }} [options] With `null`, vectors without a direction (zeros, NaN, infinite ones) get the
 *   codec's null code, else the code of +Z. `out` is an array for the codes.
 * @returns {T} The codes, `out` if given, in an array of `Codec.ArrayType`. Bits above `Codec.bits` are 0.
 * @throws {TypeError} An argument of another type.
 * @throws {RangeError} A wrong name, length or layout, or no null code.
 */
export function encode(elements, by, { null: withNull = false, offset, stride, out } = {}) {
  const facts = named(by);
  const input = inputOf(elements, facts, offset, stride);
  const codes = output(out, /** @type {any} */ (facts.ArrayType), input.count, elements);
  inPortions(input.count, (first, count) => {
    native.encode(facts.id, input.portion(first, count), bytesOf(codes.subarray(first, first + count)), Boolean(withNull));
  });
  return /** @type {T} */ (filled(out, codes));
}

/**
 * Decodes integers, as `encode` makes them.
 *
 * @param {Codes} codes An array of `Codec.ArrayType`.
 * @param {string | Codec} by The codec or format that they were encoded by, or its name.
 * @param {{ null?: boolean, out?: Float32Array }} [options] With `null`, null codes become zeros, else unit vectors like any other code.
 *   `out` is an array for the elements; where a code does not fit it may be written up to there.
 * @returns {Float32Array} Numbers of one element after the other, in `out` if given.
 * @throws {TypeError} An argument of another type.
 * @throws {RangeError} A wrong name or length, codes that do not fit into `Codec.bits`, or no null code.
 */
export function decode(codes, by, { null: withNull = false, out } = {}) {
  const { id, floats, ArrayType } = named(by);
  if (typeOf(codes) !== ArrayType.name) throw new TypeError(`codes of ${id} are in a ${ArrayType.name}, not in ${typeOf(codes)}`);
  const elements = output(out, Float32Array, codes.length * floats, codes);
  inPortions(codes.length, (first, count) => {
    const some = elements.subarray(first * floats, (first + count) * floats);
    native.decode(id, bytesOf(codes.subarray(first, first + count)), some, Boolean(withNull));
  });
  return filled(out, elements);
}

/**
 * The error of each element after encoding and decoding: in degrees, of axes (`axial…`) the angle between axes in degrees, of vectors
 * with a length (`vector…`) relative to that length.
 *
 * @param {Elements} elements As `encode` takes them.
 * @param {string | Codec} by The codec or format, or its name.
 * @param {Layout} [layout]
 * @returns {Float64Array} A number for each element, of frames two: the normal's and the tangent's. NaN where there is no direction.
 * @throws {TypeError | RangeError} As `encode` does.
 */
export function error(elements, by, { offset, stride } = {}) {
  const facts = named(by);
  const input = inputOf(elements, facts, offset, stride);
  const parts = facts.maxErrorsDeg.length;
  const errors = new Float64Array(input.count * parts);
  inPortions(input.count, (first, count) => {
    native.error(facts.id, input.portion(first, count), errors.subarray(first * parts, (first + count) * parts));
  });
  return errors;
}

/**
 * Moves vectors, frames or rotations, in their array, so that other software, which rounds or truncates them to a format, writes the
 * nearest codes that it can. With a codec, it moves them to where the codec decodes them to. What has no direction stays.
 *
 * @template {Elements} T
 * @param {T} elements As `encode` takes them.
 * @param {string | Codec} by The codec or format, or its name.
 * @param {Layout} [layout]
 * @returns {T} The array.
 * @throws {TypeError | RangeError} As `encode` does, and of codecs of axes and of vectors with a length.
 */
export function snap(elements, by, { offset = 0, stride } = {}) {
  const facts = named(by);
  const input = inputOf(elements, facts, offset, stride);
  inPortions(input.count, (first, count) => {
    const some = input.portion(first, count).slice();
    native.snap(facts.id, some);
    const begin = offset + first * input.stride;
    some.forEach((value, i) => (elements[begin + Math.floor(i / facts.floats) * input.stride + (i % facts.floats)] = value));
  });
  return elements;
}

/** @param {string | Codec} by */
function named(by) {
  return codec(typeof by === "object" && by !== null ? by.id : by);
}

/** The name of a value's type. Arrays of other windows and of test runners have theirs, too. @param {unknown} value */
function typeOf(value) {
  if (ArrayBuffer.isView(value)) return Object.prototype.toString.call(value).slice("[object ".length, -1);
  return value === null ? "null" : Array.isArray(value) ? "Array" : typeof value;
}

/** A value in a message. @param {unknown} value */
function shown(value) {
  return ["string", "number", "bigint", "boolean"].includes(typeof value) ? String(value).slice(0, 40) : typeOf(value);
}

/**
 * Checks an array of elements. Gives their number, and portions of them as floats without gaps.
 *
 * @param {Elements} elements @param {Codec} by
 */
function inputOf(elements, { id, element, floats }, offset = 0, stride = floats) {
  const type = typeOf(elements);
  if (type !== "Float32Array" && type !== "Float64Array") {
    throw new TypeError(`${id} encodes a Float32Array or Float64Array, not ${type}; new Float32Array(…) makes it so`);
  }
  if (!Number.isSafeInteger(offset) || offset < 0 || offset > elements.length) {
    throw new RangeError(`offset is a place in the array, from 0 to ${elements.length}, not ${shown(offset)}`);
  }
  if (!Number.isSafeInteger(stride) || stride < floats) {
    throw new RangeError(`stride is a number of floats from ${floats} on, those of ${element}, not ${shown(stride)}`);
  }
  const rest = (elements.length - offset) % stride;
  if (rest > 0 && rest < floats) {
    throw new RangeError(`the array ends within an element: ${id} encodes ${element} of ${floats} numbers; ${rest} are left`);
  }
  /** @param {number} first @param {number} count @returns {Float32Array} */
  const portion = (first, count) => {
    let some = elements.subarray(offset + first * stride, offset + (first + count) * stride);
    if (stride !== floats) {
      const packed = type === "Float32Array" ? new Float32Array(count * floats) : new Float64Array(count * floats);
      for (let i = 0; i < count; i++) {
        for (let c = 0; c < floats; c++) packed[i * floats + c] = some[i * stride + c];
      }
      some = packed;
    }
    return type === "Float32Array" ? /** @type {Float32Array} */ (some) : native.round(id, /** @type {Float64Array} */ (some));
  };
  return { count: Math.ceil((elements.length - offset) / stride), stride, portion };
}

/**
 * An array to write to: `out` where it can be.
 *
 * @template {Codes | Float32Array} T
 * @param {T | undefined} out @param {new (length: number) => T} ArrayType @param {number} length @param {ArrayBufferView} source
 */
function output(out, ArrayType, length, source) {
  if (out === undefined) return new ArrayType(length);
  if (typeOf(out) !== ArrayType.name) throw new TypeError(`out is a ${ArrayType.name} of ${length}, not ${typeOf(out)}`);
  if (out.length !== length) throw new RangeError(`out has ${out.length} numbers; it needs ${length}`);
  return out.buffer === source.buffer ? new ArrayType(length) : out;
}

/** What was written, moved to `out` where that lies in the buffer of the input. @template T @param {T | undefined} out @param {T} written */
function filled(out, written) {
  if (out === undefined || out === written) return written;
  /** @type {any} */ (out).set(written);
  return out;
}

/** An empty array is a portion, too: what is wrong is told. @param {number} total @param {(first: number, count: number) => void} each */
function inPortions(total, each) {
  for (let first = 0; first === 0 || first < total; first += PORTION) each(first, Math.min(PORTION, total - first));
}

/** @param {ArrayBufferView} integers */
function bytesOf(integers) {
  return new Uint8Array(integers.buffer, integers.byteOffset, integers.byteLength);
}
