#include "tests/support/awkward_layouts.h"

#include <cmath>

namespace cutis::test {

Primitive mirrored(Primitive body) {
    for (glm::vec2& uv : body.uv0) uv.x = std::abs(uv.x - 0.5f);
    return body;
}

Primitive bare(Primitive body) {
    body.uv0.clear();
    return body;
}

Primitive squeezed(Primitive body) {
    for (glm::vec2& uv : body.uv0) uv = glm::vec2(0.5);
    return body;
}

Primitive stacked(Primitive body) {
    const std::size_t face = body.uv0.size() / 6;
    for (std::size_t v = 0; v < body.uv0.size(); ++v) body.uv0[v] = body.uv0[v % face];
    return body;
}

Primitive tiled(Primitive body) {
    const std::size_t face = body.uv0.size() / 6;
    for (std::size_t v = 0; v < body.uv0.size(); ++v) body.uv0[v] += glm::vec2(float(v / face) * 100, -7);
    return body;
}

Primitive uneven(Primitive body) {
    for (std::size_t v = 0; v < body.uv0.size() / 6; ++v) body.uv0[v] *= 0.1f;
    return body;
}

Primitive shattered(const Primitive& body) {
    Primitive result;
    result.material = body.material;
    for (std::uint32_t i = 0; i < body.indices.size(); ++i) {
        result.positions.push_back(body.positions[body.indices[i]]);
        result.normals.push_back(body.normals[body.indices[i]]);
        const glm::vec2 corner(i % 3 == 1, i % 3 == 2), row(float(i / 3 % 97), float(i / 3 / 97));
        result.uv0.push_back((corner + row) * 0.01f);
        result.indices.push_back(i);
    }
    return result;
}

}  // namespace cutis::test
