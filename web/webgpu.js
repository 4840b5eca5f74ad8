// The viewer on WebGPU; `webgl.js` describes the functions.

import { wgsl } from "./shading.js";

const SAMPLES = 4;

export async function startWebGpu(canvas, onLoss) {
  const adapter = await navigator.gpu?.requestAdapter();
  const device = await adapter?.requestDevice();
  if (!device) return null;
  const context = canvas.getContext("webgpu");
  const format = navigator.gpu.getPreferredCanvasFormat();
  context.configure({ device, format, alphaMode: "opaque" });
  // Some browsers have a device that canvases cannot use, and lose it now.
  context.getCurrentTexture();
  if (await Promise.race([device.lost, device.queue.onSubmittedWorkDone()])) return null;
  device.lost.then(({ message }) => onLoss(message));
  const { VERTEX, INDEX, UNIFORM, COPY_DST } = GPUBufferUsage;
  const view = device.createBuffer({ size: 96, usage: UNIFORM | COPY_DST });
  let [pipeline, group, mesh, targets] = [null, null, null, null];

  const filled = (data, usage) => {
    const buffer = device.createBuffer({ size: Math.max(data.byteLength, 8), usage: usage | COPY_DST });
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
  };
  const sized = () => {
    const size = [canvas.width, canvas.height];
    if (targets?.size.join() === size.join()) return targets;
    targets?.textures.forEach((texture) => texture.destroy());
    const usage = GPUTextureUsage.RENDER_ATTACHMENT;
    const textures = [format, "depth24plus"].map((of) => device.createTexture({ size, format: of, sampleCount: SAMPLES, usage }));
    targets = { size, textures, views: textures.map((texture) => texture.createView()) };
    return targets;
  };
  const attribute = (shaderLocation, of, arrayStride) => ({ arrayStride, attributes: [{ shaderLocation, format: of, offset: 0 }] });

  return {
    name: "WebGPU",
    setMesh({ places, normals, indices }) {
      mesh?.buffers.forEach((buffer) => buffer.destroy());
      const buffers = [filled(places, VERTEX), filled(normals, VERTEX), filled(new Uint32Array(2), VERTEX), filled(indices, INDEX)];
      mesh = { buffers, count: indices.length };
    },
    setCodes(words) {
      mesh.buffers[2].destroy();
      mesh.buffers[2] = filled(words ?? new Uint32Array(2), VERTEX);
    },
    async setCodec(library, codec) {
      const module = device.createShaderModule({ code: wgsl(library, codec) });
      // Without codes all vertices read the same two words.
      const buffers = [attribute(0, "float32x3", 12), attribute(1, "float32x3", 12), attribute(2, "uint32x2", codec.at === "vertex" ? 8 : 0)];
      const made = await device.createRenderPipelineAsync({
        layout: "auto",
        vertex: { module, entryPoint: "at_vertex", buffers },
        fragment: { module, entryPoint: "at_pixel", targets: [{ format }] },
        depthStencil: { format: "depth24plus", depthWriteEnabled: true, depthCompare: "less" },
        multisample: { count: SAMPLES },
      });
      pipeline = made;
      group = device.createBindGroup({ layout: made.getBindGroupLayout(0), entries: [{ binding: 0, resource: { buffer: view } }] });
    },
    draw(uniforms, background) {
      device.queue.writeBuffer(view, 0, uniforms);
      const { views } = sized();
      const commands = device.createCommandEncoder();
      const [r, g, b] = background;
      const pass = commands.beginRenderPass({
        colorAttachments: [
          {
            view: views[0],
            resolveTarget: context.getCurrentTexture().createView(),
            clearValue: { r, g, b, a: 1 },
            loadOp: "clear",
            storeOp: "discard",
          },
        ],
        depthStencilAttachment: { view: views[1], depthClearValue: 1, depthLoadOp: "clear", depthStoreOp: "discard" },
      });
      if (pipeline && mesh) {
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        mesh.buffers.slice(0, 3).forEach((buffer, slot) => pass.setVertexBuffer(slot, buffer));
        pass.setIndexBuffer(mesh.buffers[3], "uint32");
        pass.drawIndexed(mesh.count);
      }
      pass.end();
      device.queue.submit([commands.finish()]);
    },
    finish: () => device.queue.onSubmittedWorkDone(),
  };
}
