#include "renderer/frame/layout_triangles.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/spans.h"

namespace cutis {
namespace {

constexpr double kCellsPerTriangle = 8, kMostCells = 1 << 22;
// Of a component's cells: with fewer claimed twice it stays whole.
constexpr double kLeastOverlap = 1e-3;

// A grid over one component.
struct Grid {
    glm::dvec2 low;
    double scale;  // cells per unit
    glm::ivec2 size;
    glm::dvec2 at(const glm::vec2& place) const { return (glm::dvec2(place) - low) * scale; }
};

Grid gridOver(std::span<const std::uint32_t> triangles, std::span<const glm::vec2> places) {
    glm::dvec2 low(1e300), high(-1e300);
    double area = 0;
    for (const std::uint32_t t : triangles) {
        const glm::dvec2 a = places[t * 3], b = places[t * 3 + 1], c = places[t * 3 + 2];
        low = glm::min(low, glm::min(glm::min(a, b), c)), high = glm::max(high, glm::max(glm::max(a, b), c));
        area += 0.5 * std::abs(cross2(b - a, c - a));
    }
    const glm::dvec2 extent = glm::max(high - low, 1e-30);
    double scale =
        std::sqrt(kCellsPerTriangle * static_cast<double>(triangles.size()) / std::max(area, 1e-60));
    scale = std::min(scale, std::sqrt(kMostCells / (extent.x * extent.y)));
    scale = std::min(scale, kMostCells / (4 * std::max(extent.x, extent.y)));
    const glm::dvec2 size = glm::floor(extent * scale) + 1.0;
    return {low, scale, glm::ivec2(glm::min(size, kMostCells / std::max(std::min(size.x, size.y), 1.0)))};
}

// Calls body(cell) for those that a triangle claims.
template <class Body>
void forEachClaim(const Grid& grid, std::span<const glm::vec2> places, std::uint32_t t, Body body) {
    forEachCellWithin(grid.at(places[t * 3]), grid.at(places[t * 3 + 1]), grid.at(places[t * 3 + 2]),
                      grid.size, [&](int x, int y) { body(std::size_t(y) * grid.size.x + x); });
}

bool claimTwice(const Grid& grid, std::span<const glm::vec2> places,
                std::span<const std::uint32_t> triangles) {
    std::vector<bool> claimed(std::size_t(grid.size.x) * grid.size.y, false);
    double once = 0, twice = 0;
    for (const std::uint32_t t : triangles) {
        forEachClaim(grid, places, t, [&](std::size_t cell) {
            (claimed[cell] ? twice : once) += 1;
            claimed[cell] = true;
        });
    }
    return twice > kLeastOverlap * once;
}

}  // namespace

Neighbours neighboursOf(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> weld) {
    struct Side {
        std::uint64_t ends;
        std::uint32_t side;
        bool operator<(const Side& other) const {
            return ends != other.ends ? ends < other.ends : side < other.side;
        }
    };
    std::vector<Side> sides;
    sides.reserve(indices.size());
    for (std::uint32_t side = 0; side < indices.size(); ++side) {
        const std::uint32_t a = weld[indices[side]], b = weld[indices[side % 3 == 2 ? side - 2 : side + 1]];
        if (a != b) sides.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), side});
    }
    std::sort(sides.begin(), sides.end());
    Neighbours neighbours(indices.size() / 3, {kNoTriangle, kNoTriangle, kNoTriangle});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        if (sides[i].ends != sides[i + 1].ends) continue;
        const std::uint32_t one = sides[i].side, other = sides[i + 1].side;
        neighbours[one / 3][one % 3] = other / 3;
        neighbours[other / 3][other % 3] = one / 3;
        ++i;
    }
    return neighbours;
}

std::vector<std::uint32_t> componentsOf(const Neighbours& neighbours, std::span<const std::uint32_t> labels,
                                        std::uint32_t& count) {
    std::vector<std::uint32_t> components(neighbours.size(), kNoTriangle), open;
    count = 0;
    for (std::uint32_t seed = 0; seed < neighbours.size(); ++seed) {
        if (components[seed] != kNoTriangle) continue;
        components[seed] = count;
        open.assign(1, seed);
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            for (const std::uint32_t next : neighbours[t]) {
                if (next == kNoTriangle || components[next] != kNoTriangle || labels[next] != labels[t])
                    continue;
                components[next] = count;
                open.push_back(next);
            }
        }
        ++count;
    }
    return components;
}

bool lieUponOneAnother(std::span<const std::uint32_t> triangles, std::span<const glm::vec2> places) {
    return claimTwice(gridOver(triangles, places), places, triangles);
}

void splitOverlaps(const Neighbours& neighbours, std::span<const glm::vec2> places,
                   std::vector<std::uint32_t>& components, std::uint32_t& count) {
    const std::uint32_t whole = count;
    std::vector<std::vector<std::uint32_t>> triangles(whole);
    for (std::uint32_t t = 0; t < components.size(); ++t) triangles[components[t]].push_back(t);
    for (std::uint32_t component = 0; component < whole; ++component) {
        const std::vector<std::uint32_t>& mine = triangles[component];
        if (mine.size() < 2) continue;
        const Grid grid = gridOver(mine, places);
        if (!claimTwice(grid, places, mine)) continue;
        // Parts are numbered from `count`, the first of them excepted, which keeps the component's number.
        for (const std::uint32_t t : mine) components[t] = kNoTriangle;
        std::vector<std::uint32_t> owner(std::size_t(grid.size.x) * grid.size.y, kNoTriangle), level, next;
        const auto take = [&](std::uint32_t t, std::uint32_t part) {
            bool free = true;
            forEachClaim(grid, places, t, [&](std::size_t cell) { free &= owner[cell] != part; });
            if (!free) return;
            forEachClaim(grid, places, t, [&](std::size_t cell) { owner[cell] = part; });
            components[t] = part;
            next.push_back(t);
        };
        bool first = true;
        for (const std::uint32_t seed : mine) {
            if (components[seed] != kNoTriangle) continue;
            const std::uint32_t part = first ? component : count++;
            first = false;
            next.clear();
            take(seed, part);
            // Level by level: a front that grows evenly leaves few strips behind.
            while (!next.empty()) {
                level.swap(next);
                next.clear();
                for (const std::uint32_t t : level) {
                    for (const std::uint32_t beside : neighbours[t]) {
                        // All that have no number yet are of this component.
                        if (beside != kNoTriangle && components[beside] == kNoTriangle) take(beside, part);
                    }
                }
            }
        }
    }
}

}  // namespace cutis
