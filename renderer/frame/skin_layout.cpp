#include "renderer/frame/skin_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

#include "renderer/frame/layout_triangles.h"
#include "renderer/frame/spans.h"
#include "renderer/frame/unwrap.h"

namespace cutis {
namespace {

// Of an island's area in the layout: smaller parts that are turned over stay where they are.
constexpr double kLeastMirrored = 1e-3;
constexpr int kMergeRounds = 4;  // small parts within small parts
// A triangle is squeezed when it has this much less of the layout than its surface would have on average, and
// an island is when so much of its surface is.
constexpr double kSqueezed = 1e-3, kMostSqueezed = 0.05;
// Directions u and v of an island lie so close to each other on the surface, as the sine between them, that
// the rectangle around it holds next to nothing but gaps: an atlas for it would have many times the texels.
constexpr double kLeastSine = 0.05;
// More islands than this, of fewer triangles each on average, are no layout.
constexpr std::uint32_t kManyIslands = 4096, kFewTriangles = 32;

const std::vector<glm::vec3>& restOf(const Primitive& p) {
    return p.restPositions.empty() ? p.positions : p.restPositions;
}

// The first vertex of each place, and of each place and texture coordinates where these are given.
std::vector<std::uint32_t> weldVertices(const std::vector<glm::vec3>& positions,
                                        const std::vector<glm::vec2>& uv) {
    struct Key {
        glm::vec3 p;
        glm::vec2 uv;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const {
            std::size_t h = 0;
            for (const float f : {key.p.x, key.p.y, key.p.z, key.uv.x, key.uv.y}) {
                h = h * 0x9e3779b97f4a7c15u + std::hash<float>{}(f);
            }
            return h ^ (h >> 29);
        }
    };
    std::unordered_map<Key, std::uint32_t, Hash> first;
    first.reserve(positions.size());
    std::vector<std::uint32_t> weld;
    weld.reserve(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        weld.push_back(first.try_emplace({positions[v], uv.empty() ? glm::vec2(0) : uv[v]}, v).first->second);
    }
    return weld;
}

// What is known of each triangle and of each connected part of the layout.
struct Islands {
    std::vector<double> turned;   // twice a triangle's area in the layout; negative: turned over
    std::vector<double> surface;  // twice its area
    std::vector<std::uint32_t> of;
    std::uint32_t count = 0;
};

Islands findIslands(const Primitive& primitive, const Neighbours& neighbours) {
    const std::vector<glm::vec3>& positions = restOf(primitive);
    Islands islands;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* v = &primitive.indices[i];
        const glm::dvec2 uv = primitive.uv0[v[0]];
        islands.turned.push_back(
            cross2(glm::dvec2(primitive.uv0[v[1]]) - uv, glm::dvec2(primitive.uv0[v[2]]) - uv));
        const glm::dvec3 p = positions[v[0]];
        islands.surface.push_back(
            glm::length(glm::cross(glm::dvec3(positions[v[1]]) - p, glm::dvec3(positions[v[2]]) - p)));
    }
    islands.of = componentsOf(neighbours, std::vector<std::uint32_t>(neighbours.size(), 0), islands.count);
    return islands;
}

// Islands that are squeezed into points or lines, at least in part.
std::vector<bool> findSqueezed(const Islands& islands) {
    std::vector<double> layout(islands.count, 0), surface(islands.count, 0), squeezed(islands.count, 0);
    for (std::size_t t = 0; t < islands.of.size(); ++t) {
        layout[islands.of[t]] += std::abs(islands.turned[t]);
        surface[islands.of[t]] += islands.surface[t];
    }
    for (std::size_t t = 0; t < islands.of.size(); ++t) {
        const std::uint32_t i = islands.of[t];
        const bool small =
            !(std::abs(islands.turned[t]) * surface[i] > kSqueezed * islands.surface[t] * layout[i]);
        if (small) squeezed[i] += islands.surface[t];
    }
    std::vector<bool> result;
    for (std::uint32_t i = 0; i < islands.count; ++i)
        result.push_back(squeezed[i] > kMostSqueezed * surface[i]);
    return result;
}

// Islands whose layout is sheared beyond kLeastSine on the whole.
std::vector<bool> findSheared(const Primitive& primitive, const Islands& islands) {
    const std::vector<glm::vec3>& positions = restOf(primitive);
    // ΣdP/du·dP/du, ΣdP/du·dP/dv, ΣdP/dv·dP/dv, by area in the layout.
    std::vector<glm::dvec3> sums(islands.count, glm::dvec3(0));
    for (std::size_t t = 0; t < islands.of.size(); ++t) {
        const double turned = islands.turned[t];
        if (turned == 0) continue;
        const std::uint32_t* v = &primitive.indices[t * 3];
        const glm::dvec3 p = positions[v[0]];
        const glm::dvec3 p1 = glm::dvec3(positions[v[1]]) - p, p2 = glm::dvec3(positions[v[2]]) - p;
        const glm::dvec2 uv = primitive.uv0[v[0]];
        const glm::dvec2 e1 = glm::dvec2(primitive.uv0[v[1]]) - uv, e2 = glm::dvec2(primitive.uv0[v[2]]) - uv;
        const glm::dvec3 du = (p1 * e2.y - p2 * e1.y) / turned, dv = (p2 * e1.x - p1 * e2.x) / turned;
        sums[islands.of[t]] +=
            std::abs(turned) * glm::dvec3(glm::dot(du, du), glm::dot(du, dv), glm::dot(dv, dv));
    }
    std::vector<bool> sheared;
    for (const glm::dvec3& sum : sums)
        sheared.push_back(sum.y * sum.y > (1 - kLeastSine * kLeastSine) * sum.x * sum.z);
    return sheared;
}

// Of the triangles that `anew` leaves out: lengths in the layout of one on the surface. 0: there are none.
double uvPerUnit(const Islands& islands, const std::vector<bool>& anew) {
    double layout = 0, surface = 0;
    for (std::size_t t = 0; t < anew.size(); ++t) {
        if (!anew[t]) layout += std::abs(islands.turned[t]), surface += islands.surface[t];
    }
    return surface > 0 ? std::sqrt(layout / surface) : 0;
}

// Connected parts of triangles that face alike, all up or all turned over.
std::vector<std::uint32_t> partsByTurn(const Islands& islands, const Neighbours& neighbours,
                                       std::uint32_t& count) {
    std::vector<std::uint32_t> labels;
    for (const double turned : islands.turned) labels.push_back(turned < 0);
    std::vector<double> islandArea(islands.count, 0);
    for (std::size_t t = 0; t < labels.size(); ++t) islandArea[islands.of[t]] += std::abs(islands.turned[t]);
    std::vector<std::uint32_t> parts = componentsOf(neighbours, labels, count);
    for (int round = 0; round < kMergeRounds; ++round) {
        std::vector<double> partArea(count, 0);
        for (std::size_t t = 0; t < parts.size(); ++t) partArea[parts[t]] += std::abs(islands.turned[t]);
        bool merged = false;
        for (std::size_t t = 0; t < parts.size(); ++t) {
            if (partArea[parts[t]] > kLeastMirrored * islandArea[islands.of[t]]) continue;
            labels[t] = 1 - labels[t], merged = true;
        }
        if (!merged) break;
        parts = componentsOf(neighbours, labels, count);
    }
    return parts;
}

// One vertex for each part that it belongs to, and for each place there; `places` has an entry a corner of a
// triangle.
SkinLayout splitVertices(const Primitive& primitive, const std::vector<glm::vec2>& places,
                         const std::vector<std::uint32_t>& parts) {
    SkinLayout layout;
    const auto vertices = static_cast<std::uint32_t>(primitive.positions.size());
    layout.indices = primitive.indices;
    layout.uv.resize(vertices);
    layout.parts.assign(vertices, kNoTriangle);
    std::unordered_map<std::uint64_t, std::uint32_t> copyOf;
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
        std::uint32_t v = primitive.indices[i];
        const std::uint32_t part = parts[i / 3];
        if (layout.parts[v] != kNoTriangle && layout.parts[v] != part) {
            const auto number = static_cast<std::uint32_t>(layout.parts.size());
            const auto [found, isNew] = copyOf.try_emplace(std::uint64_t(v) << 32 | part, number);
            if (isNew) {
                layout.copies.push_back(v);
                layout.parts.push_back(part);
                layout.uv.emplace_back();
            }
            v = found->second;
        }
        layout.indices[i] = v;
        layout.parts[v] = part;
        layout.uv[v] = places[i];
    }
    std::replace(layout.parts.begin(), layout.parts.end(), kNoTriangle, 0u);  // vertices of no triangle
    return layout;
}

