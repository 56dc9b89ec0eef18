#include "renderer/frame/atlas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "renderer/core/error.h"
#include "renderer/core/warn_once.h"
#include "renderer/frame/atlas_packing.h"
#include "renderer/frame/spans.h"

namespace cutis {
namespace {

// A chart of up to two texels with the room around it; what errors look for a size up to.
constexpr int kLeastAtlas = 8, kLargestAtlas = 16384;
constexpr double kLeastScale = 1e-12;  // of charts, at which all are less than a texel

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

// How a set of triangles lies in the layout, by their area there.
struct Stretch {
    glm::dvec2 squares{0};                              // Σ of mm² per unit² along u and v
    double area = 0;                                    // twice that of the triangles in the layout
    std::vector<std::pair<double, double>> densities;  // mm per unit, area of that density

    void add(const Geometry& geometry, std::uint32_t triangle, double mmPerUnit) {
        const std::uint32_t* t = &geometry.indices[std::size_t(triangle) * 3];
        const glm::dvec2 a = geometry.layoutUv[t[0]];
        const glm::dvec2 e1 = glm::dvec2(geometry.layoutUv[t[1]]) - a, e2 = glm::dvec2(geometry.layoutUv[t[2]]) - a;
        const double det = cross2(e1, e2);
        if (!(std::abs(det) > 1e-18)) return;
        const glm::dvec3 p = geometry.positions[t[0]];
        const glm::dvec3 p1 = (glm::dvec3(geometry.positions[t[1]]) - p) * mmPerUnit;
        const glm::dvec3 p2 = (glm::dvec3(geometry.positions[t[2]]) - p) * mmPerUnit;
        const glm::dvec3 du = (p1 * e2.y - p2 * e1.y) / det, dv = (p2 * e1.x - p1 * e2.x) / det;
        const double weight = std::abs(det);
        squares += weight * glm::dvec2(glm::dot(du, du), glm::dot(dv, dv));
        area += weight;
        densities.emplace_back(std::sqrt(glm::length(glm::cross(p1, p2)) / weight), weight);
    }

