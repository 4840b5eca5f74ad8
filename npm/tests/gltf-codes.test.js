// packNormals: attributes of the codes that encode() gives, in files that are valid.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Document, NodeIO } from "@gltf-transform/core";
import validator from "gltf-validator";
import { encode } from "unitvec";
import { checkCodes, joined, STORED } from "../unitvec/codes.js";
import { packNormals } from "../unitvec/gltf-codes.js";
import { CODECS, files } from "./mesh.js";

const served = await files();
const io = new NodeIO();

for (const codec of CODECS) {
  test(`${codec} in a file is what encode() gives, and the file is valid`, async () => {
    const glb = new Uint8Array(served.get(`/mesh/${codec}.glb`));
    const [primitive] = (await io.readBinary(glb)).getRoot().listMeshes()[0].listPrimitives();
    const stored = primitive.getAttribute(STORED[codec].attribute);
    const component = (i, c) => stored.getElement(i, [])[c];
    const codes = joined(component, stored.getCount(), codec);
    assert.deepEqual(Buffer.from(codes.buffer), served.get(`/mesh/${codec}`));
    assert.equal(primitive.getAttribute("NORMAL"), null);
    assert.equal(primitive.getAttribute("TANGENT") === null, codec === "frame32");
    const { issues } = await validator.validateBytes(glb);
    assert.deepEqual([issues.numErrors, issues.messages.filter(({ code }) => !code.includes("TANGENT"))], [0, []]);
  });
}

test("accessors that primitives share stay shared; primitives without what the codec needs stay as they are", async () => {
  const document = new Document();
  const normals = document
    .createAccessor()
    .setType("VEC3")
    .setArray(new Float32Array([0, 0, 1]));
  const [first, second, bare] = [normals, normals, null].map((accessor) =>
    document.createPrimitive().setAttribute("NORMAL", accessor),
  );
  for (const primitive of [first, second, bare]) document.createMesh().addPrimitive(primitive);
  await document.transform(packNormals({ codec: "frame32" }));
  assert.equal(first.getAttribute("NORMAL"), normals);
  await document.transform(packNormals({ codec: "oct24p" }));
  assert.equal(first.getAttribute("_NORMAL_OCT24P"), second.getAttribute("_NORMAL_OCT24P"));
  assert.deepEqual(bare.listSemantics(), []);
  assert.equal(document.getRoot().listAccessors().length, 1);
});

test("other codecs and arrays are refused by what to do", () => {
  const codes = encode(new Float32Array([0, 0, 1]), "oct32p");
  assert.throws(() => packNormals({ codec: "oct20p" }), { name: "RangeError", message: /oct16p, .* not "oct20p"/ });
  assert.throws(() => checkCodes(codes, "oct16p"), { name: "TypeError", message: /must be a Uint16Array, as encode\(\)/ });
  assert.throws(() => checkCodes([...codes], "oct32p"), { name: "TypeError", message: /Uint32Array/ });
});
