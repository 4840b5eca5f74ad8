/**
 * Codes as vertex attributes in Babylon.js (`@babylonjs/core`), with WebGL 2.
 * @module
 */
import { VertexBuffer } from "@babylonjs/core/Buffers/buffer.js";
import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import { attributeName, checkCodes, CODECS, components, glslText, isFrame, joined, row, STORED } from "./codes.js";

/** @typedef {import("./codes.js").AttributeCodec} AttributeCodec */

const NAME = "UnitvecCodes";

/**
 * Gives a mesh or a geometry codes in place of its normals, and of its tangents for frames.
 * @template {import("@babylonjs/core").Mesh | import("@babylonjs/core").Geometry} M
 * @param {M} mesh
 * @param {Uint16Array | Uint32Array} codes one a vertex, as `encode` gives them
 * @param {AttributeCodec} codec
 * @returns {M}
 */
export function setCodes(mesh, codes, codec) {
  const type = checkCodes(codes, codec) instanceof Uint16Array ? VertexBuffer.UNSIGNED_SHORT : VertexBuffer.UNSIGNED_INT;
  const options = { size: 1, type, normalized: false };
  mesh.setVerticesBuffer(new VertexBuffer(mesh.getScene().getEngine(), codes, attributeName(codec), options));
  return mesh;
}

/**
 * Makes a `StandardMaterial` or a `PBRMaterial` decode the normals, and the tangents of frames, of meshes that have the
 * codes of `setCodes`. Its other meshes stay as they are. Throws an Error if it decodes another codec already.
 * @template {import("@babylonjs/core").Material} M
 * @param {M} material
 * @param {AttributeCodec} codec
 * @returns {M}
 */
export function useCodes(material, codec) {
  const earlier = /** @type {any} */ (material.pluginManager?.getPlugin(NAME));
  if (earlier && earlier.codec !== codec) {
    throw new Error(`the material "${material.name}" decodes ${earlier.codec}: clone it for meshes with ${codec}`);
  }
  if (!earlier) addPlugin(material, codec);
  return material;
}

/**
 * Adds the plugin to a material. The base class's constructor asks for the code already, so the codec is not a field.
 * @param {import("@babylonjs/core").Material} material
 * @param {AttributeCodec} codec
 */
function addPlugin(material, codec) {
  const name = attributeName(codec);
  const code = customCode(codec);
  const hasCodes = (/** @type {import("@babylonjs/core").AbstractMesh} */ mesh) => mesh.isVerticesDataPresent(name);

  class Codes extends MaterialPluginBase {
    codec = codec;

    getClassName() {
      return NAME;
    }

    /** @param {number} language */
    isCompatible(language) {
      return language === 0; // GLSL
    }

    prepareDefines(/** @type {any} */ defines, /** @type {any} */ _scene, /** @type {any} */ mesh) {
      defines.UNITVEC_CODES = hasCodes(mesh) ? 1 + CODECS.indexOf(codec) : 0;
      if (!hasCodes(mesh)) return;
      // Babylon.js turns both off where the mesh has no such attribute.
      defines.NORMAL = true;
      defines.TANGENT ||= isFrame(codec);
    }

    /** @type {MaterialPluginBase["getAttributes"]} */
    getAttributes(attributes, _scene, mesh) {
      if (hasCodes(mesh)) attributes.push(name);
    }

    /** @param {string} stage */
    getCustomCode(stage) {
      return stage === "vertex" ? code : null;
    }
  }

  // Shaders are cached by their defines, so the define's value tells codecs apart.
  new Codes(material, NAME, 200, { UNITVEC_CODES: 0 }, true, true);
}

/**
 * Changes of the vertex shader, by the place or the expression that they replace.
 * @param {AttributeCodec} codec
 * @returns {Record<string, string>}
 */
function customCode(codec) {
  const name = attributeName(codec);
  // Babylon.js binds integers of 16 bits as floats, which have them exactly.
  const [type, code] = row(codec).codes === Uint16Array ? ["float", `uint(${name})`] : ["uint", name];
  const library = glslText(codec);
  const either = (/** @type {string} */ ours, /** @type {string} */ theirs) =>
    `#if UNITVEC_CODES > 0\n${ours}\n#else\n${theirs}\n#endif`;
  const normal = either(`vec3 normalUpdated = normal_of_code(${code});`, "vec3 normalUpdated = normal;");
  const tangent = either(`vec4 tangentUpdated = tangent_of_code(${code});`, "vec4 tangentUpdated = tangent;");
  return {
    CUSTOM_VERTEX_DEFINITIONS: either(`${library}\nin ${type} ${name};`, ""),
    "!vec3 normalUpdated\\s*=\\s*normal;": normal,
    ...(isFrame(codec) ? { "!vec4 tangentUpdated\\s*=\\s*tangent;": tangent } : {}),
  };
}

/**
 * Makes Babylon.js's glTF loader find the attributes that `packNormals` writes, and the meshes' materials decode them.
 * @example registerCodes(registerGLTFExtension) // from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry.js"
 * @param {(name: string, isExtension: boolean, factory: (loader: any) => any) => void} register
 */
export function registerCodes(register) {
  register(NAME, false, (loader) => ({
    name: NAME,
    enabled: true,
    dispose() {},
    /** @type {(context: string, name: string, node: any, mesh: any, primitive: any, assign: any) => any} */
    _loadMeshPrimitiveAsync(context, name, node, mesh, primitive, assign) {
      const codec = CODECS.find((id) => STORED[id].attribute in primitive.attributes);
      if (!codec) return null;
      // The loader does not ask this extension again for the primitive.
      const loaded = loader._loadMeshPrimitiveAsync(context, name, node, mesh, primitive, assign);
      return decoded(loaded, loader, primitive, codec);
    },
  }));
}

/**
 * @param {Promise<any>} loaded
 * @param {any} loader
 * @param {any} primitive
 * @param {AttributeCodec} codec
 */
async function decoded(loaded, loader, primitive, codec) {
  const { attribute, array } = STORED[codec];
  const accessor = loader.gltf.accessors[primitive.attributes[attribute]];
  const [mesh, parts] = await Promise.all([loaded, loader._loadAccessorAsync(`/accessors/${accessor.index}`, accessor, array)]);
  const source = mesh.sourceMesh ?? mesh;
  const size = components(codec);
  const component = (/** @type {number} */ i, /** @type {number} */ c) => parts[i * size + c];
  setCodes(source, joined(component, accessor.count, codec), codec);
  if (source.material) useCodes(source.material, codec);
  return mesh;
}
