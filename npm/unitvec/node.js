/** The package in Node.js, which reads the module from its file. */

import { readFile } from "node:fs/promises";
import { load } from "./core.js";

await load(readFile(new URL("../dist/unitvec.wasm", import.meta.url)));

export * from "./core.js";
