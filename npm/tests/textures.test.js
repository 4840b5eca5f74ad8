// Textures that `unitvec texture` writes, loaded by three.js in Chromium: shaders read the vectors that the program reads from
// them at every texel, or the loader refuses the format, as docs/textures.md says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { codec as codecNamed, decode } from "unitvec";
import { inBrowser } from "./browser.js";

const MAP = fileURLToPath(new URL("../../host/texture/data/waves.png", import.meta.url));
// Error of the codec by which the program's vectors come here, `oct32p`, and of the functions in 32-bit floats.
const EXACT = 0.003;
// Drivers may decode a block of BC5 to 8 bits: a step off in both channels, where the codec's bound is half a step in both.
const A_STEP = 2 * codecNamed("hemioct16").maxErrorsDeg[0];

const hemioct = ["hemioct_to_float32x3"];
const FILES = [
  { options: "hemioct16 --unorm", functions: ["unorm_to_octn", ...hemioct], call: "hemioct_to_float32x3(unorm_to_octn(texel.xy, 16))" },
  { options: "uoct16p", codes: "uoct16p", functions: ["oct_to_float32x3"], call: "oct_to_float32x3(texel.xy * 2.0 - 1.0)" },
  { options: "unorm8x3", functions: [], call: "normalize(texel.xyz * 2.0 - 1.0)" },
  { options: "hemioct16 --compress bc5", functions: hemioct, call: "hemioct_to_float32x3(texel.xy)", most: A_STEP },
  { options: "hemioct16 --compress bc5 --unorm", functions: hemioct, call: "hemioct_to_float32x3(texel.xy * 2.0 - 1.0)", most: A_STEP },
  { options: "oct16p --compress bc7", functions: ["oct_to_float32x3"], call: "oct_to_float32x3(texel.xy * 2.0 - 1.0)" },
  ...["hemioct16", "hemioct24", "oct32p", "uoct20p"].map((options) => ({ options, functions: [], call: "", refused: true })),
];

/** Bytes of a level of a ktx2. */
function level(ktx2, number) {
  const [start, size] = [80, 88].map((at) => Number(ktx2.readBigUInt64LE(at + 24 * number)));
  return new Uint8Array(ktx2.subarray(start, start + size)).buffer;
}

/** Largest angle between two arrays of vectors, in degrees. */
function largestAngle(a, b) {
  const angles = Array.from({ length: a.length / 3 }, (_, i) => {
    const [v, w] = [a, b].map((all) => all.slice(3 * i, 3 * i + 3));
    const [across, along] = [Math.hypot(...v.map((c, k) => c - w[k])), Math.hypot(...v.map((c, k) => c + w[k]))];
    return (2 * Math.atan2(across, along) * 180) / Math.PI;
  });
  return Math.max(...angles);
}

test("three.js", { skip: !process.env.UNITVEC_CHROMIUM }, async () => {
  const folder = await mkdtemp(join(tmpdir(), "unitvec-textures-"));
  const texture = (...args) => execFileSync(process.env.UNITVEC_PROGRAM ?? "unitvec", ["texture", ...args], { stdio: "ignore" });
  try {
    const served = new Map();
    const expected = [];
    for (const { options, codes } of FILES) {
      const [name, vectors] = ["map", "vectors"].map((stem) => join(folder, `${stem}${served.size}.ktx2`));
      texture(MAP, "--codec", ...options.split(" "), "--mips", name);
      texture(name, "--codec", "oct32p", vectors);
      const [file, first] = [await readFile(name), await readFile(vectors)];
      served.set(`/${served.size}.ktx2`, file);
      // The program reads the first level; of a codec's own channels the others are codes.
      const others = codes ? [1, 2, 3, 4, 5, 6].map((number) => decode(new Uint16Array(level(file, number)), codes)) : [];
      expected.push([decode(new Uint32Array(level(first, 0)), "oct32p"), ...others]);
    }
    const files = FILES.map(({ functions, call }, i) => ({ path: `/${i}.ktx2`, functions, call }));
    const call = `page.readAll(${JSON.stringify(files)})`;
    const { result, messages } = await inBrowser({ entry: "tests/engines/textures.js", files: served, call });
    assert.deepEqual(messages, []);
    result.forEach((read, i) => {
      const { options, refused, most = EXACT } = FILES[i];
      if (refused) return assert.match(read.refused ?? "", /Unsupported vkFormat/, options);
      assert.equal(read.levels?.length, 7, `${options}: ${read.refused}`);
      expected[i].forEach((vectors, number) => {
        const off = largestAngle(read.levels[number], [...vectors]);
        assert.ok(off < most, `${options}, level ${number}: ${off} degrees`);
      });
    });
  } finally {
    await rm(folder, { recursive: true });
  }
});

const TEXELS = [
  { format: "RG8_SNORM", most: 127, bytes: [-127, 3, 127, 90, 40, -100, -77, 127] },
  { format: "RG8", most: 255, bytes: [0, 3, 255, 90, 40, 100, 77, 254] },
];
// Places at all fractions of 8 bits, the first and the last texel among them.
const SIDE = 257;
// Roundings of sums of floats of at most 1.
const ROUNDING = 2 ** -22;

// The tables of docs/filtering.md come from this blend of channels, by fractions of 8 bits, in float64.
for (const { format, most, bytes } of TEXELS) {
  test(`a sampler of ${format}`, { skip: !process.env.UNITVEC_CHROMIUM }, async () => {
    const call = `page.sampled("${format}", ${JSON.stringify(bytes)}, ${SIDE})`;
    const { result, messages } = await inBrowser({ entry: "tests/engines/sampler.js", call });
    const [error, ...found] = result;
    assert.deepEqual([error, messages, found.length], [0, [], 2 * SIDE ** 2]);
    found.forEach((sample, i) => {
      const [channel, x, y] = [i % 2, (i >> 1) % SIDE, Math.floor(i / 2 / SIDE)];
      const [a, b] = [x, y].map((place) => place / (SIDE - 1));
      const [p, q, r, s] = [0, 1, 2, 3].map((texel) => bytes[2 * texel + channel] / most);
      const blend = (p * (1 - a) + q * a) * (1 - b) + (r * (1 - a) + s * a) * b;
      assert.ok(Math.abs(sample - blend) < ROUNDING, `${x}, ${y}: ${sample}, not ${blend}`);
    });
  });
}
