// Vertices with packed normals, and an array of tangent frames, in C++17.
//
//     c++ -std=c++17 vertices.cpp $(pkg-config --cflags --libs unitvec) -o vertices

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <unitvec.h>
#include <vector>

namespace {

struct Vertex {
    float position[3];
    unitvec_vec3 normal;
    float uv[2];
};

struct PackedVertex {
    float position[3];
    std::uint32_t normal; // VK_FORMAT_R16G16_SNORM
    float uv[2];
};

// The codec of arrays, with exceptions for errors. Vectors and frames are arrays of floats to it.
class Codec {
public:
    explicit Codec(const char *id) : codec(unitvec_find(id)) {
        if (codec == nullptr) {
            throw std::invalid_argument(std::string("no codec ") + id);
        }
    }

    template <typename Element> std::vector<unsigned char> encode(const std::vector<Element> &elements) const {
        expect_floats(sizeof(Element) / sizeof(float));
        std::vector<unsigned char> codes(elements.size() * unitvec_codec_bytes(codec));
        check(unitvec_encode(codec, floats(elements.data()), elements.size(), codes.data(), codes.size()));
        return codes;
    }

    void encode(const unitvec_elements &from, std::size_t count, void *codes, std::size_t stride) const {
        check(unitvec_encode_strided(codec, &from, count, codes, stride, nullptr));
    }

    template <typename Element> std::vector<Element> decode(const std::vector<unsigned char> &codes) const {
        expect_floats(sizeof(Element) / sizeof(float));
        std::vector<Element> elements(codes.size() / unitvec_codec_bytes(codec));
        check(unitvec_decode(codec, codes.data(), codes.size(), floats(elements.data()), elements.size()));
        return elements;
    }

private:
    static const float *floats(const void *elements) { return static_cast<const float *>(elements); }
    static float *floats(void *elements) { return static_cast<float *>(elements); }

    void expect_floats(std::size_t count) const {
        if (count != unitvec_codec_floats(codec)) {
            throw std::invalid_argument(std::string(unitvec_codec_id(codec)) + " is not a codec of these elements");
        }
    }

    static void check(unitvec_status status) {
        if (status != UNITVEC_OK) {
            throw std::runtime_error(unitvec_status_text(status));
        }
    }

    const unitvec_codec *codec;
};

std::vector<Vertex> ring(int count) {
    std::vector<Vertex> vertices;
    for (int i = 0; i < count; i++) {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(count);
        const float x = std::cos(angle), y = std::sin(angle);
        vertices.push_back({{x, y, 0.0f}, {x, y, 0.0f}, {angle, 0.0f}});
    }
    return vertices;
}

} // namespace

int main() {
    std::vector<Vertex> vertices = ring(256);

    std::vector<PackedVertex> packed;
    for (const auto &[position, normal, uv] : vertices) {
        packed.push_back({{position[0], position[1], position[2]}, 0, {uv[0], uv[1]}});
    }
    // From one kind of vertices to the other: a pointer to each component of the first normal, and the stride.
    unitvec_vec3 &first = vertices[0].normal;
    const unitvec_elements normals = {{&first.x, &first.y, &first.z}, sizeof(Vertex), 0, UNITVEC_FLOAT32};
    Codec("oct32").encode(normals, vertices.size(), &packed[0].normal, sizeof(PackedVertex));
    if (packed[9].normal != unitvec_oct32_encode(vertices[9].normal)) {
        return 1;
    }
    std::printf("%zu vertices: %zu bytes, packed %zu\n", vertices.size(), vertices.size() * sizeof(Vertex),
                packed.size() * sizeof(PackedVertex));

    // About each normal the tangent runs along +Z.
    std::vector<unitvec_frame> frames;
    for (const Vertex &vertex : vertices) {
        frames.push_back({vertex.normal, {0.0f, 0.0f, 1.0f}, 1.0f});
    }
    const Codec codec("frame32");
    const std::vector<unsigned char> codes = codec.encode(frames);
    std::printf("frames: %zu bytes, packed %zu\n", frames.size() * sizeof(unitvec_frame), codes.size());
    const std::vector<unitvec_frame> decoded = codec.decode<unitvec_frame>(codes);
    for (std::size_t i = 0; i < frames.size(); i++) {
        const unitvec_vec3 a = frames[i].normal, b = decoded[i].normal;
        if (a.x * b.x + a.y * b.y + a.z * b.z < 0.9999f || decoded[i].handedness != 1.0f) {
            return 1;
        }
    }

    const std::vector<unsigned char> too_few(codes.begin(), codes.end() - 1);
    try {
        (void)codec.decode<unitvec_frame>(too_few);
    } catch (const std::runtime_error &error) {
        std::printf("too few bytes: %s\n", error.what());
        return 0;
    }
    return 1;
}
