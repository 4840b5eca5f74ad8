// A mesh of this repository, as it is and compressed.

import { WebIO } from "@gltf-transform/core";
import { EXTMeshoptCompression, KHRDracoMeshCompression } from "@gltf-transform/extensions";
import draco from "draco3d";
import { MeshoptEncoder } from "meshoptimizer/encoder";
import { readFile } from "node:fs/promises";

export const TORUS = new URL("../../host/mesh/data/torus.glb", import.meta.url).pathname;
export const torus = new Uint8Array(await readFile(TORUS));

// By the name of the extension that a file needs; triangles keep their order.
const WAYS = {
  EXT_meshopt_compression: [EXTMeshoptCompression, {}],
  KHR_draco_mesh_compression: [KHRDracoMeshCompression, { method: KHRDracoMeshCompression.EncoderMethod.SEQUENTIAL }],
};

export const COMPRESSIONS = Object.keys(WAYS);

// The bytes of the mesh with this compression.
export async function compressed(name) {
  const [Extension, options] = WAYS[name];
  const encoders = { "draco3d.encoder": await draco.createEncoderModule(), "meshopt.encoder": MeshoptEncoder };
  const io = new WebIO().registerExtensions([Extension]).registerDependencies(encoders);
  const document = await io.readBinary(torus);
  document.createExtension(Extension).setRequired(true).setEncoderOptions(options);
  return io.writeBinary(document);
}
