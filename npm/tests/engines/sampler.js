// A linear sampler: what it makes of the square between four texels.

const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
// Pixel k lies k / (SIDE - 1) between the middles of the texels.
const FRAGMENT = (side) => `#version 300 es
precision highp float; precision highp sampler2D;
uniform sampler2D map; out vec4 result;
void main() { result = texture(map, 0.25 + 0.5 * (gl_FragCoord.xy - 0.5) / ${side - 1}.0); }`;

/** x and y of side^2 samples of a texture of two by two texels of two bytes, row by row. */
export function sampled(format, bytes, side) {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
  gl.getExtension("EXT_color_buffer_float");
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT(side)]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  const target = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, target);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, side, side);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
  const data = format === "RG8_SNORM" ? Int8Array.from(bytes) : Uint8Array.from(bytes);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl[format], 2, 2, 0, gl.RG, format === "RG8_SNORM" ? gl.BYTE : gl.UNSIGNED_BYTE, data);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  gl.viewport(0, 0, side, side);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const pixels = new Float32Array(4 * side * side);
  gl.readPixels(0, 0, side, side, gl.RGBA, gl.FLOAT, pixels);
  return [gl.getError(), ...[...pixels].filter((_, i) => i % 4 < 2)];
}
