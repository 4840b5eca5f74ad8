/**
 * The package as installed: its README in Node.js and, unbundled, in Chromium; the bits there; what bundlers keep; glTF-Transform.
 *
 * UNITVEC_INSTALLED is a folder that has it in `node_modules`, UNITVEC_CHROMIUM a browser, UNITVEC_NARROW a build without wide
 * instructions; `cargo xtask npm` gives all of them.
 */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { NodeIO } from "@gltf-transform/core";
import { build } from "esbuild";
import * as unitvec from "unitvec";
import * as exactEs from "unitvec/glsl-es/exact";
import * as es from "unitvec/glsl-es";
import { snapNormals } from "unitvec/gltf-transform";
import * as exactWgsl from "unitvec/wgsl/exact";
import * as wgsl from "unitvec/wgsl";
import { withTab } from "./browser.js";
import { digests } from "./common.js";

const { UNITVEC_PROGRAM: PROGRAM, UNITVEC_CHROMIUM: CHROMIUM, UNITVEC_COUNT: COUNT = "4096" } = process.env;
const { UNITVEC_INSTALLED: INSTALLED, UNITVEC_NARROW: NARROW } = process.env;
const HERE = fileURLToPath(new URL(".", import.meta.url));
const README = readFileSync(join(HERE, "../README.md"), "utf8");
const [, EXAMPLE, PRINTED] = /```js\n(.*?)```.*?```\n(.*?)```/s.exec(README) ?? [];

test("README's lines run as installed", { skip: !INSTALLED && "UNITVEC_INSTALLED is not set" }, () => {
  writeFileSync(join(INSTALLED, "readme.mjs"), EXAMPLE);
  assert.equal(execFileSync(process.execPath, ["readme.mjs"], { cwd: INSTALLED, encoding: "utf8" }), PRINTED);
});

test(
  "all of Chromium's bits are Node's, and README's lines run unbundled",
  { skip: !(CHROMIUM && INSTALLED) && "UNITVEC_CHROMIUM is not set" },
  async () => {
    await inChromium(async (page, printed) => {
      assert.equal(printed.join("\n") + "\n", PRINTED);
      const all = [...unitvec.codecs(), ...unitvec.formats()];
      const expected = [];
      for (const codec of all) expected.push(await digests(unitvec, codec, Number(COUNT)));
      for (const module of ["/node_modules/unitvec/dist/unitvec.wasm", ...(NARROW ? ["/narrow/unitvec.wasm"] : [])]) {
        await page.reload();
        await page.evaluate(async (module) => {
          const [unitvec, { digests }] = await Promise.all([import("unitvec/core"), import("/tests/common.js")]);
          await unitvec.load(module);
          const all = [...unitvec.codecs(), ...unitvec.formats()];
          globalThis.digestsAt = (at, count) => digests(unitvec, all[at], count);
        }, module);
        // One call for each, as a call may take minutes alone.
        for (const [at, codec] of all.entries()) {
          const found = await page.evaluate((at, count) => globalThis.digestsAt(at, count), at, Number(COUNT));
          assert.deepEqual(found, expected[at], `${codec.id} of ${module}`);
        }
      }
    });
  },
);

test("a worker of Chromium", { skip: !(CHROMIUM && INSTALLED) && "UNITVEC_CHROMIUM is not set" }, async () => {
  const code = await inChromium((page) =>
    page.evaluate(() => {
      const from = `${location.origin}/node_modules/unitvec/unitvec/web.js`;
      const script = `import { encode } from "${from}"; postMessage(encode(new Float32Array([0, 0, -1]), "oct32p")[0]);`;
      const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
      return new Promise((resolve) => (new Worker(url, { type: "module" }).onmessage = ({ data }) => resolve(data)));
    }),
  );
  assert.equal(code, unitvec.encode(new Float32Array([0, 0, -1]), "oct32p")[0]);
});

test("the module is under 200 kB, as servers compress it", () => {
  assert.ok(gzipSync(readFileSync(join(HERE, "../dist/unitvec.wasm"))).length < 200_000);
});

