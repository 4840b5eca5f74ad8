// The formats of `unitvec` beside the software that they come from: codes, decoders, and tools after `unitvec snap`.
//
// usage: node outside.mjs UNITVEC MESH.obj, in a folder with the packages of package.json
//
// `cargo xtask interop` runs it. It writes codes.csv and tools.csv, and exits with 1 if a difference is not allowed.

import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { constants, zstdCompressSync } from "node:zlib";
import AttributeCompression from "@cesium/engine/Source/Core/AttributeCompression.js";
import { Document, NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import draco3d from "draco3d";
import validator from "gltf-validator";
import { MeshoptDecoder, MeshoptEncoder } from "meshoptimizer";

const [UNITVEC, MESH] = process.argv.slice(2);
const COUNT = 1_000_000;
/** Cells in a row of the grid that carries directions through tools, which reorder vertices. */
const ROW = 1000;
const versions = { draco: "1.5.7", ...JSON.parse(readFileSync("package.json")).dependencies };
const named = (name) => `${name} ${versions[name]}`;
const [encoder, decoder] = [await draco3d.createEncoderModule({}), await draco3d.createDecoderModule({})];
await Promise.all([MeshoptEncoder.ready, MeshoptDecoder.ready]);
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
io.registerDependencies({ "meshopt.decoder": MeshoptDecoder, "draco3d.decoder": decoder });
const faults = [];

// ---- Input.

let state = 20_261_125n;
/** A number in [0, 1), of the same sequence each time: the high half of a linear congruential generator. */
function random() {
  state = BigInt.asUintN(64, state * 6364136223846793005n + 1442695040888963407n);
  return Number(state >> 32n) / 2 ** 32;
}

const unit = (v) => v.map((c) => c / Math.hypot(...v));

/** A random direction: a point of the ball, moved to the sphere. */
function direction() {
  const v = [0, 0, 0].map(() => 2 * random() - 1);
  const square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  return square > 0.01 && square <= 1 ? unit(v) : direction();
}

/** A random rotation, likewise. */
function rotation() {
  const q = [0, 0, 0, 0].map(() => 2 * random() - 1);
  const length = Math.hypot(...q);
  return length > 0.1 && length <= 1 ? unit(q) : rotation();
}

/** Axes, edges, diagonals, folds, and what is near them, in all orders and signs, zeros too; scatter round the axes. */
function hard() {
  const orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
  const bases = [[1, 0, 0], [1, 1, 0], [1, 1, 1], [2, 1, 0], [2, 1, 1], [3, 2, 1], [255, 1, 0], [127, 1, 1]];
  for (const small of [1e-2, 1e-3, 1e-5, 1e-7, 1e-20]) bases.push([1, small, 0], [1, small, small], [1, 1, small]);
  const signed = (v, signs) => v.map((c, i) => (signs >> i & 1 ? -c : c));
  const list = bases.flatMap((base) => orders.flatMap((order) =>
    [0, 1, 2, 3, 4, 5, 6, 7].map((signs) => unit(signed(order.map((from) => base[from]), signs)))));
  for (let i = 0; i < 6000; i++) {
    const v = direction().map((c) => 0.02 * c);
    v[i % 3] += i % 2 ? -1 : 1;
    list.push(unit(v));
  }
  return list;
}

/** The input of all encoders: a multiple of three, since meshes are made of it. */
function inputs() {
  const list = hard();
  while (list.length < COUNT || list.length % 3) list.push(direction());
  return Float32Array.from(list.flat());
}

/** All pairs from `least` to `most`, with lanes after each; random ones where there are more than 2^16. */
function pairs(Type, least, most, ...lanes) {
  const [span, each] = [most - least + 1, 2 + lanes.length];
  const codes = new Type(each * (span > 256 ? COUNT : span * span));
  for (let i = 0; i < codes.length / each; i++) {
    const [x, y] = span > 256 ? [random() * span, random() * span] : [i % span, i / span];
    codes.set([Math.floor(x) + least, Math.floor(y) + least, ...lanes], each * i);
  }
  return codes;
}

// ---- Comparisons.

const bytesOf = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);
/** A buffer's numbers, copied to where they are aligned. */
const as = (Type, bytes) => new Type(Uint8Array.from(bytes).buffer);
/** Vectors with a zero after each. */
const widened = (vectors) =>
  Float32Array.from({ length: vectors.length / 3 * 4 }, (_, i) => (i % 4 < 3 ? vectors[(i >> 2) * 3 + i % 4] : 0));

