// The skin as the surface that it is, whatever its texture coordinates cut it into: which triangles meet where, and the
// islands of the layout.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/frame/geometry.h"

namespace cutis {

// Side `side` of triangle t, from its vertex `side` to the next, is half-edge 3·t + side.
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge kNoHalfEdge = 0xffffffffu;

// A connected part of the layout: triangles of one character and material that share vertices of one place in it.
struct UvIsland {
    std::vector<std::uint32_t> triangles;
    bool continued = false;  // somewhere the surface goes on beyond its border
    bool overlaps = false;   // it lies upon another island of its character and material
};

// Part of an edge beyond which another triangle lies whose edge begins or ends elsewhere.
struct PartialEdge {
    HalfEdge edge, other;
    double from, to;  // shares of `edge`
};

struct SkinMesh {
    std::vector<std::uint32_t> weld;  // a vertex: the first of its place, uv, character and material
    std::vector<HalfEdge> across;     // a half-edge: the one that it meets over the surface; kNoHalfEdge: none, or partly
    std::vector<PartialEdge> partial;  // by edge
    std::vector<std::uint32_t> islandOf;  // a triangle
    std::vector<UvIsland> islands;
    std::vector<HalfEdge> borders;  // at which islands end
    std::size_t seams = 0;          // of them, those beyond which the surface goes on
    // A character: its skin has no edge at which it ends, and turns one side outwards all over.
    std::vector<bool> sealed;

    // What lies beyond an edge at that share of its length.
    HalfEdge beyond(HalfEdge edge, double share) const;
    bool continues(HalfEdge edge) const;
};

SkinMesh makeSkinMesh(const Geometry& geometry);

}  // namespace cutis
