/** The package in browsers and workers, which fetch the module from beside it. */

import { load } from "./core.js";

await load(new URL("../dist/unitvec.wasm", import.meta.url));

export * from "./core.js";