const call = (program, words) => execFileSync(program, words, { stdio: ["ignore", "ignore", "inherit"] });
const unitvec = (command, ...words) => call(UNITVEC, [command, "--quiet", ...words]);
function encoded(format, vectors, ...options) {
  writeFileSync("in.f32", bytesOf(vectors));
  unitvec("encode", "--format", format, ...options, "in.f32", "out.codes");
  return readFileSync("out.codes");
}
function decoded(format, codes) {
  writeFileSync("in.codes", bytesOf(codes));
  unitvec("decode", "--format", format, "in.codes", "out.f32");
  return as(Float32Array, readFileSync("out.f32"));
}

const rows = ["format,what,original,cases,differing,greatest difference,allowed"];

/** Compares the results of all inputs with the original's, in a row. `each`: the numbers of an input, of a result. */
function compare(format, what, original, [input, found, expected], each, allowed) {
  let [differing, greatest, beyond] = [0, 0, 0];
  const group = (numbers, size, i) => [...numbers.slice(size * i, size * i + size)];
  const cases = input.length / each[0];
  if (found.length !== cases * each[1]) faults.push(`${format}, ${what}: ${found.length} numbers for ${cases} inputs`);
  for (let i = 0; i < cases; i++) {
    let difference = 0;
    for (let k = i * each[1]; k < (i + 1) * each[1]; k++) {
      const apart = Math.abs(found[k] - expected[k]);
      difference = Math.max(difference, Number.isNaN(apart) ? Infinity : apart);
    }
    [differing, greatest] = [differing + (difference > 0), Math.max(greatest, difference)];
    if (difference > allowed && ++beyond <= 5) {
      const [from, here, there] = [group(input, each[0], i), group(found, each[1], i), group(expected, each[1], i)];
      console.log(`${format}, ${what}: ${from.join(" ")} gives ${here.join(" ")}; by ${original} ${there.join(" ")}`);
    }
  }
  // Roundings that may differ by 1 seldom do: another encoder differs in more than a hundredth.
  if (allowed === 1 && differing > cases / 100) faults.push(`${format}, ${what}: ${differing} results differ by 1`);
  if (beyond) faults.push(`${format}, ${what}: ${beyond} results are not those of ${original}`);
  rows.push([format, what, original, cases, differing, ...[greatest, allowed].map((n) => +n.toPrecision(3))].join());
  console.log(rows.at(-1));
}

/** The greatest differences of decoders: here the steps are in f32, as Draco's are; Cesium's are in f64. */
const [OF_F64, OF_F32] = [2 ** -22, 2 ** -21];

function cesium(format, bits, vectors) {
  const [Type, range, original] = [bits === 8 ? Uint8Array : Uint16Array, 2 ** bits - 1, named("@cesium/engine")];
  const [codes, pair, v] = [new Type(vectors.length / 3 * 2), {}, {}];
  for (let i = 0; i < codes.length / 2; i++) {
    [v.x, v.y, v.z] = vectors.slice(3 * i, 3 * i + 3);
    AttributeCompression.octEncodeInRange(v, range, pair);
    codes.set([pair.x, pair.y], 2 * i);
  }
  const found = as(Type, encoded(format, vectors, "--plain"));
  compare(format, "encode", original, [vectors, found, codes], [3, 2], 0);
  const all = pairs(Type, 0, range);
  const expected = new Float32Array(all.length / 2 * 3);
  for (let i = 0; i < all.length / 2; i++) {
    AttributeCompression.octDecodeInRange(all[2 * i], all[2 * i + 1], range, v);
    expected.set([v.x, v.y, v.z], 3 * i);
  }
  compare(format, "decode", original, [all, decoded(format, all), expected], [2, 3], OF_F64);
}

