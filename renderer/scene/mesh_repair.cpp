#include "renderer/scene/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace cutis {
namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Calls visit on each attribute array that the primitive has.
template <typename Visit>
void forAttributes(Primitive& p, const Visit& visit) {
    const auto visitIfAny = [&](auto& values) {
        if (!values.empty()) visit(values);
    };
    visitIfAny(p.positions), visitIfAny(p.normals), visitIfAny(p.tangents);
    visitIfAny(p.uv0), visitIfAny(p.uv1), visitIfAny(p.colors);
}

// The angle of triangle a b c at a.
float angleAt(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 u(b - a), v(c - a);
    return float(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
}

glm::dvec3 areaVector(const Primitive& p, std::size_t first) {
    const glm::dvec3 a(p.positions[p.indices[first]]);
    return glm::cross(glm::dvec3(p.positions[p.indices[first + 1]]) - a,
                      glm::dvec3(p.positions[p.indices[first + 2]]) - a);
}

bool areThree(const std::array<std::uint32_t, 3>& corners) {
    return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

glm::vec3 anyPerpendicular(const glm::vec3& n) {
    const glm::vec3 aside = std::abs(n.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(aside - n * glm::dot(n, aside));
}

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::array<std::uint32_t, 3> bits;
        const glm::vec3 unsignedZero = p + 0.f;  // -0 and 0 are one place
        std::memcpy(bits.data(), &unsignedZero, sizeof bits);
        std::uint64_t hash = 0;
        for (const std::uint32_t b : bits) hash = (hash ^ b) * 0x9e3779b97f4a7c15u, hash ^= hash >> 32;
        return hash;
    }
};

// Per vertex, the first vertex at the same place.
std::vector<std::uint32_t> weldByPosition(const std::vector<glm::vec3>& positions) {
    std::unordered_map<glm::vec3, std::uint32_t, PositionHash> firstAt;
    firstAt.reserve(positions.size());
    std::vector<std::uint32_t> first(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        first[i] = firstAt.try_emplace(positions[i], i).first->second;
    return first;
}

// Sums the unit normals of triangles at their corners' vertices, weighted by angle; `place` maps vertices to
// sums.
template <typename Place>
std::vector<glm::dvec3> sumNormals(const Primitive& p, const Place& place) {
    std::vector<glm::dvec3> sums(p.positions.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < p.indices.size(); t += 3) {
        const glm::dvec3 area = areaVector(p, t);
        if (!(glm::dot(area, area) > 0)) continue;
        const glm::dvec3 normal = glm::normalize(area);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = p.indices[t + k];
            sums[place(i)] += normal * double(angleAt(p.positions[i], p.positions[p.indices[t + (k + 1) % 3]],
                                                      p.positions[p.indices[t + (k + 2) % 3]]));
        }
    }
    return sums;
}

// The derivative of position by u' over a triangle, and whether its texture coordinates are mirrored: w of
// its tangents.
struct TriangleFrame {
    glm::vec3 tangent{0};
    float sign = 0;  // 0: its texture coordinates have no area
};

TriangleFrame frameOf(const std::array<glm::vec3, 3>& p, const std::array<glm::dvec2, 3>& uv) {
    const glm::dvec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const double area = d1.x * d2.y - d1.y * d2.x;
    const glm::dvec3 tangent =
        (glm::dvec3(p[1] - p[0]) * d2.y - glm::dvec3(p[2] - p[0]) * d1.y) * (area < 0 ? -1.0 : 1.0);
    const double length = glm::length(tangent);
    if (area == 0 || !std::isfinite(area) || !(length > 0)) return {};
    return {glm::vec3(tangent / length), area < 0 ? 1.f : -1.f};
}

}  // namespace

RepairCounts dropBadTriangles(Primitive& p, bool keepFlat) {
    RepairCounts counts;
    std::size_t kept = 0;
    for (std::size_t t = 0; t + 2 < p.indices.size(); t += 3) {
        const std::array<std::uint32_t, 3> corner{p.indices[t], p.indices[t + 1], p.indices[t + 2]};
        if (!std::ranges::all_of(corner, [&](std::uint32_t i) { return isFinite(p.positions[i]); })) {
            ++counts.nonfinite;
        } else if (const glm::dvec3 area = areaVector(p, t);
                   !(glm::dot(area, area) > 0) && !(keepFlat && areThree(corner))) {
            ++counts.degenerate;
        } else {
            std::copy(corner.begin(), corner.end(), p.indices.begin() + std::ptrdiff_t(kept));
            kept += 3;
        }
    }
    p.indices.resize(kept);
    return counts;
}

