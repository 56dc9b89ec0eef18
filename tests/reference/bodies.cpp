#include "tests/reference/bodies.h"

#include <cmath>
#include <numbers>

namespace cutis::test {

Primitive makeFineSphere(double radius, int segments) {
    Primitive mesh;
    for (int face = 0; face < 6; ++face) {
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        const int axis = face / 2, row = segments + 1;
        for (int i = 0; i < row * row; ++i) {
            const auto coordinate = [&](int k) {
                return std::tan((double(k) / segments - 0.5) * std::numbers::pi / 2);
            };
            glm::dvec3 d(0);
            d[axis] = face % 2 ? -1 : 1;
            d[(axis + 1) % 3] = coordinate(i % row) * (face % 2 ? -1 : 1);
            d[(axis + 2) % 3] = coordinate(i / row);
            mesh.normals.emplace_back(glm::normalize(d));
            mesh.positions.emplace_back(glm::normalize(d) * radius);
        }
        for (int j = 0; j < segments; ++j) {
            for (int i = 0; i < segments; ++i) {
                const std::uint32_t a = base + static_cast<std::uint32_t>(j * row + i), b = a + 1,
                                    c = a + static_cast<std::uint32_t>(row), d = c + 1;
                mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
            }
        }
    }
    return mesh;
}

Primitive makeHalvedPlate(double size) {
    Primitive mesh;
    const auto half = static_cast<float>(size / 2);
    for (int side = 0; side < 2; ++side) {
        const float left = side == 0 ? -half : 0, right = side == 0 ? 0 : half;
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec2& corner :
             {glm::vec2(left, -half), {right, -half}, {right, half}, {left, half}}) {
            mesh.positions.emplace_back(corner, 0);
            mesh.normals.emplace_back(0, 0, 1);
            mesh.colors.emplace_back(side, side, side, 1);
        }
        mesh.indices.insert(mesh.indices.end(), {base, base + 1, base + 2, base, base + 2, base + 3});
    }
    return mesh;
}

}  // namespace cutis::test
