#include "renderer/frame/atlas.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "renderer/core/error.h"
#include "shaders/shared/atlas_tiles.h"

namespace cutis {
namespace {

// Border triangles spread a texel beyond their chart; two more keep neighbours out of bilinear lookups.
constexpr int kGutter = 3;
// Rectangles, gutters included, begin and end on a grid of this many texels: each texel of a diffusion level of lower
// resolution then belongs to one chart.
constexpr int kGrid = 1 << shared::COARSEST_LEVEL;

double mmPerUnitOf(const Scene& scene, int material) {
    return scene.materials[material].skin->mmPerUnit;
}

// The value below which this share of the weight lies; sorts the list.
double weightedQuantile(std::vector<std::pair<double, double>>& valuesAndWeights, double share) {
    std::sort(valuesAndWeights.begin(), valuesAndWeights.end());
    double total = 0, seen = 0;
    for (const auto& [value, weight] : valuesAndWeights) total += weight;
    for (const auto& [value, weight] : valuesAndWeights) {
        seen += weight;
        if (seen >= share * total) return value;
    }
    return 0;
}

double weightedMedian(std::vector<std::pair<double, double>>& valuesAndWeights) {
    return weightedQuantile(valuesAndWeights, 0.5);
}

// Lengths of the surface along u and v, in mm per unit of uv, on average over a chart's triangles.
glm::dvec2 meanStretch(const Geometry& geometry, const std::vector<int>& draws, double mmPerUnit) {
    glm::dvec2 sum(0);
    double area = 0;                                    // twice that of the triangles in uv
    std::vector<std::pair<double, double>> densities;  // mm per unit of uv, area of that density
    for (int d : draws) {
        const GeometryDraw& draw = geometry.draws[d];
        for (std::uint32_t i = draw.firstIndex; i < draw.firstIndex + draw.indexCount; i += 3) {
            const std::uint32_t* t = &geometry.indices[i];
            const glm::dvec2 a = geometry.attributes[t[0]].uv0;
            const glm::dvec2 e1 = glm::dvec2(geometry.attributes[t[1]].uv0) - a;
            const glm::dvec2 e2 = glm::dvec2(geometry.attributes[t[2]].uv0) - a;
            const double det = e1.x * e2.y - e1.y * e2.x;
            if (!(std::abs(det) > 1e-18)) continue;
            const glm::dvec3 p = geometry.positions[t[0]];
            const glm::dvec3 p1 = (glm::dvec3(geometry.positions[t[1]]) - p) * mmPerUnit;
            const glm::dvec3 p2 = (glm::dvec3(geometry.positions[t[2]]) - p) * mmPerUnit;
            const glm::dvec3 du = (p1 * e2.y - p2 * e1.y) / det, dv = (p2 * e1.x - p1 * e2.x) / det;
            const double weight = std::abs(det);
            sum += weight * glm::dvec2(glm::dot(du, du), glm::dot(dv, dv));
            area += weight;
            densities.emplace_back(std::sqrt(glm::length(glm::cross(p1, p2)) / weight), weight);
        }
    }
    if (!(area > 0)) return glm::dvec2(1);
    // Their ratio shapes the rectangle; its size gives the wanted size to the median texel, which on a layout made for
    // faces is one of the face.
    const glm::dvec2 rms = glm::sqrt(sum / area);
    return rms * (weightedMedian(densities) / std::sqrt(std::max(rms.x * rms.y, 1e-30)));
}

std::vector<AtlasChart> collectCharts(const Scene& scene, Geometry& geometry) {
    std::vector<AtlasChart> charts;
    std::map<std::pair<int, int>, std::vector<int>> drawsOf;
    for (std::size_t d = 0; d < geometry.draws.size(); ++d) {
        const GeometryDraw& draw = geometry.draws[d];
        if (draw.skin) drawsOf[{draw.character, draw.material}].push_back(static_cast<int>(d));
    }
    for (const auto& [key, draws] : drawsOf) {
        AtlasChart chart;
        chart.character = key.first;
        chart.material = key.second;
        chart.uvMin = glm::dvec2(std::numeric_limits<double>::infinity());
        chart.uvMax = -chart.uvMin;
        for (int d : draws) {
            const GeometryDraw& draw = geometry.draws[d];
            geometry.drawInfos[d].chart = static_cast<std::uint32_t>(charts.size());
            for (std::uint32_t i = draw.firstIndex; i < draw.firstIndex + draw.indexCount; ++i) {
                const glm::dvec2 uv = geometry.attributes[geometry.indices[i]].uv0;
                chart.uvMin = glm::min(chart.uvMin, uv);
                chart.uvMax = glm::max(chart.uvMax, uv);
            }
        }
        const glm::dvec2 extent = glm::max(chart.uvMax - chart.uvMin, glm::dvec2(1e-9));
        const glm::dvec2 stretch = meanStretch(geometry, draws, mmPerUnitOf(scene, key.second));
        chart.sizeMm = glm::max(extent * stretch, glm::dvec2(1e-9));
        charts.push_back(chart);
    }
    return charts;
}

// Gives every chart its rectangle at `scale(chart)` texels a millimetre; false when they do not fit.
template <class Scale>
bool pack(std::vector<AtlasChart>& charts, int size, Scale scale) {
    const int cells = size / kGrid;
    if (cells == 0) return false;
    std::vector<stbrp_rect> rects;
    std::vector<glm::ivec2> sizes;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const glm::dvec2 texels = charts[i].sizeMm * scale(charts[i]);
        if (!(texels.x < size) || !(texels.y < size)) return false;
        sizes.push_back(glm::max(glm::ivec2(glm::ceil(texels)), 1));
        const glm::ivec2 taken = (sizes[i] + 2 * kGutter + kGrid - 1) / kGrid;
        stbrp_rect rect{};
        rect.id = static_cast<int>(i);
        rect.w = taken.x;
        rect.h = taken.y;
        rects.push_back(rect);
    }
    stbrp_context context;
    std::vector<stbrp_node> nodes(static_cast<std::size_t>(cells));
    stbrp_init_target(&context, cells, cells, nodes.data(), cells);
    if (!stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()))) return false;
    for (const stbrp_rect& rect : rects) {
        charts[rect.id].rect = {rect.x * kGrid + kGutter, rect.y * kGrid + kGutter, sizes[rect.id].x, sizes[rect.id].y};
    }
    return true;
}

