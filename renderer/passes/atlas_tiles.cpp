#include "renderer/passes/atlas_tiles.h"

#include <algorithm>
#include <atomic>

#include "renderer/gpu/device.h"
#include "renderer/passes/seams.h"

namespace cutis {
namespace {

constexpr std::uint32_t kNeighbours = 2;

struct GrowPush {
    std::uint32_t tileCount, step, level, axis, shift, finerShift, turn;
};

void grow(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene, const AtlasTiles& tiles,
          int taps, const GrowPush& push) {
    const gpu::Program& program = device.program("tiles_grow.comp", {{2, static_cast<std::uint32_t>(taps)}});
    commands.dispatch(program,
                      {{"AtlasChartBuffer", tiles.charts},
                       {"AtlasTileBuffer", tiles.tiles},
                       {"GaussianBuffer", scene.gaussians},
                       {"TileStateBuffer", tiles.states}},
                      push, gpu::groupsFor(program, tiles.count));
}

// Sorts the needed tiles of each chart by their steps.
void listTiles(gpu::Device& device, gpu::Commands& commands, const AtlasTiles& tiles) {
    commands.fill(tiles.counts, 0);
    const gpu::Program& count = device.program("tiles_count.comp");
    commands.dispatch(count,
                      {{"TileStateBuffer", tiles.states},
                       {"TileCountBuffer", tiles.counts},
                       {"AtlasTileBuffer", tiles.tiles}},
                      glm::uvec3(tiles.count, tiles.steps(), tiles.lit()),
                      gpu::groupsFor(count, tiles.count));
    const auto charts = static_cast<std::uint32_t>(tiles.receiverGroups.size());
    const gpu::Program& offsets = device.program("tiles_offsets.comp");
    commands.dispatch(offsets, {{"TileCountBuffer", tiles.counts}, {"TileDispatchBuffer", tiles.dispatches}},
                      glm::uvec2(charts, tiles.steps()), gpu::groupsFor(offsets, charts));
    const gpu::Program& place = device.program("tiles_place.comp");
    commands.dispatch(place,
                      {{"TileStateBuffer", tiles.states},
                       {"TileCountBuffer", tiles.counts},
                       {"TileListBuffer", tiles.list},
                       {"AtlasTileBuffer", tiles.tiles},
                       {"AtlasChartBuffer", tiles.charts}},
                      glm::uvec2(tiles.count, tiles.steps()), gpu::groupsFor(place, tiles.count));
}

}  // namespace

AtlasTiles recordCoveredTiles(gpu::Device& device, gpu::Commands& commands, const gpu::Image& triangles,
                              std::span<const ChartRange> ranges, std::vector<std::uint32_t> shifts,
                              const SeamLists& seams) {
    static std::atomic<std::uint64_t> made{0};
    AtlasTiles result;
    result.id = ++made;
    result.shifts = std::move(shifts);
    std::vector<shared::AtlasChart> charts;
    std::vector<shared::AtlasTile> tiles;
    for (const ChartRange& range : ranges) {
        shared::AtlasChart chart{};
        chart.rect = range.rect;
        chart.firstCell = glm::uvec2(range.rect) / shared::ATLAS_TILE;
        const glm::uvec2 last = glm::uvec2(range.rect) + glm::uvec2(range.rect.z, range.rect.w) - 1u;
        chart.cells = last / shared::ATLAS_TILE - chart.firstCell + 1u;
        chart.firstTile = static_cast<std::uint32_t>(tiles.size());
        chart.firstGaussian = range.firstGaussian;
        chart.gaussianCount = static_cast<std::uint32_t>(range.profile.gaussians.size());
        chart.blurredCount = range.blurred;
        chart.litWhole = std::any_of(ranges.begin(), ranges.end(), [&](const ChartRange& other) {
            return other.receiverGroup == range.receiverGroup && other.blurred < other.profile.gaussians.size();
        });
        result.wholeBodies = result.wholeBodies || chart.litWhole != 0;
        chart.mmPerUnit = range.mmPerUnit;
        for (std::uint32_t y = 0; y < chart.cells.y; ++y) {
            for (std::uint32_t x = 0; x < chart.cells.x; ++x) {
                tiles.push_back({(chart.firstCell + glm::uvec2(x, y)) * shared::ATLAS_TILE,
                                 static_cast<std::uint32_t>(charts.size())});
            }
        }
        charts.push_back(chart);
        result.receiverGroups.push_back(range.receiverGroup);
    }
    result.count = static_cast<std::uint32_t>(tiles.size());
    const auto buffer = [&](const char* name, std::uint64_t bytes, bool indirect = false) {
        return gpu::Buffer(device, {.name = name, .bytes = bytes, .indirect = indirect});
    };
    result.charts = buffer("atlas charts", charts.size() * sizeof(charts[0]));
    result.tiles = buffer("atlas tiles", tiles.size() * sizeof(tiles[0]));
    result.states = buffer("atlas tile states", tiles.size() * sizeof(shared::AtlasTileState));
    result.list = buffer("needed tiles", tiles.size() * 4);
    result.counts = buffer("needed tile counts", (charts.size() * result.steps() + 2) * 4);
    result.dispatches =
        buffer("tile dispatches", charts.size() * result.steps() * sizeof(shared::TileDispatch), true);
    commands.upload(result.charts, charts);
    commands.upload(result.tiles, tiles);
    const gpu::Program& cover = device.program("tiles_cover.comp");
    commands.dispatch(cover,
                      {{"triangles", triangles},
                       {"AtlasChartBuffer", result.charts},
                       {"AtlasTileBuffer", result.tiles},
                       {"TileStateBuffer", result.states}},
                      result.count, gpu::groupsFor(cover, result.count));
    recordGutterTiles(device, commands, seams, result);
    listTiles(device, commands, result);
    return result;
}

void recordSeenTiles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const gpu::Buffer& seenTriangles, AtlasTiles& tiles) {
    const gpu::Program& forget = device.program("tiles_forget.comp");
    commands.dispatch(forget, {{"TileStateBuffer", tiles.states}}, tiles.count,
                      gpu::groupsFor(forget, tiles.count));
    const gpu::Program& seen = device.program("tiles_seen.comp");
    commands.dispatch(seen,
                      {{"SeenBuffer", seenTriangles},
                       {"IndexBuffer", scene.indices},
                       {"TriangleDrawBuffer", scene.triangleDraws},
                       {"DrawBuffer", scene.draws},
                       {"AtlasVertexBuffer", scene.atlasVertices},
                       {"AtlasChartBuffer", tiles.charts},
                       {"TileStateBuffer", tiles.states}},
                      scene.skinTriangleCount, gpu::groupsFor(seen, scene.skinTriangleCount));
    listTiles(device, commands, tiles);
}

