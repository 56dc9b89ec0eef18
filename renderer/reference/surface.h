// A point of a surface with all that light needs to know of it.
#pragma once

#include <glm/glm.hpp>

#include "renderer/reference/ray_scene.h"

namespace cutis::reference {

struct SurfacePoint {
    const PlacedMesh* mesh = nullptr;
    const Material* material = nullptr;
    glm::dvec3 position{0};  // metres from the scene's centre, on the flat triangle
    glm::dvec3 face{0};      // unit normal of the triangle
    glm::dvec3 smooth{0};    // interpolated vertex normals: the surface that the mesh stands for
    glm::dvec3 normal{0};    // with the normal map, once it is read
    glm::dvec3 outside{0};   // where rays from this point start
    glm::dvec4 base{1};      // base colour, texture and vertex colour multiplied, once they are read
};

// The point of a hit, seen from its front or, with `fromBack`, from its back, which turns all normals round.
//
// Rays start where the smooth surface lies (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II,
// 2021, ch. 4), so that facets do not shade themselves where light grazes them, and a bound on rounding above
// it.
SurfacePoint surfaceAt(const RayScene& rays, const Hit& hit, bool fromBack = false);

// Reads base colour and normal map at the same hit, which costs as much again: until then `normal` is the
// smooth one.
void readTextures(SurfacePoint& point, const Hit& hit, bool fromBack = false);

// The albedo of the model: base colour in [0,1].
inline glm::dvec3 albedoOf(const SurfacePoint& point) {
    return glm::clamp(glm::dvec3(point.base), 0.0, 1.0);
}

// The smooth normal as a normal map of the material turns it; as it is where the slot or the tangents are missing.
glm::dvec3 mappedNormal(const Hit& hit, const TextureSlot& slot, double scale, const glm::dvec3& smooth,
                        bool fromBack);

// The texture of a slot there; white when the slot is empty.
glm::dvec4 textureAt(const Hit& hit, const TextureSlot& slot);

}  // namespace cutis::reference
