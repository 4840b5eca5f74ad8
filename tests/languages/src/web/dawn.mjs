// Dawn in Node.js: dawn.mjs ADDON URL.

import { createRequire } from "node:module";
import { run } from "./run.mjs";
import { open } from "./webgpu.mjs";

const [addon, base] = process.argv.slice(2);
const { create, globals } = createRequire(import.meta.url)(addon);
Object.assign(globalThis, globals);
// Kept: Dawn ends with what is collected.
globalThis.gpu = create(["backend=vulkan"]);
await run(base, () => open(globalThis.gpu));
process.exit(0);
