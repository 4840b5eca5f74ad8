/** What arrays the functions take and give, and what they refuse. */

import assert from "node:assert/strict";
import test from "node:test";
import * as unitvec from "unitvec";
import { generator } from "./common.js";

const { codec, codecs, decode, encode, error, formats, snap } = unitvec;
const ALL = [...codecs(), ...formats()];
const random = generator(1);

/** Elements of unit length, since formats of components keep lengths. */
function elements({ floats, element }, count) {
  const parts = element === "frames" ? [3, 3, 1] : [floats];
  const part = (size) => {
    const some = Array.from({ length: size }, () => random() - 0.5);
    return some.map((component) => component / Math.hypot(...some));
  };
  return new Float32Array(Array.from({ length: count }, () => parts.flatMap(part)).flat());
}

const NORMALS = elements(codec("oct32p"), 64);

test("lengths and types of every codec, and its bounds", () => {
  for (const it of ALL) {
    const some = elements(it, 30);
    const codes = encode(some, it.id);
    assert.ok(codes instanceof it.ArrayType && codes.length === 30 && codes.BYTES_PER_ELEMENT >= it.bytes);
    assert.ok(codes.every((code) => BigInt(code) >> BigInt(it.bits) === 0n), it.id);
    assert.equal(decode(codes, it).length, some.length);
    assert.equal(decode(encode(new Float32Array(), it), it).length, 0);
    const errors = error(some, it);
    assert.equal(errors.length, 30 * it.maxErrorsDeg.length);
    const isBounded = it.domain === "sphere" && it.element === "vectors" && !it.id.endsWith("plain");
    if (isBounded) assert.ok(Math.max(...errors) <= it.maxErrorsDeg[0], it.id);
  }
});

test("interleaved, doubles, portions and out give the same codes", () => {
  const many = elements(codec("oct24p"), 40_000);
  const codes = encode(many, "oct24p");
  const wide = new Float32Array(40_000 * 8);
  for (let i = 0; i < 40_000; i++) wide.set(many.subarray(3 * i, 3 * i + 3), 8 * i + 5);
  assert.deepEqual(encode(wide, "oct24p", { stride: 8, offset: 5 }), codes);
  assert.deepEqual(encode(Float64Array.from(many), "oct24p"), codes);
  const far = new Float64Array([1e300, 0, -1e300, 0, 1e-300, 0]);
  assert.deepEqual(encode(far, "oct32p"), encode(new Float32Array([1, 0, -1, 0, 1, 0]), "oct32p"));
  const out = new Uint32Array(40_000);
  assert.equal(encode(many, "oct24p", { out }), out);
  assert.deepEqual(out, codes);
  const shared = many.slice();
  // The codes over the first floats that they are made of.
  assert.deepEqual(encode(shared, "oct24p", { out: new Uint32Array(shared.buffer, 0, 40_000) }), codes);
  const decoded = new Float32Array(many.length);
  assert.equal(decode(codes, "oct24p", { out: decoded }), decoded);
  const moved = snap(wide.slice(), "oct24p", { stride: 8, offset: 5 });
  for (let i = 0; i < 40_000; i++) wide.set(decoded.subarray(3 * i, 3 * i + 3), 8 * i + 5);
  assert.deepEqual(moved, wide);
});

test("snapped rotations: SOG's own encoder is off by half as much", () => {
  const rotations = Float32Array.from({ length: 4000 }, () => random() - 0.5);
  const mean = (errors) => errors.reduce((sum, error) => sum + error) / errors.length;
  const snapped = snap(rotations.slice(), "sog");
  const written = decode(encode(snapped, "sog plain"), "sog plain");
  const off = Float64Array.from({ length: 1000 }, (_, i) => {
    const [a, b] = [rotations, written].map((all) => all.subarray(4 * i, 4 * i + 4));
    return (360 / Math.PI) * Math.acos(Math.min(Math.abs(a.reduce((dot, x, k) => dot + x * b[k], 0)) / (Math.hypot(...a) * Math.hypot(...b)), 1));
  });
  const before = mean(error(rotations, "sog plain"));
  assert.ok(mean(off) < 0.55 * before, `${mean(off)} of ${before}`);
});

test("null codes", () => {
  const some = new Float32Array([0, 0, 0, NaN, 1, 0, 0, 0, 1]);
  for (const it of ALL) {
    if (it.element !== "vectors" || it.null === null) {
      assert.throws(() => encode(new Float32Array(it.floats), it, { null: true }), /no code to spare/);
      continue;
    }
    const codes = encode(some, it, { null: true });
    assert.ok(codes[0] === it.null && codes[1] === it.null && codes[2] !== it.null, it.id);
    const decoded = decode(codes, it, { null: true });
    assert.ok(decoded.subarray(0, 6).every((c) => c === 0) && decoded.subarray(6).some((c) => c !== 0), it.id);
  }
});

