#include "renderer/passes/environment_visibility.h"

#include <algorithm>

#include "renderer/gpu/device.h"
#include "renderer/passes/light_maps.h"
#include "renderer/passes/light_views.h"

namespace cutis {
namespace {

constexpr std::uint32_t kBatch = 32;  // directions at a time: the bits of a word
// Receiver groups at a time: the depth of 32 directions for each of them is all that is ever held.
constexpr std::uint32_t kGroupBatch = 8;

struct BitsPush {
    shared::TilePush tiles;
    std::uint32_t firstView, groupViews, word;
    std::uint32_t firstVertex, vertexCount, firstProbe, probeCount;  // of a draw
    float clearance;
};

struct OcclusionPush {
    shared::TilePush tiles;
    std::uint32_t word;
    std::uint32_t firstVertex, vertexCount, firstProbe, probeCount;  // of a draw
};

bool changes(const VisibilityInput& input, std::size_t group) {
    return input.groupsChanged.empty() || input.groupsChanged[group];
}

// Calls visit(draw) for every draw whose vertices are probes that are seen.
template <class Visit>
void forEachProbeDraw(const VisibilityInput& input, Visit visit) {
    for (std::size_t d = 0; d < input.draws.size(); ++d) {
        const std::uint32_t group = input.draws[d].receiverGroup;
        if (input.draws[d].chart == shared::NO_CHART && input.groupsSeen[group] && changes(input, group)) visit(d);
    }
}

}  // namespace

void recordEnvironmentVisibility(gpu::Device& device, gpu::Commands& commands, const VisibilityInput& input,
                                 std::span<const glm::vec4> directions, EnvironmentVisibility& result) {
    const bool whole = input.groupsChanged.empty();
    if (whole) result = {};
    result.directions = static_cast<int>(directions.size());
    const auto words = static_cast<std::uint32_t>((directions.size() + kBatch - 1) / kBatch);
    if (input.surface && whole) {
        const auto half = static_cast<std::uint32_t>((input.surface->size + 1) / 2);
        result.visibility = gpu::Image(device, {.name = "environment visibility",
                                                .format = VK_FORMAT_R32_UINT,
                                                .width = half,
                                                .height = half,
                                                .layers = words});
    }
    if (whole) {
        result.vertexVisibility = gpu::Buffer(
            device, {.name = "vertex visibility", .bytes = std::uint64_t(input.probeCount) * words * 4});
    }

    // Views: direction-major within a group, so that a batch of one group is one run of views.
    std::vector<shared::LightView> views;
    for (std::size_t g = 0; g < input.groups.size(); ++g) {
        for (std::size_t d = 0; d < directions.size(); ++d) {
            views.push_back(directionalView(-glm::dvec3(glm::vec3(directions[d])), input.groups[g], input.casters,
                                            input.origin, input.mapSize));
            views.back().layer = static_cast<std::uint32_t>(g % kGroupBatch * kBatch + d % kBatch);
        }
    }
    const gpu::Buffer viewBuffer(
        device, {.name = "environment views", .bytes = views.size() * sizeof(shared::LightView)});
    commands.upload(viewBuffer, views);
    const auto mapSize = static_cast<std::uint32_t>(input.mapSize);
    const auto groups = static_cast<std::uint32_t>(input.groups.size());
    const gpu::Image depth(device, {.name = "environment depth",
                                    .format = VK_FORMAT_D16_UNORM,
                                    .width = mapSize,
                                    .height = mapSize,
                                    .layers = kBatch * std::min(groups, kGroupBatch)});

    const auto unseen = std::find(input.groupsSeen.begin(), input.groupsSeen.end(), false);
    if (unseen != input.groupsSeen.end()) commands.clear(depth, gpu::ClearValue::depth(1));  // theirs stays empty
    const auto directionCount = static_cast<std::uint32_t>(directions.size());
    for (std::uint32_t first = 0; first < groups; first += kGroupBatch) {
        const std::uint32_t groupCount = std::min(kGroupBatch, groups - first);
        const auto seen = input.groupsSeen.begin() + first;
        if (std::none_of(seen, seen + groupCount, [](bool s) { return s; })) continue;
        bool any = false;
        for (std::uint32_t g = first; g < first + groupCount; ++g) any |= changes(input, g);
        if (!any) continue;
        for (std::uint32_t word = 0; word < words; ++word) {
            for (std::uint32_t g = first; g < first + groupCount; ++g) {
                if (!input.groupsSeen[g] || !changes(input, g)) continue;
                recordLightMaps(device, commands, *input.scene,
                                {.depth = &depth,
                                 .viewBuffer = &viewBuffer,
                                 .views = views,
                                 .firstView = g * directionCount + word * kBatch,
                                 .viewCount = std::min(kBatch, directionCount - word * kBatch),
                                 .proxies = true});
            }
            BitsPush push{{}, 0, directionCount, word, 0, 0, 0, input.probeCount, input.clearance};
            const auto hasMaps = [&](std::uint32_t group) {
                return group >= first && group < first + groupCount;
            };
            if (input.surface) {
                const gpu::Bindings bindings =
                    withTiles({{"position", input.surface->position},
                               {"normal", input.surface->normal},
                               {"visibility", result.visibility},
                               {"DrawBuffer", input.scene->draws},
                               {"MaterialBuffer", input.scene->materials},
                               {"LightViewBuffer", viewBuffer},
                               {"lightDepthCompare", depthComparison(device, depth)}},
                              *input.tiles);
                for (std::uint32_t chart = 0; chart < input.tiles->receiverGroups.size(); ++chart) {
                    // Of what is not seen no tile is needed.
                    const std::uint32_t group = input.tiles->receiverGroups[chart];
                    if ((!hasMaps(group) && input.groupsSeen[group]) || !changes(input, group)) continue;
                    push.tiles = tilePush(*input.tiles, chart, input.tiles->probes());
                    const gpu::Program& program = device.program("environment_visibility.comp");
                    commands.dispatchIndirect(program, bindings, push, input.tiles->dispatches,
                                              tileGroups(program, push.tiles, 1));
                }
            }
            const gpu::Program& program = device.program("environment_visibility.comp+VERTICES");
            forEachProbeDraw(input, [&](std::size_t d) {
                if (!hasMaps(input.draws[d].receiverGroup)) return;
                push.tiles.receiverGroup = input.draws[d].receiverGroup;
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
}

void recordEnvironmentOcclusion(gpu::Device& device, gpu::Commands& commands, const VisibilityInput& input,
                                std::span<const glm::vec4> directions,
                                std::span<const shared::EnvironmentDirection> arriving,
                                EnvironmentVisibility& visibility) {
    const gpu::Buffer directionBuffer(device, {.name = "sky directions", .bytes = directions.size_bytes()});
    commands.upload(directionBuffer, std::as_bytes(directions));
    const gpu::Buffer arrivingBuffer(device, {.name = "sky light", .bytes = arriving.size_bytes()});
    commands.upload(arrivingBuffer, std::as_bytes(arriving));
    const bool whole = input.groupsChanged.empty();
    OcclusionPush push{{}, 0, 0, 0, 0, input.probeCount};
    const auto words = static_cast<std::uint32_t>(directions.size() / kBatch);
    if (input.surface) {
        const std::uint32_t half = visibility.visibility.width();
        const auto image = [&](const char* name, VkFormat format, std::uint32_t layers = 1) {
            return gpu::Image(
                device, {.name = name, .format = format, .width = half, .height = half, .layers = layers});
        };
        if (whole) {
            visibility.occlusion = image("environment occlusion", VK_FORMAT_R16G16B16A16_SFLOAT);
            visibility.openSky = image("open sky", VK_FORMAT_R16G16B16A16_SFLOAT);
            commands.clear(visibility.occlusion);
            commands.clear(visibility.openSky);
        }
        const gpu::Image sums = image("environment sums", VK_FORMAT_R32G32B32A32_SFLOAT, 3);
        const gpu::Bindings bindings = withTiles({{"position", input.surface->position},
                                                  {"normal", input.surface->normal},
                                                  {"visibility", visibility.visibility},
                                                  {"occlusion", visibility.occlusion},
                                                  {"openSky", visibility.openSky},
                                                  {"sums", sums},
                                                  {"DrawBuffer", input.scene->draws},
                                                  {"DirectionBuffer", directionBuffer},
                                                  {"EnvironmentDirectionBuffer", arrivingBuffer}},
                                                 *input.tiles);
        for (push.word = 0; push.word < words; ++push.word) {
            for (std::uint32_t chart = 0; chart < input.tiles->receiverGroups.size(); ++chart) {
                if (!changes(input, input.tiles->receiverGroups[chart])) continue;
                push.tiles = tilePush(*input.tiles, chart, input.tiles->probes());
                const gpu::Program& program = device.program("environment_occlusion.comp");
                commands.dispatchIndirect(program, bindings, push, input.tiles->dispatches,
                                          tileGroups(program, push.tiles, 1));
            }
        }
    }
    if (whole) {
        visibility.probes = gpu::Buffer(
            device, {.name = "probes", .bytes = std::uint64_t(input.probeCount) * 2 * sizeof(glm::vec4)});
    }
    const gpu::Buffer sums(device, {.name = "environment sums",
                                    .bytes = std::uint64_t(input.probeCount) * 3 * sizeof(glm::vec4)});
    const gpu::Program& program = device.program("environment_occlusion.comp+VERTICES");
    for (push.word = 0; push.word < words; ++push.word) {
        forEachProbeDraw(input, [&](std::size_t d) {
            push.firstVertex = input.draws[d].firstVertex;
            push.vertexCount = input.vertexCounts[d];
            push.firstProbe = input.draws[d].firstProbe;
            commands.dispatch(program,
                              {{"AttributeBuffer", input.scene->attributes},
                               {"VisibilityBuffer", visibility.vertexVisibility},
                               {"ProbeBuffer", visibility.probes},
                               {"SumBuffer", sums},
                               {"DirectionBuffer", directionBuffer},
                               {"EnvironmentDirectionBuffer", arrivingBuffer}},
                              push, gpu::groupsFor(program, push.vertexCount));
        });
    }
}

}  // namespace cutis