/** An attribute of a Draco stream: the floats, or the integers that they are made from. */
function attribute(stream, kind, isRaw) {
  const [source, mesh] = [new decoder.Decoder(), new decoder.Mesh()];
  if (isRaw) source.SkipAttributeTransform(decoder[kind]);
  const status = source.DecodeArrayToMesh(stream, stream.length, mesh);
  if (!status.ok()) throw new Error(status.error_msg());
  const [name, Type] = isRaw ? ["Int32", Int32Array] : ["Float", Float32Array];
  const array = new decoder[`Draco${isRaw ? name : "Float32"}Array`]();
  const id = source.GetAttributeId(mesh, decoder[kind]);
  source[`GetAttribute${name}ForAllPoints`](mesh, source.GetAttribute(mesh, id), array);
  const numbers = Type.from({ length: array.size() }, (_, i) => array.GetValue(i));
  [array, mesh, source].forEach((object) => decoder.destroy(object));
  return numbers;
}

/** The Draco stream of a mesh with these normals, in their order. */
function stream(bits, vectors) {
  const [builder, mesh, target] = [new encoder.MeshBuilder(), new encoder.Mesh(), new encoder.Encoder()];
  const [count, array] = [vectors.length / 3, new encoder.DracoInt8Array()];
  // Draco unites vertices that are alike: no two positions are.
  const positions = Float32Array.from(vectors, (_, i) => i);
  builder.AddFacesToMesh(mesh, count / 3, Uint32Array.from({ length: count }, (_, i) => i));
  builder.AddFloatAttributeToMesh(mesh, encoder.POSITION, count, 3, positions);
  builder.AddFloatAttributeToMesh(mesh, encoder.NORMAL, count, 3, vectors);
  target.SetEncodingMethod(encoder.MESH_SEQUENTIAL_ENCODING);
  target.SetAttributeQuantization(encoder.NORMAL, bits);
  const length = target.EncodeMeshToDracoBuffer(mesh, array);
  return Int8Array.from({ length }, (_, i) => array.GetValue(i));
}

/** Draco's decoder reads streams only: it gets the codes of the input and, for 8 bits, the directions of all codes. */
function draco(bits, vectors) {
  const [format, original, size] = [`draco:${bits}`, named("draco3d"), Math.ceil(bits / 4)];
  const packed = (numbers) => Uint8Array.from({ length: numbers.length / 2 * size }, (_, i) => {
    const at = 2 * Math.floor(i / size);
    return (numbers[at] + numbers[at + 1] * 2 ** bits) / 256 ** (i % size);
  });
  const check = (input) => {
    const data = stream(bits, input);
    const [codes, floats] = [packed(attribute(data, "NORMAL", true)), attribute(data, "NORMAL", false)];
    compare(format, "encode", original, [input, encoded(format, input, "--plain"), codes], [3, size], 0);
    compare(format, "decode", original, [codes, decoded(format, codes), floats], [size, 3], OF_F32);
  };
  check(vectors);
  // 255 x 255 codes, a multiple of three.
  if (bits === 8) check(decoded(format, packed(pairs(Int32Array, 0, 254))));
}

/** Codes as the filter's decoder leaves them. It takes compressed ones. */
function filtered(codes, stride, filter) {
  const count = codes.byteLength / stride;
  const vertices = MeshoptEncoder.encodeVertexBuffer(as(Uint8Array, bytesOf(codes)), count, stride);
  const result = new Uint8Array(codes.byteLength);
  MeshoptDecoder.decodeGltfBuffer(result, count, stride, vertices, "ATTRIBUTES", filter);
  return as(codes.constructor, result);
}

/** The filter's decoder rounds otherwise by 1, with SIMD or without. */
function meshopt(name, bits, vectors) {
  const [format, original, largest] = [`${name}:${bits}`, named("meshoptimizer"), 2 ** (bits - 1) - 1];
  const [Type, stride, scale] = name === "meshopt-oct" ? [Int8Array, 4, 127] : [Int16Array, 8, 32767];
  const input = widened(vectors);
  const codes = as(Type, MeshoptEncoder.encodeFilterOct(input, input.length / 4, stride, bits));
  const found = as(Type, encoded(format, vectors, "--plain"));
  compare(format, "encode", original, [vectors, found, codes], [3, 4], 0);
  const all = pairs(Type, -largest, largest, largest, 0);
  const expected = filtered(all, stride, "OCTAHEDRAL").filter((_, i) => i % 4 < 3);
  const numbers = decoded(format, all).map((float) => Math.round(float * scale));
  compare(format, "decode", original, [all, numbers, expected], [4, 3], 1);
}

