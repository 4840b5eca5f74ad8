// PlayCanvas: WebGL 2.
import * as pc from "playcanvas";
import { codesElement, useCodes } from "unitvec/playcanvas";
import { WIDTH, HEIGHT, MAPPED, compare, meshOfServer, normalMap } from "./common.js";

const canvas = Object.assign(document.createElement("canvas"), { width: WIDTH, height: HEIGHT });
const app = new pc.Application(canvas, { graphicsDeviceOptions: { antialias: false, preserveDrawingBuffer: true } });
const { gl } = app.graphicsDevice;

const entity = (type, options, place) => {
  const made = new pc.Entity();
  made.addComponent(type, options);
  place?.(made);
  app.root.addChild(made);
  return made;
};

function meshOf(arrays, codec, isMapped) {
  const count = arrays.positions.length / 3;
  const float = (semantic, components) => ({ semantic, components, type: pc.TYPE_FLOAT32 });
  const elements = [
    [float(pc.SEMANTIC_POSITION, 3), arrays.positions],
    [codec ? codesElement(codec) : float(pc.SEMANTIC_NORMAL, 3), arrays[codec ?? "normals"]],
    ...(isMapped ? [[float(pc.SEMANTIC_TEXCOORD0, 2), arrays.uvs]] : []),
    ...(isMapped && codec !== "frame32" ? [[float(pc.SEMANTIC_TANGENT, 4), arrays.tangents]] : []),
  ];
  // With a number of vertices the elements lie one after the other, each from a multiple of 4 bytes.
  const described = elements.map(([element]) => element);
  const format = new pc.VertexFormat(app.graphicsDevice, described, count);
  const bytes = new Uint8Array(format.verticesByteSize);
  for (const [{ semantic }, { buffer, byteOffset, byteLength }] of elements) {
    const { offset } = format.elements.find(({ name }) => name === semantic);
    bytes.set(new Uint8Array(buffer, byteOffset, byteLength), offset);
  }
  const mesh = new pc.Mesh(app.graphicsDevice);
  mesh.vertexBuffer = new pc.VertexBuffer(app.graphicsDevice, format, count, { data: bytes.buffer });
  const size = arrays.index.length;
  mesh.indexBuffer[0] = new pc.IndexBuffer(app.graphicsDevice, pc.INDEXFORMAT_UINT32, size, pc.BUFFER_STATIC, arrays.index.buffer);
  mesh.primitive[0] = { type: pc.PRIMITIVE_TRIANGLES, base: 0, count: size, indexed: true };
  mesh.aabb = new pc.BoundingBox(new pc.Vec3(), new pc.Vec3(2, 2, 2));
  return mesh;
}

export async function rows() {
  const arrays = await meshOfServer();
  app.setCanvasResolution(pc.RESOLUTION_FIXED, WIDTH, HEIGHT);
  entity("camera", { clearColor: new pc.Color(0, 0, 0), fov: 45 }, (camera) => camera.setPosition(0, 0, 4.2));
  entity("light", { type: "directional", intensity: 2 }, (light) => light.setEulerAngles(40, 30, 0));
  app.scene.ambientLight = new pc.Color(0.2, 0.2, 0.3);
  app.start();
  app.autoRender = false;
  const options = { width: 64, height: 64, mipmaps: false, levels: [normalMap()] };
  const bumps = new pc.Texture(app.graphicsDevice, options);

  return compare(["Standard", `Standard${MAPPED}`], async (name, codec) => {
    const isMapped = name.endsWith(MAPPED);
    const material = Object.assign(new pc.StandardMaterial(), { diffuse: new pc.Color(0.8, 0.8, 1), gloss: 0.7 });
    if (isMapped) material.normalMap = bumps;
    if (codec) useCodes(material, codec, app.graphicsDevice);
    material.update();
    const instance = new pc.MeshInstance(meshOf(arrays, codec, isMapped), material);
    const object = entity("render", { meshInstances: [instance] });
    app.renderNextFrame = true;
    await new Promise((resolve) => app.once("frameend", resolve));
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const pixels = new Uint8Array(WIDTH * HEIGHT * 4);
    gl.readPixels(0, 0, WIDTH, HEIGHT, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    object.destroy();
    return pixels;
  });
}
