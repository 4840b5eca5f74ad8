/** Normals and tangents of glTF-Transform's documents, for `document.transform(snapNormals())`. */

import { codec, snap } from "unitvec";

/**
 * Moves normals and tangents to vectors that a codec decodes to, so that what quantises them afterwards, as `quantize()`, `draco()`
 * or `meshopt()`, writes the nearest codes: what the program `unitvec snap` does. A codec of frames moves both together, one of
 * vectors each by itself. Morph targets, vectors without a direction, and attributes that are not floats stay as they are.
 *
 * @param {object} [options]
 * @param {string} [options.codec] The codec, or the format that is written afterwards: `gltf-snorm8` unless said, which is for
 *   `quantize()`; `draco:10` for `draco()`, `meshopt-oct:8` for `meshopt()`.
 * @returns {(document: import("@gltf-transform/core").Document) => void}
 * @throws {RangeError} There is no such codec, or it is not for directions.
 */
export function snapNormals({ codec: name = "gltf-snorm8" } = {}) {
  const by = codec(name);
  if (by.element === "rotations") throw new RangeError(`${by.id} is not for directions; take another codec, as "oct16p"`);
  snap(new Float32Array(), by);
  return function snapNormals(document) {
    const done = new Set();
    for (const primitive of document
      .getRoot()
      .listMeshes()
      .flatMap((mesh) => mesh.listPrimitives())) {
      const [normals, tangents] = ["NORMAL", "TANGENT"].map((semantic) => primitive.getAttribute(semantic));
      for (const accessors of by.element === "frames" ? [[normals, tangents]] : [[normals], [tangents]]) {
        // Primitives share accessors.
        if (accessors.some((accessor) => accessor === null || done.has(accessor))) continue;
        const arrays = accessors.map((accessor) => accessor?.getArray());
        if (arrays.every((array) => array instanceof Float32Array)) {
          move(arrays, accessors[0]?.getElementSize() ?? by.floats, by);
          accessors.forEach((accessor, i) => done.add(accessor?.setArray(arrays[i])));
        } else {
          document.getLogger().warn("snapNormals: left out what is not of floats; it comes before quantize()");
        }
      }
    }
  };
}

/**
 * Moves vectors at this stride, or normals and tangents together.
 *
 * @param {Float32Array[]} arrays
 * @param {number} stride
 * @param {import("./core.js").Codec} by
 */
function move([vectors, tangents], stride, by) {
  if (!tangents) {
    snap(vectors, by, { stride });
    return;
  }
  const frames = new Float32Array((vectors.length / 3) * by.floats);
  for (let i = 0; i < vectors.length / 3; i++) {
    frames.set(vectors.subarray(3 * i, 3 * i + 3), 7 * i);
    frames.set(tangents.subarray(4 * i, 4 * i + 4), 7 * i + 3);
  }
  snap(frames, by);
  for (let i = 0; i < vectors.length / 3; i++) {
    vectors.set(frames.subarray(7 * i, 7 * i + 3), 3 * i);
    tangents.set(frames.subarray(7 * i + 3, 7 * i + 7), 4 * i);
  }
}
