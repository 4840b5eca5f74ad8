// Reads the triangles of a GLB file (glTF 2.0, sections 3 and 4). Whatever the file says is checked against its length first.

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;
export const MOST_BYTES = 512 * 2 ** 20;
const MOST_VERTICES = 4_000_000;
const MOST_NODES = 100_000;
const TRIANGLES = 4;
// Array type, and the largest value of normalised integers, by glTF's number of a component's type.
const COMPONENTS = {
  5120: [Int8Array, 127],
  5121: [Uint8Array, 255],
  5122: [Int16Array, 32767],
  5123: [Uint16Array, 65535],
  5125: [Uint32Array, 1],
  5126: [Float32Array, 1],
};
const WIDTHS = { SCALAR: 1, VEC3: 3 };

// A file that the page cannot show; the message is one line.
export class GlbError extends Error {}

const refuse = (why) => {
  throw new GlbError(why);
};
const isCount = (x) => Number.isInteger(x) && x >= 0;
const list = (x) => (Array.isArray(x) ? x : []);

// The floats of all triangles in the scene: `places`, `indices` and, where every part has them, `normals`.
export function readGlb(bytes) {
  const { json, bin } = chunks(bytes);
  for (const name of list(json.extensionsRequired)) {
    if (name !== "KHR_mesh_quantization") refuse(`the file needs ${name}, which this page does not read: export it without`);
  }
  const parts = [];
  let [vertices, corners] = [0, 0];
  for (const { mesh, matrix } of placed(json)) {
    for (const primitive of list(list(json.meshes)[mesh]?.primitives)) {
      if ((primitive?.mode ?? TRIANGLES) !== TRIANGLES) continue;
      const countOf = (accessor) => list(json.accessors)[accessor]?.count || 0;
      vertices += countOf(primitive.attributes?.POSITION);
      corners += countOf(primitive.indices);
      if (vertices > MOST_VERTICES || corners > 6 * MOST_VERTICES) {
        refuse(`the file has more than ${MOST_VERTICES / 1e6} million vertices, or twice as many triangles: simplify it first`);
      }
      parts.push(part(json, bin, primitive, matrix));
    }
  }
  if (!parts.length) refuse("the file has no triangles");
  return joined(parts);
}

function chunks(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.byteLength < 20 || view.getUint32(0, true) !== MAGIC) refuse("this is no GLB file: it does not begin with the letters glTF");
  if (view.getUint32(4, true) !== 2) refuse(`the file is of glTF ${view.getUint32(4, true)}; this page reads glTF 2`);
  const found = {};
  for (let at = 12; at + 8 <= view.byteLength; ) {
    const [length, type] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    if (length > view.byteLength - at - 8) refuse(`the file is cut off: a part of ${length} bytes begins ${view.byteLength - at - 8} before its end`);
    found[type] ??= bytes.subarray(at + 8, at + 8 + length);
    at += 8 + length;
  }
  let json = null;
  try {
    json = JSON.parse(new TextDecoder().decode(found[JSON_CHUNK] ?? new Uint8Array()));
  } catch {}
  if (json === null || typeof json !== "object") refuse("the file's description is no JSON: it is damaged");
  return { json, bin: found[BIN_CHUNK] ?? new Uint8Array() };
}

// The meshes of the scene with their matrices, column by column.
function placed(json) {
  const nodes = list(json.nodes);
  const scene = list(json.scenes)[json.scene ?? 0];
  const found = [];
  const waiting = list(scene?.nodes).map((index) => ({ index, matrix: IDENTITY }));
  for (let seen = 0; waiting.length; seen++) {
    const { index, matrix } = waiting.pop();
    const node = nodes[index];
    if (!node || seen > MOST_NODES) refuse(node ? "the file's nodes lead back to themselves, or are too many" : `the file has no node ${index}`);
    const own = multiplied(matrix, matrixOf(node));
    if (node.mesh !== undefined) found.push({ mesh: node.mesh, matrix: own });
    for (const child of list(node.children)) waiting.push({ index: child, matrix: own });
  }
  return scene ? found : list(json.meshes).map((_, mesh) => ({ mesh, matrix: IDENTITY }));
}

function part(json, bin, { attributes = {}, indices }, matrix) {
  const places = read(json, bin, attributes.POSITION, 3);
  const normals = attributes.NORMAL === undefined ? null : read(json, bin, attributes.NORMAL, 3);
  const count = places.length / 3;
  if (normals && normals.length !== places.length) refuse("the file has another number of normals than of positions");
  const order = indices === undefined ? Uint32Array.from({ length: count - (count % 3) }, (_, at) => at) : read(json, bin, indices, 1);
  if (order.some((index) => index >= count)) refuse("a triangle of the file names a vertex that is not there");
  if (!places.every(Number.isFinite)) refuse("a position of the file is infinite or no number");
  const moved = apply(matrix, places, 1);
  return { places: moved, normals: normals && apply(cofactors(matrix), normals, 0), indices: order.subarray(0, order.length - (order.length % 3)) };
}

