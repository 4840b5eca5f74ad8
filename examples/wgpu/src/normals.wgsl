// Encodes normals, and decodes their codes. The functions of oct32 stand before this text, or are imported.

@group(0) @binding(0) var<storage, read> normals: array<f32>;
@group(0) @binding(1) var<storage, read_write> codes: array<u32>;
@group(0) @binding(2) var<storage, read_write> decoded: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if i >= arrayLength(&codes) {
        return;
    }
    let code = oct32_encode(vec3f(normals[3u * i], normals[3u * i + 1u], normals[3u * i + 2u]));
    let normal = oct32_decode(code);
    codes[i] = code;
    decoded[3u * i] = normal.x;
    decoded[3u * i + 1u] = normal.y;
    decoded[3u * i + 2u] = normal.z;
}
