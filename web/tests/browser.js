// Opens the page, target/web/index.html or the file of UNITVEC_PAGE, in headless Chromium: the file that UNITVEC_CHROMIUM names, with the libraries of
// UNITVEC_CHROMIUM_LIBRARIES.

import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";
import { PNG } from "pngjs";
import puppeteer from "puppeteer-core";

export const PAGE = pathToFileURL(process.env.UNITVEC_PAGE ?? new URL("../../target/web/index.html", import.meta.url).pathname);
// Chromium's own renderers for machines without a GPU.
const ARGS = ["--no-sandbox", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
// Without Vulkan's compositor SwiftShader loses a WebGPU device when it meets a canvas.
const VULKAN = ["--use-vulkan=swiftshader", "--enable-features=Vulkan"];

export function launch({ vulkan = true } = {}) {
  const { UNITVEC_CHROMIUM: file = "chromium", UNITVEC_CHROMIUM_LIBRARIES: libraries, ...env } = process.env;
  if (libraries) env.LD_LIBRARY_PATH = libraries;
  return puppeteer.launch({ executablePath: file, args: vulkan ? [...ARGS, ...VULKAN] : ARGS, env });
}

// A page with this state in its address, when it shows it. It has what the browser asked for and complained of.
export async function open(browser, state = {}, { width = 1280, height = 800, features = [] } = {}) {
  const page = await browser.newPage();
  const [requests, complaints] = [[], []];
  page.on("request", (request) => requests.push(request.url()));
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (reason) => complaints.push(reason.message));
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures(features);
  const given = Object.entries({ turn: "0", ...state }).filter(([, value]) => value !== null);
  await page.goto(`${PAGE}#${new URLSearchParams(given)}`);
  const message = await (await page.waitForFunction("window.page ? ' ' : document.getElementById('message').textContent")).jsonValue();
  assert.equal(message.trim(), "");
  return Object.assign(page, { requests, complaints });
}

// Pixels of the picture when all is drawn.
export async function picture(page) {
  await page.evaluate(async () => {
    await window.page.settled();
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    await window.page.gpu.finish();
  });
  const { x, y, width, height } = await (await page.$("#canvas")).boundingBox();
  return PNG.sync.read(Buffer.from(await page.screenshot({ clip: { x, y, width, height } })));
}