    // Lengths of the surface along u and v, in mm per unit. Their ratio shapes the rectangle; its size gives the wanted size
    // to the median texel, which on a layout made for faces is one of the face.
    glm::dvec2 mmPerUv() {
        if (!(area > 0)) return glm::dvec2(1);
        const glm::dvec2 rms = glm::sqrt(squares / area);
        return rms * (weightedMedian(densities) / std::sqrt(std::max(rms.x * rms.y, 1e-30)));
    }
};

// By how much an island's own texels are made finer than those of its chart: where they would be more than kUneven times as
// long or as short otherwise.
glm::dvec2 evenScale(Stretch& island, const glm::dvec2& mmPerUv) {
    constexpr double kUneven = 6;
    if (!(island.area > 0)) return glm::dvec2(1);
    const glm::dvec2 ratio = island.mmPerUv() / mmPerUv;
    const bool uneven = std::max(ratio.x, ratio.y) > kUneven || std::min(ratio.x, ratio.y) < 1 / kUneven;
    return uneven && ratio.x > 0 && ratio.y > 0 ? ratio : glm::dvec2(1);
}

IslandShape islandShape(const Geometry& geometry, const SkinMesh& mesh, std::uint32_t number) {
    const UvIsland& island = mesh.islands[number];
    IslandShape shape{.island = number, .uvMin = glm::dvec2(std::numeric_limits<double>::infinity()),
                      .uvMax = glm::dvec2(-std::numeric_limits<double>::infinity()), .continued = island.continued,
                      .overlaps = island.overlaps};
    for (const std::uint32_t t : island.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec2 uv = geometry.layoutUv[geometry.indices[std::size_t(t) * 3 + corner]];
            shape.uvMin = glm::min(shape.uvMin, uv);
            shape.uvMax = glm::max(shape.uvMax, uv);
        }
    }
    return shape;
}

void warnOfLayout(const Scene& scene, const AtlasChart& chart, const ChartShape& shape) {
    std::size_t overlapping = 0, uneven = 0;
    for (const IslandShape& island : shape.islands) {
        overlapping += island.overlaps;
        uneven += island.scale != glm::dvec2(1);
    }
    const std::string skin = "skin \"" + scene.materials[chart.material].name + "\" of \"" +
                             scene.characters[chart.character].name + "\": ";
    const std::string of = " of " + std::to_string(shape.islands.size()) + " islands of its texture coordinates ";
    if (overlapping > 0) {
        warnOnce(skin + std::to_string(overlapping) + of + "lie upon one another: each gets a place of its own");
    }
    if (uneven > 0) {
        warnOnce(skin + std::to_string(uneven) + of + "have more than six times or less than a sixth of the detail of the others: " +
                 "they are evened out");
    }
}

std::vector<AtlasChart> collectCharts(const Scene& scene, const SkinMesh& mesh, Geometry& geometry,
                                      const AtlasOptions& options, std::vector<ChartShape>& shapes) {
    std::vector<AtlasChart> charts;
    std::map<std::pair<int, int>, std::vector<int>> drawsOf;
    for (std::size_t d = 0; d < geometry.draws.size(); ++d) {
        const GeometryDraw& draw = geometry.draws[d];
        if (draw.skin) drawsOf[{draw.character, draw.material}].push_back(static_cast<int>(d));
    }
    for (const auto& [key, draws] : drawsOf) {
        for (int d : draws) geometry.drawInfos[d].chart = static_cast<std::uint32_t>(charts.size());
        charts.push_back({.character = key.first, .material = key.second});
        ChartShape shape;
        shape.texelsPerMm = options.size > 0 ? 1 : 1 / options.mmPerTexelWanted[key.first];
        if (!options.reachMm.empty()) shape.reachMm = options.reachMm[key.second];
        shapes.push_back(shape);
    }
    for (std::uint32_t i = 0; i < mesh.islands.size(); ++i) {
        const std::uint32_t first = mesh.islands[i].triangles.front();
        const std::uint32_t chart = geometry.drawInfos[geometry.triangleDraws[first]].chart;
        shapes[chart].islands.push_back(islandShape(geometry, mesh, i));
    }
    for (std::size_t c = 0; c < charts.size(); ++c) {
        const double mmPerUnit = mmPerUnitOf(scene, charts[c].material);
        Stretch whole;
        std::vector<Stretch> each(shapes[c].islands.size());
        for (std::size_t k = 0; k < each.size(); ++k) {
            for (const std::uint32_t t : mesh.islands[shapes[c].islands[k].island].triangles) {
                whole.add(geometry, t, mmPerUnit);
                each[k].add(geometry, t, mmPerUnit);
            }
        }
        shapes[c].mmPerUv = whole.mmPerUv();
        for (std::size_t k = 0; k < each.size(); ++k) {
            shapes[c].islands[k].scale = evenScale(each[k], shapes[c].mmPerUv);
        }
        warnOfLayout(scene, charts[c], shapes[c]);
    }
    return charts;
}

// The most texels that skin takes along either side of its chart.
double widestChart(const std::vector<ChartShape>& shapes) {
    double widest = 0;
    for (const ChartShape& shape : shapes) {
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(0);
        for (const IslandShape& island : shape.islands) {
            low = glm::min(low, island.place);
            high = glm::max(high,
                            island.place + (island.uvMax - island.uvMin) * shape.texelsPerUv * island.scale);
        }
        widest = std::max({widest, high.x - low.x, high.y - low.y});
    }
    return widest;
}

std::string bySquares(int size) {
    return std::to_string(size) + " x " + std::to_string(size);
}

[[noreturn]] void failToFit(std::vector<ChartShape>& shapes, int size) {
    std::size_t islands = 0;
    for (const ChartShape& shape : shapes) islands += shape.islands.size();
    std::string why =
        "its " + std::to_string(islands) + " islands of skin do not fit " + bySquares(size) + " texels";
    for (int larger = 2 * kLeastAtlas; larger <= kLargestAtlas; larger *= 2) {
        if (!packCharts(shapes, larger, kLeastScale)) continue;
        why += "; " + bySquares(larger) + " would hold them";
        break;
    }
    throw Error("cannot lay out the atlas", why, "--irradiance-size");
}

// Returns the atlas' size: the one asked for, but where that leaves no room for a gutter: then the least that
// has it, with skin on as few of its texels as asked.
int packIntoExactly(std::vector<ChartShape>& shapes, int asked) {
    const int size = std::max(asked, kLeastAtlas);
    const auto fits = [&](double scale) {
        return packCharts(shapes, size, scale) && (asked == size || widestChart(shapes) <= asked);
    };
    // The largest common scale that fits, by bisection of its logarithm.
    double low = kLeastScale, high = 1 / kLeastScale;
    if (!fits(low)) failToFit(shapes, asked);
    while (high / low > 1.0005) {
        const double middle = std::sqrt(low * high);
        (fits(middle) ? low : high) = middle;
    }
    packCharts(shapes, size, low);
    return size;
}

// Gives every vertex its place, and every triangle at a border its entry in borderTriangles.
void placeVertices(const Geometry& geometry, const SkinMesh& mesh, const std::vector<ChartShape>& shapes, Atlas& atlas) {
    atlas.vertices.resize(geometry.skinVertexCount);
    atlas.gutters.resize(mesh.islands.size());
    for (const ChartShape& shape : shapes) {
        for (const IslandShape& island : shape.islands) {
            atlas.gutters[island.island] = island.gutter;
            const glm::dvec2 corner = glm::dvec2(shape.rect.x, shape.rect.y) + island.place;
            for (const std::uint32_t t : mesh.islands[island.island].triangles) {
                for (int i = 0; i < 3; ++i) {
                    const std::uint32_t v = geometry.indices[std::size_t(t) * 3 + i];
                    const glm::dvec2 uv = glm::dvec2(geometry.layoutUv[v]) - island.uvMin;
                    atlas.vertices[v].texel = glm::vec2(corner + uv * shape.texelsPerUv * island.scale);
                    atlas.vertices[v].island = static_cast<float>(island.island + 1);
                }
            }
        }
    }
    std::vector<bool> border(geometry.skinVertexCount, false);
    for (const HalfEdge h : mesh.borders) {
        border[mesh.weld[geometry.indices[h]]] = true;
        border[mesh.weld[geometry.indices[h % 3 == 2 ? h - 2 : h + 1]]] = true;
    }
    for (std::uint32_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const std::uint32_t* v = &geometry.indices[std::size_t(t) * 3];
        if (border[mesh.weld[v[0]]] || border[mesh.weld[v[1]]] || border[mesh.weld[v[2]]]) {
            atlas.borderTriangles.push_back(t);
        }
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
        const std::uint32_t chart = geometry.drawInfos[geometry.triangleDraws[t]].chart;
        const double det = e1.x * e2.y - e1.y * e2.x;
        if (!(std::abs(det) > 1e-12)) continue;
        const glm::dvec3 du = (p1 * e2.y - p2 * e1.y) / det, dv = (p2 * e1.x - p1 * e2.x) / det;
        const glm::dvec3 g(glm::dot(du, du), glm::dot(du, dv), glm::dot(dv, dv));
        const double texels = 0.5 * std::abs(det);
        for (int i = 0; i < 3; ++i) sums[weld[v[i]]] += glm::dvec4(g * texels, texels);
        texelSizes.emplace_back(std::pow(std::max(g.x * g.z - g.y * g.y, 0.0), 0.25), texels);
        const double mean = 0.5 * (g.x + g.z), apart = std::hypot(0.5 * (g.x - g.z), g.y);  // of the eigenvalues
        longestSides[chart].emplace_back(std::sqrt(mean + apart), texels);
        shortestSides[chart].emplace_back(std::sqrt(std::max(mean - apart, 0.0)), texels);
    }
    for (std::size_t c = 0; c < atlas.charts.size(); ++c) {
        atlas.charts[c].bodyMm2 = geometry.skinMm2[atlas.charts[c].character];
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

Atlas layOutAtlas(const Scene& scene, const SkinMesh& mesh, Geometry& geometry, const AtlasOptions& options) {
    Atlas atlas;
    std::vector<ChartShape> shapes;
    atlas.charts = collectCharts(scene, mesh, geometry, options, shapes);
    if (shapes.empty()) return atlas;
    if (options.size == 0) atlas.size = packSmallest(shapes, options.maxSize);
    if (atlas.size == 0) {
        atlas.size = packIntoExactly(shapes, options.size > 0 ? options.size : options.maxSize);
    }
    for (std::size_t c = 0; c < shapes.size(); ++c) atlas.charts[c].rect = shapes[c].rect;
    placeVertices(geometry, mesh, shapes, atlas);
    computeMetric(scene, geometry, mesh.weld, atlas);
    return atlas;
}

}  // namespace cutis
