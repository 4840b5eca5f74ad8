// What the types take and refuse: `npm run types` compiles it.
import type { Document } from "@gltf-transform/core";
import { type Codec, choose, codecs, decode, encode, error } from "unitvec";
import { load } from "unitvec/core";
import { oct32p } from "unitvec/glsl-es";
import { snapNormals } from "unitvec/gltf-transform";
import { merge, oct16p_decode } from "unitvec/wgsl/exact";

export async function uses(document: Document): Promise<string> {
  const codes: Uint32Array = encode(new Float64Array(3), "oct32p", { stride: 3, out: new Uint32Array(1) });
  const vectors: Float32Array = decode(codes, codecs()[0]);
  const errors: Float64Array = error(vectors, choose(1, { domain: "hemisphere" }));
  const made: Codec["element"] = choose(errors[0]).element;
  await load(new URL("https://example.com/unitvec.wasm"));
  await document.transform(snapNormals({ codec: "draco:10" }));
  // @ts-expect-error: lists are no arrays.
  encode([0, 0, 1], "oct32p");
  // @ts-expect-error: no such option.
  decode(codes, "oct32p", { stride: 4 });
  // @ts-expect-error: codecs have no width.
  return made + codecs()[0].width + merge(oct16p_decode, oct32p);
}
