import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import * as codes from "unitvec/three";
import { WIDTH, HEIGHT } from "./common.js";
import { run } from "./three.js";

const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setSize(WIDTH, HEIGHT);
const gl = renderer.getContext();

function pixelsOf(scene, camera) {
  renderer.render(scene, camera);
  const pixels = new Uint8Array(WIDTH * HEIGHT * 4);
  gl.readPixels(0, 0, WIDTH, HEIGHT, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  if (gl.getError()) throw new Error("WebGL reports an error");
  return pixels;
}

export const rows = () => run({ THREE, GLTFLoader, codes, suffix: "Material", pixelsOf });
