// The page in Chromium, on both of its APIs: pictures by their content, keyboard, names, sizes.

import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, stat, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { after, before, test } from "node:test";
import { PAGE, launch, open, picture } from "./browser.js";
import { COMPRESSIONS, TORUS, compressed } from "./torus.js";

const APIS = { webgpu: "WebGPU", webgl: "WebGL 2" };
const AXE = new URL("../node_modules/axe-core/axe.min.js", import.meta.url);

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const text = (page, selector) => page.$eval(selector, (element) => element.textContent);
const choose = (page, name, value) =>
  page.$eval(`[name=${name}]`, (field, value) => { field.value = value; field.dispatchEvent(new Event("input", { bubbles: true })); }, value);

// Largest and mean difference of two pictures, in steps of 1/255.
function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  let [most, sum] = [0, 0];
  a.data.forEach((x, at) => { const d = Math.abs(x - b.data[at]); most = Math.max(most, d); sum += d; });
  return { most, mean: sum / a.data.length };
}

// A whole picture of codes, and of floats, without what lies over them.
async function both(state) {
  const pictures = [];
  for (const split of ["0", "1"]) {
    const page = await open(browser, { ...state, split }, { width: 700, height: 500 });
    await page.addStyleTag({ content: "#split, .tag { visibility: hidden }" });
    pictures.push(await picture(page));
    assert.equal(await text(page, "#api").then((api) => api.split(" · ")[0]), APIS[state.api]);
    assert.deepEqual([page.complaints, await text(page, "#message")], [[], ""]);
    await page.close();
  }
  return pictures;
}

for (const api of Object.keys(APIS)) {
  // A sharp edge in the mirror moves by a part of a pixel at 32 bits: few pixels differ, and by little.
  test(`${api}: 32 bits look like floats, 8 bits do not`, async () => {
    for (const at of ["pixel", "vertex"]) {
      const [fine, coarse] = [difference(...(await both({ api, at, codec: "oct32p" }))), difference(...(await both({ api, at, codec: "oct8p" })))];
      console.log(`${api}, ${at}: oct32p ${JSON.stringify(fine)}, oct8p ${JSON.stringify(coarse)}`);
      assert.ok(fine.most <= 8 && fine.mean < 0.01, JSON.stringify(fine));
      assert.ok(coarse.most > 100 && coarse.mean > 3, JSON.stringify(coarse));
    }
  });

  test(`${api}: every family is shown, without a complaint`, async () => {
    const page = await open(browser, { api, show: "error" }, { width: 400, height: 400 });
    for (const family of await page.$$eval("[name=family] option", (options) => options.map(({ value }) => value))) {
      await choose(page, "family", family);
      await page.evaluate(() => window.page.settled());
      assert.deepEqual([page.complaints, await text(page, "#message")], [[], ""], family);
    }
    await choose(page, "family", "oct…");
    await page.click("[name=dither]");
    await page.evaluate(() => window.page.settled());
    assert.deepEqual([page.complaints, await text(page, "#message")], [[], ""]);
    assert.match(await text(page, "#text"), /_encode_dithered/);
  });

  test(`${api}: work of a frame`, async () => {
    const page = await open(browser, { api });
    await picture(page);
    const milliseconds = await page.evaluate(async () => {
      const began = performance.now();
      for (let frame = 0; frame < 20; frame++) { window.page.stage.drawNow(); await window.page.gpu.finish(); }
      return (performance.now() - began) / 20;
    });
    console.log(`${api}: ${milliseconds.toFixed(1)} ms a frame of 1280 x 800`);
  });
}

test("both APIs show the same", async () => {
  const [a, b] = [await both({ api: "webgpu", codec: "oct16p" }), await both({ api: "webgl", codec: "oct16p" })];
  const { mean } = difference(a[0], b[0]);
  assert.ok(mean < 0.5, `${mean}`);
});

test("a browser whose WebGPU reaches no canvas gets WebGL 2", async (t) => {
  const other = await launch({ vulkan: false });
  t.after(() => other.close());
  const page = await open(other);
  assert.match(await text(page, "#api"), /^WebGL 2/);
  assert.equal(await text(page, "#message"), "");
});

test("the page is one file, and asks for nothing", async () => {
  assert.ok((await stat(PAGE)).size < 3e6);
  const page = await open(browser);
  await choose(page, "language", "hlsl");
  await page.waitForFunction(() => document.getElementById("text").textContent.includes("uint oct16p_encode(float3"));
  const outside = page.requests.filter((url) => !url.startsWith("blob:null/") && url.split("#")[0] !== PAGE.href);
  assert.deepEqual([page.requests.length > 0, outside, page.complaints], [true, [], []]);
});