// Whether islands that meet in single vertices lie upon one another: such a vertex would belong to both.
bool touchUponOneAnother(const Primitive& primitive, const Islands& islands,
                         std::span<const std::uint32_t> weld, std::span<const glm::vec2> places) {
    std::vector<std::uint32_t> islandAt(weld.size(), kNoTriangle), root(islands.count);
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
        std::uint32_t& at = islandAt[weld[primitive.indices[i]]];
        const std::uint32_t island = find(islands.of[i / 3]);
        if (at != kNoTriangle) root[find(at)] = island;
        at = island;
    }
    std::vector<std::vector<std::uint32_t>> triangles(islands.count);
    std::vector<bool> joined(islands.count, false);
    for (std::uint32_t t = 0; t < islands.of.size(); ++t) {
        const std::uint32_t group = find(islands.of[t]);
        triangles[group].push_back(t);
        if (group != islands.of[t]) joined[group] = true;
    }
    for (std::uint32_t i = 0; i < islands.count; ++i) {
        if (joined[i] && lieUponOneAnother(triangles[i], places)) return true;
    }
    return false;
}

// Lays triangles out anew that `chosen` names, the others as `places` and `parts` say; numbers from `count`
// on are free. uvPerUnit: lengths in the layout of one on the surface; 0: any.
void unwrapChosen(const Primitive& primitive, const std::vector<bool>& chosen, double uvPerUnit,
                  std::vector<glm::vec2>& places, std::vector<std::uint32_t>& parts, std::uint32_t count) {
    const std::vector<glm::vec3>& positions = restOf(primitive);
    std::vector<std::uint32_t> triangles, indices;
    std::vector<glm::vec3> corners;
    for (std::uint32_t t = 0; t < chosen.size(); ++t) {
        if (!chosen[t]) continue;
        triangles.push_back(t);
        for (std::uint32_t i = t * 3; i < t * 3 + 3; ++i) {
            indices.push_back(primitive.indices[i]);
            corners.push_back(positions[primitive.indices[i]]);
        }
    }
    if (triangles.empty()) return;
    const Unwrapped made = unwrap(corners, neighboursOf(indices, weldVertices(positions, {})));
    const auto scale = static_cast<float>(uvPerUnit > 0 ? uvPerUnit * made.size : 1);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        parts[triangles[k]] = count + made.charts[k];
        for (int i = 0; i < 3; ++i) places[triangles[k] * 3 + i] = made.places[k * 3 + i] * scale;
    }
}

}  // namespace

