// What normals cost in GLB files: bytes, time to load, memory on the GPU, and error, beside other compression.
//
//   node benchmarks/sizes.js RECORD.csv
import { NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { draco, meshopt, quantize } from "@gltf-transform/functions";
import draco3d from "draco3d";
import { MeshoptDecoder, MeshoptEncoder } from "meshoptimizer";
import { writeFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import { decode } from "unitvec";
import { inBrowser } from "../tests/browser.js";
import { documentOf } from "../tests/mesh.js";
import { joined, STORED } from "../unitvec/codes.js";
import { packNormals } from "../unitvec/gltf-codes.js";
import { snapNormals } from "../unitvec/gltf-transform.js";
import { bunny, million } from "./meshes.js";

const TIMES = 5;
await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
const io = new NodeIO()
  .setVertexLayout("separate")
  .registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({
    "draco3d.decoder": await draco3d.createDecoderModule(),
    "draco3d.encoder": await draco3d.createEncoderModule(),
    "meshopt.decoder": MeshoptDecoder,
    "meshopt.encoder": MeshoptEncoder,
  });

// glTF-Transform's functions that write each file. Draco needs 24 bits for the numbers of vertices.
const normals = (bits) => quantize({ pattern: /^NORMAL$/, quantizeNormal: bits });
const positions = quantize({ pattern: /^POSITION$/ });
const packed = (codec) => packNormals({ codec });
const byMeshopt = meshopt({ encoder: MeshoptEncoder });
const snapped = (codec) => snapNormals({ codec });
const byDraco = draco({ quantizeGeneric: 24 });
const FILES = [
  { name: "floats" },
  { name: "floats snapped to `oct16p`", transforms: [snapped("oct16p")] },
  { name: "`oct16p`", codec: "oct16p", transforms: [packed("oct16p")] },
  { name: "`oct32p`", codec: "oct32p", transforms: [packed("oct32p")] },
  { name: "int8", transforms: [normals(8)] },
  { name: "int16", transforms: [normals(16)] },
  { name: "floats and tangents", tangents: true },
  { name: "`frame32`", tangents: true, codec: "frame32", transforms: [packed("frame32")] },
  { name: "`oct16p`", small: true, codec: "oct16p", transforms: [packed("oct16p"), positions] },
  { name: "int8", small: true, transforms: [normals(8), positions] },
  { name: "meshopt in 8 bits", small: true, transforms: [byMeshopt] },
  { name: "snapped then meshopt in 8 bits", small: true, transforms: [snapped("meshopt-oct:8"), byMeshopt] },
  { name: "meshopt of `oct16p`", small: true, codec: "oct16p", transforms: [packed("oct16p"), byMeshopt] },
  { name: "Draco in 10 bits", small: true, transforms: [byDraco] },
  { name: "snapped then Draco in 10 bits", small: true, transforms: [snapped("draco:10"), byDraco] },
];

/** The bytes of a file of `FILES`. */
async function written(geometry, { tangents, transforms = [] }, ids) {
  const document = documentOf(geometry, { tangents, ids });
  await document.transform(...transforms);
  return io.writeBinary(document);
}

/** Mean and largest angle in degrees between the normals of a file, whose vertices are numbered, and the geometry's. */
async function errors(geometry, bytes, codec) {
  const [primitive] = (await io.readBinary(bytes)).getRoot().listMeshes()[0].listPrimitives();
  const ids = primitive.getAttribute("_ID");
  const vectors = codec ? decoded(primitive, codec) : primitive.getAttribute("NORMAL");
  const original = geometry.attributes.normal.array;
  let [sum, largest] = [0, 0];
  for (let i = 0; i < ids.getCount(); i++) {
    const at = 3 * Math.round(ids.getScalar(i));
    const degrees = (angle(original.subarray(at, at + 3), vectors.getElement(i, [])) * 180) / Math.PI;
    sum += degrees;
    largest = Math.max(largest, degrees);
  }
  return [sum / ids.getCount(), largest].map((degrees) => Number(degrees.toPrecision(6)));
}

function decoded(primitive, codec) {
  const accessor = primitive.getAttribute(STORED[codec].attribute);
  const size = accessor.getElementSize();
  const floats = decode(
    joined((i, c) => accessor.getArray()[size * i + c], accessor.getCount(), codec),
    codec,
  );
  const stride = codec === "frame32" ? 7 : 3;
  return { getElement: (i) => floats.subarray(stride * i, stride * i + 3) };
}

/** Angle between two vectors of any length, exact for small ones too. */
function angle([ax, ay, az], [bx, by, bz]) {
  const cross = Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
  return Math.atan2(cross, ax * bx + ay * by + az * bz);
}

const rows = [];
const served = new Map();
const meshes = { bunny: await bunny(), million: million() };
for (const [mesh, geometry] of Object.entries(meshes)) {
  geometry.computeTangents();
  for (const file of FILES) {
    const bytes = await written(geometry, file, false);
    const path = `/${mesh}/${served.size}.glb`;
    served.set(path, bytes);
    const [mean, largest] = await errors(geometry, await written(geometry, file, true), file.codec);
    rows.push([path, mesh, file.name, file.small ? "14 bits" : "floats", bytes.length, gzipSync(bytes).length, mean, largest]);
  }
}
const call = `page.measure(${JSON.stringify([...served.keys()])}, ${TIMES})`;
const { result, messages, chromium } = await inBrowser({ entry: "benchmarks/page.js", files: served, call });
if (messages.length) throw new Error(messages.join("\n"));
const TITLES = "mesh,file,positions,bytes,gzip,mean_deg,max_deg,gpu_bytes,three_ms,babylon_ms,chromium";
const lines = rows.map(([path, mesh, ...cells]) => {
  const [three, babylon] = ["three", "babylon"].map((of) => result.find(({ engine, name }) => engine === of && name === path));
  const gpuBytes = Math.round(three.bytes / meshes[mesh].attributes.position.count);
  return [mesh, ...cells, gpuBytes, three.ms.toFixed(1), babylon.ms.toFixed(1), chromium.replace("Chrome/", "")].join();
});
await writeFile(process.argv[2], `${[TITLES, ...lines].join("\n")}\n`);
