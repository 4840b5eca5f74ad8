// The codecs in WebAssembly, beside the page: some take seconds to begin, and meshes are large.

import { encode, error, load } from "../npm/unitvec/core.js";

let loaded;

// Two words for each code, the low one first.
function words(codes) {
  if (codes instanceof BigUint64Array) return new Uint32Array(codes.buffer);
  const out = new Uint32Array(2 * codes.length);
  codes.forEach((code, at) => (out[2 * at] = code));
  return out;
}

onmessage = async ({ data: { wasm, id, what, elements, codec } }) => {
  if (wasm) loaded = load(wasm);
  try {
    await loaded;
    const result = wasm ? new Uint8Array() : what === "encode" ? words(encode(elements, codec)) : error(elements, codec);
    postMessage({ id, result }, [result.buffer]);
  } catch (reason) {
    postMessage({ id, reason: reason.message });
  }
};
