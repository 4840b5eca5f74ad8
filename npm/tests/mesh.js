// The mesh of the engines' pages, as arrays, codes and GLB files: a torus knot.
import { Document, NodeIO } from "@gltf-transform/core";
import { readFile } from "node:fs/promises";
import { TorusKnotGeometry } from "three";
import { encode } from "unitvec";
import { packNormals } from "../unitvec/gltf-codes.js";

export const CODECS = ["oct16p", "oct24p", "oct32p", "frame32"];

/** Bytes by path, as the pages fetch them. */
export async function files() {
  const geometry = new TorusKnotGeometry(1, 0.35, 300, 48);
  // Texture coordinates are mirrored, so that all handednesses are -1, which no engine takes by default.
  const { position, normal, uv } = geometry.attributes;
  uv.array.forEach((value, i) => (uv.array[i] = value * (i % 2 ? -2 : 12)));
  geometry.computeTangents();
  const { tangent } = geometry.attributes;
  const arrays = { positions: position.array, normals: normal.array, tangents: tangent.array, uvs: uv.array };
  const mesh = { ...arrays, index: new Uint32Array(geometry.index.array) };
  for (const codec of CODECS) mesh[codec] = encode(codec === "frame32" ? frames(normal, tangent) : normal.array, codec);
  const named = Object.entries(mesh).map(([name, array]) => [name, Buffer.from(array.buffer, array.byteOffset, array.byteLength)]);
  const glbs = [null, ...CODECS].map(async (codec) => [`${codec ?? "floats"}.glb`, await glb(geometry, codec)]);
  return new Map([...named, ...(await Promise.all(glbs))].map(([name, bytes]) => [`/mesh/${name}`, bytes]));
}

/** Normal, tangent and handedness of each vertex side by side. */
export function frames(normal, tangent) {
  const floats = new Float32Array(7 * normal.count);
  for (let i = 0; i < normal.count; i++) {
    floats.set(normal.array.subarray(3 * i, 3 * i + 3), 7 * i);
    floats.set(tangent.array.subarray(4 * i, 4 * i + 4), 7 * i + 3);
  }
  return floats;
}

/** A GLB of the geometry with a normal map, packed by a codec or with floats. */
async function glb(geometry, codec) {
  const document = documentOf(geometry, { tangents: true });
  const image = await readFile(new URL("../../host/texture/data/waves.png", import.meta.url));
  const texture = document.createTexture().setImage(image).setMimeType("image/png");
  const [material] = document.getRoot().listMaterials();
  material.setNormalTexture(texture).setNormalScale(0.3).setRoughnessFactor(0.25).setMetallicFactor(0.3);
  if (codec) await document.transform(packNormals({ codec }));
  return new NodeIO().writeBinary(document);
}

/** A document of a geometry, with tangents and texture coordinates or without; an attribute `_ID` numbers vertices if asked for. */
export function documentOf(geometry, { tangents = false, ids = false }) {
  const document = new Document();
  const buffer = document.createBuffer();
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array.slice()).setBuffer(buffer);
  const { position, normal, uv, tangent } = geometry.attributes;
  const primitive = document.createPrimitive().setMaterial(document.createMaterial());
  primitive.setIndices(accessor("SCALAR", geometry.index.array));
  primitive.setAttribute("POSITION", accessor("VEC3", position.array)).setAttribute("NORMAL", accessor("VEC3", normal.array));
  if (tangents)
    primitive.setAttribute("TANGENT", accessor("VEC4", tangent.array)).setAttribute("TEXCOORD_0", accessor("VEC2", uv.array));
  if (ids)
    primitive.setAttribute(
      "_ID",
      accessor(
        "SCALAR",
        Float32Array.from({ length: position.count }, (_, i) => i),
      ),
    );
  const node = document.createNode().setMesh(document.createMesh().addPrimitive(primitive));
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  return document;
}
