// What a primitive needs to be drawn that its file may lack: clean triangles, normals, tangents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis {

struct RepairCounts {
    std::size_t nonfinite = 0;   // triangles dropped for a position that is NaN or infinite
    std::size_t degenerate = 0;  // triangles dropped for having no area
};

// Drops triangles with a vertex that is not finite and those without area. Indices must be in range. With `keepFlat`, of
// a shape that morph targets may unfold, only those without area go whose corners are not three vertices.
RepairCounts dropBadTriangles(Primitive& primitive, bool keepFlat = false);

// Drops vertices that no triangle uses; the others keep their order. Returns which vertex each of them was.
std::vector<std::uint32_t> dropUnusedVertices(Primitive& primitive);

// Makes every normal unit length. Where one is missing, zero or not finite it becomes the mean of the normals
// of the triangles around it, each weighted by its angle there (Thürmer & Wüthrich 1998). When the primitive
// has no normals at all, `smooth` shares them between vertices at one place, so that no seam of the texture
// coordinates shows.
void completeNormals(Primitive& primitive, bool smooth);

// Tangents for the texture coordinates that `slot` samples with: the direction in which u' grows, weighted by
// angle as MikkTSpace does, and in w the sign that makes cross(N, T) · w the direction in which v' falls
// (glTF's green is up, its v goes down). Vertices where mirrored triangles meet are split. Without usable
// texture coordinates any tangent is taken. Returns which vertices the ones that this appended are copies of.
std::vector<std::uint32_t> computeTangents(Primitive& primitive, const TextureSlot& slot);

}  // namespace cutis
