#include "renderer/frame/seam_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/core/parallel.h"
#include "renderer/frame/spans.h"

namespace cutis {
namespace {

constexpr int kMostSteps = 1000;  // triangles that one walk crosses
// A border's ends belong to two edges: a walk begins this share of an edge away from them.
constexpr double kFromEnds = 1e-4;
constexpr std::uint32_t kAllOwn = 0xf;  // see ownTexels

struct SurfacePoint {
    std::uint32_t triangle;
    glm::dvec3 barycentric;
};

struct Corners {
    glm::dvec3 p[3];
};

// Walks over the surface in straight lines.
class Walker {
  public:
    Walker(const Geometry& geometry, const SkinMesh& mesh) : geometry_(geometry), mesh_(mesh) {}

    // From a share of a half-edge out of its triangle by `way`, in that triangle's plane. Nothing where the surface ends.
    std::optional<SurfacePoint> walk(HalfEdge edge, double share, glm::dvec3 way) const {
        Corners from = cornersOf(edge / 3);
        glm::dvec3 at = glm::mix(from.p[edge % 3], from.p[(edge + 1) % 3], share);
        for (int step = 0; step < kMostSteps; ++step) {
            const HalfEdge entry = mesh_.beyond(edge, share);
            if (entry == kNoHalfEdge) return {};
            const std::uint32_t triangle = entry / 3;
            const Corners to = cornersOf(triangle);
            way = unfold(from, static_cast<int>(edge % 3), to, static_cast<int>(entry % 3), way);
            const glm::dvec3 here = barycentric(to, at), there = barycentric(to, at + way);
            if (!std::isfinite(there.x + there.y + there.z + here.x + here.y + here.z)) return {};
            // The first side beyond which the way leads. Vertex i lies opposite to side i + 1.
            double left = 1;
            int exit = -1;
            for (int i = 0; i < 3; ++i) {
                const int side = (i + 1) % 3;
                if (side == static_cast<int>(entry % 3) || !(there[i] < 0)) continue;
                const double reached = std::clamp(here[i] / (here[i] - there[i]), 0.0, 1.0);
                if (reached < left || exit < 0) left = reached, exit = side;
            }
            if (exit < 0) {
                const glm::dvec3 inside = glm::max(there, 0.0);
                return SurfacePoint{triangle, inside / (inside.x + inside.y + inside.z)};
            }
            const glm::dvec3 w = glm::mix(here, there, left);
            const double along = w[exit] + w[(exit + 1) % 3];
            edge = triangle * 3 + static_cast<HalfEdge>(exit);
            share = std::clamp(along > 0 ? w[(exit + 1) % 3] / along : 0.5, 0.0, 1.0);
            at = glm::mix(to.p[exit], to.p[(exit + 1) % 3], share);
            way *= 1 - left;
            from = to;
        }
        return {};
    }

  private:
    Corners cornersOf(std::uint32_t triangle) const {
        const std::uint32_t* v = &geometry_.indices[std::size_t(triangle) * 3];
        return {{geometry_.positions[v[0]], geometry_.positions[v[1]], geometry_.positions[v[2]]}};
    }

    // Unit vector from a side into its triangle, at right angles to it.
    static glm::dvec3 inwards(const Corners& t, int side, const glm::dvec3& along) {
        const glm::dvec3 toThird = t.p[(side + 2) % 3] - t.p[side];
        return glm::normalize(toThird - along * glm::dot(toThird, along));
    }

    // `way` turned about the edge that two triangles share, from the plane of one into that of the other.
    static glm::dvec3 unfold(const Corners& from, int side, const Corners& to, int entry, const glm::dvec3& way) {
        const glm::dvec3 along = glm::normalize(from.p[(side + 1) % 3] - from.p[side]);
        const double out = std::max(-glm::dot(way, inwards(from, side, along)), 0.0);
        const glm::dvec3 entryAlong = glm::normalize(to.p[(entry + 1) % 3] - to.p[entry]);
        return along * glm::dot(way, along) + inwards(to, entry, entryAlong) * out;
    }

    static glm::dvec3 barycentric(const Corners& t, const glm::dvec3& p) {
        const glm::dvec3 e1 = t.p[1] - t.p[0], e2 = t.p[2] - t.p[0], n = glm::cross(e1, e2), s = p - t.p[0];
        const double area = glm::dot(n, n);
        const double u = glm::dot(glm::cross(s, e2), n) / area, v = glm::dot(glm::cross(e1, s), n) / area;
        return {1 - u - v, u, v};
    }

    const Geometry& geometry_;
    const SkinMesh& mesh_;
};

// The atlas at one resolution as texels' centres see it.
struct Grid {
    int size = 0;
    double texel = 1;  // of the atlas, along each side of one of these
    std::vector<std::uint32_t> owner;  // island + 1 where a centre lies on it
    std::vector<float> distance;       // in texels of the atlas, to the nearest border, where there is no owner
    std::vector<HalfEdge> nearest;

