// Textures in three.js: what a shader makes of each texel of each level.
import * as THREE from "three";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";
import * as texts from "unitvec/glsl-es";

const VERTEX = "in vec3 position; void main() { gl_Position = vec4(position, 1.0); }";

/** Vectors of the levels of a file by a function of `text` (`hemioct_to_float32x3(e)`, of a texel), or the loader's refusal. */
async function read(renderer, loader, { path, functions, call }) {
  let map;
  try {
    map = await loader.loadAsync(path);
  } catch (error) {
    return { refused: String(error) };
  }
  const fragmentShader = `precision highp float; precision highp int; precision highp sampler2D;
    ${texts.merge(...functions.map((name) => texts[name]))}
    uniform sampler2D map; uniform int level; out vec4 result;
    void main() { vec4 texel = texelFetch(map, ivec2(gl_FragCoord.xy), level); result = vec4(${call}, 1.0); }`;
  const uniforms = { map: { value: map }, level: { value: 0 } };
  const material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: VERTEX, fragmentShader, uniforms });
  const square = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
  const levels = map.mipmaps.map(({ width, height }, level) => {
    const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, depthBuffer: false });
    uniforms.level.value = level;
    renderer.setRenderTarget(target);
    renderer.render(square, new THREE.Camera());
    const pixels = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    return [...pixels].filter((_, i) => i % 4 < 3);
  });
  return { levels };
}

export async function readAll(files) {
  const renderer = new THREE.WebGLRenderer();
  const loader = new KTX2Loader().detectSupport(renderer);
  const results = [];
  for (const file of files) results.push(await read(renderer, loader, file));
  return results;
}
