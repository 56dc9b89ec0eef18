// The pass table: to add a pass, add its row here, its pair of files and its shader.
#include <algorithm>
#include <bit>

#include "renderer/frame/frame.h"
#include "renderer/frame/opposite.h"
#include "renderer/gpu/device.h"
#include "renderer/passes/diffusion.h"
#include "renderer/passes/exitance.h"
#include "renderer/passes/irradiance.h"
#include "renderer/passes/light_maps.h"
#include "renderer/passes/light_views.h"
#include "renderer/passes/opposite.h"
#include "renderer/passes/published_diffusion.h"
#include "renderer/passes/seen_triangles.h"
#include "renderer/passes/surface.h"
#include "renderer/passes/thickness.h"

namespace cutis {
namespace {

constexpr int kSupersampling = 3;
// Light maps are as fine as the picture asks (a texel is one to two pixels), whatever their number: a light casts the same
// shadow alone and among many. Only beyond this much memory do they become coarser.
constexpr std::uint64_t kLightMapBytes = std::uint64_t(2) << 30;
constexpr int kLargestLightMap = 4096, kFinestUsefulLightMap = 1024, kSmallestLightMap = 128;

void addToRuns(const shared::LightSampleData& sample, std::vector<LightRun>& runs, std::uint32_t index) {
    const bool sameLight = !runs.empty() && runs.back().light == sample.light;
    const bool shadow = (sample.flags & shared::LIGHT_SHADOW) != 0;
    if (!sameLight || runs.back().sampleCount == kLongestLightRun || runs.back().shadow != shadow) {
        runs.push_back({.firstSample = index, .firstView = sample.firstView, .light = sample.light, .shadow = shadow,
                        .startsLight = !sameLight});
    }
    ++runs.back().sampleCount;
}

void uploadLights(FrameContext& frame) {
    std::vector<shared::LightSampleData> samples;
    std::uint32_t shadowed = 0;
    int lastLight = 0;
    for (const LightSample& from : frame.lightSamples) {
        shared::LightSampleData to{};
        to.position = glm::vec3(from.position - frame.geometry.origin);
        to.direction = glm::vec3(from.direction);
        to.intensity = glm::vec3(from.intensity);
        to.cosInner = static_cast<float>(from.cosInner);
        to.cosOuter = static_cast<float>(from.cosOuter);
        to.range = static_cast<float>(from.range);
        to.radius = static_cast<float>(from.radius);
        if (from.directional) to.flags |= shared::LIGHT_DIRECTIONAL;
        if (from.cosineEmission) to.flags |= shared::LIGHT_COSINE;
        if (from.shadow) {
            to.flags |= shared::LIGHT_SHADOW;
            to.firstView = shadowed++ * static_cast<std::uint32_t>(frame.groups.size());
        }
        if (samples.empty() || from.light != lastLight) to.light = frame.lights.lightCount++;
        else to.light = frame.lights.lightCount - 1;
        lastLight = from.light;
        addToRuns(to, frame.lights.runs, static_cast<std::uint32_t>(samples.size()));
        samples.push_back(to);
    }
    frame.lights.groupCount = static_cast<std::uint32_t>(frame.groups.size());
    frame.lights.sampleCount = static_cast<std::uint32_t>(samples.size());
    frame.lights.samples = gpu::Buffer(
        *frame.device, {.name = "light samples", .bytes = samples.size() * sizeof(shared::LightSampleData)});
    if (!samples.empty()) frame.commands->upload(frame.lights.samples, samples);
}

int lightMapSize(const FrameContext& frame, std::size_t views) {
    if (frame.settings->lightMapSize > 0) return frame.settings->lightMapSize;
    const std::uint64_t texelBytes = frame.needs[Need::translucency] ? 8 : 4;
    const auto wanted = static_cast<unsigned>(std::clamp<double>(frame.pixelsAcross, 1, kLargestLightMap));
    int size = std::clamp(static_cast<int>(std::bit_ceil(wanted)) / 2, kFinestUsefulLightMap, kLargestLightMap);
    while (size > kSmallestLightMap && views * texelBytes * size * size > kLightMapBytes) size /= 2;
    return size;
}

void lightMapsRow(FrameContext& frame) {
    std::vector<LightSample> shadowed;
    for (const LightSample& sample : frame.lightSamples) {
        if (sample.shadow) shadowed.push_back(sample);
    }
    LightMaps& maps = frame.lights;
    const std::size_t count = shadowed.size() * frame.groups.size();
    maps.size = lightMapSize(frame, count);
    maps.viewList =
        computeLightViews(shadowed, frame.groups, frame.geometry.bounds, frame.geometry.origin, maps.size);
    maps.views = gpu::Buffer(*frame.device, {.name = "light views", .bytes = count * sizeof(shared::LightView)});
    frame.commands->upload(maps.views, maps.viewList);
    const auto image = [&](const char* name, VkFormat format) {
        const auto size = static_cast<std::uint32_t>(maps.size);
        return gpu::Image(*frame.device, {.name = name, .format = format, .width = size, .height = size,
                                          .layers = static_cast<std::uint32_t>(count)});
    };
    maps.depth = image("light depth", VK_FORMAT_D32_SFLOAT);
    if (frame.needs[Need::translucency]) maps.entry = image("light entry points", VK_FORMAT_R32_UINT);
    recordLightMaps(*frame.device, *frame.commands, frame.scene.buffers,
                    {.depth = &maps.depth, .entry = maps.entry ? &maps.entry : nullptr, .viewBuffer = &maps.views,
                     .views = maps.viewList, .firstView = 0, .viewCount = static_cast<std::uint32_t>(count),
                     .atlasSize = frame.atlas.size});
}

void surfaceRow(FrameContext& frame) {
    const bool reduced = frame.settings->reducedLevels && frame.settings->chain == Chain::exact;
    frame.surface = recordSurface(*frame.device, *frame.commands, frame.scene.buffers, frame.scene.charts,
                                  frame.atlas.size, levelShifts(frame.scene.charts, reduced), frame.tiles);
}

// Calls body(tile) for the parts of the picture, with room for one of them in frame.viewTile.
template <class Body>
void forEachViewTile(FrameContext& frame, Body body) {
    const glm::ivec2 picture(frame.settings->width, frame.settings->height);
    const int step = tileSize(frame.scene.buffers, kSupersampling);
    if (!frame.viewTile.camera) {
        frame.viewTile = makeTileBuffers(*frame.device, frame.scene.buffers, glm::min(glm::ivec2(step), picture),
                                         kSupersampling);
    }
    for (int y = 0; y < picture.y; y += step) {
        for (int x = 0; x < picture.x; x += step) {
            const glm::ivec2 origin(x, y);
            body(ViewTile{origin, glm::min(glm::ivec2(step), picture - origin), picture, kSupersampling});
        }
    }
}

void visibleRow(FrameContext& frame) {
    const gpu::Buffer seen = makeSeenTriangles(*frame.device, *frame.commands, frame.scene.buffers);
    forEachViewTile(frame, [&](const ViewTile& tile) {
        recordSeenTriangles(*frame.device, *frame.commands, frame.scene.buffers, frame.camera, tile, frame.viewTile,
                            seen);
    });
    recordSeenTiles(*frame.device, *frame.commands, frame.scene.buffers, seen, frame.tiles);
}

void thicknessRow(FrameContext& frame) {
    recordThickness(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.lights, frame.tiles,
                    frame.skin);
}

void neededTexelsRow(FrameContext& frame) {
    recordNeededTiles(*frame.device, *frame.commands, frame.scene.buffers, frame.tiles);
}

void oppositeRow(FrameContext& frame) {
    const std::vector<shared::OppositeVertex> vertices =
        findOpposite(*frame.input->scene, frame.geometry, frame.atlas);
    frame.oppositeVertices = gpu::Buffer(*frame.device, {.name = "opposite sides", .bytes = vertices.size() * sizeof(vertices[0])});
    frame.commands->upload(frame.oppositeVertices, vertices);
    recordOpposite(*frame.device, *frame.commands, frame.scene.buffers, frame.oppositeVertices, frame.tiles,
                   frame.surface);
}

void environmentVisibilityRow(FrameContext& frame) {
    std::vector<std::uint32_t> vertexCounts;
    for (const GeometryDraw& draw : frame.geometry.draws) vertexCounts.push_back(draw.vertexCount);
    const VisibilityInput input{.scene = &frame.scene.buffers,
                                .surface = frame.surface.size > 0 ? &frame.surface : nullptr,
                                .tiles = &frame.tiles,
                                .draws = frame.geometry.drawInfos,
                                .vertexCounts = vertexCounts,
                                .groups = frame.groups,
                                .casters = frame.geometry.bounds,
                                .origin = frame.geometry.origin,
                                .probeCount = frame.geometry.probeCount,
                                .mapSize = kVisibilityMapSize,
                                .clearance = 2 * static_cast<float>(frame.proxyError)};
    const EnvironmentSettings& settings = frame.input->rig.environment;
    std::vector<glm::dvec3> directions;
    std::vector<glm::vec4> parts;  // of the sky
    for (const VisibilityDirection& part : visibilityDirections(*frame.environment, shared::VISIBILITY_DIRECTIONS)) {
        directions.push_back(rotateAboutY(part.direction, settings.rotation));
        parts.emplace_back(directions.back(), part.solidAngle);
    }
    std::vector<shared::EnvironmentDirection> arriving;
    for (const DirectionalFlux& from :
         fluxPerDirection(frame.clusters, directions, settings.rotation, settings.intensity)) {
        arriving.push_back({glm::vec3(from.flux), glm::vec3(from.direction)});
    }
    frame.visibility = recordEnvironmentVisibility(*frame.device, *frame.commands, input, parts);
    recordEnvironmentOcclusion(*frame.device, *frame.commands, input, parts, arriving, frame.visibility);
}

void irradianceRow(FrameContext& frame) {
    const bool environment = frame.needs[Need::environment];
    recordIrradiance(*frame.device, *frame.commands,
                     {.scene = &frame.scene.buffers,
                      .surface = &frame.surface,
                      .tiles = &frame.tiles,
                      .lights = frame.needs[Need::lights] ? &frame.lights : nullptr,
                      .environment = environment ? &frame.environmentMaps : nullptr,
                      .visibility = environment ? &frame.visibility : nullptr,
                      .environmentSettings = environment ? &frame.environmentSettings : nullptr},
                     frame.skin);
}

void diffusionRow(FrameContext& frame) {
    const auto record = frame.settings->chain == Chain::published ? recordPublishedDiffusion : recordDiffusion;
    record(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.tiles, frame.skin);
}

void exitanceRow(FrameContext& frame) {
    recordExitance(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.tiles,
                   frame.settings->chain == Chain::published ? ThicknessStorage::bytes : ThicknessStorage::floats,
                   frame.skin);
}

// Both depend on the camera and work tile by tile, so one row holds them.
void compositeRow(FrameContext& frame) {
    const bool environment = frame.needs[Need::environment];
    if (frame.target.aovs) frame.commands->clear(frame.target.aovs);
    forEachViewTile(frame, [&](const ViewTile& tile) {
        recordView(*frame.device, *frame.commands, frame.scene.buffers, frame.camera, tile, frame.viewTile);
        recordComposite(*frame.device, *frame.commands,
                        {.scene = &frame.scene.buffers,
                         .buffers = &frame.viewTile,
                         .skin = frame.needs[Need::litSkin] ? &frame.skin : nullptr,
                         .surface = &frame.surface,
                         .lights = &frame.lights,
                         .environment = environment ? &frame.environmentMaps : nullptr,
                         .visibility = environment ? &frame.visibility : nullptr,
                         .environmentSettings = environment ? &frame.environmentSettings : nullptr},
                        tile, frame.target);
    });
}

}  // namespace

void uploadFrameLights(FrameContext& frame) { uploadLights(frame); }

const std::vector<PassRow>& passTable() {
    using R = Resource;
    static const std::vector<PassRow> table{
        // name                     need                reads                        reads if written              writes
        {"surface",                 Need::skin,         {},                          {},                           {R::surface},    surfaceRow},
        {"visible",                 Need::hiddenSkin,   {R::surface},                {},                           {R::seen},       visibleRow},
        {"opposite",                Need::oppositeSides, {R::surface},               {R::seen},                    {R::thickness},  oppositeRow},
        {"light_maps",              Need::shadows,      {},                          {},                           {R::lightMaps},  lightMapsRow},
        {"thickness",               Need::translucency, {R::surface, R::lightMaps},  {R::seen},                    {R::thickness},  thicknessRow},
        {"needed_texels",           Need::litSkin,      {R::surface},                {R::seen, R::thickness},      {R::tiles},      neededTexelsRow},
        {"environment_visibility",  Need::environment,  {},                          {R::surface, R::tiles},       {R::visibility}, environmentVisibilityRow},
        {"irradiance",              Need::litSkin,      {R::surface, R::tiles},      {R::thickness, R::lightMaps, R::visibility}, {R::irradiance}, irradianceRow},
        {"diffusion",               Need::litSkin,      {R::surface, R::irradiance}, {},                           {R::levels},     diffusionRow},
        {"exitance",                Need::litSkin,      {R::levels},                 {R::thickness},               {R::exitance},   exitanceRow},
        {"composite",               Need::always,       {},                          {R::exitance, R::lightMaps, R::visibility}, {R::picture}, compositeRow},
    };
    return table;
}

}  // namespace cutis
