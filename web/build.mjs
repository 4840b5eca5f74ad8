// Assembles the page: one file without any request. node build.mjs DATA OUTPUT, with the folder of what `page` of unitvec-choose writes.

import { build } from "esbuild";
import { readFile, readdir, writeFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

const [data, output] = process.argv.slice(2);
const here = (name) => new URL(name, import.meta.url);
const packed = (id, bytes) =>
  `<script type="application/gzip" id="data-${id}">${gzipSync(bytes, { level: 9 }).toString("base64")}</script>`;

// Names of the packages within the page; undefined stands for its own modules.
const packages = new Set();
const bundle = async (entry, more = {}) => {
  const how = { bundle: true, minify: true, format: "esm", target: "es2022", external: ["node:*"], write: false, metafile: true };
  const { metafile, outputFiles } = await build({ entryPoints: [here(entry).pathname], ...how, ...more });
  for (const input of Object.keys(metafile.inputs)) packages.add(/^node_modules\/((?:@\w[^/]*\/)?[^/]+)/.exec(input)?.[1]);
  return outputFiles[0].text;
};

// The licence of a package that is within the page, as each asks for.
async function licence(name) {
  const folder = here(`node_modules/${name}/`);
  const { version, license } = JSON.parse(await readFile(new URL("package.json", folder), "utf8"));
  const file = (await readdir(folder)).find((one) => /^licen[cs]e/i.test(one));
  if (!file && license !== "Apache-2.0") throw Error(`${name} ${version} has no file with its licence, ${license}`);
  return `${name} ${version}\n\n${await readFile(file ? new URL(file, folder) : here("../LICENSE-APACHE"), "utf8")}`;
}

const parts = [];
for (const name of (await readdir(data)).sort()) parts.push(packed(name.replace(".json", ""), await readFile(`${data}/${name}`)));
for (const [id, name] of [["wasm", "../npm/dist/unitvec.wasm"], ["draco", "node_modules/draco3d/draco_decoder.wasm"]]) {
  parts.push(packed(id, await readFile(here(name))));
}
// From a file, browsers start no worker that is a module. It gets the bytes of the codecs, and needs no address of its own.
const worker = await bundle("worker.js", { format: "iife", define: { "import.meta.url": '""' } });
const script = (await bundle("main.js", { define: { WORKER: JSON.stringify(worker) } })).replaceAll("</script", "<\\/script");
const [page, style] = [await readFile(here("index.html"), "utf8"), await bundle("style.css")];
packages.delete(undefined);
const licences = await Promise.all([...packages].sort().map(licence));
parts.push(`<script type="text/plain" id="licences">\n${licences.join("\n\n")}</script>`);
const end = `${parts.join("\n")}\n<script type="module">${script}</script>\n</body>`;
await writeFile(output, page.replace("/* style.css */", () => style).replace("</body>", () => end));
