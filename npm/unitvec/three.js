/**
 * Codes as vertex attributes in three.js, for `WebGLRenderer`; `unitvec/three-webgpu` is for `WebGPURenderer`.
 * @module
 */
import { BufferAttribute, IntType } from "three";
import { attributeName, checkCodes, CODECS, glslText, isFrame, joined } from "./codes.js";

/** @typedef {import("./codes.js").AttributeCodec} AttributeCodec */

/**
 * Gives a geometry codes in place of its normals, and of its tangents for frames.
 *
 * The attributes `normal` and `tangent` are then the codes too, since three.js takes a geometry without them for one
 * to shade flat: do not compute with them.
 * @template {import("three").BufferGeometry} G
 * @param {G} geometry
 * @param {Uint16Array | Uint32Array} codes one a vertex, as `encode` gives them
 * @param {AttributeCodec} codec
 * @returns {G}
 */
export function setCodes(geometry, codes, codec) {
  const attribute = new BufferAttribute(checkCodes(codes, codec), 1);
  attribute.gpuType = IntType; // integers of 16 bits would reach the shader as floats
  for (const name of [attributeName(codec), "normal", ...(isFrame(codec) ? ["tangent"] : [])]) {
    geometry.setAttribute(name, attribute);
  }
  return geometry;
}

/**
 * Makes a material decode its normals, and the tangents of frames, from the codes of `setCodes`. Works for all
 * materials that have normals, with morph targets, skins and instances. Clones of the material need it again.
 * @template {import("three").Material} M
 * @param {M} material
 * @param {AttributeCodec} codec
 * @returns {M}
 */
export function useCodes(material, codec) {
  const library = glslText(codec);
  const name = attributeName(codec);
  // three.js's chunk, with the decoded normal and, in frames, a variable that hides the attribute `tangent`.
  const normalChunk = `
vec3 objectNormal = normal_of_code(${name});
#ifdef USE_TANGENT
  ${isFrame(codec) ? `vec4 tangent = tangent_of_code(${name});` : ""}
  vec3 objectTangent = tangent.xyz;
#endif`;
  const { onBeforeCompile, customProgramCacheKey } = material;
  const earlierKey = customProgramCacheKey.call(material);
  material.onBeforeCompile = (shader, renderer) => {
    onBeforeCompile.call(material, shader, renderer);
    if (!shader.vertexShader.includes("#include <beginnormal_vertex>")) {
      throw new Error(`${material.type} has no normals to decode: take a material such as MeshStandardMaterial`);
    }
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", `#include <common>\n${library}\nin uint ${name};`)
      .replace("#include <beginnormal_vertex>", normalChunk);
  };
  material.customProgramCacheKey = () => `${earlierKey} ${name}`;
  return material;
}

/**
 * Plugin for three.js's `GLTFLoader`: finds the attributes that `packNormals` writes, and gives their meshes materials
 * that decode them.
 * @example new GLTFLoader().register(codesPlugin)
 * @type {(parser: object) => { name: string, afterRoot(result: any): Promise<void> }}
 */
export const codesPlugin = pluginWith(useCodes);

/**
 * The plugin with another function in place of `useCodes`.
 * @param {(material: any, codec: AttributeCodec) => any} use
 * @returns {(parser: object) => { name: string, afterRoot(result: any): Promise<void> }}
 */
export function pluginWith(use) {
  return () => ({
    name: "unitvec_codes",
    async afterRoot({ scenes }) {
      const materials = new Map();
      const visit = (/** @type {any} */ mesh) => mesh.isMesh && decodeMesh(mesh, materials, use);
      for (const scene of scenes) scene.traverse(visit);
    },
  });
}

/**
 * @param {import("three").Mesh<any, any>} mesh
 * @param {Map<string, any>} materials made so far, by the loader's material and the codec
 * @param {(material: any, codec: AttributeCodec) => any} use
 */
function decodeMesh(mesh, materials, use) {
  const codec = CODECS.find((id) => attributeName(id) in mesh.geometry.attributes);
  if (!codec) return;
  const stored = mesh.geometry.getAttribute(attributeName(codec));
  if (stored !== mesh.geometry.getAttribute("normal")) {
    const component = (/** @type {number} */ i, /** @type {number} */ c) => stored.getComponent(i, c);
    setCodes(mesh.geometry, joined(component, stored.count, codec), codec);
  }
  const key = `${mesh.material.uuid} ${codec}`;
  if (!materials.has(key)) materials.set(key, use(repaired(mesh.material.clone(), codec), codec));
  mesh.material = materials.get(key);
}

/**
 * Undoes what the loader does to materials of meshes without normals and tangents: it shades flat, and turns the normal
 * map's y for derivatives in place of tangents.
 * @param {any} material
 * @param {AttributeCodec} codec
 */
function repaired(material, codec) {
  material.flatShading = false;
  if (isFrame(codec)) {
    for (const scale of [material.normalScale, material.clearcoatNormalScale]) scale?.set(scale.x, -scale.y);
  }
  return material;
}