void recordNeededTiles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene, int taps,
                       AtlasTiles& tiles) {
    std::uint32_t turn = 0;
    const auto add = [&](std::uint32_t step, std::uint32_t level, std::uint32_t axis, std::uint32_t shift,
                         std::uint32_t finer) {
        grow(device, commands, scene, tiles, taps, {tiles.count, step, level, axis, shift, finer, turn});
        turn = 1 - turn;
    };
    const std::uint32_t coarsest = tiles.shifts.empty() ? 0 : tiles.shifts.back();
    if (coarsest > 0) add(tiles.lookups(), 0, kNeighbours, coarsest, 0);
    for (std::uint32_t level = tiles.levels(); level-- > 0;) {
        const std::uint32_t shift = tiles.shifts[level], finer = tiles.finerShift(level);
        recordSeamTiles(device, commands, scene.seams, tiles, tiles.level(level), shift, turn);
        add(tiles.scratch(level), level, 1, shift, finer);
        add(tiles.scratch(level) + 1, level, 0, shift, finer);
    }
    if (tiles.wholeBodies) {
        const gpu::Program& whole = device.program("tiles_whole.comp");
        commands.dispatch(whole,
                          {{"AtlasChartBuffer", tiles.charts}, {"AtlasTileBuffer", tiles.tiles}, {"TileStateBuffer", tiles.states}},
                          glm::uvec2(tiles.count, tiles.lit()), gpu::groupsFor(whole, tiles.count));
    }
    recordSeamTiles(device, commands, scene.seams, tiles, tiles.lit(), 0, turn);
    // Neighbours are all that bilinear lookups of probes reach.
    add(tiles.probes(), 0, kNeighbours, 0, 0);
    listTiles(device, commands, tiles);
}

gpu::Bindings withTiles(gpu::Bindings bindings, const AtlasTiles& tiles) {
    bindings.push_back({"AtlasChartBuffer", tiles.charts});
    bindings.push_back({"AtlasTileBuffer", tiles.tiles});
    bindings.push_back({"TileListBuffer", tiles.list});
    bindings.push_back({"TileDispatchBuffer", tiles.dispatches});
    return bindings;
}

shared::TilePush tilePush(const AtlasTiles& tiles, std::uint32_t chart, std::uint32_t step) {
    return {chart, chart * tiles.steps() + step, tiles.receiverGroups[chart]};
}

std::uint64_t tileGroups(const gpu::Program& program, const shared::TilePush& push, std::uint32_t shift) {
    const bool large = program.localSize()[0] * program.localSize()[1] == 256;
    return push.dispatch * sizeof(shared::TileDispatch) + offsetof(shared::TileDispatch, groups) +
           (shift + (large ? 1 : 0)) * sizeof(glm::uvec3);
}

CoveredTexels coveredTexels(const gpu::Readback& counts) {
    const std::vector<std::uint32_t> values = counts.as<std::uint32_t>();
    return {values[0], values[1]};
}

}  // namespace cutis