// The values of an accessor as floats, or as unsigned integers where it has one component.
function read(json, bin, index, width) {
  const accessor = list(json.accessors)[index];
  const { bufferView, componentType, count, byteOffset = 0, normalized = false, type, sparse } = accessor ?? {};
  const [Type, most] = COMPONENTS[componentType] ?? [];
  const isWrong = !Type || WIDTHS[type] !== width || !isCount(count) || !isCount(byteOffset) || (width === 1 && ![5121, 5123, 5125].includes(componentType));
  if (isWrong) refuse(`accessor ${index} of the file is missing or of a kind that this page does not read`);
  const view = list(json.bufferViews)[bufferView];
  if (sparse || !view) refuse(`accessor ${index} of the file is sparse or has no data in the file; this page reads neither`);
  if (view.buffer !== 0 || list(json.buffers)[0]?.uri !== undefined) refuse("the file keeps data outside of itself: pack it into one GLB");
  const { byteOffset: start = 0, byteLength, byteStride } = view;
  const size = Type.BYTES_PER_ELEMENT;
  const stride = byteStride ?? width * size;
  const end = start + byteOffset + (count - 1) * stride + width * size;
  const isOutside = ![start, byteLength, stride].every(isCount) || start + byteLength > bin.length || (count > 0 && end > start + byteLength);
  if (isOutside || stride < width * size) refuse(`accessor ${index} of the file reaches beyond its data: it is cut off or damaged`);
  const data = new DataView(bin.buffer, bin.byteOffset + start + byteOffset, count ? end - start - byteOffset : 0);
  const get = `get${Type.name.replace("Array", "")}`;
  const out = new (width === 1 ? Uint32Array : Float32Array)(count * width);
  for (let at = 0; at < out.length; at++) {
    const value = data[get](Math.floor(at / width) * stride + (at % width) * size, true);
    out[at] = normalized ? Math.max(value / most, -1) : value;
  }
  return out;
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function numbers(values, length, otherwise) {
  if (values === undefined) return otherwise;
  const isRight = Array.isArray(values) && values.length === length && values.every(Number.isFinite);
  return isRight ? values : refuse("a node of the file has a wrong matrix, place, turn or size");
}

function matrixOf({ matrix, translation, rotation, scale }) {
  if (matrix) return numbers(matrix, 16);
  const [x, y, z, w] = numbers(rotation, 4, [0, 0, 0, 1]);
  const [a, b, c] = numbers(scale, 3, [1, 1, 1]);
  // prettier-ignore
  return [
    a * (1 - 2 * (y * y + z * z)), a * 2 * (x * y + z * w), a * 2 * (x * z - y * w), 0,
    b * 2 * (x * y - z * w), b * (1 - 2 * (x * x + z * z)), b * 2 * (y * z + x * w), 0,
    c * 2 * (x * z + y * w), c * 2 * (y * z - x * w), c * (1 - 2 * (x * x + y * y)), 0,
    ...numbers(translation, 3, [0, 0, 0]), 1,
  ];
}

export const multiplied = (a, b) =>
  Array.from({ length: 16 }, (_, at) => [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + (at % 4)] * b[at - (at % 4) + k], 0));

// Of the inverse's transpose, but for a factor: what moves normals.
function cofactors(m) {
  const at = (row, column) => m[4 * column + row];
  const minor = (r, c) => {
    const [r1, r2, c1, c2] = [(r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3];
    return at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
  };
  return IDENTITY.map((one, k) => (k % 4 < 3 && k < 12 ? minor(k % 4, Math.floor(k / 4)) : one));
}

function apply(m, vectors, w) {
  const out = new Float32Array(vectors.length);
  for (let at = 0; at < vectors.length; at += 3) {
    const [x, y, z] = vectors.subarray(at, at + 3);
    for (let k = 0; k < 3; k++) out[at + k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k] * w;
  }
  return out;
}

function joined(parts) {
  const total = (name) => parts.reduce((sum, one) => sum + one[name].length, 0);
  const hasNormals = parts.every(({ normals }) => normals);
  const places = new Float32Array(total("places"));
  const normals = hasNormals ? new Float32Array(places.length) : null;
  const indices = new Uint32Array(total("indices"));
  let [vertex, index] = [0, 0];
  for (const one of parts) {
    places.set(one.places, 3 * vertex);
    normals?.set(one.normals, 3 * vertex);
    indices.set(one.indices.map((at) => at + vertex), index);
    vertex += one.places.length / 3;
    index += one.indices.length;
  }
  return { places, normals, indices };
}
