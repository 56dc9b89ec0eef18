#include "renderer/frame/light_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "renderer/frame/frame.h"
#include "renderer/frame/upload_parts.h"
#include "renderer/gpu/device.h"

namespace cutis {
namespace {

constexpr double kPatchesAcross = 32;  // the root of a body's area
constexpr double kPiecesAcross = 4;    // a patch
constexpr int kSampleBlocks = 512;     // along each side of the atlas

// The shares of a triangle's corners at the middles of n² equal pieces.
template <class Body>
void forEachPiece(int n, Body body) {
    const auto at = [&](double i, double j) { body(glm::dvec3(n - i - j, i, j) / double(n)); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            at(i + 1 / 3.0, j + 1 / 3.0);
            if (i + j + 1 < n) at(i + 2 / 3.0, j + 2 / 3.0);
        }
    }
}

struct PatchSums {
    glm::dvec3 moment{0}, normal{0};
    double area = 0;
};

using Cell = std::array<std::int64_t, 3>;
struct SampleKey {
    std::size_t patch;
    float island;
    std::uint32_t block;
    auto operator<=>(const SampleKey&) const = default;
};

}  // namespace

int countWideGaussians(const Scene& scene, const Geometry& geometry, const RenderSettings& settings) {
    if (settings.chain == Chain::published) return 0;
    std::set<std::pair<int, int>> bodies;  // character, material
    for (const GeometryDraw& draw : geometry.draws) {
        if (draw.skin) bodies.emplace(draw.character, draw.material);
    }
    int count = 0;
    for (const auto& [character, material] : bodies) {
        for (const skin::Gaussian& g : profileOf(scene, material, settings.gaussians).gaussians) {
            count += isWide(g.variance, geometry.skinMm2[character]);
        }
    }
    return count;
}

void appendPatches(const Scene& scene, const Geometry& geometry, const Atlas& atlas, int character, PatchList& list) {
    // The pose may have more or less skin than the body at rest; patches are those of a body at rest.
    const double side = std::max(std::sqrt(geometry.skinMm2[character]) / kPatchesAcross, 1e-30);
    const auto block = static_cast<float>((atlas.size + kSampleBlocks - 1) / kSampleBlocks);
    std::map<Cell, std::size_t> patchAt;
    std::vector<PatchSums> sums;
    std::map<SampleKey, shared::PatchSample> samples;
    for (std::uint32_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const GeometryDraw& draw = geometry.draws[geometry.triangleDraws[t]];
        if (draw.character != character) continue;
        const double mm = scene.materials[draw.material].skin->mmPerUnit;
        const std::uint32_t* v = &geometry.indices[std::size_t(t) * 3];
        const glm::dmat3 p(geometry.positions[v[0]], geometry.positions[v[1]], geometry.positions[v[2]]);
        const glm::dmat3 n(geometry.attributes[v[0]].normal, geometry.attributes[v[1]].normal,
                           geometry.attributes[v[2]].normal);
        const glm::dmat3x2 places(atlas.vertices[v[0]].texel, atlas.vertices[v[1]].texel, atlas.vertices[v[2]].texel);
        const double longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
        const int pieces = std::clamp(static_cast<int>(std::ceil(longest * mm / side * kPiecesAcross)), 1, 256);
        const double area =
            0.5 * mm * mm * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / (double(pieces) * pieces);
        if (!(area > 0)) continue;
        forEachPiece(pieces, [&](const glm::dvec3& share) {
            const glm::dvec3 at = p * share, cell = glm::floor(at * (mm / side));
            const auto found = patchAt.try_emplace({std::int64_t(cell.x), std::int64_t(cell.y), std::int64_t(cell.z)}, sums.size());
            if (found.second) sums.emplace_back();
            PatchSums& patch = sums[found.first->second];
            patch.moment += at * area, patch.normal += n * share * area, patch.area += area;
            const glm::vec2 place(places * share), corner = glm::max(glm::floor(place / block), glm::vec2(0));
            const float island = atlas.vertices[v[0]].island;
            const SampleKey key{found.first->second, island,
                                static_cast<std::uint32_t>(corner.y) * kSampleBlocks + static_cast<std::uint32_t>(corner.x)};
            samples.try_emplace(key, shared::PatchSample{place, island, 0}).first->second.area += static_cast<float>(area);
        });
    }
    const auto firstPatch = static_cast<std::uint32_t>(list.patches.size());
    for (const PatchSums& patch : sums) {
        const double length = glm::length(patch.normal);
        list.patches.push_back({.centre = glm::vec3(patch.moment / patch.area),
                                .area = static_cast<float>(patch.area),
                                .normal = length > 0 ? glm::vec3(patch.normal / length) : glm::vec3(0),
                                .firstSample = 0,
                                .sampleCount = 0});
    }
    for (const auto& [key, sample] : samples) {
        shared::LightPatch& patch = list.patches[firstPatch + key.patch];
        if (patch.sampleCount++ == 0) patch.firstSample = static_cast<std::uint32_t>(list.samples.size());
        list.samples.push_back(sample);
    }
}

void uploadLightPatches(FrameContext& frame) {
    PatchList list;
    std::map<std::uint32_t, LightPatches::Range> ofBody;  // by receiver group
    frame.patches = {};
    for (const ChartRange& chart : frame.scene.charts) {
        LightPatches::Range& range = frame.patches.ofChart.emplace_back();
        if (chart.blurred == chart.profile.gaussians.size()) continue;
        if (!ofBody.contains(chart.receiverGroup)) {
            const auto first = static_cast<std::uint32_t>(list.patches.size());
            appendPatches(*frame.input->scene, frame.geometry, frame.atlas, static_cast<int>(chart.receiverGroup), list);
            ofBody[chart.receiverGroup] = {first, static_cast<std::uint32_t>(list.patches.size()) - first};
        }
        range = ofBody[chart.receiverGroup];
    }
    frame.patches.count = static_cast<std::uint32_t>(list.patches.size());
    frame.patches.patches = uploadBuffer(*frame.device, *frame.commands, "light patches", list.patches);
    frame.patches.samples = uploadBuffer(*frame.device, *frame.commands, "light patch samples", list.samples);
    frame.patches.light = gpu::Buffer(*frame.device, {.name = "light of patches", .bytes = list.patches.size() * sizeof(glm::vec3)});
}

void forgetLightPatches(FrameContext& frame) { frame.patches = {}; }

}  // namespace cutis
