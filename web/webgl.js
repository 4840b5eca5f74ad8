// The viewer on WebGL 2; `webgpu.js` has the same functions.

import { glsl } from "./shading.js";

export function startWebGl(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, powerPreference: "high-performance" });
  if (!gl) throw Error("this browser has neither WebGPU nor WebGL 2");
  const view = gl.createBuffer();
  gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, view);
  gl.enable(gl.DEPTH_TEST);
  let [program, objects, count] = [null, null, 0];

  const filled = (target, data) => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return buffer;
  };

  return {
    name: "WebGL 2",
    // Triangles: three floats a vertex in `places` and `normals`.
    setMesh({ places, normals, indices }) {
      objects?.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
      if (objects) gl.deleteVertexArray(objects.array);
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      const buffers = [places, normals].map((data, location) => {
        const buffer = filled(gl.ARRAY_BUFFER, data);
        gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 0, 0);
        gl.enableVertexAttribArray(location);
        return buffer;
      });
      buffers.push(filled(gl.ELEMENT_ARRAY_BUFFER, indices));
      objects = { array, buffers };
      count = indices.length;
    },
    // Two words a vertex, the low one first; null where pixels are encoded.
    setCodes(words) {
      gl.bindVertexArray(objects.array);
      gl.deleteBuffer(objects.codes ?? null);
      objects.codes = null;
      gl.disableVertexAttribArray(2);
      gl.vertexAttribI4ui(2, 0, 0, 0, 0);
      if (!words) return;
      objects.codes = filled(gl.ARRAY_BUFFER, words);
      gl.vertexAttribIPointer(2, 2, gl.UNSIGNED_INT, 0, 0);
      gl.enableVertexAttribArray(2);
    },
    async setCodec(library, codec) {
      const made = gl.createProgram();
      glsl(library, codec).forEach((text, stage) => {
        const shader = gl.createShader([gl.VERTEX_SHADER, gl.FRAGMENT_SHADER][stage]);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(made, shader);
        gl.deleteShader(shader);
      });
      gl.linkProgram(made);
      if (!gl.getProgramParameter(made, gl.LINK_STATUS)) {
        const logs = gl.getAttachedShaders(made).map((shader) => gl.getShaderInfoLog(shader));
        throw Error(`WebGL 2 refuses the shader: ${logs.join("")}${gl.getProgramInfoLog(made)}`);
      }
      gl.deleteProgram(program);
      program = made;
      gl.uniformBlockBinding(program, gl.getUniformBlockIndex(program, "View"), 0);
    },
    // `uniforms` are those of the shaders' `View`.
    draw(uniforms, background) {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(...background, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      if (!program || !objects) return;
      gl.bindBuffer(gl.UNIFORM_BUFFER, view);
      gl.bufferData(gl.UNIFORM_BUFFER, uniforms, gl.DYNAMIC_DRAW);
      gl.useProgram(program);
      gl.bindVertexArray(objects.array);
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    },
    // Resolves when all is drawn.
    async finish() {
      const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      gl.flush();
      while (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise((resolve) => setTimeout(resolve));
    },
  };
}