/** The same filter for rotations, and the codes that it writes. */
function meshoptQuat(bits, rotations) {
  const [format, original] = [`meshopt-quat:${bits}`, named("meshoptimizer")];
  const codes = as(Int16Array, MeshoptEncoder.encodeFilterQuat(rotations, rotations.length / 4, 8, bits));
  const found = as(Int16Array, encoded(format, rotations, "--plain"));
  compare(format, "encode", original, [rotations, found, codes], [4, 4], 0);
  const numbers = decoded(format, codes).map((float) => Math.round(float * 32767));
  compare(format, "decode", original, [codes, numbers, filtered(codes, 8, "QUATERNION")], [4, 4], 1);
}

/** glTF's components, by a tool that quantises. One that does not normalise first may round otherwise by 1. */
async function snorm(bits, vectors, tool, command, allowed) {
  const [format, Type, count] = [`gltf-snorm${bits}`, bits === 8 ? Int8Array : Int16Array, vectors.length / 3];
  const places = Array.from({ length: count }, (_, i) => [i % ROW, Math.floor(i / ROW), +(i % 3 === 1)]);
  const indices = Uint32Array.from(places, (_, i) => i);
  await writeMesh("in.glb", { positions: Float32Array.from(places.flat()), normals: vectors, indices });
  run(`${command} ${bits}`, "in.glb", "out.glb");
  const { positions, normals, stored } = await meshOf("out.glb");
  const [codes, floats] = [new Type(4 * count), new Float32Array(3 * count)];
  for (let i = 0; i < 3 * count; i += 3) {
    const at = Math.round(positions[i]) + ROW * Math.round(positions[i + 1]);
    codes.set(stored.slice(i, i + 3), 4 * at);
    floats.set(normals.slice(i, i + 3), 3 * at);
  }
  const found = as(Type, encoded(format, vectors, "--plain"));
  compare(format, "encode", named(tool), [vectors, found, codes], [3, 4], allowed);
  compare(format, "decode", named(tool), [codes, decoded(format, codes), floats], [4, 3], 0);
}

// ---- Meshes and tools.

/** Writes a mesh as GLB. */
async function writeMesh(file, { positions, normals, indices }) {
  const target = new Document();
  const buffer = target.createBuffer();
  const accessor = (array, type) => target.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const primitive = target.createPrimitive().setIndices(accessor(indices, "SCALAR"));
  primitive.setAttribute("POSITION", accessor(positions, "VEC3")).setAttribute("NORMAL", accessor(normals, "VEC3"));
  target.createScene().addChild(target.createNode().setMesh(target.createMesh().addPrimitive(primitive)));
  await io.write(file, target);
}

/** Positions in the scene, normals as a viewer gets them, and the numbers in the file that they come from. */
async function meshOf(file) {
  const [positions, normals, stored] = [[], [], []];
  if (file.endsWith(".drc")) {
    const data = new Int8Array(readFileSync(file));
    return { positions: attribute(data, "POSITION", false), normals: attribute(data, "NORMAL", false) };
  }
  for (const node of (await io.read(file)).getRoot().listNodes()) {
    const m = node.getWorldMatrix();
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const [position, normal] = ["POSITION", "NORMAL"].map((name) => primitive.getAttribute(name));
      for (let i = 0; i < position.getCount(); i++) {
        const [x, y, z] = position.getElement(i, []);
        for (let k = 0; k < 3; k++) positions.push(m[k] * x + m[k + 4] * y + m[k + 8] * z + m[k + 12]);
        normals.push(...normal.getElement(i, []));
      }
      for (const number of normal.getArray()) stored.push(number);
    }
  }
  return { positions, normals, stored };
}