/** Opens a page with README's lines, and runs a test there. */
async function inChromium(run) {
  const map = { unitvec: "unitvec/web.js", "unitvec/core": "unitvec/core.js", "unitvec/wgsl": "dist/wgsl.js" };
  const imports = Object.fromEntries(Object.entries(map).map(([name, file]) => [name, `/node_modules/unitvec/${file}`]));
  const page = `<!doctype html><script type="importmap">${JSON.stringify({ imports })}</script>`;
  const folders = { node_modules: INSTALLED, tests: join(HERE, ".."), narrow: join(NARROW ?? "", "..") };
  const answer = (path) => {
    const [, first] = path.split("/");
    return first in folders ? readFileSync(join(folders[first], path)) : Buffer.from(page);
  };
  return withTab(answer, async (tab, address) => {
    const printed = [];
    tab.on("console", (message) => printed.push(message.text()));
    tab.on("pageerror", (error) => printed.push(String(error)));
    await tab.goto(address);
    await tab.addScriptTag({ type: "module", content: `${EXAMPLE}\nglobalThis.isDone = true;` });
    await tab.waitForFunction("globalThis.isDone", { timeout: 60_000 });
    return run(tab, printed);
  });
}

const EDITIONS = { wgsl, "wgsl --exact": exactWgsl, "glsl-es": es, "glsl-es --exact": exactEs };

test("texts are those of the program, and merge without repeating", { skip: !PROGRAM && "UNITVEC_PROGRAM is not set" }, () => {
  const code = (text) => text.replace(/^\/\/.*$/gm, "").replace(/\s+/g, " ").trim();
  for (const [options, { merge, ...texts }] of Object.entries(EDITIONS)) {
    const run = (...words) => code(execFileSync(PROGRAM, ["shader", "--language", ...options.split(" "), ...words], { encoding: "utf8" }));
    for (const id of ["oct16p", "oct32p", "frame32", "ico24"]) assert.equal(code(texts[id]), run("--codec", id), id);
    assert.equal(code(texts.oct32p_decode), run("--function", "oct32p_decode"));
    const names = (text) => [...text.matchAll(/^fn (\w+)|#define (\w+)/gm)].map((found) => found[0]);
    const merged = names(merge(...Object.values(texts)));
    assert.deepEqual(new Set(merged), new Set(names(Object.values(texts).join("\n"))));
    assert.equal(new Set(merged).size, merged.length);
  }
});

test("bundlers keep what is imported", async () => {
  const contents = 'import { oct32p } from "unitvec/glsl-es"; console.log(oct32p);';
  const options = { bundle: true, write: false, format: "esm", stdin: { contents, resolveDir: HERE } };
  const { outputFiles } = await build({ ...options, minify: true });
  assert.ok(outputFiles[0].text.length < 20_000 && outputFiles[0].text.includes("oct32p_decode"));
});

test("snapNormals does what the program does", { skip: !PROGRAM && "UNITVEC_PROGRAM is not set" }, async () => {
  const cwd = mkdtempSync(join(tmpdir(), "unitvec-"));
  const io = new NodeIO();
  const mesh = join(HERE, "../../host/mesh/data/torus.glb");
  const vectors = (document) => {
    const [primitive] = document.getRoot().listMeshes()[0].listPrimitives();
    return ["NORMAL", "TANGENT"].map((semantic) => primitive.getAttribute(semantic).getArray());
  };
  for (const codec of ["oct16p", "frame32", "gltf-snorm8", "draco:10"]) {
    execFileSync(PROGRAM, ["snap", "--for", codec, mesh, "out.glb"], { cwd, stdio: "pipe" });
    const document = await io.read(mesh);
    const before = vectors(document).map((array) => array.slice());
    await document.transform(snapNormals({ codec }));
    assert.deepEqual(vectors(document), vectors(await io.read(join(cwd, "out.glb"))), codec);
    assert.notDeepEqual(vectors(document), before);
  }
  assert.throws(() => snapNormals({ codec: "quat32" }), /not for directions/);
  rmSync(cwd, { recursive: true });
});
