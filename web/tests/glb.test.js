// Files that are no meshes, or say what is not so: each gets one line, and none much memory.

import assert from "node:assert/strict";
import { test } from "node:test";
import { GlbError } from "../chunks.js";
import { readGlb } from "../glb.js";
import { whole } from "../mesh.js";
import { COMPRESSIONS, compressed, torus } from "./torus.js";

// A GLB of this JSON, of a text or a value, and these bytes.
function glb(json, bin = new Uint8Array(36)) {
  const text = new TextEncoder().encode(typeof json === "string" ? json : JSON.stringify(json));
  const bytes = new Uint8Array(28 + text.length + bin.length);
  const words = [0x46546c67, 2, bytes.length, text.length, 0x4e4f534a];
  const view = new DataView(bytes.buffer);
  words.forEach((word, at) => view.setUint32(4 * at, word, true));
  bytes.set(text, 20);
  view.setUint32(20 + text.length, bin.length, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  bytes.set(bin, 28 + text.length);
  return bytes;
}

const mesh = (more = {}, accessor = {}) => ({
  meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
  accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", ...accessor }],
  bufferViews: [{ buffer: 0, byteLength: 36 }],
  buffers: [{ byteLength: 36 }],
  ...more,
});

const indexed = (of) => ({
  ...mesh({ meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }] }),
  accessors: [...mesh().accessors, { bufferView: 0, componentType: 5121, count: 3, type: "SCALAR", ...of }],
});

// A triangle in the corners 0, x, y.
const corners = new Uint8Array(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
const placed = async (...nodes) => readGlb(glb(mesh({ nodes, scenes: [{ nodes: [0] }] }), corners));

// Turned by half about x, and moved by 1 along z: (0, 0, 1), (1, 0, 1), (0, -1, 1).
test("triangles are placed as their nodes say", async () => {
  const { places, normals, indices } = await placed({ translation: [0, 0, 1], children: [1] }, { mesh: 0, rotation: [1, 0, 0, 0] });
  assert.deepEqual([[...places], normals, [...indices]], [[0, 0, 1, 1, 0, 1, 0, -1, 1], null, [0, 1, 2]]);
  const whole = await readGlb(torus);
  assert.equal(whole.normals.length, whole.places.length);
});

// A mirror turns the order of corners; their other order keeps the side that they are seen from.
test("mirrored triangles show the same side", async () => {
  const { places, indices } = await placed({ mesh: 0, scale: [1, 1, -1] });
  assert.deepEqual([[...places].map(Math.abs), [...indices]], [[0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 2, 1]]);
});

test("vertices without normals get those of their triangles", async () => {
  for (const scale of [[1, 1, 1], [1, 1, -1]]) {
    const { normals } = whole(await placed({ mesh: 0, scale }));
    assert.deepEqual([...normals].map((x) => x + 0), [1, 2, 3].flatMap(() => [0, 0, scale[2]]));
  }
});

// The sum of each triangle's corners, as encoders begin triangles with another corner.
const sums = ({ indices, ...of }, name) =>
  Array.from({ length: indices.length }, (_, at) => [0, 1, 2].reduce((sum, k) => sum + of[name][3 * indices[at - (at % 3) + k] + (at % 3)], 0));

for (const name of COMPRESSIONS) {
  test(`files with ${name} open`, async () => {
    const [found, plain] = [await readGlb(await compressed(name)), await readGlb(torus)];
    assert.equal(found.indices.length, plain.indices.length);
    for (const of of ["places", "normals"]) {
      const [a, b] = [sums(found, of), sums(plain, of)];
      assert.ok(a.every((x, at) => Math.abs(x - b[at]) < 0.02), of);
    }
  });
}

const BROKEN = {
  empty: [new Uint8Array(), /no GLB/],
  "of glTF 1": [Uint8Array.from(torus, (byte, at) => (at === 4 ? 1 : byte)), /glTF 1/],
  "cut off": [torus.subarray(0, torus.length / 2), /cut off/],
  "no JSON": [glb("{"), /no JSON/],
  "null for JSON": [glb("null"), /no JSON/],
  "without triangles": [glb({}), /no triangles/],
  "a huge count": [glb(mesh({}, { count: 2 ** 31 })), /more than 4 million/],
  "a count beyond its data": [glb(mesh({}, { count: 1000 })), /beyond its data/],
  "a negative count": [glb(mesh({}, { count: -1 })), /accessor 0/],
  "a stride of nothing": [glb(mesh({ bufferViews: [{ buffer: 0, byteLength: 36, byteStride: 0 }] })), /beyond its data/],
  "a huge stride": [glb(mesh({ bufferViews: [{ buffer: 0, byteLength: 36, byteStride: 2 ** 52 }] })), /beyond its data/],
  "data elsewhere": [glb(mesh({ buffers: [{ uri: "mesh.bin", byteLength: 36 }] })), /outside/],
  "a circle of nodes": [glb(mesh({ nodes: [{ children: [0, 0] }], scenes: [{ nodes: [0] }] })), /back to themselves/],
  "nodes that are none": [glb(mesh({ nodes: [], scenes: [{ nodes: [7] }] })), /no node 7/],
  "a matrix of words": [glb(mesh({ nodes: [{ mesh: 0, matrix: "unit" }], scenes: [{ nodes: [0] }] })), /wrong matrix/],
  "a circle of two nodes": [glb(mesh({ nodes: [{ children: [1] }, { children: [0] }], scenes: [{ nodes: [1] }] })), /back to themselves/],
  "a huge count without data": [glb(mesh({}, { count: 1e9, bufferView: undefined })), /more than 4 million/],
  "a huge count of exceptions": [glb(mesh({}, { sparse: { count: 1e9 } })), /more than 4 million/],
  "an extension of its own": [glb(mesh({ extensionsRequired: ["MY_triangles"] })), /MY_triangles/],
  "indices of three numbers": [glb(indexed({ type: "VEC3", componentType: 5121 })), /indices of a wrong kind/],
  "an index beyond its vertices": [glb(indexed({ byteOffset: 13 }), corners), /vertex that is not there/],
};

for (const [name, [bytes, line]] of Object.entries(BROKEN)) {
  test(`a file ${name} gets one line`, async () => {
    await assert.rejects(readGlb(bytes), (reason) => reason instanceof GlbError && line.test(reason.message) && !reason.message.includes("\n"));
  });
}

test("mutated files end in a mesh or a line", async () => {
  const json = 20 + new DataView(torus.buffer, torus.byteOffset).getUint32(12, true);
  let seed = 1;
  const random = (below) => (seed = (seed * 48271) % 2147483647) % below;
  for (let round = 0; round < 3000; round++) {
    const bytes = torus.slice();
    for (let changes = 1 + random(3); changes > 0; changes--) bytes[random(json)] = random(2) ? 48 + random(10) : random(256);
    try {
      await readGlb(bytes);
    } catch (reason) {
      assert.ok(reason instanceof GlbError, `round ${round}: ${reason.stack}`);
    }
  }
});
