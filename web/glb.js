// Reads the triangles of a GLB file by glTF-Transform, compressed ones too.

import { Accessor, GLB_BUFFER, Logger, Primitive, WebIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import startDraco from "draco3d/draco_decoder_nodejs.js";
import { mat3, mat4, vec3 } from "gl-matrix";
import { MeshoptDecoder } from "meshoptimizer/decoder";
import { GlbError, checkSize, chunks, refuse } from "./chunks.js";

// The floats of all triangles in the scene: `places`, `indices` and, where every part has them, `normals`. `dracoModule` gives the
// bytes of Draco's decoder, which Node.js finds by itself.
export async function readGlb(bytes, dracoModule) {
  const parts = await partsOf(bytes, dracoModule).catch((reason) =>
    refuse(reason instanceof GlbError ? reason.message : `the file is damaged: ${String(reason?.message ?? reason).split("\n")[0]}`),
  );
  if (!parts.length) refuse("the file has no triangles");
  const total = (countOf) => parts.reduce((sum, part) => sum + countOf(part), 0);
  const [vertices, corners] = [total(({ position }) => position.getCount()), total(cornersOf)];
  checkSize(vertices, corners);
  const [places, normals] = ["position", "normal"].map((of) => (parts.every((part) => part[of]) ? new Float32Array(3 * vertices) : null));
  const mesh = { places, normals, indices: new Uint32Array(corners) };
  let [vertex, corner] = [0, 0];
  for (const part of parts) {
    add(mesh, part, vertex, corner);
    vertex += part.position.getCount();
    corner += cornersOf(part);
  }
  if (!places.every(Number.isFinite)) refuse("a position of the file is infinite or no number");
  return mesh;
}

// The triangles of the scene's meshes, with their matrices.
async function partsOf(bytes, dracoModule) {
  const { json, bin } = chunks(bytes);
  const io = new WebIO().setLogger(new Logger(Logger.Verbosity.SILENT)).registerExtensions(ALL_EXTENSIONS);
  await MeshoptDecoder.ready;
  io.registerDependencies({ "meshopt.decoder": MeshoptDecoder });
  if (json.extensionsUsed?.includes("KHR_draco_mesh_compression")) {
    const decoder = await startDraco({ wasmBinary: await dracoModule?.() });
    io.registerDependencies({ "draco3d.decoder": decoder });
  }
  // The version is that of the container, which is checked.
  const described = { json: { ...json, asset: { version: "2.0" } }, resources: { [GLB_BUFFER]: bin } };
  const root = (await io.readJSON(described)).getRoot();
  return instances(root).flatMap(({ mesh, matrix }) => {
    const triangles = mesh.listPrimitives().filter((primitive) => primitive.getMode() === Primitive.Mode.TRIANGLES);
    return triangles.map((primitive) => checked(primitive, matrix));
  });
}

function instances(root) {
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  if (!scene) return root.listMeshes().map((mesh) => ({ mesh, matrix: mat4.create() }));
  const found = [];
  scene.traverse((node) => node.getMesh() && found.push({ mesh: node.getMesh(), matrix: node.getWorldMatrix() }));
  return found;
}

function checked(primitive, matrix) {
  const [position, normal] = ["POSITION", "NORMAL"].map((name) => primitive.getAttribute(name));
  const indices = primitive.getIndices();
  const isVector = (accessor) => accessor?.getType() === Accessor.Type.VEC3 && accessor.getCount() === position.getCount();
  if (!isVector(position) || (normal && !isVector(normal))) refuse("the file has positions or normals of a wrong kind, or not as many of both");
  if (indices && indices.getType() !== Accessor.Type.SCALAR) refuse("the file has indices of a wrong kind");
  return { position, normal, indices, matrix };
}

const cornersOf = ({ position, indices }) => (indices ?? position).getCount() - ((indices ?? position).getCount() % 3);

function add({ places, normals, indices }, part, vertex, corner) {
  const count = part.position.getCount();
  // Stays the identity for a matrix without an inverse.
  const ofNormals = mat3.create();
  mat3.normalFromMat4(ofNormals, part.matrix);
  const isMirrored = mat4.determinant(part.matrix) < 0;
  const vector = vec3.create();
  for (let at = 0; at < count; at++) {
    places.set(vec3.transformMat4(vector, part.position.getElement(at, vector), part.matrix), 3 * (vertex + at));
    if (normals) normals.set(vec3.transformMat3(vector, part.normal.getElement(at, vector), ofNormals), 3 * (vertex + at));
  }
  for (let at = 0; at < cornersOf(part); at++) {
    const from = isMirrored ? at + [0, 1, -1][at % 3] : at;
    const index = part.indices ? part.indices.getScalar(from) : from;
    if (!(index >= 0 && index < count)) refuse("a triangle of the file names a vertex that is not there");
    indices[corner + at] = vertex + index;
  }
}