/** Writes a mesh as PLY, which Draco's encoder reads. */
function writePly(file, { positions, normals }, indices) {
  const properties = ["x", "y", "z", "nx", "ny", "nz"].map((name) => `property float ${name}\n`).join("");
  const vertices = `element vertex ${positions.length / 3}\n${properties}`;
  const faces = `element face ${indices.length / 3}\nproperty list uchar int vertex_indices\n`;
  const lines = [];
  const group = (numbers, i) => numbers.slice(i, i + 3).join(" ");
  for (let i = 0; i < positions.length; i += 3) lines.push(`${group(positions, i)} ${group(normals, i)}`);
  for (let i = 0; i < indices.length; i += 3) lines.push(`3 ${group(indices, i)}`);
  writeFileSync(file, `ply\nformat ascii 1.0\n${vertices}${faces}end_header\n${lines.join("\n")}\n`);
}

/** The bytes that zstd leaves of a file. */
const zstdBytes = (bytes) => zstdCompressSync(bytes, { params: { [constants.ZSTD_c_compressionLevel]: 19 } }).length;

/** Runs the command line of a tool. */
function run(command, input, output) {
  const [program, ...words] = command.split(" ");
  if (program === "gltf-transform") call(program, [words[0], input, output, ...words.slice(1)]);
  else call(program, [...words, "-i", input, "-o", output]);
}

/** The angles between vectors, in degrees: the mean and the greatest. */
function angles(found, expected) {
  let [sum, greatest] = [0, 0];
  for (let i = 0; i < found.length; i += 3) {
    const [a, b] = [found, expected].map((vectors) => unit([...vectors.slice(i, i + 3)]));
    const angle = 2 * Math.asin(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / 2) * 180 / Math.PI;
    [sum, greatest] = [sum + angle, Math.max(greatest, angle)];
  }
  return [3 * sum / found.length, greatest];
}

/** The mesh's normal for each of these positions, which tools reorder and round: of the nearest vertex. */
function normalsAt(found, { positions, normals }) {
  const distance = (i, k) => [0, 1, 2].reduce((sum, c) => sum + (found[i + c] - positions[k + c]) ** 2, 0);
  const at = (i) => {
    let [least, nearest] = [Infinity, 0];
    for (let k = 0; k < positions.length; k += 3) {
      const apart = distance(i, k);
      if (apart < least) [least, nearest] = [apart, k];
    }
    return [...normals.slice(nearest, nearest + 3)];
  };
  return Array.from({ length: found.length / 3 }, (_, i) => at(3 * i)).flat();
}

/** Errors that glTF's validator finds in a file, and in the same without compression, which it does not look into. */
async function verdict(file) {
  const target = await io.read(file);
  const extensions = target.getRoot().listExtensionsUsed();
  extensions.filter(({ extensionName }) => /compression/.test(extensionName)).forEach((it) => it.dispose());
  const codes = [];
  for (const bytes of [new Uint8Array(readFileSync(file)), await io.writeBinary(target)]) {
    const { issues } = await validator.validateBytes(bytes, { maxIssues: 0, writeTimestamp: false });
    codes.push(...issues.messages.filter(({ severity }) => severity === 0).map(({ code }) => code));
  }
  return codes.length ? `${codes.length} errors: ${[...new Set(codes)].join(" ")}` : "valid";
}

/** Command lines, and the format of the normals that each writes. */
const COMMANDS = [
  ["gltfpack", "gltfpack -vn 8", "gltf-snorm8"],
  ["gltfpack", "gltfpack -vn 8 -cc", "meshopt-oct:8"],
  ["gltfpack", "gltfpack -vn 12 -cc", "meshopt-oct16:12"],
  ["@gltf-transform/cli", "gltf-transform quantize --quantize-normal 8", "gltf-snorm8"],
  ["@gltf-transform/cli", "gltf-transform meshopt", "meshopt-oct:8"],
  ["@gltf-transform/cli", "gltf-transform draco", "draco:10"],
  ["@gltf-transform/cli", "gltf-transform draco --quantize-normal 8", "draco:8"],
  ["draco", "draco_encoder -qn 8", "draco:8"],
  ["draco", "draco_encoder -qn 10", "draco:10"],
];

