// Babylon.js: WebGL 2.
import {
  Color3,
  Color4,
  DirectionalLight,
  Engine,
  FreeCamera,
  HemisphericLight,
  ImportMeshAsync,
  Mesh,
  PBRMaterial,
  RawTexture,
  RenderTargetTexture,
  Scene,
  StandardMaterial,
  Vector3,
  VertexBuffer,
} from "@babylonjs/core";
import { registerGLTFExtension } from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry.js";
import "@babylonjs/loaders/glTF/2.0/index.js";
import { registerCodes, setCodes, useCodes } from "unitvec/babylon";
import { WIDTH, HEIGHT, MAPPED, compare, meshOfServer, normalMap } from "./common.js";

const canvas = Object.assign(document.createElement("canvas"), { width: WIDTH, height: HEIGHT });
const engine = new Engine(canvas, false);
const classes = { Standard: StandardMaterial, PBR: PBRMaterial };

export async function rows() {
  const arrays = await meshOfServer();
  registerCodes(registerGLTFExtension);

  const made = (name, codec, scene) => {
    const mesh = new Mesh("", scene);
    const set = (kind, array, size) => mesh.setVerticesBuffer(new VertexBuffer(engine, array, kind, false, false, size));
    const isMapped = name.endsWith(MAPPED);
    set("position", arrays.positions, 3);
    if (isMapped) set("uv", arrays.uvs, 2);
    if (isMapped && codec !== "frame32") set("tangent", arrays.tangents, 4);
    if (codec) setCodes(mesh, arrays[codec], codec);
    else set("normal", arrays.normals, 3);
    mesh.setIndices(arrays.index, arrays.positions.length / 3);
    const material = new classes[name.replace(MAPPED, "")]("", scene);
    material.backFaceCulling = false;
    if (material instanceof PBRMaterial) {
      Object.assign(material, { metallic: 0.3, roughness: 0.25, albedoColor: new Color3(0.8, 0.8, 1) });
    }
    if (isMapped) material.bumpTexture = RawTexture.CreateRGBATexture(normalMap(), 64, 64, scene);
    mesh.material = codec ? useCodes(material, codec) : material;
    return [mesh];
  };

  return compare(["Standard", "PBR", `Standard${MAPPED}`, `PBR${MAPPED}`, "glTF"], async (name, codec) => {
    const scene = new Scene(engine);
    scene.clearColor = new Color4(0, 0, 0, 1);
    const camera = new FreeCamera("", new Vector3(0, 0, -4.2), scene);
    camera.setTarget(Vector3.Zero());
    new DirectionalLight("", new Vector3(-1, -2, 3), scene).intensity = 2;
    new HemisphericLight("", new Vector3(0, 1, 0), scene).intensity = 0.3;
    const url = `/mesh/${codec ?? "floats"}.glb`;
    const meshes = name === "glTF" ? (await ImportMeshAsync(url, scene)).meshes : made(name, codec, scene);
    await scene.whenReadyAsync();
    const target = new RenderTargetTexture("", { width: WIDTH, height: HEIGHT }, scene, false);
    Object.assign(target, { activeCamera: camera, renderList: meshes });
    scene.render();
    while (!target.isReadyForRendering()) await new Promise((resolve) => setTimeout(resolve, 20));
    target.render();
    const pixels = new Uint8Array((await target.readPixels()).buffer);
    scene.dispose();
    return pixels;
  });
}
