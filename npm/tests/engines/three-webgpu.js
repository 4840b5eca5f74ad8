import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import * as THREE from "three/webgpu";
import * as codes from "unitvec/three-webgpu";
import { WIDTH, HEIGHT } from "./common.js";
import { run } from "./three.js";

export async function rows(forceWebGL) {
  const renderer = new THREE.WebGPURenderer({ antialias: false, forceWebGL });
  await renderer.init();
  if (Boolean(renderer.backend.isWebGPUBackend) === forceWebGL) throw new Error("the browser has no WebGPU");
  renderer.setSize(WIDTH, HEIGHT);
  const target = new THREE.RenderTarget(WIDTH, HEIGHT);
  renderer.setRenderTarget(target);
  const pixelsOf = (scene, camera) => {
    renderer.render(scene, camera);
    return renderer.readRenderTargetPixelsAsync(target, 0, 0, WIDTH, HEIGHT);
  };
  return run({ THREE, GLTFLoader, codes, suffix: "NodeMaterial", pixelsOf });
}
