// The viewer's shaders. What both languages share is written once, in WGSL; `asGlsl` rewrites it.

const SHARED = `
fn sky(d: vec3f) -> vec3f {
    let floor: vec3f = mix(vec3f(0.05, 0.05, 0.06), vec3f(0.34, 0.30, 0.27), smoothstep(-0.9, 0.0, d.y));
    let air: vec3f = mix(vec3f(0.50, 0.52, 0.54), vec3f(0.05, 0.09, 0.15), smoothstep(0.0, 0.75, d.y));
    let p: vec2f = d.xz / (abs(d.y) + 0.25);
    let across: f32 = abs(fract(p.x * 1.6 + 0.5) - 0.5);
    let along: f32 = smoothstep(0.08, 0.11, abs(fract(p.y * 0.5) - 0.5));
    let reach: f32 = 1.0 - smoothstep(1.9, 2.4, max(abs(p.x), abs(p.y)));
    let lamps: f32 = (1.0 - smoothstep(0.17, 0.20, across)) * along * reach * smoothstep(0.0, 0.06, d.y);
    let glow: vec3f = mix(vec3f(1.0, 0.86, 0.68), vec3f(0.72, 0.88, 1.0), smoothstep(-0.8, 0.8, p.x));
    let joints: f32 = smoothstep(0.455, 0.475, max(abs(fract(p.x * 2.0) - 0.5), abs(fract(p.y * 2.0) - 0.5)));
    let ground: f32 = joints * (1.0 - smoothstep(-0.25, -0.08, d.y));
    let base: vec3f = mix(floor + vec3f(0.13, 0.14, 0.16) * ground, air, smoothstep(-0.02, 0.02, d.y));
    return mix(base, glow * 1.05, lamps);
}

fn heat(t: f32) -> vec3f {
    let low: vec3f = mix(vec3f(0.06, 0.05, 0.22), vec3f(0.53, 0.11, 0.42), clamp(t * 3.0, 0.0, 1.0));
    let high: vec3f = mix(low, vec3f(0.95, 0.42, 0.18), clamp(t * 3.0 - 1.0, 0.0, 1.0));
    return mix(high, vec3f(0.99, 0.93, 0.60), clamp(t * 3.0 - 2.0, 0.0, 1.0));
}

fn mirror(n: vec3f, e: vec3f) -> vec3f {
    return sky(reflect(-e, n)) * vec3f(0.92, 0.93, 0.95);
}

fn gloss(n: vec3f, e: vec3f) -> vec3f {
    let key: vec3f = normalize(vec3f(0.35, 0.75, 0.56));
    let side: vec3f = normalize(vec3f(-0.85, 0.25, 0.46));
    let body: vec3f = vec3f(0.10, 0.22, 0.36) * (0.25 + 0.75 * max(dot(n, key), 0.0) + 0.35 * max(dot(n, side), 0.0));
    let warm: f32 = pow(max(dot(n, normalize(key + e)), 0.0), 500.0);
    let cool: f32 = pow(max(dot(n, normalize(side + e)), 0.0), 250.0);
    return body + vec3f(1.0, 0.96, 0.9) * (1.2 * warm) + vec3f(0.5, 0.7, 1.0) * (0.6 * cool);
}

fn facing(e: vec3f, n: vec3f) -> vec3f {
    let x: vec3f = normalize(cross(vec3f(0.0, 1.0, 0.0001), e));
    return vec3f(dot(n, x), dot(n, cross(e, x)), max(dot(n, e), 0.0));
}

fn unfaced(e: vec3f, n: vec3f) -> vec3f {
    let x: vec3f = normalize(cross(vec3f(0.0, 1.0, 0.0001), e));
    return n.x * x + n.y * cross(e, x) + n.z * e;
}

fn error(n: vec3f, plain: vec3f, scale: f32) -> vec3f {
    return heat(2.0 * asin(min(0.5 * length(n - plain), 1.0)) * scale);
}
`;

