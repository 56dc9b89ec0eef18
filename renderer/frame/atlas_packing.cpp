#include "renderer/frame/atlas_packing.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "shaders/shared/atlas_tiles.h"

namespace cutis {
namespace {

// Border triangles spread a texel beyond their island; two more keep neighbours out of bilinear lookups.
constexpr int kLeastGutter = 3;
// Rectangles, gutters included, begin and end on a grid of this many texels: each texel of a diffusion level of lower
// resolution then belongs to one of them.
constexpr int kGrid = 1 << shared::COARSEST_LEVEL;
constexpr double kLargestSide = 1 << 16;  // texels of an island that is worth placing
// A layout as it came takes up to this many times the texels of its islands' rectangles.
constexpr double kMostEmpty = 4;
// Of more islands than this the tightest packing takes too long.
constexpr std::size_t kManyIslands = 4096;

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

// Places rectangles in rows, high ones first: quick for any number of them. `width` holds the widest.
void packRows(std::vector<stbrp_rect>& rects, int width) {
    std::vector<stbrp_rect*> order;
    for (stbrp_rect& rect : rects) order.push_back(&rect);
    std::sort(order.begin(), order.end(), [](const stbrp_rect* a, const stbrp_rect* b) {
        return a->h != b->h ? a->h > b->h : a->id < b->id;
    });
    int x = 0, y = 0, height = 0;
    for (stbrp_rect* rect : order) {
        if (x + rect->w > width) x = 0, y += height, height = 0;
        rect->x = x, rect->y = y;
        x += rect->w;
        height = std::max(height, static_cast<int>(rect->h));
    }
}

// The island's size in texels.
glm::dvec2 texelsOf(const ChartShape& chart, const IslandShape& island) {
    return (island.uvMax - island.uvMin) * chart.texelsPerUv * island.scale;
}

// Packs islands about square; returns the size of the rectangle that they take, in cells.
glm::ivec2 packIslands(ChartShape& chart) {
    std::vector<stbrp_rect> rects;
    double area = 0;
    int widest = 1, height = 0;
    for (std::size_t i = 0; i < chart.islands.size(); ++i) {
        const IslandShape& island = chart.islands[i];
        const glm::dvec2 texels = texelsOf(chart, island);
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
    if (rects.size() > kManyIslands) {
        packRows(rects, width);
    } else {
        packRects(rects, width, height);  // one above the other they fit in any case
    }
    glm::ivec2 taken(1);
    for (const stbrp_rect& rect : rects) {
        IslandShape& island = chart.islands[rect.id];
        island.place = glm::dvec2(rect.x * kGrid + island.gutter, rect.y * kGrid + island.gutter);
        taken = glm::max(taken, glm::ivec2(rect.x + rect.w, rect.y + rect.h));
    }
    return taken;
}

// The layout as it came, with room around it. Nothing where it does not serve.
std::optional<glm::ivec2> keepIslands(ChartShape& chart) {
    glm::dvec2 low(1e300), high(-1e300);
    int gutter = kLeastGutter;
    double held = 0;  // texels of the islands' rectangles
    for (const IslandShape& island : chart.islands) {
        if (chart.islands.size() > 1 && (island.continued || island.overlaps || island.scale != glm::dvec2(1))) return {};
        low = glm::min(low, island.uvMin), high = glm::max(high, island.uvMax);
        gutter = std::max(gutter, island.gutter);
        const glm::dvec2 texels = texelsOf(chart, island) + 2.0 * island.gutter;
        held += texels.x * texels.y;
    }
    const glm::dvec2 texels = (high - low) * chart.texelsPerUv, all = texels + 2.0 * gutter;
    if (chart.islands.size() > 1 && all.x * all.y > kMostEmpty * held) return {};
    for (IslandShape& island : chart.islands) {
        island.place = (island.uvMin - low) * chart.texelsPerUv + double(gutter);
    }
    return glm::ivec2(cellsFor(texels.x, gutter), cellsFor(texels.y, gutter));
}

// Sizes in cells of the charts' rectangles at that scale; none where one is too large to place.
std::vector<glm::ivec2> layOutCharts(std::vector<ChartShape>& charts, double scale) {
    std::vector<glm::ivec2> sizes;
    for (ChartShape& chart : charts) {
        const double texelsPerMm = chart.texelsPerMm * scale;
        chart.texelsPerUv = chart.mmPerUv * texelsPerMm;
        for (IslandShape& island : chart.islands) {
            const glm::dvec2 texels = texelsOf(chart, island);
            if (!(texels.x < kLargestSide) || !(texels.y < kLargestSide)) return {};
            const double most = std::min(chart.reachMm * texelsPerMm, 0.5 * std::sqrt(texels.x * texels.y));
            island.gutter = island.continued ? std::max(kLeastGutter, static_cast<int>(std::ceil(most))) : kLeastGutter;
        }
        const std::optional<glm::ivec2> kept = keepIslands(chart);
        sizes.push_back(kept ? *kept : packIslands(chart));
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
