#include "renderer/passes/environment_visibility.h"

#include <algorithm>

#include "renderer/gpu/device.h"
#include "renderer/passes/light_maps.h"
#include "renderer/passes/light_views.h"

namespace cutis {
namespace {

constexpr std::uint32_t kBatch = 32;  // directions at a time: the bits of a word

struct BitsPush {
    std::uint32_t receiverGroup, firstView, count, batch;
    std::uint32_t firstVertex, vertexCount, firstProbe, probeCount;
    glm::uvec2 origin, size;  // probes
    float clearance;
};

struct OcclusionPush {
    std::uint32_t directionCount;
    std::uint32_t firstVertex, vertexCount, firstProbe, probeCount;
};

// Calls visit(draw) for every draw whose vertices are probes.
template <class Visit>
void forEachProbeDraw(const VisibilityInput& input, Visit visit) {
    for (std::size_t d = 0; d < input.draws.size(); ++d) {
        if (input.draws[d].chart == shared::NO_CHART) visit(d);
    }
}

}  // namespace

EnvironmentVisibility recordEnvironmentVisibility(gpu::Device& device, gpu::Commands& commands,
                                                  const VisibilityInput& input, std::span<const glm::vec3> directions) {
    EnvironmentVisibility result;
    result.directions = static_cast<int>(directions.size());
    const auto words = static_cast<std::uint32_t>((directions.size() + kBatch - 1) / kBatch);
    if (input.surface) {
        const auto half = static_cast<std::uint32_t>((input.surface->size + 1) / 2);
        result.visibility = gpu::Image(device, {.name = "environment visibility", .format = VK_FORMAT_R32_UINT,
                                                .width = half, .height = half, .layers = words});
    }
    result.vertexVisibility =
        gpu::Buffer(device, {.name = "vertex visibility", .bytes = std::uint64_t(input.probeCount) * words * 4});

    // Views: direction-major within a group, so that a batch of one group is one run of views. Layers are reused by
    // every batch: the depth of 32 directions is all that is ever held.
    std::vector<shared::LightView> views;
    for (std::size_t g = 0; g < input.groups.size(); ++g) {
        for (std::size_t d = 0; d < directions.size(); ++d) {
            views.push_back(directionalView(-glm::dvec3(directions[d]), input.groups[g], input.casters, input.origin,
                                            input.mapSize));
            views.back().layer = static_cast<std::uint32_t>(d % kBatch);
        }
    }
    const gpu::Buffer viewBuffer(
        device, {.name = "environment views", .bytes = views.size() * sizeof(shared::LightView)});
    commands.upload(viewBuffer, views);
    const auto mapSize = static_cast<std::uint32_t>(input.mapSize);
    const gpu::Image depth(device, {.name = "environment depth", .format = VK_FORMAT_D16_UNORM, .width = mapSize,
                                    .height = mapSize, .layers = kBatch});

    for (std::uint32_t g = 0; g < input.groups.size(); ++g) {
        for (std::uint32_t word = 0; word < words; ++word) {
            const auto firstView = static_cast<std::uint32_t>(g * directions.size() + word * kBatch);
            const auto count = std::min<std::uint32_t>(kBatch, directions.size() - word * kBatch);
            recordLightMaps(device, commands, *input.scene,
                            {.depth = &depth, .viewBuffer = &viewBuffer, .views = views, .firstView = firstView,
                             .viewCount = count, .proxies = true});
            BitsPush push{g, firstView, count, word, 0, 0, 0, input.probeCount, {}, {}, input.clearance};
            if (input.surface) {
                const gpu::Program& program = device.program("environment_visibility.comp");
                for (const ChartRange& chart : input.charts) {
                    if (chart.receiverGroup != g) continue;
                    // Chart borders spread a texel outwards, and a probe covers two.
                    push.origin = (glm::uvec2(chart.rect) - 2u) / 2u;
                    push.size = glm::uvec2(chart.rect.z, chart.rect.w) / 2u + 3u;
                    commands.dispatch(program,
                                      {{"position", input.surface->position},
                                       {"normal", input.surface->normal},
                                       {"visibility", result.visibility},
                                       {"DrawBuffer", input.scene->draws},
                                       {"LightViewBuffer", viewBuffer},
                                       {"lightDepthCompare", depthComparison(device, depth)}},
                                      push, gpu::groupsFor(program, push.size.x, push.size.y));
                }
            }
            const gpu::Program& program = device.program("environment_visibility.comp+VERTICES");
            forEachProbeDraw(input, [&](std::size_t d) {
                if (input.draws[d].receiverGroup != g) return;
                push.firstVertex = input.draws[d].firstVertex;
                push.vertexCount = input.vertexCounts[d];
                push.firstProbe = input.draws[d].firstProbe;
                commands.dispatch(program,
                                  {{"PositionBuffer", input.scene->positions},
                                   {"AttributeBuffer", input.scene->attributes},
                                   {"VisibilityBuffer", result.vertexVisibility},
                                   {"LightViewBuffer", viewBuffer},
                                   {"lightDepthCompare", depthComparison(device, depth)}},
                                  push, gpu::groupsFor(program, push.vertexCount));
            });
        }
    }
    return result;
}

void recordEnvironmentOcclusion(gpu::Device& device, gpu::Commands& commands, const VisibilityInput& input,
                                std::span<const glm::vec3> directions,
                                std::span<const shared::EnvironmentDirection> arriving,
                                EnvironmentVisibility& visibility) {
    std::vector<glm::vec4> padded;
    for (const glm::vec3& d : directions) padded.emplace_back(d, 0);
    const gpu::Buffer directionBuffer(device, {.name = "sky directions", .bytes = padded.size() * sizeof(glm::vec4)});
    commands.upload(directionBuffer, padded);
    const gpu::Buffer arrivingBuffer(device, {.name = "sky light", .bytes = arriving.size_bytes()});
    commands.upload(arrivingBuffer, std::as_bytes(arriving));
    OcclusionPush push{static_cast<std::uint32_t>(directions.size()), 0, 0, 0, input.probeCount};
    if (input.surface) {
        const std::uint32_t half = visibility.visibility.width();
        const auto image = [&](const char* name) {
            return gpu::Image(
                device, {.name = name, .format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = half, .height = half});
        };
        visibility.occlusion = image("environment occlusion");
        visibility.openSky = image("open sky");
        const gpu::Program& program = device.program("environment_occlusion.comp");
        commands.dispatch(program,
                          {{"position", input.surface->position},
                           {"normal", input.surface->normal},
                           {"visibility", visibility.visibility},
                           {"occlusion", visibility.occlusion},
                           {"openSky", visibility.openSky},
                           {"DirectionBuffer", directionBuffer},
                           {"EnvironmentDirectionBuffer", arrivingBuffer}},
                          push, gpu::groupsFor(program, half, half));
    }
    visibility.probes =
        gpu::Buffer(device, {.name = "probes", .bytes = std::uint64_t(input.probeCount) * 2 * sizeof(glm::vec4)});
    const gpu::Program& program = device.program("environment_occlusion.comp+VERTICES");
    forEachProbeDraw(input, [&](std::size_t d) {
        push.firstVertex = input.draws[d].firstVertex;
        push.vertexCount = input.vertexCounts[d];
        push.firstProbe = input.draws[d].firstProbe;
        commands.dispatch(program,
                          {{"AttributeBuffer", input.scene->attributes},
                           {"VisibilityBuffer", visibility.vertexVisibility},
                           {"ProbeBuffer", visibility.probes},
                           {"DirectionBuffer", directionBuffer},
                           {"EnvironmentDirectionBuffer", arrivingBuffer}},
                          push, gpu::groupsFor(program, push.vertexCount));
    });
}

}  // namespace cutis
