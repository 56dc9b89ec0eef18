#include "renderer/frame/opposite.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/skin/profile.h"

namespace cutis {
namespace {

// Faces whose normals differ by less than 100 degrees are one side, not two.
constexpr float kLeastOpposition = 0.17f;
// Standard deviations of the widest Gaussian beyond which nothing comes through: exp(-4²/2) is 3e-4.
constexpr double kReachDeviations = 4;

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePointer = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using ScenePointer = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

// Triangles of one character's skin, numbers as in Geometry.
using TriangleList = std::vector<std::uint32_t>;

struct Closest {
    glm::vec3 point, barycentric;
};

// The point of a triangle nearest to p, by the region of its plane that p projects into (Ericson 2005,
// §5.1.5).
Closest closestOnTriangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 ab = b - a, ac = c - a;
    const auto at = [&](float v, float w) { return Closest{a + v * ab + w * ac, {1 - v - w, v, w}}; };
    const float d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return at(0, 0);
    const float d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return at(1, 0);
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return at(d1 / (d1 - d3), 0);
    const float d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return at(0, 1);
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return at(0, d2 / (d2 - d6));
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(1 - w, w);
    }
    const float sum = va + vb + vc;
    return sum > 0 ? at(vb / sum, vc / sum) : at(0, 0);
}

// One search: from a point with its normal to the nearest triangle that faces away from it through the body.
struct Search {
    const Geometry& geometry;
    const TriangleList& triangles;
    glm::vec3 position, normal;
    float best;  // the least of distance / √opposition so far, metres
    std::uint32_t triangle = 0xffffffffu;
    Closest found{};
};

bool tryTriangle(RTCPointQueryFunctionArguments* arguments) {
    Search& search = *static_cast<Search*>(arguments->userPtr);
    const std::uint32_t triangle = search.triangles[arguments->primID];
    const std::uint32_t* v = &search.geometry.indices[triangle * 3];
    const std::vector<glm::vec3>& p = search.geometry.positions;
    const Closest closest = closestOnTriangle(search.position, p[v[0]], p[v[1]], p[v[2]]);
    const auto& attributes = search.geometry.attributes;
    const glm::vec3 normal = closest.barycentric.x * attributes[v[0]].normal +
                             closest.barycentric.y * attributes[v[1]].normal +
                             closest.barycentric.z * attributes[v[2]].normal;
    const float length = glm::length(normal);
    if (!(length > 0)) return false;
    const glm::vec3 way = closest.point - search.position;
    const float opposition = -glm::dot(normal, search.normal) / length;
    // Out of the body at the far side, into it at this one: two lips that touch face each other through air.
    if (opposition < kLeastOpposition || glm::dot(way, search.normal) > 0 || glm::dot(way, normal) < 0)
        return false;
    const float cost = glm::length(way) / std::sqrt(opposition);
    if (cost >= search.best) return false;
    search.best = cost;
    search.triangle = triangle;
    search.found = closest;
    arguments->query->radius = cost;  // no point farther than this can cost less
    return true;
}

ScenePointer buildScene(RTCDevice device, const Geometry& geometry, const TriangleList& triangles) {
    ScenePointer scene(rtcNewScene(device));
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), geometry.skinVertexCount));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
    if (!corners || !indices) throw std::bad_alloc();
    std::copy_n(geometry.positions.begin(), geometry.skinVertexCount, corners);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        std::copy_n(&geometry.indices[triangles[t] * 3], 3, &indices[t * 3]);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene.get(), mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene.get());
    return scene;
}

// How far from its surface light of a material is felt, metres.
double reachOf(const SkinMaterial& skin) {
    double widest = 0;
    for (const skin::Gaussian& g : skin.profile.gaussians) widest = std::max(widest, g.variance);
    return kReachDeviations * std::sqrt(widest) * skin.scale / skin.mmPerUnit;
}

shared::OppositeVertex resultOf(const Search& search, const Atlas& atlas, double mmPerUnit) {
    shared::OppositeVertex result{glm::vec2(-1), kNoThickness, 0};
    if (search.triangle == 0xffffffffu) return result;
    const std::uint32_t* v = &search.geometry.indices[search.triangle * 3];
    result.texel = glm::vec2(0);
    for (int i = 0; i < 3; ++i) result.texel += search.found.barycentric[i] * atlas.vertices[v[i]].texel;
    result.thickness = static_cast<float>(glm::distance(search.found.point, search.position) * mmPerUnit);
    result.island = atlas.vertices[v[0]].island;
    return result;
}

}  // namespace

std::vector<shared::OppositeVertex> findOpposite(const Scene& scene, const Geometry& geometry,
                                                 const Atlas& atlas) {
    std::vector<shared::OppositeVertex> result(geometry.skinVertexCount, {glm::vec2(-1), kNoThickness, 0});
    std::vector<TriangleList> triangles(scene.characters.size());
    for (const GeometryDraw& draw : geometry.draws) {
        if (!draw.skin || draw.character < 0) continue;
        for (std::uint32_t t = draw.firstIndex / 3; t < (draw.firstIndex + draw.indexCount) / 3; ++t)
            triangles[draw.character].push_back(t);
    }
    const DevicePointer device(rtcNewDevice(nullptr));
    if (!device) throw Error("cannot measure thickness", "Embree does not start on this machine");
    for (std::size_t c = 0; c < triangles.size(); ++c) {
        if (triangles[c].empty()) continue;
        const ScenePointer mesh = buildScene(device.get(), geometry, triangles[c]);
        for (const GeometryDraw& draw : geometry.draws) {
            const SkinMaterial* skin = draw.skin ? &*scene.materials[draw.material].skin : nullptr;
            if (!skin || draw.character != static_cast<int>(c) || !skin->translucency) continue;
            const auto reach = static_cast<float>(reachOf(*skin));
            constexpr std::uint32_t kVerticesPerTask = 256;
            parallelFor((draw.vertexCount + kVerticesPerTask - 1) / kVerticesPerTask, [&](std::size_t task) {
                const std::uint32_t first =
                    draw.firstVertex + static_cast<std::uint32_t>(task) * kVerticesPerTask;
                const std::uint32_t last =
                    std::min(first + kVerticesPerTask, draw.firstVertex + draw.vertexCount);
                for (std::uint32_t v = first; v < last; ++v) {
                    Search search{geometry, triangles[c], geometry.positions[v],
                                  geometry.attributes[v].normal, reach};
                    RTCPointQuery query{search.position.x, search.position.y, search.position.z, 0, reach};
                    RTCPointQueryContext context;
                    rtcInitPointQueryContext(&context);
                    rtcPointQuery(mesh.get(), &query, &context, tryTriangle, &search);
                    result[v] = resultOf(search, atlas, skin->mmPerUnit);
                }
            });
        }
    }
    return result;
}

}  // namespace cutis
