#include "renderer/frame/unwrap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cutis {
namespace {

constexpr int kDirections = 12;
constexpr int kNormalRounds = 4, kLabelRounds = 8, kMergeRounds = 2;
// Cosines between a triangle and the direction that it is seen from: of those that are given their label
// first, and of those that join a part around them.
constexpr double kFacing = 0.5, kLeastFacing = 0.3;
// Parts of less than this share of the surface join one beside them where they may.
constexpr double kSmallPart = 2e-3;

struct Facets {
    std::vector<glm::dvec3> normals;  // unit, or zero
    std::vector<double> areas;
};

Facets facetsOf(std::span<const glm::vec3> corners) {
    Facets facets;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const glm::dvec3 a = corners[i];
        const glm::dvec3 n = glm::cross(glm::dvec3(corners[i + 1]) - a, glm::dvec3(corners[i + 2]) - a);
        const double length = glm::length(n);
        facets.normals.push_back(length > 0 ? n / length : glm::dvec3(0));
        facets.areas.push_back(0.5 * length);
    }
    return facets;
}

// The corners of an icosahedron: no direction lies more than 37.4° from one of them.
const std::array<glm::dvec3, kDirections>& directions() {
    static const std::array<glm::dvec3, kDirections> found = [] {
        std::array<glm::dvec3, kDirections> corners;
        for (int i = 0; i < kDirections; ++i) {
            const double longer = (i & 1 ? -0.5 : 0.5) * (1 + std::sqrt(5.0)), shorter = i & 2 ? -1 : 1;
            glm::dvec3 corner(0);
            corner[i / 4] = longer, corner[(i / 4 + 1) % 3] = shorter;
            corners[i] = glm::normalize(corner);
        }
        return corners;
    }();
    return found;
}

double facing(const glm::dvec3& normal, std::uint32_t label) {
    return glm::dot(normal, directions()[label]);
}

std::uint32_t facedMost(const glm::dvec3& normal) {
    std::uint32_t most = 0;
    for (std::uint32_t label = 1; label < kDirections; ++label) {
        if (facing(normal, label) > facing(normal, most)) most = label;
    }
    return most;
}

// The place in the plane that one sees from a direction.
glm::dvec2 seenFrom(const glm::dvec3& p, std::uint32_t label) {
    const glm::dvec3 n = directions()[label];
    const glm::dvec3 across =
        glm::normalize(glm::cross(std::abs(n.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), n));
    return {glm::dot(p, across), glm::dot(p, glm::cross(n, across))};
}

// Normals of the surface about each triangle: pores and noise cut nothing up.
std::vector<glm::dvec3> smoothNormals(const Facets& facets, const Neighbours& neighbours) {
    std::vector<glm::dvec3> sums(facets.normals.size());
    for (std::size_t t = 0; t < sums.size(); ++t) sums[t] = facets.normals[t] * facets.areas[t];
    for (int round = 0; round < kNormalRounds; ++round) {
        const std::vector<glm::dvec3> before = sums;
        for (std::size_t t = 0; t < sums.size(); ++t) {
            for (const std::uint32_t beside : neighbours[t]) {
                if (beside != kNoTriangle) sums[t] += before[beside];
            }
        }
    }
    return sums;
}

std::vector<std::uint32_t> labelsOf(const Facets& facets, const Neighbours& neighbours) {
    const std::vector<glm::dvec3> smooth = smoothNormals(facets, neighbours);
    std::vector<std::uint32_t> labels;
    for (std::size_t t = 0; t < smooth.size(); ++t) {
        const std::uint32_t about = facedMost(smooth[t]);
        labels.push_back(facing(facets.normals[t], about) > kFacing ? about : facedMost(facets.normals[t]));
    }
    // Borders that wind between two labels become straight.
    for (int round = 0; round < kLabelRounds; ++round) {
        const std::vector<std::uint32_t> before = labels;
        for (std::size_t t = 0; t < labels.size(); ++t) {
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t one = neighbours[t][i], other = neighbours[t][(i + 1) % 3];
                if (one == kNoTriangle || other == kNoTriangle || before[one] != before[other]) continue;
                if (facing(facets.normals[t], before[one]) > kFacing) labels[t] = before[one];
            }
        }
    }
    return labels;
}

// Gives small parts the label that most of their border has, where all of their triangles face that way.
void mergeSmallParts(const Facets& facets, const Neighbours& neighbours, std::vector<std::uint32_t>& labels) {
    std::uint32_t count = 0;
    const std::vector<std::uint32_t> parts = componentsOf(neighbours, labels, count);
    std::vector<double> areas(count, 0);
    std::vector<std::array<int, kDirections>> besides(count, std::array<int, kDirections>{});
    std::vector<std::array<bool, kDirections>> may(count);
    for (auto& each : may) each.fill(true);
    double total = 0;
    for (std::size_t t = 0; t < labels.size(); ++t) {
        areas[parts[t]] += facets.areas[t], total += facets.areas[t];
        for (std::uint32_t label = 0; label < kDirections; ++label) {
            may[parts[t]][label] = may[parts[t]][label] && facing(facets.normals[t], label) > kLeastFacing;
        }
        for (const std::uint32_t beside : neighbours[t]) {
            if (beside != kNoTriangle && parts[beside] != parts[t]) ++besides[parts[t]][labels[beside]];
        }
    }
    for (std::size_t t = 0; t < labels.size(); ++t) {
        const std::uint32_t part = parts[t];
        if (areas[part] > kSmallPart * total) continue;
        int most = 0;
        for (std::uint32_t label = 0; label < kDirections; ++label) {
            if (may[part][label] && besides[part][label] > most)
                most = besides[part][label], labels[t] = label;
        }
    }
}

}  // namespace

Unwrapped unwrap(std::span<const glm::vec3> corners, const Neighbours& neighbours) {
    const Facets facets = facetsOf(corners);
    std::vector<std::uint32_t> labels = labelsOf(facets, neighbours);
    for (int round = 0; round < kMergeRounds; ++round) mergeSmallParts(facets, neighbours, labels);
    Unwrapped result;
    result.places.reserve(corners.size());
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::vec3& p : corners)
        low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    result.size = std::max(glm::length(high - low), 1e-30);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 p = (glm::dvec3(corners[i]) - low) / result.size;
        result.places.push_back(glm::vec2(seenFrom(p, labels[i / 3])));
    }
    result.charts = componentsOf(neighbours, labels, result.count);
    splitOverlaps(neighbours, result.places, result.charts, result.count);
    return result;
}

}  // namespace cutis
