// The scene's triangles where they stand in the world, relative to its centre.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis::reference {

// One primitive of one node. Positions are rounded to float32 once, since Embree computes with it; everything
// else takes these rounded positions for exact.
struct PlacedMesh {
    const Scene* scene = nullptr;
    const Material* material = nullptr;
    int character = -1;  // index into Scene::characters
    bool skin = false;   // of a character
    std::vector<std::array<float, 4>>
        positions;                          // metres from the scene's centre; the fourth pads for Embree
    std::vector<glm::dvec3> restPositions;  // world, at rest; only of skin with pores
    std::vector<glm::dvec3> normals;        // unit
    std::vector<glm::dvec4> tangents;       // or empty
    const Primitive* primitive = nullptr;   // texture coordinates and colours
    std::vector<std::uint32_t> indices;     // three a triangle, counter-clockwise seen from the front

    glm::dvec3 position(std::uint32_t vertex) const {
        const std::array<float, 4>& p = positions[vertex];
        return {p[0], p[1], p[2]};
    }
    std::array<std::uint32_t, 3> triangle(std::uint32_t t) const {
        return {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]};
    }
    // Barycentric interpolation; (u, v) weigh the second and third vertex.
    glm::dvec2 uvAt(int texCoord, std::uint32_t t, double u, double v) const;
    glm::dvec4 colorAt(std::uint32_t t, double u, double v) const;
    // Coverage in [0,1]: of a blended material as it is, of a masked one 0 or 1.
    double alphaAt(std::uint32_t t, double u, double v) const;
};

struct PlacedScene {
    glm::dvec3 origin{0};  // world place of zero: the centre of the scene's bounds
    double radius = 0;     // of a ball round it that holds everything
    std::vector<PlacedMesh> meshes;
};

PlacedScene placeScene(const Scene& scene);

}  // namespace cutis::reference