void packIntoExactly(std::vector<AtlasChart>& charts, int size) {
    // The largest common scale that fits, by bisection of its logarithm.
    const auto fits = [&](double scale) { return pack(charts, size, [scale](const AtlasChart&) { return scale; }); };
    double low = 1e-12, high = 1e12;
    if (!fits(low)) {
        throw Error("cannot lay out the atlas",
                    std::to_string(charts.size()) + " charts do not fit " + std::to_string(size) + " x " +
                        std::to_string(size) + " texels", "--irradiance-size");
    }
    for (int i = 0; i < 60 && high / low > 1.0005; ++i) {
        const double middle = std::sqrt(low * high);
        (fits(middle) ? low : high) = middle;
    }
    fits(low);
}

int packChosen(std::vector<AtlasChart>& charts, const AtlasOptions& options) {
    const auto wanted = [&](const AtlasChart& chart) { return 1 / options.mmPerTexelWanted[chart.character]; };
    for (int size = 64; size <= options.maxSize; size += std::max(64, size / 8 / 64 * 64)) {
        if (pack(charts, size, wanted)) return size;
    }
    packIntoExactly(charts, options.maxSize);
    return options.maxSize;
}

// Vertices that stand at one place with one uv are one vertex of the layout, however the file split them.
std::vector<std::uint32_t> weldVertices(const Geometry& geometry) {
    struct Key {
        glm::vec3 p;
        glm::vec2 uv;
        std::uint32_t chart;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& k) const {
            std::size_t h = k.chart;
            for (float f : {k.p.x, k.p.y, k.p.z, k.uv.x, k.uv.y}) {
                h = h * 0x9e3779b97f4a7c15u + std::hash<float>{}(f);
            }
            return h ^ (h >> 29);
        }
    };
    std::unordered_map<Key, std::uint32_t, Hash> first;
    first.reserve(geometry.skinVertexCount);
    std::vector<std::uint32_t> weld(geometry.skinVertexCount);
    for (std::size_t d = 0; d < geometry.draws.size() && geometry.draws[d].skin; ++d) {
        const GeometryDraw& draw = geometry.draws[d];
        for (std::uint32_t v = draw.firstVertex; v < draw.firstVertex + draw.vertexCount; ++v) {
            const Key key{geometry.positions[v], geometry.attributes[v].uv0, geometry.drawInfos[d].chart};
            weld[v] = first.try_emplace(key, v).first->second;
        }
    }
    return weld;
}

