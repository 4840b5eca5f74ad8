/** What tests in Node.js and in browsers share. */

// Node.js 18 has no global one.
const { subtle } = globalThis.crypto ?? (await import("node:crypto")).webcrypto;

/** Numbers in [0, 1), the same sequence each time: mulberry32. */
export function generator(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const SPECIAL = [0, 0x80000000, 0x7f800000, 0xff800000, 0x7fc00000, 1, 0x3f800000, 0xbf800000];

/** Random elements of random lengths; a quarter of them are any bits of floats, half of those special ones. */
export function inputs(codec, count) {
  const random = generator(5);
  const values = new Float32Array(count * codec.floats);
  const bits = new Uint32Array(values.buffer);
  for (let i = 0; i < count; i++) {
    const scale = 2 ** Math.floor(random() * 40 - 20);
    for (let c = i * codec.floats; c < (i + 1) * codec.floats; c++) {
      if (i % 4 > 0) values[c] = (2 * random() - 1) * scale;
      else bits[c] = random() < 0.5 ? random() * 2 ** 32 : SPECIAL[Math.floor(random() * SPECIAL.length)];
    }
  }
  return values;
}

/** Digests of the codes of these inputs, and of what they are decoded to. */
export async function digests(unitvec, codec, count) {
  const codes = unitvec.encode(inputs(codec, count), codec);
  const hashes = [codes, unitvec.decode(codes, codec)].map((array) => subtle.digest("SHA-256", array));
  return (await Promise.all(hashes)).map((hash) => new Uint8Array(hash).slice(0, 8).join(" "));
}
