#include "renderer/frame/atlas.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/core/error.h"
#include "renderer/frame/atlas_packing.h"

namespace cutis {
namespace {

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
        shape.mmPerUv = meanStretch(geometry, draws, mmPerUnitOf(scene, key.second));
        shape.texelsPerMm = options.size > 0 ? 1 : 1 / options.mmPerTexelWanted[key.first];
        if (!options.reachMm.empty()) shape.reachMm = options.reachMm[key.second];
        shapes.push_back(shape);
    }
    for (std::uint32_t i = 0; i < mesh.islands.size(); ++i) {
        IslandShape island{.island = i, .uvMin = glm::dvec2(std::numeric_limits<double>::infinity()),
                           .uvMax = glm::dvec2(-std::numeric_limits<double>::infinity()),
                           .continued = mesh.islands[i].continued};
        for (const std::uint32_t t : mesh.islands[i].triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec2 uv = geometry.attributes[geometry.indices[std::size_t(t) * 3 + corner]].uv0;
                island.uvMin = glm::min(island.uvMin, uv);
                island.uvMax = glm::max(island.uvMax, uv);
            }
        }
        const std::uint32_t first = mesh.islands[i].triangles.front();
        shapes[geometry.drawInfos[geometry.triangleDraws[first]].chart].islands.push_back(island);
    }
    return charts;
}

void packIntoExactly(std::vector<ChartShape>& shapes, int size) {
    // The largest common scale that fits, by bisection of its logarithm.
    double low = 1e-12, high = 1e12;
    if (!packCharts(shapes, size, low)) {
        throw Error("cannot lay out the atlas",
                    std::to_string(shapes.size()) + " charts do not fit " + std::to_string(size) + " x " +
                        std::to_string(size) + " texels", "--irradiance-size");
    }
    while (high / low > 1.0005) {
        const double middle = std::sqrt(low * high);
        (packCharts(shapes, size, middle) ? low : high) = middle;
    }
    packCharts(shapes, size, low);
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
                    const glm::dvec2 uv = glm::dvec2(geometry.attributes[v].uv0) - island.uvMin;
                    atlas.vertices[v].texel = glm::vec2(corner + uv * shape.texelsPerUv);
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

Atlas layOutAtlas(const Scene& scene, const SkinMesh& mesh, Geometry& geometry, const AtlasOptions& options) {
    Atlas atlas;
    std::vector<ChartShape> shapes;
    atlas.charts = collectCharts(scene, mesh, geometry, options, shapes);
    if (shapes.empty()) return atlas;
    if (options.size == 0) atlas.size = packSmallest(shapes, options.maxSize);
    if (atlas.size == 0) {
        atlas.size = options.size > 0 ? options.size : options.maxSize;
        packIntoExactly(shapes, atlas.size);
    }
    for (std::size_t c = 0; c < shapes.size(); ++c) atlas.charts[c].rect = shapes[c].rect;
    placeVertices(geometry, mesh, shapes, atlas);
    computeMetric(scene, geometry, mesh.weld, atlas);
    return atlas;
}

}  // namespace cutis
