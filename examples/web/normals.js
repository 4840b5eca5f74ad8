// Encodes and decodes normals with the library's shaders, on each API that the browser has.

import { VECTORS } from "./vectors.js";

const COUNT = VECTORS.length;
const SHADERS = new URL("../../shaders/", import.meta.url);

// The text of a family and of what it needs, joined as the heads of the files say. The exact edition gives the same bits on
// all devices.
async function library(folder, ending) {
    const files = ["arith", "oct"].map(async (name) => {
        const response = await fetch(new URL(`${folder}/exact/${name}.${ending}`, SHADERS));
        if (!response.ok) throw Error(`${response.url}: ${response.status}`);
        return response.text();
    });
    return (await Promise.all(files)).join("\n");
}

const WGSL = `
@group(0) @binding(0) var<storage, read> normals: array<vec3f>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4u>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if i >= arrayLength(&results) { return; }
    let code = oct32_encode(normals[i]);
    results[i] = vec4u(code, bitcast<vec3u>(oct32_decode(code)));
}
`;

// The codes and the bits of the decoded vectors, four words for each normal.
async function onWebGpu() {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) throw Error("not available in this browser");
    const device = await adapter.requestDevice();
    const code = (await library("wgsl", "wgsl")) + WGSL;
    device.pushErrorScope("validation");
    const module = device.createShaderModule({ code });
    const pipeline = device.createComputePipeline({ layout: "auto", compute: { module } });
    const { STORAGE, COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage;
    const size = 16 * COUNT;
    const normals = device.createBuffer({ size, usage: STORAGE | COPY_DST });
    const results = device.createBuffer({ size, usage: STORAGE | COPY_SRC });
    const copy = device.createBuffer({ size, usage: MAP_READ | COPY_DST });
    device.queue.writeBuffer(normals, 0, inputs());
    const entries = [normals, results].map((buffer, binding) => ({ binding, resource: { buffer } }));
    const commands = device.createCommandEncoder();
    const pass = commands.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.dispatchWorkgroups(Math.ceil(COUNT / 64));
    pass.end();
    commands.copyBufferToBuffer(results, 0, copy, 0, size);
    device.queue.submit([commands.finish()]);
    const error = await device.popErrorScope();
    if (error) throw Error(error.message);
    await copy.mapAsync(GPUMapMode.READ);
    return new Uint32Array(copy.getMappedRange().slice());
}

const CORNERS = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
`;

const GLSL = `
precision highp usampler2D;
uniform usampler2D normals;
out uvec4 result;

void main() {
    vec3 normal = uintBitsToFloat(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    uint code = oct32_encode(normal);
    result = uvec4(code, floatBitsToUint(oct32_decode(code)));
}
`;

// The same by a fragment shader: codes go to textures of integers, since those of floats and of unorm convert.
async function onWebGl() {
    const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
    if (!gl) throw Error("not available in this browser");
    const program = gl.createProgram();
    const fragments = `#version 300 es\n${await library("glsl-es", "glsl")}${GLSL}`;
    for (const [type, text] of [[gl.VERTEX_SHADER, CORNERS], [gl.FRAGMENT_SHADER, fragments]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw Error(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw Error(gl.getProgramInfoLog(program));
    const texture = (words) => {
        gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32UI, COUNT, 1, 0, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        return gl.getParameter(gl.TEXTURE_BINDING_2D);
    };
    const results = texture(null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, results, 0);
    texture(inputs());
    gl.viewport(0, 0, COUNT, 1);
    gl.useProgram(program);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const words = new Uint32Array(4 * COUNT);
    gl.readPixels(0, 0, COUNT, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
    return words;
}

// The bits of the normals, four words for each: vec3f has the alignment of four in WGSL, and texels have four components.
function inputs() {
    return new Uint32Array(VECTORS.flatMap(({ normal }) => [...normal, 0]));
}

const floats = (bits) => [...new Float32Array(new Uint32Array(bits).buffer)].map((x) => x.toPrecision(4)).join(", ");
const hex = (code) => code.toString(16).padStart(8, "0");

function cell(row, text, differs) {
    const td = row.insertCell();
    td.textContent = text;
    td.className = differs ? "differs" : "";
}

const rows = VECTORS.map(({ normal, code }) => {
    const row = document.getElementById("vectors").insertRow();
    cell(row, floats(normal), false);
    cell(row, hex(code), false);
    return row;
});

for (const [name, run] of [["WebGPU", onWebGpu], ["WebGL 2", onWebGl]]) {
    let verdict;
    try {
        const words = await run();
        let agreeing = 0;
        VECTORS.forEach(({ code, decoded }, i) => {
            const [given, ...vector] = words.subarray(4 * i, 4 * i + 4);
            const agrees = given === code && vector.every((bits, k) => bits === decoded[k]);
            agreeing += agrees;
            cell(rows[i], `${hex(given)}: ${floats(vector)}`, !agrees);
        });
        verdict = `${agreeing} of ${COUNT} agree to the bit`;
    } catch (error) {
        for (const row of rows) cell(row, "", false);
        verdict = error.message;
    }
    document.getElementById("apis").appendChild(document.createElement("li")).textContent = `${name}: ${verdict}`;
    console.log(`${name}: ${verdict}`);
}
console.log("done");
