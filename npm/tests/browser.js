// Pages in headless Chromium, bundled by esbuild, from a server of this process.
import { build } from "esbuild";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";

const ARGUMENTS = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
];
const npm = new URL("../", import.meta.url);

/** A bundle of a page's module, with the package `three` for "three", which three.js's loaders import. */
async function bundle(entry, three) {
  const edition = {
    name: "edition",
    setup: (esbuild) =>
      esbuild.onResolve({ filter: /^three$/ }, ({ kind, resolveDir }) => esbuild.resolve(three, { kind, resolveDir })),
  };
  const plugins = three === "three" ? [] : [edition];
  const options = { bundle: true, format: "esm", write: false, plugins, logLevel: "error" };
  const result = await build({ ...options, entryPoints: [fileURLToPath(new URL(entry, npm))] });
  return result.outputFiles[0].contents;
}

/**
 * Opens a tab of Chromium beside a server of this process, and gives what `use` makes of the tab and the server's address. `answer`
 * gives the bytes of a path, or none.
 */
export async function withTab(answer, use) {
  const server = createServer(async (request, response) => {
    const path = new URL(request.url ?? "", "http://localhost").pathname;
    const bytes = await answer(path);
    const types = { js: "text/javascript", wasm: "application/wasm", "": "text/html" };
    const type = types[/\.(\w+)$/.exec(path)?.[1] ?? ""] ?? "application/octet-stream";
    response.writeHead(bytes ? 200 : 404, { "content-type": type }).end(bytes || undefined);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(undefined)));
  const { UNITVEC_CHROMIUM: executablePath = "/usr/bin/chromium", UNITVEC_CHROMIUM_LIBRARIES: LD_LIBRARY_PATH } = process.env;
  const env = { ...process.env, ...(LD_LIBRARY_PATH ? { LD_LIBRARY_PATH } : {}) };
  const browser = await puppeteer.launch({ executablePath, env, args: ARGUMENTS, protocolTimeout: 600_000 });
  try {
    return await use(await browser.newPage(), `http://127.0.0.1:${server.address().port}/`);
  } finally {
    await browser.close();
    server.close();
  }
}

/**
 * Opens Chromium on a page, and gives what `call` makes of its module, by a string of JavaScript with `page` for it.
 * Errors of the page and of the console fail.
 */
export async function inBrowser({ entry, files = new Map(), three = "three", call }) {
  const served = new Map(files).set("/", Buffer.from('<!doctype html><title>unitvec</title><link rel="icon" href="data:,">'));
  served.set("/page.js", await bundle(entry, three));
  const answer = async (path) =>
    served.get(path) ?? (path.startsWith("/node_modules/") && (await readFile(new URL(`.${path}`, npm)).catch(() => null)));
  return withTab(answer, async (tab, address) => {
    const messages = [];
    tab.on("console", (message) => {
      const isComplaint = ["error", "warn"].includes(message.type()) && !message.text().includes("GPU stall due to ReadPixels");
      if (isComplaint) messages.push(message.text());
    });
    tab.on("pageerror", (error) => messages.push(String(error)));
    await tab.goto(address);
    const result = await tab.evaluate(`import("/page.js").then((page) => ${call})`);
    return { result, messages, chromium: await tab.browser().version() };
  });
}