SkinLayout layOutSkin(const Primitive& primitive) {
    const std::size_t triangleCount = primitive.indices.size() / 3;
    std::vector<glm::vec2> places(triangleCount * 3, glm::vec2(0));
    std::vector<std::uint32_t> parts(triangleCount, 0);
    std::vector<bool> anew(triangleCount, true);
    if (primitive.uv0.empty()) {
        unwrapChosen(primitive, anew, 0, places, parts, 0);
        SkinLayout layout = splitVertices(primitive, places, parts);
        layout.remark = "has no texture coordinates: its skin is laid out anew";
        return layout;
    }
    const std::vector<std::uint32_t> weld = weldVertices(restOf(primitive), primitive.uv0);
    const Neighbours neighbours = neighboursOf(primitive.indices, weld);
    const Islands islands = findIslands(primitive, neighbours);
    std::string cause;
    if (islands.count > kManyIslands && triangleCount < std::size_t(kFewTriangles) * islands.count) {
        cause = "are cut into " + std::to_string(islands.count) + " islands";
    } else {
        const std::vector<bool> squeezed = findSqueezed(islands), sheared = findSheared(primitive, islands);
        for (std::size_t t = 0; t < triangleCount; ++t)
            anew[t] = squeezed[islands.of[t]] || sheared[islands.of[t]];
        const auto any = [](const std::vector<bool>& of) {
            return std::find(of.begin(), of.end(), true) != of.end();
        };
        if (any(sheared)) cause = "are sheared";
        if (any(squeezed)) cause = "leave parts of the surface no room";
    }
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = primitive.uv0[primitive.indices[i]];
    std::uint32_t count = 0;
    parts = partsByTurn(islands, neighbours, count);
    if (cause.empty() && count > islands.count) cause = "fold";
    splitOverlaps(neighbours, places, parts, count);
    if (cause.empty() && (count > islands.count || touchUponOneAnother(primitive, islands, weld, places))) {
        cause = "lie upon themselves";
    }
    if (cause.empty()) return {};
    unwrapChosen(primitive, anew, uvPerUnit(islands, anew), places, parts, count);
    SkinLayout layout = splitVertices(primitive, places, parts);
    layout.remark = "has texture coordinates that " + cause + ": its skin gets a layout of its own there";
    return layout;
}

}  // namespace cutis
