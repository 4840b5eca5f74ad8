/**
 * Codes as vertex attributes of glTF files, by glTF-Transform.
 * @module
 */
import { encode } from "unitvec";
import { isFrame, row, split, STORED } from "./codes.js";

/** @typedef {import("./codes.js").AttributeCodec} AttributeCodec */

/**
 * glTF-Transform's function that replaces the normals of all primitives, and the tangents for frames, by an attribute
 * of codes, such as `_NORMAL_OCT32P`. The hooks of `unitvec/three` and `unitvec/babylon` read it; other viewers take
 * such a mesh for one without normals.
 *
 * Primitives without normals, or without tangents for frames, and those whose morph targets have some of their own, stay
 * as they are.
 * @example await document.transform(packNormals({ codec: "oct32p" }))
 * @param {{ codec?: AttributeCodec }} [options] the codec, oct32p unless given
 * @returns {import("@gltf-transform/core").Transform}
 */
export function packNormals({ codec = "oct32p" } = {}) {
  row(codec);
  return function packNormals(document) {
    const accessors = document.getRoot().listAccessors();
    /** @type {Made} */
    const made = new Map();
    for (const primitive of document
      .getRoot()
      .listMeshes()
      .flatMap((mesh) => mesh.listPrimitives())) {
      pack(document, primitive, codec, { accessors, made });
    }
    for (const accessor of [...made.values()].flatMap(({ from }) => from)) {
      if (accessor.listParents().every((parent) => parent.propertyType === "Root")) accessor.dispose();
    }
  };
}

/**
 * The accessors of codes so far, by the places of those that they are made from.
 * @typedef {import("@gltf-transform/core").Accessor} Accessor
 * @typedef {Map<string, { codes: Accessor, from: Accessor[] }>} Made
 */

/**
 * @param {import("@gltf-transform/core").Document} document
 * @param {import("@gltf-transform/core").Primitive} primitive
 * @param {AttributeCodec} codec
 * @param {{ accessors: Accessor[], made: Made }} shared
 */
function pack(document, primitive, codec, { accessors, made }) {
  const names = isFrame(codec) ? ["NORMAL", "TANGENT"] : ["NORMAL"];
  const from = names.flatMap((name) => primitive.getAttribute(name) ?? []);
  const moves = primitive.listTargets().some((target) => names.some((name) => target.getAttribute(name)));
  if (from.length < names.length || moves) return;
  const key = from.map((accessor) => accessors.indexOf(accessor)).join();
  if (!made.has(key)) {
    const { type, array } = STORED[codec];
    const parts = split(/** @type {any} */ (encode(vectors(from), codec)), codec);
    const codes = document
      .createAccessor()
      .setType(type)
      .setArray(/** @type {any} */ (new array(parts)));
    made.set(key, { codes: codes.setBuffer(from[0].getBuffer()), from });
  }
  primitive.setAttribute(row(codec).attribute, made.get(key)?.codes ?? null);
  for (const name of names) primitive.setAttribute(name, null);
}

/** The vectors of accessors side by side: 3 floats an element, or 7 with tangents. */
function vectors(/** @type {Accessor[]} */ from) {
  const count = from[0].getCount();
  const size = from.reduce((sum, accessor) => sum + accessor.getElementSize(), 0);
  const floats = new Float32Array(count * size);
  const elements = (/** @type {number} */ i) => from.flatMap((accessor) => accessor.getElement(i, /** @type {number[]} */ ([])));
  for (let i = 0; i < count; i++) floats.set(elements(i), i * size);
  return floats;
}
