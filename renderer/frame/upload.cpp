#include "renderer/frame/upload.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "renderer/frame/frame.h"
#include "renderer/frame/light_patches.h"
#include "renderer/frame/seam_map.h"
#include "renderer/frame/stretch.h"
#include "renderer/frame/upload_parts.h"
#include "renderer/gpu/device.h"
#include "renderer/passes/diffusion.h"
#include "renderer/skin/energy.h"

namespace cutis {

skin::Profile profileOf(const Scene& scene, int material, int gaussians) {
    const SkinMaterial& skin = *scene.materials[material].skin;
    skin::Profile profile = skin::scaled(skin::sorted(skin.profile), skin.scale);
    // A Gaussian that no channel uses is a blur that nothing reads.
    std::erase_if(profile.gaussians, [](const skin::Gaussian& g) { return g.weight == glm::dvec3(0); });
    return gaussians > 0 ? skin::reduced(profile, gaussians) : profile;
}

std::vector<double> reachBeyondBorders(const Scene& scene, const Geometry& geometry, const RenderSettings& settings) {
    std::vector<double> reaches(scene.materials.size(), 0);
    std::vector<double> bodies(scene.materials.size(), 0);  // mm², the largest
    for (const GeometryDraw& draw : geometry.draws) {
        if (draw.skin) bodies[draw.material] = std::max(bodies[draw.material], geometry.skinMm2[draw.character]);
    }
    for (const int material : skinMaterials(scene, geometry)) {
        double before = 0, widest = 0;
        for (const skin::Gaussian& g : profileOf(scene, material, settings.gaussians).gaussians) {
            if (settings.chain == Chain::exact && isWide(g.variance, bodies[material])) continue;  // not blurred
            widest = std::max(widest, g.variance - before);
            before = g.variance;
        }
        if (widest > 0) reaches[material] = std::exp2(std::ceil(2 * std::log2(3 * std::sqrt(widest))) / 2);
    }
    return reaches;
}

namespace {

// The Gaussians of up to that variance (mm²) as one of their mean variance.
skin::Profile narrowAsOne(const skin::Profile& profile, double variance) {
    skin::Profile result;
    double weights = 0;
    for (const skin::Gaussian& g : profile.gaussians) {
        if (result.gaussians.empty() || g.variance > variance) {
            result.gaussians.push_back(g);
            weights = g.weight.x + g.weight.y + g.weight.z;
            continue;
        }
        skin::Gaussian& one = result.gaussians.back();
        const double more = g.weight.x + g.weight.y + g.weight.z;
        one.variance = (one.variance * weights + g.variance * more) / (weights + more);
        one.weight += g.weight;
        weights += more;
    }
    return result;
}

// The profile as texture space can hold it, of a body whose skin has that area (mm²). `texel`: the coarsest texel of a level, mm.
//
// A normalised blur loses nothing at the ends of the body, so a Gaussian counts by what it gathers there (skin::gatheredShare); but one
// that is wide beside the body is not blurred at all (passes/wide_gaussians.h). A blur of many times the width of
// both a texel and the blur before it would step over what it is to blur, for its taps are few: levels that nothing
// reads (weight 0) lead up to it. Profiles of skin on bodies of people need neither.
skin::Profile onBody(const skin::Profile& profile, double area, double texel) {
    // Taps then lie within two texels, or two standard deviations of what is blurred: what aliases is below exp(-π²/2).
    constexpr double kWidestStep = 50;
    skin::Profile result;
    double before = 0;
    for (skin::Gaussian g : profile.gaussians) {
        if (isWide(g.variance, area)) {
            result.gaussians.push_back(g);
            continue;
        }
        g.weight *= skin::gatheredShare(g.variance, area);
        g.variance = std::max({g.variance, before, 1e-30});
        for (double step = kWidestStep * std::max({before, texel * texel, 1e-30}); step < g.variance; step *= kWidestStep) {
            result.gaussians.push_back({step, glm::dvec3(0)});
        }
        before = g.variance;
        result.gaussians.push_back(g);
    }
    return result;
}

}  // namespace

std::vector<ChartRange> chartRanges(const Scene& scene, const Atlas& atlas, const RenderSettings& settings) {
    constexpr double kLookupVariance = 1.0 / 6;  // texels², as in shaders/lib/blur_reach.glsl
    const bool merge = settings.prune && settings.chain == Chain::exact;
    // That of the atlas, so that charts of one profile have the same levels and light goes on from one to the other.
    const double coarsestTexel = atlas.mmPerTexel * (reducesLevels(settings) ? 1 << kCoarseLevels : 1);
    std::vector<ChartRange> ranges;
    std::size_t terms = 0;
    for (const AtlasChart& chart : atlas.charts) {
        ChartRange range;
        range.rect = chart.rect;
        range.firstGaussian = static_cast<std::uint32_t>(terms);
        range.profile = profileOf(scene, chart.material, settings.gaussians);
        // Through a rim as thin as a narrow Gaussian light comes by its own variance.
        if (merge && !scene.materials[chart.material].skin->translucency) {
            range.profile = narrowAsOne(range.profile, kLookupVariance * chart.finestMm * chart.finestMm);
        }
        if (settings.chain == Chain::exact) range.profile = onBody(range.profile, chart.bodyMm2, coarsestTexel);
        range.blurred = static_cast<std::uint32_t>(std::count_if(
            range.profile.gaussians.begin(), range.profile.gaussians.end(), [&](const skin::Gaussian& g) {
                return settings.chain == Chain::published || !isWide(g.variance, chart.bodyMm2);
            }));
        range.facing = !scene.materials[chart.material].skin->translucency;
        range.mmPerUnit = static_cast<float>(scene.materials[chart.material].skin->mmPerUnit);
        range.coarsestMm = chart.coarsestMm;
        range.receiverGroup = static_cast<std::uint32_t>(chart.character);
        terms += range.profile.gaussians.size();
        ranges.push_back(std::move(range));
    }
    return ranges;
}

std::vector<int> profileNumbers(const std::vector<ChartRange>& charts) {
    std::vector<std::vector<double>> distinct;
    std::vector<int> numbers;
    for (const ChartRange& chart : charts) {
        std::vector<double> variances;
        for (const skin::Gaussian& g : chart.profile.gaussians) variances.push_back(g.variance);
        numbers.push_back(static_cast<int>(indexOf(distinct, variances)));
    }
    return numbers;
}

bool reducesLevels(const RenderSettings& settings) { return settings.reducedLevels && settings.chain == Chain::exact; }

void uploadMeshes(FrameContext& frame) {
    const Geometry& geometry = frame.geometry;
    SceneBuffers& buffers = frame.scene.buffers;
    gpu::Device& device = *frame.device;
    gpu::Commands& commands = *frame.commands;
    buffers.indices = uploadBuffer(device, commands, "indices", geometry.indices, true);
    buffers.positions = uploadBuffer(device, commands, "positions", geometry.positions);
    buffers.attributes = uploadBuffer(device, commands, "attributes", geometry.attributes);
    buffers.triangleDraws = uploadBuffer(device, commands, "triangle draws", geometry.triangleDraws);
}

void forgetMeshes(FrameContext& frame) {
    SceneBuffers& buffers = frame.scene.buffers;
    buffers.indices = {}, buffers.positions = {}, buffers.attributes = {}, buffers.triangleDraws = {};
}

void uploadSceneTextures(FrameContext& frame) {
    const Scene& scene = *frame.input->scene;
    SceneBuffers& buffers = frame.scene.buffers;
    gpu::Commands commands(*frame.device);
    TextureArrays arrays =
        uploadTextures(*frame.device, commands, scene, textureUses(scene, frame.geometry, frame.settings->prune));
    commands.submitAndWait();
    buffers.textureGroups = static_cast<std::uint32_t>(arrays.images.size());
    buffers.textureArrays = std::move(arrays.images);
    buffers.materialTextures = std::move(arrays.sampled);
    frame.scene.texturePlaces = std::move(arrays.places);
}

void forgetTextures(FrameContext& frame) {
    frame.scene.buffers.materialTextures.clear();
    frame.scene.buffers.textureArrays.clear();
}

// The layout is that of the scene at rest, whatever pose it is in: texels stay on the skin while it moves.
void makeLayout(FrameContext& frame) {
    const AtlasOptions options{.size = frame.settings->irradianceSize,
                               .mmPerTexelWanted = frame.detail.mmPerTexel,
                               .reachMm = reachBeyondBorders(*frame.input->scene, frame.geometry, *frame.settings)};
    frame.atlas = layOutAtlas(*frame.input->scene, frame.skinMesh, frame.geometry, options);
}

void uploadLayout(FrameContext& frame) {
    SceneBuffers& buffers = frame.scene.buffers;
    buffers.atlasVertices = uploadBuffer(*frame.device, *frame.commands, "atlas vertices", frame.atlas.vertices);
    std::vector<std::uint32_t> all(frame.geometry.skinTriangleCount);
    std::iota(all.begin(), all.end(), 0u);
    buffers.skinTriangles = uploadBuffer(*frame.device, *frame.commands, "skin triangles", all);
    buffers.skinTriangleCount = frame.geometry.skinTriangleCount;
    buffers.borderTriangles =
        uploadBuffer(*frame.device, *frame.commands, "border triangles", frame.atlas.borderTriangles);
    buffers.borderTriangleCount = static_cast<std::uint32_t>(frame.atlas.borderTriangles.size());
}

void uploadStretch(FrameContext& frame) {
    frame.scene.buffers.atlasVertices = uploadBuffer(*frame.device, *frame.commands, "atlas vertices",
                                                     verticesInPose(*frame.input->scene, frame.geometry, frame.atlas));
}

void forgetLayout(FrameContext& frame) {
    SceneBuffers& buffers = frame.scene.buffers;
    buffers.atlasVertices = {}, buffers.skinTriangles = {}, buffers.borderTriangles = {};
    buffers.skinTriangleCount = buffers.borderTriangleCount = 0;
    frame.atlas = {};
    for (shared::DrawInfo& draw : frame.geometry.drawInfos) draw.chart = shared::NO_CHART;
}

void uploadDraws(FrameContext& frame) {
    frame.scene.draws = frame.geometry.drawInfos;
    frame.scene.buffers.draws = uploadBuffer(*frame.device, *frame.commands, "draws", frame.scene.draws);
}

void uploadProfiles(FrameContext& frame) {
    frame.scene.charts = chartRanges(*frame.input->scene, frame.atlas, *frame.settings);
    frame.scene.gaussians = 0;
    std::vector<shared::GaussianTerm> terms;
    for (const ChartRange& chart : frame.scene.charts) {
        for (const skin::Gaussian& g : chart.profile.gaussians) {
            terms.push_back({glm::vec3(g.weight), static_cast<float>(g.variance)});
        }
        frame.scene.gaussians = std::max(frame.scene.gaussians, static_cast<int>(chart.profile.gaussians.size()));
    }
    frame.scene.buffers.gaussians = uploadBuffer(*frame.device, *frame.commands, "gaussians", terms);
}

void makeSeams(FrameContext& frame) {
    const std::vector<ChartRange> charts = chartRanges(*frame.input->scene, frame.atlas, *frame.settings);
    const std::vector<int> profiles = profileNumbers(charts);
    std::vector<std::uint32_t> shifts = levelShifts(charts, reducesLevels(*frame.settings));
    shifts.push_back(0);
    for (std::uint32_t shift = 0; shift <= kCoarseLevels; ++shift) {
        if (std::find(shifts.begin(), shifts.end(), shift) == shifts.end()) continue;
        frame.seamMaps[shift] = makeSeamMap(frame.geometry, frame.skinMesh, frame.atlas, profiles, shift);
    }
}

void uploadSeams(FrameContext& frame) {
    SeamLists& seams = frame.scene.buffers.seams;
    for (std::uint32_t shift = 0; shift <= kCoarseLevels; ++shift) {
        const SeamMap map = std::exchange(frame.seamMaps[shift], {});
        seams.counts[shift] = static_cast<std::uint32_t>(map.texels.size());
        if (map.texels.empty()) continue;
        seams.texels[shift] = uploadBuffer(*frame.device, *frame.commands, "seams", map.texels);
        if (shift == 0) seams.metrics = uploadBuffer(*frame.device, *frame.commands, "seam metrics", map.metrics);
    }
}

void forgetSeams(FrameContext& frame) { frame.scene.buffers.seams = {}; }

void makeOccluders(FrameContext& frame) {
    // A third of a texel of the finest map that these meshes are drawn into.
    double texel = std::numeric_limits<double>::infinity();
    for (const ReceiverGroup& group : frame.geometry.receiverGroups) {
        texel = std::min(texel, glm::length(group.restBounds.size()) / kVisibilityMapSize);
    }
    frame.proxyError = 0.3 * texel;
    frame.occluderIndices = makeOcclusionProxies(frame.geometry, frame.proxyError);
}

void uploadOccluders(FrameContext& frame) {
    const std::vector<std::uint32_t> indices = std::exchange(frame.occluderIndices, {});
    frame.scene.buffers.proxyIndices = uploadBuffer(*frame.device, *frame.commands, "sky occluders", indices, true);
}

}  // namespace cutis