std::uint32_t findRoot(std::vector<std::uint32_t>& parent, std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

// Islands are the connected parts of a UV layout; the border is where an edge has one triangle only.
void findIslandsAndBorders(const Geometry& geometry, const std::vector<std::uint32_t>& weld, Atlas& atlas) {
    std::vector<std::uint32_t> parent(weld.size());
    std::iota(parent.begin(), parent.end(), 0u);
    std::unordered_map<std::uint64_t, int> edgeUses;
    const std::size_t indexCount = std::size_t(geometry.skinTriangleCount) * 3;
    edgeUses.reserve(indexCount);
    const auto edgeKey = [&](std::size_t triangle, int side) {
        const std::uint32_t a = weld[geometry.indices[triangle * 3 + side]];
        const std::uint32_t b = weld[geometry.indices[triangle * 3 + (side + 1) % 3]];
        return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    };
    for (std::size_t t = 0; t < geometry.skinTriangleCount; ++t) {
        for (int side = 0; side < 3; ++side) {
            ++edgeUses[edgeKey(t, side)];
            const std::uint32_t a = findRoot(parent, weld[geometry.indices[t * 3 + side]]);
            const std::uint32_t b = findRoot(parent, weld[geometry.indices[t * 3 + (side + 1) % 3]]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<bool> border(weld.size(), false);
    for (const auto& [key, uses] : edgeUses) {
        if (uses == 1) border[key >> 32] = border[key & 0xffffffffu] = true;
    }
    for (std::size_t t = 0; t < geometry.skinTriangleCount; ++t) {
        for (int side = 0; side < 3; ++side) {
            if (border[weld[geometry.indices[t * 3 + side]]]) {
                atlas.borderTriangles.push_back(static_cast<std::uint32_t>(t));
                break;
            }
        }
    }
    std::unordered_map<std::uint32_t, float> number;
    for (std::size_t v = 0; v < weld.size(); ++v) {
        const std::uint32_t root = findRoot(parent, weld[v]);
        const auto next = static_cast<float>(number.size() + 1);
        atlas.vertices[v].island = number.try_emplace(root, next).first->second;
    }
}

// G = JᵀJ at every vertex, the mean of its triangles' by their area in the atlas; and sizes of texels.
void computeMetric(const Scene& scene, const Geometry& geometry, const std::vector<std::uint32_t>& weld, Atlas& atlas) {
    std::vector<glm::dvec4> sums(weld.size(), glm::dvec4(0));
    std::vector<std::pair<double, double>> texelSizes;  // size in mm, texels of that size
    texelSizes.reserve(geometry.skinTriangleCount);
    std::vector<std::vector<std::pair<double, double>>> longestSides(atlas.charts.size());  // the same of each chart
    std::vector<std::vector<std::pair<double, double>>> shortestSides(atlas.charts.size());
    for (std::size_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const std::uint32_t* v = &geometry.indices[t * 3];
        const double mmPerUnit = mmPerUnitOf(scene, geometry.draws[geometry.triangleDraws[t]].material);
        const glm::dvec2 e1 = glm::dvec2(atlas.vertices[v[1]].texel) - glm::dvec2(atlas.vertices[v[0]].texel);
        const glm::dvec2 e2 = glm::dvec2(atlas.vertices[v[2]].texel) - glm::dvec2(atlas.vertices[v[0]].texel);
        const glm::dvec3 p = geometry.positions[v[0]];
        const glm::dvec3 p1 = (glm::dvec3(geometry.positions[v[1]]) - p) * mmPerUnit;
        const glm::dvec3 p2 = (glm::dvec3(geometry.positions[v[2]]) - p) * mmPerUnit;
        const double det = e1.x * e2.y - e1.y * e2.x;
        if (!(std::abs(det) > 1e-12)) continue;
        const glm::dvec3 du = (p1 * e2.y - p2 * e1.y) / det, dv = (p2 * e1.x - p1 * e2.x) / det;
        const glm::dvec3 g(glm::dot(du, du), glm::dot(du, dv), glm::dot(dv, dv));
        const double texels = 0.5 * std::abs(det);
        for (int i = 0; i < 3; ++i) sums[weld[v[i]]] += glm::dvec4(g * texels, texels);
        texelSizes.emplace_back(std::pow(std::max(g.x * g.z - g.y * g.y, 0.0), 0.25), texels);
        const double mean = 0.5 * (g.x + g.z), apart = std::hypot(0.5 * (g.x - g.z), g.y);  // of the eigenvalues
        const std::uint32_t chart = geometry.drawInfos[geometry.triangleDraws[t]].chart;
        longestSides[chart].emplace_back(std::sqrt(mean + apart), texels);
        shortestSides[chart].emplace_back(std::sqrt(std::max(mean - apart, 0.0)), texels);
    }
    for (std::size_t c = 0; c < atlas.charts.size(); ++c) {
        atlas.charts[c].coarsestMm = weightedQuantile(longestSides[c], 0.8);
        atlas.charts[c].finestMm = weightedQuantile(shortestSides[c], 0.02);
    }
    for (std::size_t v = 0; v < weld.size(); ++v) {
        const glm::dvec4 sum = sums[weld[v]];
        atlas.vertices[v].metric = sum.w > 0 ? glm::vec3(glm::dvec3(sum) / sum.w) : glm::vec3(0);
    }
    atlas.mmPerTexel = weightedMedian(texelSizes);
}

}  // namespace

Atlas layOutAtlas(const Scene& scene, Geometry& geometry, const AtlasOptions& options) {
    Atlas atlas;
    atlas.charts = collectCharts(scene, geometry);
    if (atlas.charts.empty()) return atlas;
    if (options.size > 0) {
        atlas.size = options.size;
        packIntoExactly(atlas.charts, options.size);
    } else {
        atlas.size = packChosen(atlas.charts, options);
    }
    atlas.vertices.resize(geometry.skinVertexCount);
    for (std::size_t d = 0; d < geometry.draws.size() && geometry.draws[d].skin; ++d) {
        const GeometryDraw& draw = geometry.draws[d];
        const AtlasChart& chart = atlas.charts[geometry.drawInfos[d].chart];
        const glm::dvec2 extent = glm::max(chart.uvMax - chart.uvMin, glm::dvec2(1e-9));
        for (std::uint32_t v = draw.firstVertex; v < draw.firstVertex + draw.vertexCount; ++v) {
            const glm::dvec2 uv = (glm::dvec2(geometry.attributes[v].uv0) - chart.uvMin) / extent;
            atlas.vertices[v].texel =
                glm::vec2(glm::dvec2(chart.rect.x, chart.rect.y) + uv * glm::dvec2(chart.rect.z, chart.rect.w));
        }
    }
    const std::vector<std::uint32_t> weld = weldVertices(geometry);
    findIslandsAndBorders(geometry, weld, atlas);
    computeMetric(scene, geometry, weld, atlas);
    return atlas;
}

}  // namespace cutis