const ERRORS = ["plain", "snapped", "nearest"].map((of) => `mean ${of},max ${of}`);
const SIZES = ["plain", "snapped"].map((of) => `bytes ${of},zstd ${of},validator ${of}`);
const results = [`tool,command,format,vertices,${ERRORS},${SIZES}`];

/** Runs a tool on the mesh, and on the mesh with snapped normals. */
async function tool(name, command, format, mesh) {
  unitvec("snap", "--for", format, "mesh.glb", "snapped.glb");
  const [errors, sizes, counts] = [[], [], []];
  for (const glb of ["mesh.glb", "snapped.glb"]) {
    const [input, output] = name === "draco" ? ["in.ply", "out.drc"] : [glb, "out.glb"];
    if (name === "draco") writePly(input, await meshOf(glb), mesh.indices);
    run(command, input, output);
    const [{ positions, normals }, bytes] = [await meshOf(output), readFileSync(output)];
    errors.push(angles(normals, normalsAt(positions, mesh)));
    sizes.push(bytes.length, zstdBytes(bytes), name === "draco" ? "" : await verdict(output));
    counts.push(normals.length / 3);
  }
  errors.push(angles(decoded(format, encoded(format, mesh.normals)), mesh.normals));
  const [plain, snapped, nearest] = errors.map(([mean]) => mean);
  if (counts[0] !== counts[1]) faults.push(`${command}: ${counts.join(" and ")} vertices`);
  if (snapped > plain) faults.push(`${command}: snapped ${snapped} degrees, ${plain} before`);
  // Components need not be the nearest: tools normalise first, which undoes a length.
  const isNearest = snapped <= nearest + 1e-4 || format.startsWith("gltf");
  if (!isNearest) faults.push(`${command}: snapped ${snapped} degrees, not ${nearest}`);
  if (sizes.some((size) => /error/.test(size))) faults.push(`${command}: the validator finds ${sizes.join()}`);
  const [title, degrees] = [named(name), errors.flat().map((angle) => angle.toFixed(4))];
  results.push([title, command, format, counts[0], ...degrees, ...sizes].join());
  console.log(results.at(-1));
}

// ---- Gaussian splats.

const PLACES = ["x", "y", "z", "scale_0", "scale_1", "scale_2", "f_dc_0", "f_dc_1", "f_dc_2", "opacity"];
const ROTATION = ["rot_1", "rot_2", "rot_3", "rot_0"];

/** Writes splats of these rotations, on a line: tools that sort splats leave their order. */
function writeSplats(file, rotations) {
  const [count, size] = [rotations.length / 4, PLACES.length + ROTATION.length];
  const lines = ["ply", "format binary_little_endian 1.0", `element vertex ${count}`];
  lines.push(...[...PLACES, ...ROTATION].map((name) => `property float ${name}`), "end_header", "");
  const numbers = new Float32Array(count * size);
  for (let i = 0; i < count; i++) {
    numbers.set([i / 100, 0, 0, -4, -4, -4, 0, 0, 0, 0, ...rotations.slice(4 * i, 4 * i + 4)], i * size);
  }
  writeFileSync(file, Buffer.concat([Buffer.from(lines.join("\n")), bytesOf(numbers)]));
}

/** The rotations of a file of splats. */
function rotationsOf(file) {
  call("splat-transform", ["--overwrite", file, "back.ply"]);
  const [bytes, end] = [readFileSync("back.ply"), "end_header\n"];
  const start = bytes.indexOf(end) + end.length;
  const names = [...bytes.toString("latin1", 0, start).matchAll(/property float (\S+)/g)].map(([, name]) => name);
  const all = as(Float32Array, bytes.subarray(start));
  const at = (i) => names.length * (i >> 2) + names.indexOf(ROTATION[i % 4]);
  return Float32Array.from({ length: all.length / names.length * 4 }, (_, i) => all[at(i)]);
}

/** The same rotations, with the signs of others. */
function aligned(rotations, others) {
  const along = (i) => [0, 1, 2, 3].reduce((sum, k) => sum + rotations[i + k] * others[i + k], 0);
  return rotations.map((c, i) => (along(i - i % 4) < 0 ? -c : c));
}

