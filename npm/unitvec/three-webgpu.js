/**
 * Codes as vertex attributes in three.js, for `WebGPURenderer`, with WebGPU and with WebGL 2: the functions of
 * `unitvec/three`, by node materials. Materials of other classes, which the renderer converts, will do as well.
 * @module
 */
import {
  attribute,
  Fn,
  glsl,
  glslFn,
  mat3,
  materialReference,
  modelViewMatrix,
  normalLocal,
  normalView,
  positionLocal,
  texture,
  varying,
  vec3,
  vec4,
  wgsl,
  wgslFn,
} from "three/tsl";
import { glslText, isFrame, wgslText } from "./codes.js";
import { pluginWith } from "./three.js";

export { setCodes } from "./three.js";

/** @typedef {import("./codes.js").AttributeCodec} AttributeCodec */

/**
 * Makes a material decode its normals from the codes of `setCodes`. Set the material's own `positionNode` and
 * `normalMap` before.
 *
 * Of frames, tangents serve the normal map, in tangent space; other uses of tangents, such as anisotropy, are not
 * supported. The normals are decoded before the material's positions: nodes cannot replace an attribute.
 * @template {import("three").Material} M
 * @param {M} material
 * @param {AttributeCodec} codec
 * @returns {M}
 */
export function useCodes(material, codec) {
  const nodes = /** @type {any} */ (material);
  const position = nodes.positionNode ?? positionLocal;
  const { normalOf, tangentOf } = decoders(codec);
  nodes.positionNode = Fn((/** @type {any} */ builder) => {
    normalLocal.assign(normalOf(builder));
    return position;
  })();
  if (isFrame(codec) && nodes.normalMap) nodes.normalNode = mapped(nodes, tangentOf);
  return material;
}

/** Plugin for three.js's `GLTFLoader`, as that of `unitvec/three`. */
export const codesPlugin = pluginWith(useCodes);

/**
 * Functions from a builder to a node, the normal or the tangent of the vertex's code, in the builder's language. They
 * share one text, since a shader may have it only once.
 * @param {AttributeCodec} codec
 */
function decoders(codec) {
  const libraries = { wgsl: wgsl(wgslText(codec)), glsl: glsl(glslText(codec)) };
  const decoder = (/** @type {string} */ part, /** @type {string} */ type) => {
    const functions = {
      wgsl: wgslFn(`fn ${part}_of_vertex(code: u32) -> ${type}f { return ${part}_of_code(code); }`, [libraries.wgsl]),
      glsl: glslFn(`${type} ${part}_of_vertex(uint code) { return ${part}_of_code(code); }`, [libraries.glsl]),
    };
    return (/** @type {any} */ builder) =>
      functions[builder.renderer.backend.isWebGPUBackend ? "wgsl" : "glsl"]({ code: attribute("normal", "uint") });
  };
  return { normalOf: decoder("normal", "vec3"), tangentOf: decoder("tangent", "vec4") };
}

/**
 * The normal of a material's normal map, in view space, about tangents that a decoder gives.
 * @param {any} material
 * @param {(builder: any) => any} tangentOf
 */
function mapped(material, tangentOf) {
  return Fn((/** @type {any} */ builder) => {
    const decoded = tangentOf(builder);
    const tangent = varying(modelViewMatrix.mul(vec4(decoded.xyz, 0)).xyz).normalize();
    const bitangent = normalView.cross(tangent).mul(varying(decoded.w));
    const texel = /** @type {any} */ (texture(material.normalMap).xyz.mul(2).sub(1));
    const scaled = vec3(texel.xy.mul(materialReference("normalScale", "vec2")), texel.z);
    return mat3(tangent, bitangent, normalView).mul(scaled).normalize();
  })();
}
