// The chunks of a GLB file (glTF 2.0, sections 3 and 4). Whatever the file says is checked against its length.

import { Accessor } from "@gltf-transform/core";

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;
export const MOST_BYTES = 512 * 2 ** 20;
const MOST_VERTICES = 4_000_000;
const MOST_CORNERS = 6 * MOST_VERTICES;
// Of all accessors: attributes, animations and indices together.
const MOST_ELEMENTS = 16 * MOST_VERTICES;
const MOST_NODES = 100_000;
// Numbers of a node's properties.
const LENGTHS = { matrix: 16, translation: 3, rotation: 4, scale: 3 };

// A file that the page cannot show; the message is one line.
export class GlbError extends Error {}

export const refuse = (why) => {
  throw new GlbError(why);
};
const isCount = (x) => Number.isInteger(x) && x >= 0;
const list = (x) => (Array.isArray(x) ? x : []);

// The description and the data of a file, whose accessors and nodes lead to what is there.
export function chunks(bytes) {
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
  const bin = found[BIN_CHUNK] ?? new Uint8Array();
  const isOutside = ({ uri }) => uri !== undefined && !/^data:/.test(uri);
  if (list(json.buffers).some((buffer) => isOutside(buffer ?? {}))) refuse("the file keeps data outside of itself: pack it into one GLB");
  checkAccessors(json, bin);
  checkNodes(json);
  return { json, bin };
}

// Refuses more than the page can show at once.
export function checkSize(vertices, corners, elements = 0) {
  if (vertices > MOST_VERTICES || corners > MOST_CORNERS || elements > MOST_ELEMENTS) {
    refuse(`the file has more than ${MOST_VERTICES / 1e6} million vertices, or twice as many triangles: simplify it first`);
  }
}

function checkAccessors({ accessors, bufferViews }, bin) {
  const countOf = (one) => (Math.max(one?.count, 0) || 0) + (Math.max(one?.sparse?.count, 0) || 0);
  checkSize(0, 0, list(accessors).reduce((sum, one) => sum + countOf(one), 0));
  for (const [index, accessor] of list(accessors).entries()) {
    const { bufferView, byteOffset = 0, componentType, count, type } = accessor ?? {};
    if (!isCount(count) || !isCount(byteOffset)) refuse(`accessor ${index} of the file is missing or of a kind that this page does not read`);
    if (bufferView === undefined) continue;
    const { byteOffset: start = 0, byteLength, byteStride, extensions } = list(bufferViews)[bufferView] ?? {};
    const size = Accessor.getElementSize(type) * Accessor.getComponentSize(componentType);
    const stride = byteStride ?? size;
    const end = byteOffset + (count - 1) * stride + size;
    // Compressed views have their length once they are decoded.
    const isWhole = [start, byteLength, stride].every(isCount) && (extensions || start + byteLength <= bin.length) && (count === 0 || end <= byteLength);
    if (!isWhole || stride < size) refuse(`accessor ${index} of the file reaches beyond its data: it is cut off or damaged`);
  }
}

function checkNodes({ nodes, scenes, scene }) {
  const waiting = [...list(list(scenes)[scene ?? 0]?.nodes)];
  for (let seen = 0; waiting.length; seen++) {
    const index = waiting.pop();
    const node = list(nodes)[index];
    if (!node || seen > MOST_NODES) refuse(node ? "the file's nodes lead back to themselves, or are too many" : `the file has no node ${index}`);
    for (const [name, length] of Object.entries(LENGTHS)) {
      const isRight = node[name] === undefined || (list(node[name]).length === length && node[name].every(Number.isFinite));
      if (!isRight) refuse("a node of the file has a wrong matrix, place, turn or size");
    }
    for (const child of list(node.children)) waiting.push(child);
  }
}