test("choose takes the fewest bytes, and of those the least cost", () => {
  // As `unitvec choose --max-error` prints first.
  assert.deepEqual([1, 0.01].map((bound) => unitvec.choose(bound).id), ["oct16", "oct32"]);
  for (const [bound, element] of [[0.01, "vectors"], [1, "frames"], [0.1, "rotations"]]) {
    const chosen = unitvec.choose(bound, { element });
    const most = (c) => Math.max(...c.maxErrorsDeg);
    const fits = codecs().filter((c) => c.element === element && c.domain === "sphere" && c.isUnit && most(c) <= bound && c.maxDeg > 0);
    assert.deepEqual([most(chosen) <= bound, chosen.bytes], [true, Math.min(...fits.map((c) => c.bytes))]);
  }
});

test("what is wrong is named", () => {
  for (const [wrong, type, reason] of [
    [() => encode(NORMALS, "oct99"), RangeError, /did you mean oct/],
    [() => encode(NORMALS, 7), TypeError, /named by a string/],
    [() => encode(NORMALS, "draco:99"), RangeError, /2 to 16 bits/],
    [() => encode(NORMALS.subarray(1), "oct16"), RangeError, /ends within an element/],
    [() => encode([0, 0, 1], "oct16"), TypeError, /not Array; new Float32Array/],
    [() => encode(NORMALS, "oct16", { stride: 2 }), RangeError, /from 3 on/],
    [() => encode(NORMALS, "oct16", { offset: -1 }), RangeError, /from 0 to 192/],
    [() => encode(NORMALS, "oct16", { out: new Uint32Array(64) }), TypeError, /Uint16Array of 64, not Uint32Array/],
    [() => encode(NORMALS, "oct16", { out: new Uint16Array(63) }), RangeError, /has 63 numbers; it needs 64/],
    [() => decode(new Uint8Array(4), "oct32"), TypeError, /in a Uint32Array, not in Uint8Array/],
    [() => decode(new Uint32Array([1 << 24]), "oct24"), RangeError, /16777216 is no code of oct24, which has 24 bits/],
    [() => unitvec.choose(1e-9), RangeError, /the finest reaches/],
    [() => unitvec.choose(1, { element: "colours" }), RangeError, /elements are "vectors"/],
    [() => snap(new Float32Array(3), "axial16"), RangeError, /not for directions/],
  ]) {
    assert.throws(wrong, (thrown) => thrown instanceof type && reason.test(thrown.message), String(wrong));
  }
});

test("10^5 odd arguments: each is taken, or refused by a TypeError or RangeError", () => {
  const pick = (values) => values[Math.floor(random() * values.length)];
  const types = [Float32Array, Float64Array, Uint8Array, Uint8ClampedArray, Int8Array, Uint16Array, Uint32Array, Int32Array, BigUint64Array];
  const numbers = [0, 1, 3, 4, 7, 8, 64, -1, 0.5, NaN, Infinity, -0, 2 ** 31, 2 ** 32, 2 ** 53, 3n, "3", undefined, null, true, {}, [], Symbol("s")];
  const detached = new Float32Array(6);
  structuredClone(detached, { transfer: [detached.buffer] });
  class Own extends Float32Array {}
  const array = () => {
    const buffer = pick([ArrayBuffer, SharedArrayBuffer]);
    const bytes = new Uint8Array(new buffer(8 * Math.floor(random() * 40))).map(() => random() * 256);
    return pick([new (pick(types))(bytes.buffer), NORMALS, new Own(9), detached, Buffer.from(bytes), new DataView(bytes.buffer), bytes.buffer]);
  };
  const other = () => pick([...numbers, NORMALS.buffer, "oct32p", [0, 0, 1], [[0, 0, 1]], new Proxy({}, {}), Object.create(null), () => 1, /x/]);
  const odd = ["OCT24P", "", "draco:", "draco:10 ", "\u0000", "\ud800", "é".repeat(1000), "__proto__", { id: "oct16" }, { id: 3 }];
  const names = [...ALL.map((it) => it.id), ...ALL, ...odd];
  const places = () => ({ offset: pick(numbers), stride: pick(numbers), null: pick([true, false, 1]) });
  const options = () => pick([undefined, null, 5, "x", {}, places(), { ...places(), offset: 0 }, { out: pick([array(), other()]) }]);
  const outcomes = { taken: 0, refused: 0 };
  for (let i = 0; i < 100_000; i++) {
    const fits = random() < 0.5;
    const by = pick(random() < 0.9 ? names : [other()]);
    const call = pick([encode, encode, decode, decode, error, snap, codec, unitvec.choose]);
    try {
      // Codes of the right type are many of the calls.
      const codes = fits && call === decode ? new (codec(typeof by === "object" ? by.id : by).ArrayType)(Math.floor(random() * 9)) : array();
      call(random() < 0.9 ? codes : other(), by, options());
      outcomes.taken++;
    } catch (thrown) {
      assert.ok(thrown instanceof TypeError || thrown instanceof RangeError, `${call.name}: ${thrown?.stack}`);
      outcomes.refused++;
    }
  }
  assert.ok(outcomes.taken > 5000 && outcomes.refused > 5000, JSON.stringify(outcomes));
  // It still works.
  assert.deepEqual(decode(encode(new Float32Array([0, 0, 1]), "oct32p"), "oct32p"), new Float32Array([0, 0, 1]));
});