std::vector<std::uint32_t> dropUnusedVertices(Primitive& p) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> place(p.positions.size(), kUnused), kept;
    for (const std::uint32_t i : p.indices) place[i] = 0;
    for (std::uint32_t i = 0; i < place.size(); ++i) {
        if (place[i] == kUnused) continue;
        place[i] = std::uint32_t(kept.size());
        kept.push_back(i);
    }
    if (kept.size() == p.positions.size()) return kept;
    forAttributes(p, [&](auto& values) {
        for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
        values.resize(kept.size());
    });
    for (std::uint32_t& i : p.indices) i = place[i];
    return kept;
}

void completeNormals(Primitive& p, bool smooth) {
    const bool none = p.normals.empty();
    p.normals.resize(p.positions.size(), glm::vec3(0));
    constexpr float kShortest = 1e-6f;
    bool anyMissing = none;
    for (glm::vec3& normal : p.normals) {
        const float length = glm::length(normal);
        const bool usable = std::isfinite(length) && length > kShortest;
        normal = usable ? normal / length : glm::vec3(0);
        anyMissing |= !usable;
    }
    if (!anyMissing) return;
    std::vector<std::uint32_t> place;
    if (none && smooth) place = weldByPosition(p.positions);
    const auto placeOf = [&](std::uint32_t i) { return place.empty() ? i : place[i]; };
    const std::vector<glm::dvec3> sums = sumNormals(p, placeOf);
    for (std::uint32_t i = 0; i < p.normals.size(); ++i) {
        if (p.normals[i] != glm::vec3(0)) continue;
        const glm::dvec3& sum = sums[placeOf(i)];
        const double length = glm::length(sum);
        // Triangles back to back cancel, unused vertices have none: any direction is as good.
        p.normals[i] = length > kShortest ? glm::vec3(sum / length) : glm::vec3(0, 0, 1);
    }
}

std::vector<std::uint32_t> computeTangents(Primitive& p, const TextureSlot& slot) {
    const std::vector<glm::vec2>& uv = slot.texCoord == 1 ? p.uv1 : p.uv0;
    const glm::dmat3 transform(slot.transform);
    const auto uvAt = [&](std::uint32_t i) {
        return uv.empty() ? glm::dvec2(0) : glm::dvec2(transform * glm::dvec3(uv[i], 1));
    };
    std::vector<TriangleFrame> frames(p.indices.size() / 3);
    for (std::size_t t = 0; t < frames.size(); ++t) {
        const std::uint32_t* i = p.indices.data() + 3 * t;
        frames[t] = frameOf({p.positions[i[0]], p.positions[i[1]], p.positions[i[2]]},
                            {uvAt(i[0]), uvAt(i[1]), uvAt(i[2])});
    }

    // The first triangle with texture coordinates decides a vertex's sign; those of the other sign get a copy
    // of it.
    p.tangents.clear();
    std::vector<float> sign(p.positions.size(), 0);
    std::unordered_map<std::uint32_t, std::uint32_t> mirrored;
    std::vector<std::uint32_t> copyOf;
    for (std::size_t t = 0; t < frames.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& i = p.indices[3 * t + k];
            if (frames[t].sign == 0) continue;
            if (sign[i] == 0) sign[i] = frames[t].sign;
            if (sign[i] == frames[t].sign) continue;
            const auto [copy, isNew] =
                mirrored.try_emplace(i, std::uint32_t(p.positions.size() + copyOf.size()));
            if (isNew) copyOf.push_back(i);
            i = copy->second;
        }
    }
    forAttributes(p, [&](auto& values) {
        for (const std::uint32_t original : copyOf) values.push_back(values[original]);
    });
    for (const std::uint32_t original : copyOf) sign.push_back(-sign[original]);

    std::vector<glm::vec3> sums(p.positions.size(), glm::vec3(0));
    for (std::size_t t = 0; t < frames.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = p.indices[3 * t + k];
            sums[i] +=
                frames[t].tangent * angleAt(p.positions[i], p.positions[p.indices[3 * t + (k + 1) % 3]],
                                            p.positions[p.indices[3 * t + (k + 2) % 3]]);
        }
    }
    p.tangents.resize(p.positions.size());
    for (std::size_t i = 0; i < p.tangents.size(); ++i) {
        const glm::vec3& n = p.normals[i];
        const glm::vec3 flat = sums[i] - n * glm::dot(n, sums[i]);
        const float length = glm::length(flat);
        const glm::vec3 tangent =
            length > 1e-4f * glm::length(sums[i]) && length > 0 ? flat / length : anyPerpendicular(n);
        p.tangents[i] = glm::vec4(tangent, sign[i] == 0 ? 1.f : sign[i]);
    }
    return copyOf;
}

}  // namespace cutis