    std::size_t at(int x, int y) const { return std::size_t(y) * size + x; }
    glm::dvec2 centre(int x, int y) const { return (glm::dvec2(x, y) + 0.5) * texel; }
    // Texels whose centres lie between two places of the atlas, the last one included.
    glm::ivec2 first(const glm::dvec2& low) const { return glm::max(glm::ivec2(glm::ceil(low / texel - 0.5)), 0); }
    glm::ivec2 last(const glm::dvec2& high) const { return glm::min(glm::ivec2(glm::floor(high / texel - 0.5)), size - 1); }
};

glm::dvec2 texelOf(const Geometry& geometry, const Atlas& atlas, HalfEdge corner) {
    return atlas.vertices[geometry.indices[corner]].texel;
}

HalfEdge nextCorner(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }

void findOwners(const Geometry& geometry, const SkinMesh& mesh, const Atlas& atlas, Grid& grid) {
    grid.owner.assign(std::size_t(grid.size) * grid.size, 0);
    for (std::uint32_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const glm::dvec2 a = texelOf(geometry, atlas, t * 3), b = texelOf(geometry, atlas, t * 3 + 1),
                         c = texelOf(geometry, atlas, t * 3 + 2);
        const double area = cross2(b - a, c - a);
        if (area == 0) continue;
        const glm::ivec2 first = grid.first(glm::min(glm::min(a, b), c)), last = grid.last(glm::max(glm::max(a, b), c));
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                const glm::dvec2 p = grid.centre(x, y);
                if (cross2(b - a, p - a) * area < 0 || cross2(c - b, p - b) * area < 0 || cross2(a - c, p - c) * area < 0) {
                    continue;
                }
                grid.owner[grid.at(x, y)] = mesh.islandOf[t] + 1;
            }
        }
    }
}

// The share of the segment a-b at its point nearest to p.
double nearestShare(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    const double length2 = glm::dot(b - a, b - a);
    return length2 > 0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
}

void findNearestBorders(const Geometry& geometry, const SkinMesh& mesh, const Atlas& atlas, Grid& grid) {
    grid.distance.assign(grid.owner.size(), std::numeric_limits<float>::infinity());
    grid.nearest.assign(grid.owner.size(), kNoHalfEdge);
    for (const HalfEdge h : mesh.borders) {
        const glm::dvec2 a = texelOf(geometry, atlas, h), b = texelOf(geometry, atlas, nextCorner(h)),
                         c = texelOf(geometry, atlas, nextCorner(nextCorner(h)));
        const double area = cross2(b - a, c - a), length = glm::length(b - a);
        if (area == 0 || !(length > 0)) continue;
        const glm::dvec2 outwards = glm::dvec2(b.y - a.y, a.x - b.x) / length * (area > 0 ? 1.0 : -1.0);
        const double reach = atlas.gutters[mesh.islandOf[h / 3]];
        const glm::uvec4 rect = atlas.charts[geometry.drawInfos[geometry.triangleDraws[h / 3]].chart].rect;
        const glm::ivec2 first = grid.first(glm::max(glm::min(a, b) - reach, glm::dvec2(rect.x, rect.y)));
        const glm::ivec2 last = grid.last(glm::min(glm::max(a, b) + reach, glm::dvec2(rect.x + rect.z, rect.y + rect.w)));
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                const std::size_t at = grid.at(x, y);
                if (grid.owner[at] != 0) continue;
                const glm::dvec2 p = grid.centre(x, y), away = p - glm::mix(a, b, nearestShare(a, b, p));
                const double distance = glm::length(away), out = glm::dot(away, outwards);
                if (distance > reach || !(out > 1e-3 * distance)) continue;
                // At a corner two edges are equally near: the one that faces the texel more counts.
                const auto rank = static_cast<float>(distance * (1 - 1e-4 * out / distance));
                if (rank < grid.distance[at]) grid.distance[at] = rank, grid.nearest[at] = h;
            }
        }
    }
}

// `v` of the atlas as the triangle's plane holds it, in metres.
std::optional<glm::dvec3> onSurface(const Geometry& geometry, const Atlas& atlas, std::uint32_t triangle, const glm::dvec2& v) {
    const HalfEdge h = triangle * 3;
    const glm::dvec2 a = texelOf(geometry, atlas, h), e1 = texelOf(geometry, atlas, h + 1) - a,
                     e2 = texelOf(geometry, atlas, h + 2) - a;
    const double det = cross2(e1, e2);
    if (!(std::abs(det) > 1e-12)) return {};
    const glm::dvec3 p = geometry.positions[geometry.indices[h]];
    const glm::dvec3 p1 = glm::dvec3(geometry.positions[geometry.indices[h + 1]]) - p;
    const glm::dvec3 p2 = glm::dvec3(geometry.positions[geometry.indices[h + 2]]) - p;
    return (p1 * cross2(v, e2) + p2 * cross2(e1, v)) / det;
}

