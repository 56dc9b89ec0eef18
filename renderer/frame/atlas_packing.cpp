#include "renderer/frame/atlas_packing.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <cmath>

#include "shaders/shared/atlas_tiles.h"

namespace cutis {
namespace {

// Border triangles spread a texel beyond their island; two more keep neighbours out of bilinear lookups.
constexpr int kLeastGutter = 3;
// Rectangles, gutters included, begin and end on a grid of this many texels: each texel of a diffusion level of lower
// resolution then belongs to one of them.
constexpr int kGrid = 1 << shared::COARSEST_LEVEL;
constexpr double kLargestSide = 1 << 16;  // texels of an island that is worth placing

int cellsFor(double texels, int gutter) {
    return (std::max(static_cast<int>(std::ceil(texels)), 1) + 2 * gutter + kGrid - 1) / kGrid;
}

// Places rectangles of w × h cells in a target of width × height.
bool packRects(std::vector<stbrp_rect>& rects, int width, int height) {
    if (width <= 0 || height <= 0) return false;
    stbrp_context context;
    std::vector<stbrp_node> nodes(static_cast<std::size_t>(width));
    stbrp_init_target(&context, width, height, nodes.data(), width);
    return stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size())) != 0;
}

// Packs islands about square; returns the size of the rectangle that they take, in cells.
glm::ivec2 packIslands(ChartShape& chart) {
    std::vector<stbrp_rect> rects;
    double area = 0;
    int widest = 1, height = 0;
    for (std::size_t i = 0; i < chart.islands.size(); ++i) {
        const IslandShape& island = chart.islands[i];
        const glm::dvec2 texels = (island.uvMax - island.uvMin) * chart.texelsPerUv;
        stbrp_rect rect{};
        rect.id = static_cast<int>(i);
        rect.w = cellsFor(texels.x, island.gutter);
        rect.h = cellsFor(texels.y, island.gutter);
        area += double(rect.w) * rect.h;
        widest = std::max(widest, static_cast<int>(rect.w));
        height += rect.h;
        rects.push_back(rect);
    }
    const int width = std::max(widest, static_cast<int>(std::ceil(std::sqrt(area))));
    packRects(rects, width, height);  // one above the other they fit in any case
    glm::ivec2 taken(1);
    for (const stbrp_rect& rect : rects) {
        IslandShape& island = chart.islands[rect.id];
        island.place = glm::dvec2(rect.x * kGrid + island.gutter, rect.y * kGrid + island.gutter);
        taken = glm::max(taken, glm::ivec2(rect.x + rect.w, rect.y + rect.h));
    }
    return taken;
}

// The layout as it came, with room around it.
glm::ivec2 keepIslands(ChartShape& chart) {
    glm::dvec2 low(1e300), high(-1e300);
    int gutter = kLeastGutter;
    for (const IslandShape& island : chart.islands) {
        low = glm::min(low, island.uvMin), high = glm::max(high, island.uvMax);
        gutter = std::max(gutter, island.gutter);
    }
    for (IslandShape& island : chart.islands) {
        island.place = (island.uvMin - low) * chart.texelsPerUv + double(gutter);
    }
    const glm::dvec2 texels = (high - low) * chart.texelsPerUv;
    return {cellsFor(texels.x, gutter), cellsFor(texels.y, gutter)};
}

// Sizes in cells of the charts' rectangles at that scale; none where one is too large to place.
std::vector<glm::ivec2> layOutCharts(std::vector<ChartShape>& charts, double scale) {
    std::vector<glm::ivec2> sizes;
    for (ChartShape& chart : charts) {
        const double texelsPerMm = chart.texelsPerMm * scale;
        chart.texelsPerUv = chart.mmPerUv * texelsPerMm;
        bool apart = false;
        for (IslandShape& island : chart.islands) {
            const glm::dvec2 texels = (island.uvMax - island.uvMin) * chart.texelsPerUv;
            if (!(texels.x < kLargestSide) || !(texels.y < kLargestSide)) return {};
            const double most = std::min(chart.reachMm * texelsPerMm, 0.5 * std::sqrt(texels.x * texels.y));
            island.gutter = island.continued ? std::max(kLeastGutter, static_cast<int>(std::ceil(most))) : kLeastGutter;
            apart |= island.continued && chart.islands.size() > 1;
        }
        sizes.push_back(apart ? packIslands(chart) : keepIslands(chart));
    }
    return sizes;
}

bool place(std::vector<ChartShape>& charts, const std::vector<glm::ivec2>& sizes, int size) {
    std::vector<stbrp_rect> rects;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        if (sizes.size() != charts.size() || std::max(sizes[i].x, sizes[i].y) > size / kGrid) return false;
        stbrp_rect rect{};
        rect.id = static_cast<int>(i);
        rect.w = sizes[i].x, rect.h = sizes[i].y;
        rects.push_back(rect);
    }
    if (!packRects(rects, size / kGrid, size / kGrid)) return false;
    for (const stbrp_rect& rect : rects) charts[rect.id].rect = glm::uvec4(rect.x, rect.y, rect.w, rect.h) * unsigned(kGrid);
    return true;
}

}  // namespace

bool packCharts(std::vector<ChartShape>& charts, int size, double scale) {
    return place(charts, layOutCharts(charts, scale), size);
}

int packSmallest(std::vector<ChartShape>& charts, int largest) {
    const std::vector<glm::ivec2> sizes = layOutCharts(charts, 1);
    for (int size = 64; size <= largest; size += std::max(64, size / 8 / 64 * 64)) {
        if (place(charts, sizes, size)) return size;
    }
    return 0;
}

}  // namespace cutis
