// GLSL ES 3.00, in a context of WebGL 2: one fragment for each element, whose words are two texels.

const COLUMNS = 256;
const CORNERS = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
`;

export function open() {
    const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
    if (!gl) throw Error("no WebGL 2");
    const info = gl.getExtension("WEBGL_debug_renderer_info");
    return new Device(gl, info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : gl.getParameter(gl.RENDERER));
}

class Device {
    constructor(gl, name) {
        this.gl = gl;
        this.name = name;
    }

    // Warnings are errors.
    shader(type, text) {
        const { gl } = this;
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        const log = gl.getShaderInfoLog(shader);
        if (log || !gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw Error(log);
        return shader;
    }

    program(text) {
        const { gl } = this;
        const program = gl.createProgram();
        const shaders = [this.shader(gl.VERTEX_SHADER, CORNERS), this.shader(gl.FRAGMENT_SHADER, text)];
        for (const shader of shaders) gl.attachShader(program, shader);
        gl.linkProgram(program);
        const log = gl.getProgramInfoLog(program);
        if (log || !gl.getProgramParameter(program, gl.LINK_STATUS)) throw Error(log);
        for (const shader of shaders) gl.deleteShader(shader);
        return program;
    }

    texture(width, height, words) {
        const { gl } = this;
        const texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.texImage2D(
            gl.TEXTURE_2D, 0, gl.RGBA32UI, width, height, 0, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words
        );
        return texture;
    }

    run(job, input) {
        const { gl } = this;
        const rows = Math.ceil(job.count / COLUMNS);
        const texels = new Uint32Array(COLUMNS * rows * 8);
        for (let i = 0; i < job.count; ++i) {
            texels.set(input.subarray(i * job.read, (i + 1) * job.read), 8 * i);
        }
        const program = this.program(job.text);
        const targets = [0, 1].map(() => this.texture(COLUMNS, rows, null));
        const source = this.texture(2 * COLUMNS, rows, texels);
        const frame = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        const attachments = [gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1];
        attachments.forEach((attachment, n) =>
            gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, targets[n], 0)
        );
        gl.drawBuffers(attachments);
        gl.viewport(0, 0, COLUMNS, rows);
        gl.useProgram(program);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        const results = attachments.map((attachment) => {
            const words = new Uint32Array(COLUMNS * rows * 4);
            gl.readBuffer(attachment);
            gl.readPixels(0, 0, COLUMNS, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
            return words;
        });
        const error = gl.getError();
        for (const texture of [source, ...targets]) gl.deleteTexture(texture);
        gl.deleteFramebuffer(frame);
        gl.deleteProgram(program);
        if (error) throw Error(`WebGL error ${error}`);
        const output = new Uint32Array(job.count * job.written);
        for (let i = 0; i < job.count; ++i) {
            for (let word = 0; word < job.written; ++word) {
                output[i * job.written + word] = results[word >> 2][4 * i + (word & 3)];
            }
        }
        return output;
    }
}
