/**
 * Codes as vertex attributes in PlayCanvas, with WebGL 2.
 * @module
 */
import { SEMANTIC_NORMAL, ShaderChunks, SHADERLANGUAGE_GLSL, TYPE_UINT16, TYPE_UINT32 } from "playcanvas";
import { glslText, isFrame, row } from "./codes.js";

/** @typedef {import("./codes.js").AttributeCodec} AttributeCodec */

/**
 * The codes of a codec as an element of a `VertexFormat`: integers of 16 bits for oct16p, else of 32, in the place of
 * normals.
 * @param {AttributeCodec} codec
 */
export function codesElement(codec) {
  const type = row(codec).codes === Uint16Array ? TYPE_UINT16 : TYPE_UINT32;
  return { semantic: SEMANTIC_NORMAL, components: 1, type, asInt: true };
}

/**
 * Makes a `StandardMaterial` decode the normals, and the tangents of frames, of meshes whose format has `codesElement`.
 * Call `material.update()` after it.
 * @template {import("playcanvas").StandardMaterial} M
 * @param {M} material
 * @param {AttributeCodec} codec
 * @param {import("playcanvas").GraphicsDevice} device whose chunks are changed
 * @returns {M}
 */
export function useCodes(material, codec, device) {
  const chunks = material.getShaderChunks(SHADERLANGUAGE_GLSL);
  const original = ShaderChunks.get(device, SHADERLANGUAGE_GLSL);
  /** @type {(name: string, ...changes: [string, string][]) => void} */
  const change = (name, ...changes) => {
    const text = changes.reduce((chunk, [from, to]) => chunk.replace(from, to), original.get(name) ?? "");
    chunks.set(name, text);
  };
  const library = glslText(codec);
  const tangent = isFrame(codec) ? "#ifdef TANGENTS\nvec4 vertex_tangent;\n#endif\n" : "";
  const setTangent = isFrame(codec) ? "\n#ifdef TANGENTS\nvertex_tangent = tangent_of_code(vertex_normal);\n#endif" : "";
  change(
    "normalCoreVS",
    ["attribute vec3 vertex_normal;", `${library}attribute uint vertex_normal;\n${tangent}`],
    ["getLocalNormal(vec3 vertexNormal)", "getLocalNormal()"],
    ["vec3 localNormal = vertex_normal;", `vec3 localNormal = normal_of_code(vertex_normal);${setTangent}`],
  );
  change("normalVS", ["getLocalNormal(vertex_normal)", "getLocalNormal()"]);
  if (isFrame(codec)) {
    change("litMainVS", ["attribute vec4 vertex_tangent;", ""]);
    // PlayCanvas has tangents only where the mesh's format names them.
    material.onUpdateShader = (options) => {
      options.litOptions.hasTangents = true;
      return options;
    };
  }
  return material;
}
