// Runs a WebAssembly module that prints through `host.put`.
import { readFileSync } from "node:fs";

const bytes = [];
const host = { put: (byte) => bytes.push(byte) };
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { host });
const status = instance.exports.main(0, 0);
process.stdout.write(Buffer.from(bytes));
process.exitCode = status;
