// The triangles of a layout as a graph, and where they lie upon one another.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace cutis {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// The triangles beyond the three sides of each.
using Neighbours = std::vector<std::array<std::uint32_t, 3>>;

// Sides meet where they join the same two vertices, which `weld` numbers: one entry a vertex of `indices`.
// Where more than two do, they meet in pairs.
Neighbours neighboursOf(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> weld);

// Numbers the connected sets of triangles of equal label from 0; one entry a triangle.
std::vector<std::uint32_t> componentsOf(const Neighbours& neighbours, std::span<const std::uint32_t> labels,
                                        std::uint32_t& count);

// Whether some of these triangles cover places in the plane that others of them cover; see splitOverlaps.
bool lieUponOneAnother(std::span<const std::uint32_t> triangles, std::span<const glm::vec2> places);

// Splits components where they lie upon themselves in the plane, so that none does: triangles are taken from
// neighbour to neighbour as long as their places are free, and the others are left to a component of their
// own. `places`: one a corner of a triangle. Places are told apart on a grid of some eight cells a triangle,
// and of four million at the most.
void splitOverlaps(const Neighbours& neighbours, std::span<const glm::vec2> places,
                   std::vector<std::uint32_t>& components, std::uint32_t& count);

}  // namespace cutis