const asGlsl = (wgsl) =>
  wgsl
    .replace(/fn (\w+)\((.*)\) -> (\w+) \{/g, (_, name, list, type) => `${type} ${name}(${list.replace(/(\w+): (\w+)/g, "$2 $1")}) {`)
    .replace(/let (\w+): (\w+) =/g, "$2 $1 =")
    .replace(/\bvec([234])f\b/g, "vec$1")
    .replace(/\bf32\b/g, "float");

// Statements that make `back`, the coded normal, in words of either language, and the way from there to the normal.
function glue({ id, bits, frame, hemisphere, dither, at }, isWgsl) {
  const [vec3, vec4, uvec2] = isWgsl ? ["vec3f", "vec4f", "vec2u"] : ["vec3", "vec4", "uvec2"];
  const variable = (type, name) => (isWgsl ? `var ${name}: ${type};` : `${type} ${name};`);
  const normal = hemisphere ? "facing(e, plain)" : "plain";
  const input = frame ? `${normal}, ${vec4}(cross(${normal}, ${vec3}(0.0, 1.0, 0.0)), 1.0)` : normal;
  const code = at === "vertex" ? `code${bits > 32 ? "" : ".x"}` : `${id}_encode(${input})`;
  const offset = `dither_from_pixel(${uvec2}(pixel.xy))`;
  const decoded = dither ? `${id}_decode_dithered(${id}_encode_dithered(${normal}, ${offset}), ${offset})` : `${id}_decode(${code})`;
  const made = frame
    ? `${variable(vec4, "tangent")} ${id}_decode(${code}, ${isWgsl ? "&back, &tangent" : "back, tangent"});`
    : `back = ${decoded};`;
  return { declared: variable(vec3, "back"), made, turned: hemisphere ? "unfaced(e, back)" : "back" };
}

// The end of both fragment shaders: `plain`, `e` and `pixel` are there; the float's normal is left of the split.
function ending(codec, { declared, made, turned }, how, isWgsl) {
  const coded = codec.at === "vertex" ? "" : made;
  return `${isWgsl ? "var n = plain;" : "vec3 n = plain;"}
    ${codec.at === "vertex" ? "" : declared}
    if (pixel.x >= ${how}.x) { ${coded} n = normalize(${turned}); }
    // Nearly the curve of sRGB.
    ${isWgsl ? "var" : "vec3"} light = sqrt(${codec.show === "gloss" ? "gloss(n, e)" : "mirror(n, e)"});
    ${codec.show === "error" ? `if (pixel.x >= ${how}.x) { light = error(n, plain, ${how}.y); }` : ""}`;
}

// Shaders of WebGPU: positions, normals and codes at locations 0 to 2.
export function wgsl(library, codec) {
  const glued = glue(codec, true);
  const inVertex = codec.at === "vertex";
  return `${library}
${SHARED}
struct View { clip: mat4x4f, eye: vec4f, how: vec4f }
@group(0) @binding(0) var<uniform> view: View;
struct Between { @builtin(position) pixel: vec4f, @location(0) place: vec3f, @location(1) plain: vec3f, @location(2) back: vec3f }
@vertex fn at_vertex(@location(0) place: vec3f, @location(1) plain: vec3f, @location(2) code: vec2u) -> Between {
    ${inVertex ? glued.declared + glued.made : "let back = plain;"}
    return Between(view.clip * vec4f(place, 1.0), place, plain, back);
}
@fragment fn at_pixel(v: Between) -> @location(0) vec4f {
    let e = normalize(view.eye.xyz - v.place);
    let plain = normalize(v.plain);
    let pixel = v.pixel;
    ${inVertex ? "let back = v.back;" : ""}
    ${ending(codec, glued, "view.how", true)}
    return vec4f(light, 1.0);
}`;
}

// Shaders of WebGL 2: that of vertices and that of pixels.
export function glsl(library, codec) {
  const glued = glue(codec, false);
  const inVertex = codec.at === "vertex";
  const head = `#version 300 es
precision highp float; precision highp int;
layout(std140) uniform View { mat4 clip; vec4 eye; vec4 how; };
`;
  return [
    `${head}${inVertex ? library : ""}
layout(location = 0) in vec3 place_in; layout(location = 1) in vec3 plain_in; layout(location = 2) in uvec2 code;
out vec3 place; out vec3 plain_out; out vec3 back_out;
void main() {
    ${inVertex ? glued.declared + glued.made : "vec3 back = plain_in;"}
    place = place_in; plain_out = plain_in; back_out = back;
    gl_Position = clip * vec4(place, 1.0);
}`,
    `${head}${inVertex ? "" : library}
${asGlsl(SHARED)}
in vec3 place; in vec3 plain_out; in vec3 back_out;
out vec4 colour;
void main() {
    vec3 e = normalize(eye.xyz - place); vec3 plain = normalize(plain_out);
    vec2 pixel = vec2(gl_FragCoord.x, eye.w - gl_FragCoord.y);
    ${inVertex ? "vec3 back = back_out;" : ""}
    ${ending(codec, glued, "how", false)}
    colour = vec4(light, 1.0);
}`,
  ];
}
