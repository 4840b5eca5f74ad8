/**
 * Times of encoding and decoding on one thread, in ns a vector, and as ratios to the slices of Rust in the same run:
 *
 *     cargo build --release -p unitvec-wasm --example slices
 *     node benchmarks/speed.js ../target/release/examples/slices
 *
 * The last row is an octahedral encoder and decoder of 16 bits in JavaScript, as projects write it: it rounds.
 */

import { execFileSync } from "node:child_process";
import { codec, decode, encode } from "unitvec";

const [SLICES] = process.argv.slice(2);
const COUNT = 1 << 20;
const vectors = (floats) => Float32Array.from({ length: COUNT * floats }, (_, i) => ((i * 0.618034) % 1) - 0.5);

/** The least time of each of two functions, in ns a vector, in turn; and their ratios to the slices. */
function print(name, of, ...functions) {
  const times = functions.map(() => Infinity);
  for (let turn = 0; turn < 5; turn++) {
    functions.forEach((run, i) => {
      const started = performance.now();
      run();
      times[i] = Math.min(times[i], ((performance.now() - started) * 1e6) / COUNT);
    });
  }
  const slices = SLICES ? execFileSync(SLICES, [of, COUNT], { encoding: "utf8" }).split(" ").map(Number) : [];
  console.log([name, ...times.map((time) => time.toFixed(2)), ...slices.map((time, i) => (times[i] / time).toFixed(1))].join(","));
}

function encodeByHand(v, codes) {
  for (let i = 0; i < codes.length; i++) {
    const norm = Math.abs(v[3 * i]) + Math.abs(v[3 * i + 1]) + Math.abs(v[3 * i + 2]);
    let [x, y] = [v[3 * i] / norm, v[3 * i + 1] / norm];
    if (v[3 * i + 2] < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
    codes[i] = (Math.round(x * 127) & 255) | ((Math.round(y * 127) & 255) << 8);
  }
}

function decodeByHand(codes, v) {
  for (let i = 0; i < codes.length; i++) {
    let [x, y] = [((codes[i] << 24) >> 24) / 127, ((codes[i] << 16) >> 24) / 127];
    const z = 1 - Math.abs(x) - Math.abs(y);
    if (z < 0) [x, y] = [x + (x < 0 ? -z : z), y + (y < 0 ? -z : z)];
    const scale = 1 / Math.sqrt(x * x + y * y + z * z);
    [v[3 * i], v[3 * i + 1], v[3 * i + 2]] = [x * scale, y * scale, z * scale];
  }
}

console.log("codec,encode ns,decode ns,encode / Rust,decode / Rust");
for (const name of ["oct16", "oct16p", "oct32", "oct32p", "ico32", "frame32", "fib24"]) {
  const elements = vectors(codec(name).floats);
  const codes = encode(elements, name);
  print(name, name, () => encode(elements, name, { out: codes }), () => decode(codes, name, { out: elements }));
}
const [elements, codes] = [vectors(3), new Uint16Array(COUNT)];
print("oct16 by hand", "oct16", () => encodeByHand(elements, codes), () => decodeByHand(codes, elements));