test("the keyboard reaches and moves everything, and shows where it is", async () => {
  const page = await open(browser);
  const reached = [];
  for (let presses = 0; presses < 40; presses++) {
    await page.keyboard.press("Tab");
    const one = await page.evaluate(() => {
      const { activeElement: it } = document;
      if (it === document.body) return null;
      const shown = [it, it.nextElementSibling, it.firstElementChild].filter(Boolean);
      const has = shown.some((part) => ["solid", "auto"].includes(getComputedStyle(part).outlineStyle) && getComputedStyle(part).outlineWidth !== "0px");
      return { name: it.id || it.name, has };
    });
    if (!one) break;
    assert.ok(one.has, `${one.name} shows no focus`);
    reached.push(one.name);
  }
  const all = ["canvas", "split", "show", "at", "turn", "open", "family", "bits", "dither", "gpu", "language", "copy", "text"];
  assert.deepEqual(reached, all);
  const after = async (selector, key, what) => {
    await page.focus(selector);
    const before = await page.evaluate(what);
    await page.keyboard.press(key);
    assert.notDeepEqual(await page.evaluate(what), before, `${selector} ${key}`);
  };
  await after("#canvas", "ArrowLeft", "page.state.yaw");
  await after("#canvas", "ArrowUp", "page.state.pitch");
  await after("#canvas", "+", "page.state.distance");
  await after("#split", "ArrowRight", "split.getAttribute('aria-valuenow')");
  await after("#split", "Home", "page.state.split");
  await after("[name=bits]", "ArrowRight", "page.state.codec");
  await after("[name=show][value=mirror]", "ArrowRight", "page.state.show");
  await page.waitForFunction("location.hash.includes('codec=oct18p')");
  const again = await open(browser, Object.fromEntries(new URLSearchParams(await page.evaluate("location.hash.slice(1)"))));
  assert.equal(await text(again, "#codec"), "oct18p");
});

test("the split follows mouse and finger", async () => {
  const page = await open(browser);
  const { x, y, width, height } = await (await page.$("#canvas")).boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 4, y + height / 2, { steps: 4 });
  await page.mouse.up();
  assert.equal(await page.$eval("#split", (it) => it.getAttribute("aria-valuenow")), "25");
  const touch = await page.touchscreen.touchStart(x + width / 4, y + height / 2);
  await touch.move(x + (3 * width) / 4, y + height / 2);
  await touch.end();
  assert.equal(await page.$eval("#split", (it) => it.getAttribute("aria-valuenow")), "75");
});

test("names, roles and contrast pass axe; 360 pixels are wide enough", async () => {
  const axe = await readFile(AXE, "utf8");
  for (const [scheme, width] of [["light", 1280], ["dark", 1280], ["light", 360], ["dark", 360]]) {
    const features = [{ name: "prefers-color-scheme", value: scheme }];
    const page = await open(browser, { codec: "snorm11_11_10" }, { width, height: 740, features });
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run());
    assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html.slice(0, 90))]), [], `${scheme}, ${width}`);
    assert.ok((await page.evaluate("document.documentElement.scrollWidth")) <= width);
    await page.close();
  }
});

test("nothing moves by itself where less motion is asked for", async () => {
  for (const [value, turns] of [["reduce", 0], ["no-preference", 1]]) {
    const page = await open(browser, { turn: null }, { features: [{ name: "prefers-reduced-motion", value }] });
    assert.equal(await page.evaluate("page.state.turn"), turns);
    await page.close();
  }
});

test("one's own mesh is shown and measured; a broken one gets a line", async () => {
  const page = await open(browser, { at: "vertex" });
  const folder = await mkdtemp(join(tmpdir(), "unitvec-"));
  const files = [TORUS];
  for (const name of COMPRESSIONS) {
    files.push(join(folder, `${name}.glb`));
    await writeFile(files.at(-1), await compressed(name));
  }
  const file = await page.$("#file");
  for (const own of files) {
    await file.uploadFile(own);
    await page.waitForFunction((name) => document.getElementById("said").textContent.startsWith(name), {}, basename(own));
    await page.waitForFunction(() => document.getElementById("errors").textContent.includes("your mesh"));
    assert.equal(await text(page, "#message"), "");
  }
  await rm(folder, { recursive: true });
  await file.uploadFile(new URL("page.test.js", import.meta.url).pathname);
  await page.waitForFunction(() => document.getElementById("message").textContent);
  assert.equal(await text(page, "#message"), "page.test.js: this is no GLB file: it does not begin with the letters glTF");
  assert.deepEqual(page.complaints, []);
});
