// Assembles the page: one file without any request. node build.mjs DATA OUTPUT, with the folder of what `page` of unitvec-choose writes.

import { build } from "esbuild";
import { readFile, readdir, writeFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

const [data, output] = process.argv.slice(2);
const here = (name) => new URL(name, import.meta.url);
const packed = (id, bytes) =>
  `<script type="application/gzip" id="data-${id}">${gzipSync(bytes, { level: 9 }).toString("base64")}</script>`;

const bundle = async (entry, more = {}) => {
  const options = { entryPoints: [here(entry).pathname], bundle: true, minify: true, write: false, format: "esm", target: "es2022", ...more };
  return (await build(options)).outputFiles[0].text;
};
const parts = [];
for (const name of (await readdir(data)).sort()) parts.push(packed(name.replace(".json", ""), await readFile(`${data}/${name}`)));
parts.push(packed("wasm", await readFile(here("../npm/dist/unitvec.wasm"))));
// From a file, browsers start no worker that is a module. It gets the bytes of the codecs, and needs no address of its own.
const worker = await bundle("worker.js", { format: "iife", define: { "import.meta.url": '""' } });
const script = (await bundle("main.js", { define: { WORKER: JSON.stringify(worker) } })).replaceAll("</script", "<\\/script");
const [page, style] = [await readFile(here("index.html"), "utf8"), await bundle("style.css")];
const end = `${parts.join("\n")}\n<script type="module">${script}</script>\n</body>`;
await writeFile(output, page.replace("/* style.css */", () => style).replace("</body>", () => end));
