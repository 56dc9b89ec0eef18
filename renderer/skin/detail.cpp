#include "renderer/skin/detail.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "renderer/skin/specular.h"

namespace cutis::skin {
namespace {

// A number in [0,1) for each cell (PCG, O'Neill 2014): the same on every machine.
double randomOf(std::uint32_t seed) {
    std::uint32_t x = seed * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return ((x >> 22u) ^ x) / 4294967296.0;
}

// Scattered points, one in each cell of a grid of `cells` along a side of the tile.
glm::dvec2 pointOf(int column, int row, int cells) {
    const auto wrap = [&](int i) { return static_cast<std::uint32_t>((i % cells + cells) % cells); };
    const std::uint32_t cell = 10007u * cells + wrap(row) * cells + wrap(column);
    return {column + randomOf(2 * cell), row + randomOf(2 * cell + 1)};
}

// Plates between furrows, as skin's surface has them: domes about scattered points, which fall off towards
// the lines where two of these are equally far (Worley 1996). `place`: 1 across the tile.
double platesAt(const glm::dvec2& place, int cells) {
    const glm::dvec2 p = place * double(cells);
    const int column = static_cast<int>(std::floor(p.x)), row = static_cast<int>(std::floor(p.y));
    double nearest = std::numeric_limits<double>::infinity(), second = nearest;
    for (int y = row - 2; y <= row + 2; ++y) {
        for (int x = column - 2; x <= column + 2; ++x) {
            const double distance = glm::distance(p, pointOf(x, y, cells));
            if (distance < nearest) {
                second = nearest, nearest = distance;
            } else {
                second = std::min(second, distance);
            }
        }
    }
    const double toEdge = (second - nearest) / 0.35;
    return (-std::exp(-toEdge * toEdge) - 0.25 * nearest * nearest) / cells;
}

// Wide furrows between plates, and shallower ones across these.
double heightAt(const glm::dvec2& place) {
    return platesAt(place, 17) + 0.6 * platesAt(place, 29);
}

int wrapped(long long i, int size) {
    return static_cast<int>(((i % size) + size) % size);
}

// Means over a fine grid of places between texels: the mean square of what lookups show.
double varianceOf(const DetailTile& tile, int level) {
    constexpr int kPlaces = 3;
    const int size = kDetailSize >> level, side = size * kPlaces;
    double sum = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::dvec2 slope = tile.lookUp(level, (glm::dvec2(x, y) + 0.5) / double(side));
            sum += glm::dot(slope, slope);
        }
    }
    return sum / (double(side) * side);
}

DetailTile makeTile() {
    std::vector<double> height;
    for (int y = 0; y < kDetailSize; ++y) {
        for (int x = 0; x < kDetailSize; ++x)
            height.push_back(heightAt((glm::dvec2(x, y) + 0.5) / double(kDetailSize)));
    }
    const auto at = [&](int x, int y) {
        return height[std::size_t(wrapped(y, kDetailSize)) * kDetailSize + wrapped(x, kDetailSize)];
    };
    DetailTile tile{};
    for (int y = 0; y < kDetailSize; ++y) {
        for (int x = 0; x < kDetailSize; ++x)
            tile.slopes[0].emplace_back(at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1));
    }
    const float scale = static_cast<float>(std::sqrt(kDetailVariance / varianceOf(tile, 0)));
    for (glm::vec2& slope : tile.slopes[0]) slope *= scale;
    for (int level = 1; level < kDetailLevels; ++level) {
        const int size = kDetailSize >> level;
        const std::vector<glm::vec2>& finer = tile.slopes[level - 1];
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const std::size_t i = std::size_t(2 * y) * (2 * size) + 2 * x;
                tile.slopes[level].push_back(
                    0.25f * (finer[i] + finer[i + 1] + finer[i + 2 * size] + finer[i + 2 * size + 1]));
            }
        }
    }
    for (int level = 0; level < kDetailLevels; ++level) tile.variance[level] = varianceOf(tile, level);
    return tile;
}

}  // namespace

glm::dvec2 DetailTile::lookUp(int level, const glm::dvec2& place) const {
    const int size = kDetailSize >> level;
    const glm::dvec2 texel = place * double(size) - 0.5, base = glm::floor(texel), f = texel - base;
    const auto at = [&](int dx, int dy) {
        const int x = wrapped(static_cast<long long>(base.x) + dx, size),
                  y = wrapped(static_cast<long long>(base.y) + dy, size);
        return glm::dvec2(slopes[level][std::size_t(y) * size + x]);
    };
    return (at(0, 0) * (1 - f.x) + at(1, 0) * f.x) * (1 - f.y) +
           (at(0, 1) * (1 - f.x) + at(1, 1) * f.x) * f.y;
}

glm::dvec2 DetailTile::lookUp(double level, const glm::dvec2& place) const {
    const double clamped = std::clamp(level, 0.0, double(kDetailLevels - 1));
    const int below = std::min(static_cast<int>(clamped), kDetailLevels - 2);
    const double f = clamped - below;
    return lookUp(below, place) * (1 - f) + lookUp(below + 1, place) * f;
}

double DetailTile::varianceAt(double level) const {
    const double clamped = std::clamp(level, 0.0, double(kDetailLevels - 1));
    const int below = std::min(static_cast<int>(clamped), kDetailLevels - 2);
    const double kept = (1 - (clamped - below)) * (1 - (clamped - below));
    return kept * variance[below] + (1 - kept) * variance[below + 1];
}

const DetailTile& detailTile() {
    static const DetailTile tile = makeTile();
    return tile;
}

double detailStrength(double asked, double narrowest) {
    return std::min(asked, std::sqrt(0.5 * narrowest * narrowest / kDetailVariance));
}

double narrowestSlope(double m, double lobeWeight, double lobeRatio) {
    return std::max(lobeWeight > 0 ? m * lobeRatio : m, kMinRoughness);
}

}  // namespace cutis::skin