/** The angles of the rotations between rotations, in degrees: the mean and the greatest. */
function turns(found, expected) {
  let [sum, greatest] = [0, 0];
  for (let i = 0; i < found.length; i += 4) {
    const [a, b] = [found, expected].map((rotations) => unit([...rotations.slice(i, i + 4)]));
    const off = (sign) => Math.hypot(...a.map((c, k) => c - sign * b[k]));
    const angle = 4 * Math.asin(Math.min(off(1), off(-1)) / 2) * 180 / Math.PI;
    [sum, greatest] = [sum + angle, Math.max(greatest, angle)];
  }
  return [4 * sum / found.length, greatest];
}

/** Writes splats by PlayCanvas' tool, which rounds or truncates rotations, and the same splats with snapped rotations. */
function splats(format, output, rotations) {
  const [name, errors, sizes] = ["@playcanvas/splat-transform", [], []];
  writeSplats("in.ply", rotations);
  unitvec("snap", "--for", format, "in.ply", "snapped.ply");
  for (const input of ["in.ply", "snapped.ply"]) {
    call("splat-transform", ["--overwrite", input, output]);
    const [found, bytes] = [rotationsOf(output), readFileSync(output)];
    if (input === "in.ply") {
      const here = decoded(format, encoded(format, rotations, "--plain"));
      compare(format, "encode and decode", named(name), [rotations, here, aligned(found, here)], [4, 4], OF_F32);
    }
    errors.push(turns(found, rotations));
    sizes.push(bytes.length, zstdBytes(bytes), "");
  }
  errors.push(turns(decoded(format, encoded(format, rotations)), rotations));
  const [[plain], [snapped]] = errors;
  if (snapped > plain) faults.push(`${format}: snapped ${snapped} degrees, ${plain} before`);
  const degrees = errors.flat().map((angle) => angle.toFixed(4));
  results.push([named(name), `splat-transform ${output}`, format, rotations.length / 4, ...degrees, ...sizes].join());
  console.log(results.at(-1));
}

/** A mesh of the repository, also written as GLB, with the normals that `unitvec` computes. */
async function readMesh() {
  const lines = readFileSync(MESH, "utf8").split("\n").map((line) => line.split(" "));
  const numbers = (kind) => lines.filter(([word]) => word === kind).flatMap((words) => words.slice(1).map(Number));
  unitvec("normals", MESH, "normals.f32");
  const [positions, normals] = [Float32Array.from(numbers("v")), as(Float32Array, readFileSync("normals.f32"))];
  const mesh = { positions, normals, indices: Uint32Array.from(numbers("f"), (number) => number - 1) };
  await writeMesh("mesh.glb", mesh);
  return mesh;
}

const vectors = inputs();
cesium("tiles3d-oct16", 8, vectors);
cesium("quantized-mesh", 8, vectors);
cesium("tiles3d-oct32", 16, vectors);
for (const bits of [8, 10, 12]) draco(bits, vectors);
for (const bits of [6, 8]) meshopt("meshopt-oct", bits, vectors);
for (const bits of [8, 10, 12, 16]) meshopt("meshopt-oct16", bits, vectors);
for (const bits of [8, 16]) {
  await snorm(bits, vectors, "gltfpack", "gltfpack -vn", 0);
  await snorm(bits, vectors, "@gltf-transform/cli", "gltf-transform quantize --quantize-normal", 1);
}
const rotations = Array.from({ length: COUNT }, rotation);
for (const bits of [8, 12, 16]) meshoptQuat(bits, Float32Array.from(rotations.flat()));
const ofSplats = Float32Array.from(rotations.slice(0, 100_000).flat());
splats("sog", "out.sog", ofSplats);
splats("spz", "out.spz", ofSplats);
splats("playcanvas-ply", "out.compressed.ply", ofSplats);
const mesh = await readMesh();
for (const [name, command, format] of COMMANDS) await tool(name, command, format, mesh);

writeFileSync("codes.csv", `${rows.join("\n")}\n`);
writeFileSync("tools.csv", `${results.join("\n")}\n`);
faults.forEach((fault) => console.error(`FAIL: ${fault}`));
process.exit(faults.length ? 1 : 0);