// Which of the four texels from `base` on are the island's own, a bit each.
std::uint32_t ownTexels(const Grid& grid, const glm::ivec2& base, std::uint32_t island) {
    std::uint32_t mask = 0;
    for (int i = 0; i < 4; ++i) {
        const glm::ivec2 at = base + glm::ivec2(i & 1, i >> 1);
        if (at.x < 0 || at.y < 0 || at.x >= grid.size || at.y >= grid.size) continue;
        if (grid.owner[grid.at(at.x, at.y)] == island + 1) mask |= 1u << i;
    }
    return mask;
}

struct Sources {
    glm::ivec2 base;
    std::uint32_t own;
};

// The four texels to read a place from: those around it where they are all the island's own, else the nearest four beside it
// that are, from which light is extrapolated; where there are none, what the island has of those around it.
Sources sourcesOf(const Grid& grid, const glm::dvec2& place, std::uint32_t island) {
    const glm::ivec2 around(glm::floor(place - 0.5));
    Sources sources{around, ownTexels(grid, around, island)};
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 9 && ownTexels(grid, around, island) != kAllOwn; ++i) {
        const glm::ivec2 base = around + glm::ivec2(i % 3 - 1, i / 3 - 1);
        const glm::dvec2 f = place - 0.5 - glm::dvec2(base);
        const double beyond = glm::length(f - glm::clamp(f, 0.0, 1.0));
        if (beyond < nearest && ownTexels(grid, base, island) == kAllOwn) nearest = beyond, sources = {base, kAllOwn};
    }
    return sources;
}

}  // namespace

SeamMap makeSeamMap(const Geometry& geometry, const SkinMesh& mesh, const Atlas& atlas, std::span<const int> profiles,
                    std::uint32_t shift) {
    Grid grid;
    grid.size = (atlas.size + (1 << shift) - 1) >> shift;
    grid.texel = double(1u << shift);
    findOwners(geometry, mesh, atlas, grid);
    findNearestBorders(geometry, mesh, atlas, grid);
    const Walker walker(geometry, mesh);
    const auto chartOf = [&](std::uint32_t triangle) { return geometry.drawInfos[geometry.triangleDraws[triangle]].chart; };

    struct Found {
        shared::SeamTexel texel;
        glm::vec3 metric;
    };
    std::vector<std::vector<Found>> rows(static_cast<std::size_t>(grid.size));
    parallelFor(rows.size(), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < grid.size; ++x) {
            const HalfEdge h = grid.nearest[grid.at(x, y)];
            if (h == kNoHalfEdge || !mesh.continues(h)) continue;
            const glm::dvec2 a = texelOf(geometry, atlas, h), b = texelOf(geometry, atlas, nextCorner(h));
            const glm::dvec2 p = grid.centre(x, y);
            const double share = std::clamp(nearestShare(a, b, p), kFromEnds, 1 - kFromEnds);
            const std::optional<glm::dvec3> way = onSurface(geometry, atlas, h / 3, p - glm::mix(a, b, share));
            if (!way) continue;
            const std::optional<SurfacePoint> end = walker.walk(h, share, *way);
            if (!end || profiles[chartOf(end->triangle)] != profiles[chartOf(h / 3)]) continue;
            glm::dvec2 place(0);
            for (int i = 0; i < 3; ++i) {
                place += end->barycentric[i] * texelOf(geometry, atlas, end->triangle * 3 + static_cast<HalfEdge>(i));
            }
            place /= grid.texel;
            const Sources sources = sourcesOf(grid, place, mesh.islandOf[end->triangle]);
            if (sources.own == 0 || sources.base.x < 0 || sources.base.y < 0) continue;
            const glm::uvec2 base(sources.base);
            rows[row].push_back({{.texel = static_cast<std::uint32_t>(x) | static_cast<std::uint32_t>(y) << 14 | sources.own << 28,
                                  .base = base.x | base.y << 16,
                                  .place = glm::vec2(place),
                                  .island = static_cast<float>(mesh.islandOf[h / 3] + 1),
                                  .charts = chartOf(h / 3) | chartOf(end->triangle) << 16},
                                 glm::vec3(glm::mix(glm::dvec3(atlas.vertices[geometry.indices[h]].metric),
                                                    glm::dvec3(atlas.vertices[geometry.indices[nextCorner(h)]].metric), share))});
        }
    });
    SeamMap map;
    for (const std::vector<Found>& row : rows) {
        for (const Found& found : row) {
            map.texels.push_back(found.texel);
            map.metrics.push_back(found.metric);
        }
    }
    return map;
}

}  // namespace cutis
