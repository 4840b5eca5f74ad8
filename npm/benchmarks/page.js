// Loads a GLB in three.js and in Babylon.js, with the package's hooks, up to the first picture.
import {
  DracoDecoder,
  Engine,
  FreeCamera,
  HemisphericLight,
  ImportMeshAsync,
  MeshoptCompression,
  Scene,
  Vector3,
} from "@babylonjs/core";
import { registerGLTFExtension } from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry.js";
import "@babylonjs/loaders/glTF/2.0/index.js";
import { MeshoptDecoder } from "meshoptimizer";
import { HemisphereLight, PerspectiveCamera, WebGLRenderer, Scene as ThreeScene } from "three";
import { DRACOLoader } from "three/examples/jsm/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { registerCodes } from "unitvec/babylon";
import { codesPlugin } from "unitvec/three";

const packages = `${location.origin}/node_modules`;
const draco = `${packages}/three/examples/jsm/libs/draco/gltf/`;
const SIZE = 64;

/** Bytes that go to vertex buffers: what `gl.bufferData` gets. */
function counter(gl) {
  const counted = { bytes: 0 };
  const { bufferData } = gl;
  gl.bufferData = (target, data, ...others) => {
    if (target === gl.ARRAY_BUFFER) counted.bytes += data.byteLength ?? data;
    return bufferData.call(gl, target, data, ...others);
  };
  return counted;
}

/** Waits for the GPU. */
const finish = (gl) => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));

function three() {
  const renderer = new WebGLRenderer({ antialias: false });
  renderer.setSize(SIZE, SIZE);
  const loader = new GLTFLoader().register(codesPlugin).setMeshoptDecoder(MeshoptDecoder);
  loader.setDRACOLoader(new DRACOLoader().setDecoderPath(draco));
  const camera = new PerspectiveCamera();
  camera.position.set(0.5, 1, 3);
  const gl = renderer.getContext();
  return {
    counted: counter(gl),
    async load(bytes) {
      const { scene } = await loader.parseAsync(bytes, "");
      renderer.render(new ThreeScene().add(scene, new HemisphereLight()), camera);
      finish(gl);
      return () => scene.traverse(({ geometry }) => geometry?.dispose());
    },
  };
}

function babylon() {
  registerCodes(registerGLTFExtension);
  DracoDecoder.DefaultConfiguration = {
    wasmUrl: `${draco}draco_wasm_wrapper.js`,
    wasmBinaryUrl: `${draco}draco_decoder.wasm`,
    fallbackUrl: `${draco}draco_decoder.js`,
  };
  MeshoptCompression.Configuration = { decoder: { url: `${packages}/meshoptimizer/meshopt_decoder.cjs` } };
  const canvas = Object.assign(document.createElement("canvas"), { width: SIZE, height: SIZE });
  const gl = canvas.getContext("webgl2", { antialias: false });
  const counted = counter(gl);
  const engine = new Engine(gl, false);
  const scene = new Scene(engine);
  new FreeCamera("", new Vector3(0.5, 1, -3), scene);
  new HemisphericLight("", new Vector3(0, 1, 0), scene);
  return {
    counted,
    async load(bytes) {
      const { meshes } = await ImportMeshAsync(new Uint8Array(bytes), scene, { pluginExtension: ".glb" });
      // whenReadyAsync() looks every 100 ms only.
      while (!scene.isReady()) await new Promise((resolve) => setTimeout(resolve));
      scene.render();
      finish(gl);
      return () => meshes[0].dispose(false, true);
    },
  };
}

/** The bytes in vertex buffers and the median time in milliseconds of some loads, for each engine and file. */
export async function measure(names, times) {
  const results = [];
  for (const [engine, { counted, load }] of Object.entries({ three: three(), babylon: babylon() })) {
    for (const name of names) {
      const bytes = await (await fetch(name)).arrayBuffer();
      const taken = [];
      // The first one also compiles shaders and decoders, and does not count.
      for (let i = 0; i <= times; i++) {
        counted.bytes = 0;
        const start = performance.now();
        const dispose = await load(bytes.slice());
        taken.push(performance.now() - start);
        dispose();
      }
      const sorted = taken.slice(1).sort((a, b) => a - b);
      results.push({ engine, name, bytes: counted.bytes, ms: sorted[sorted.length >> 1] });
    }
  }
  return results;
}
