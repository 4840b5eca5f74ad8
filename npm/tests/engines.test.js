// Each engine, material and codec draws what float normals draw, but for a declared difference. With UNITVEC_RECORD set
// the differences are written to docs/data/web_engines.csv, for the table of docs/web-engines.md.
import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { after, test } from "node:test";
import { codec as codecNamed } from "unitvec";
import { inBrowser } from "./browser.js";
import { files } from "./mesh.js";

const PAGES = [
  { engine: "three", api: "WebGL 2", page: "three-webgl" },
  { engine: "three", api: "WebGPU", page: "three-webgpu", argument: "false", three: "three/webgpu" },
  { engine: "three", api: "WebGL 2 by WebGPURenderer", page: "three-webgpu", argument: "true", three: "three/webgpu" },
  { engine: "@babylonjs/core", api: "WebGL 2", page: "babylon" },
  { engine: "playcanvas", api: "WebGL 2", page: "playcanvas" },
];

// Most that a colour, of 255, changes by a radian of the normal. The glossy ones have a highlight of roughness 0.25; the
// toon one steps between tones over a pixel or so, so that it shows how far an edge moves.
const SLOPES = {
  Normal: 128,
  Matcap: 128,
  Lambert: 700,
  Phong: 700,
  Toon: 8000,
  Standard: 2500,
  Physical: 2500,
  PBR: 2500,
  glTF: 3000,
};
// Four pixels are left out: shading jumps where a mapped normal turns from the eye and from the light at once.
// Sine of the most that the normal maps tilt: so far a turn of the tangent moves the normal.
const TILT = 0.25;

/** Most that a codec may change a material: what its bounds explain, and one for rounding. */
function limit(material, id) {
  const [normal, tangent = 0] = codecNamed(id).maxErrorsDeg;
  const angle = normal + (/map|glTF/.test(material) ? TILT * tangent : 0);
  return 1 + Math.ceil((SLOPES[material.split(" ")[0]] * angle * Math.PI) / 180);
}

const skip = !process.env.UNITVEC_CHROMIUM;
const recorded = [];
const served = skip ? null : files();

for (const { engine, api, page, argument = "", three } of PAGES) {
  test(`${engine}, ${api}`, { skip }, async () => {
    const entry = `tests/engines/${page}.js`;
    const call = `page.rows(${argument})`;
    const { result, messages, chromium } = await inBrowser({ entry, files: await served, three, call });
    assert.deepEqual(messages, []);
    const manifest = await readFile(new URL(`../node_modules/${engine}/package.json`, import.meta.url));
    const { version } = JSON.parse(String(manifest));
    for (const { material, codec, largest, usual, different, lit } of result) {
      const most = limit(material, codec);
      assert.ok(lit > 500_000, `${material}: the mesh fills a third of the picture`);
      assert.ok(different > 0, `${material}, ${codec}: codes, not floats, were drawn`);
      assert.ok(usual <= most, `${material}, ${codec}: ${usual} of 255, more than ${most}`);
      recorded.push([engine, version, api, chromium.replace("Chrome/", ""), material, codec, largest, most]);
    }
  });
}

after(async () => {
  if (!process.env.UNITVEC_RECORD) return;
  const rows = [["engine", "version", "api", "chromium", "material", "codec", "largest", "limit"], ...recorded];
  await writeFile(new URL("../../docs/data/web_engines.csv", import.meta.url), rows.map((row) => `${row}\n`).join(""));
});
