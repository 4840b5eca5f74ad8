/**
 * The codes and the decoded floats are those of the released vectors and of the program `unitvec`, bit for bit.
 *
 * They need a checkout, and the program's path in UNITVEC_PROGRAM; `cargo xtask npm` gives both. UNITVEC_WASM is another module to
 * test.
 */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import * as unitvec from "unitvec/core";
import { inputs } from "./common.js";

const { UNITVEC_PROGRAM: PROGRAM, UNITVEC_COUNT: COUNT = "4096", UNITVEC_WASM: WASM } = process.env;
const VECTORS = new URL("../../vectors/", import.meta.url);

await unitvec.load(readFileSync(WASM ?? new URL("../dist/unitvec.wasm", import.meta.url)));

const bytes = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);
const floats = (cases) =>
  new Float32Array(new Uint32Array(cases.flatMap((words) => words.split(" ").map((word) => parseInt(word, 16)))).buffer);

test("released vectors", () => {
  const released = unitvec.codecs().filter((codec) => existsSync(new URL(`${codec.id}.json`, VECTORS)));
  assert.ok(released.length > 100);
  for (const codec of released) {
    const { cases } = JSON.parse(readFileSync(new URL(`${codec.id}.json`, VECTORS), "utf8"));
    const codes = (rows) =>
      codec.ArrayType.from(rows, (row) => (codec.ArrayType === BigUint64Array ? BigInt : Number)(`0x${row[1]}`));
    // A third column is the decoded code; cases without a first one have a code that no encoder writes.
    const encoded = cases.filter((row) => row[0]);
    assert.deepEqual(unitvec.encode(floats(encoded.map((row) => row[0])), codec), codes(encoded), codec.id);
    const decoded = unitvec.decode(codes(cases), codec);
    assert.deepEqual(bytes(decoded), bytes(floats(cases.map((row) => row[2]))), codec.id);
  }
});

test("the program agrees", { skip: !PROGRAM && "UNITVEC_PROGRAM is not set" }, () => {
  const cwd = mkdtempSync(join(tmpdir(), "unitvec-"));
  for (const codec of [...unitvec.codecs(), ...unitvec.formats()]) {
    const values = inputs(codec, Number(COUNT));
    writeFileSync(join(cwd, "in.bin"), values);
    const [name, plain] = codec.id.split(" ");
    const run = (...words) => execFileSync(PROGRAM, words, { cwd, stdio: "pipe" });
    run("encode", "--codec", name, ...(plain ? ["--plain"] : []), "in.bin", "codes.dat");
    run("decode", "--codec", name, "codes.dat", "out.bin");
    const codes = unitvec.encode(values, codec);
    assert.ok(packed(codes, codec.bytes).equals(readFileSync(join(cwd, "codes.dat"))), codec.id);
    assert.ok(bytes(unitvec.decode(codes, codec)).equals(readFileSync(join(cwd, "out.bin"))), codec.id);
  }
  rmSync(cwd, { recursive: true });
});

/** Codes as the program writes them: the low bytes alone. */
function packed(codes, size) {
  const [all, width] = [bytes(codes), codes.BYTES_PER_ELEMENT];
  const some = Buffer.alloc(codes.length * size);
  for (let i = 0; i < some.length; i++) some[i] = all[Math.floor(i / size) * width + (i % size)];
  return some;
}
