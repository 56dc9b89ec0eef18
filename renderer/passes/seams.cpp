#include "renderer/passes/seams.h"

#include <algorithm>

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

struct CountPush {
    std::uint32_t count;
};

struct TilesPush {
    std::uint32_t count, step, shift, turn;
};

// One invocation for each texel of a list; the push constants begin with its length.
template <class Push>
void dispatchSeams(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, std::uint32_t shift,
                   const char* shader, gpu::Bindings bindings, Push push) {
    push.count = seams.counts[shift];
    if (push.count == 0) return;
    bindings.push_back({"SeamBuffer", seams.texels[shift]});
    const std::uint32_t groups = (push.count + 63) / 64;
    commands.dispatch(device.program(shader), bindings, push,
                      {std::min(groups, shared::TILE_ROW), (groups + shared::TILE_ROW - 1) / shared::TILE_ROW});
}

}  // namespace

void recordGutterTiles(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const AtlasTiles& tiles) {
    dispatchSeams(device, commands, seams, 0, "tiles_gutter.comp",
                  {{"AtlasChartBuffer", tiles.charts}, {"TileStateBuffer", tiles.states}}, CountPush{});
}

void recordGutterStretch(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const AtlasTiles& tiles,
                         const SurfaceImages& surface) {
    if (seams.counts[0] == 0) return;
    dispatchSeams(device, commands, seams, 0, "seams_stretch.comp",
                  {{"stretch", surface.stretch},
                   {"MetricBuffer", seams.metrics},
                   {"AtlasChartBuffer", tiles.charts},
                   {"TileStateBuffer", tiles.states}},
                  CountPush{});
}

void recordSeamTiles(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const AtlasTiles& tiles,
                     std::uint32_t step, std::uint32_t shift, std::uint32_t turn) {
    dispatchSeams(device, commands, seams, shift, "tiles_seams.comp",
                  {{"AtlasChartBuffer", tiles.charts}, {"TileStateBuffer", tiles.states}}, TilesPush{0, step, shift, turn});
}

void recordSeams(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const gpu::ImageView& light,
                 std::uint32_t shift) {
    dispatchSeams(device, commands, seams, shift, "seams.comp", {{"light", light}}, CountPush{});
}

}  // namespace cutis
