#include "renderer/reference/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/core/error.h"
#include "renderer/reference/layers.h"

namespace cutis::reference {
namespace {

// What a filter function needs besides the hit. The first member must be Embree's own.
struct FilterContext {
    RTCIntersectContext embree;
    std::vector<Hit>* hits = nullptr;
    glm::dvec3 transmittance{1};
};

// Light weaker than this is none.
constexpr double kOpaque = 1e-9;

Hit hitOf(const RTCFilterFunctionNArguments* arguments) {
    const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    return {static_cast<const PlacedMesh*>(arguments->geometryUserPtr),
            hit->primID,
            hit->u,
            hit->v,
            ray->tfar,
            1};
}

// Between the ray and the triangle's normal, which has the length of its area.
double normalAlongRay(const RTCFilterFunctionNArguments* arguments) {
    const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    return hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
}

bool facesAway(const RTCFilterFunctionNArguments* arguments) {
    return normalAlongRay(arguments) >= 0;
}

// Of a ray of unit direction.
double cosineOf(const RTCFilterFunctionNArguments* arguments) {
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    const double length = glm::length(glm::dvec3(hit->Ng_x, hit->Ng_y, hit->Ng_z));
    return length > 0 ? std::min(std::abs(normalAlongRay(arguments)) / length, 1.0) : 0;
}

// The camera's: leaves out what is not there, keeps aside what is seen through, lets the nearest of the rest
// end the ray.
void filterVisible(const RTCFilterFunctionNArguments* arguments) {
    Hit hit = hitOf(arguments);
    if (!hit.mesh->material->doubleSided && facesAway(arguments)) {
        arguments->valid[0] = 0;
        return;
    }
    if (hit.mesh->material->alphaMode == AlphaMode::opaque && !hit.mesh->material->seenThrough()) return;
    hit.alpha = hit.mesh->alphaAt(hit.triangle, hit.u, hit.v);
    if (hit.mesh->material->alphaMode == AlphaMode::mask) {
        if (hit.alpha == 0) arguments->valid[0] = 0;
        if (hit.alpha == 0 || !hit.mesh->material->seenThrough()) return;
    }
    arguments->valid[0] = 0;
    if (hit.alpha > 0) reinterpret_cast<FilterContext*>(arguments->context)->hits->push_back(hit);
}

void filterShadow(const RTCFilterFunctionNArguments* arguments) {
    const Hit hit = hitOf(arguments);
    glm::dvec3& transmittance = reinterpret_cast<FilterContext*>(arguments->context)->transmittance;
    transmittance *= lightThrough(hit, cosineOf(arguments));
    if (std::max({transmittance.r, transmittance.g, transmittance.b}) > kOpaque) arguments->valid[0] = 0;
}

void collectHit(const RTCFilterFunctionNArguments* arguments) {
    reinterpret_cast<FilterContext*>(arguments->context)->hits->push_back(hitOf(arguments));
    arguments->valid[0] = 0;
}

RTCRay rayOf(const glm::dvec3& from, const glm::dvec3& direction, double tNear, double tFar) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x), ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(direction.x), ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = static_cast<float>(tNear);
    ray.tfar = tFar < std::numeric_limits<float>::max() ? static_cast<float>(tFar)
                                                        : std::numeric_limits<float>::infinity();
    ray.mask = 0xffffffffu;
    return ray;
}

void attach(RTCDevice device, RTCScene scene, const PlacedMesh& mesh, RTCFilterFunctionN intersect,
            RTCFilterFunctionN occluded) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(),
                               0, 16, mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               12, mesh.indices.size() / 3);
    rtcSetGeometryUserData(geometry, const_cast<PlacedMesh*>(&mesh));
    if (intersect) rtcSetGeometryIntersectFilterFunction(geometry, intersect);
    if (occluded) rtcSetGeometryOccludedFilterFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

RTCScene newScene(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    // Robust: no ray slips between two triangles that share an edge. Medium quality: no triangle is split in
    // two, so that none is ever reported twice.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    return scene;
}

void collect(RTCScene scene, const glm::dvec3& from, const glm::dvec3& direction, double tFar,
             std::vector<Hit>& hits) {
    hits.clear();
    FilterContext context;
    rtcInitIntersectContext(&context.embree);
    context.hits = &hits;
    RTCRayHit ray{};
    ray.ray = rayOf(from, direction, 0, tFar);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context.embree, &ray);
}

}  // namespace

struct RayScene::Scenes {
    RTCDevice device = nullptr;
    RTCScene visible = nullptr, all = nullptr;
    std::vector<RTCScene> skin;  // per character

    ~Scenes() {
        for (RTCScene scene : skin) rtcReleaseScene(scene);
        if (visible) rtcReleaseScene(visible);
        if (all) rtcReleaseScene(all);
        if (device) rtcReleaseDevice(device);
    }
};

RayScene::RayScene(const PlacedScene& placed, bool through)
    : scenes_(std::make_unique<Scenes>()), radius_(placed.radius) {
    Scenes& s = *scenes_;
    s.device = rtcNewDevice(nullptr);
    if (!s.device) throw Error("cannot cast rays", "Embree does not run on this machine");
    s.visible = newScene(s.device);
    if (through) s.all = newScene(s.device);
    for (const PlacedMesh& mesh : placed.meshes) {
        const bool opaque = mesh.material->alphaMode == AlphaMode::opaque && !mesh.material->seenThrough();
        attach(s.device, s.visible, mesh, opaque && mesh.material->doubleSided ? nullptr : filterVisible,
               opaque ? nullptr : filterShadow);
        if (through) attach(s.device, s.all, mesh, collectHit, nullptr);
        if (!mesh.skin) continue;
        while (static_cast<int>(s.skin.size()) <= mesh.character) s.skin.push_back(newScene(s.device));
        attach(s.device, s.skin[mesh.character], mesh, collectHit, nullptr);
    }
    rtcCommitScene(s.visible);
    if (through) rtcCommitScene(s.all);
    for (RTCScene scene : s.skin) rtcCommitScene(scene);
    if (rtcGetDeviceError(s.device) != RTC_ERROR_NONE)
        throw Error("cannot cast rays", "Embree refused the scene");
}

RayScene::~RayScene() = default;

void RayScene::findVisible(const glm::dvec3& from, const glm::dvec3& direction, double tNear, double tFar,
                           std::vector<Hit>& hits) const {
    hits.clear();
    FilterContext context;
    rtcInitIntersectContext(&context.embree);
    context.hits = &hits;
    RTCRayHit ray{};
    ray.ray = rayOf(from, direction, tNear, tFar);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scenes_->visible, &context.embree, &ray);
    if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        std::erase_if(hits, [&](const Hit& hit) { return hit.t >= ray.ray.tfar; });
        const RTCGeometry geometry = rtcGetGeometry(scenes_->visible, ray.hit.geomID);
        hits.push_back({static_cast<const PlacedMesh*>(rtcGetGeometryUserData(geometry)), ray.hit.primID,
                        ray.hit.u, ray.hit.v, ray.ray.tfar, 1});
    }
    std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
}

glm::dvec3 RayScene::transmittance(const glm::dvec3& from, const glm::dvec3& direction, double tFar) const {
    FilterContext context;
    rtcInitIntersectContext(&context.embree);
    RTCRay ray = rayOf(from, direction, 0, tFar);
    rtcOccluded1(scenes_->visible, &context.embree, &ray);
    return ray.tfar < 0 ? glm::dvec3(0) : context.transmittance;
}

void RayScene::findSkin(int character, const glm::dvec3& from, const glm::dvec3& direction, double tFar,
                        std::vector<Hit>& hits) const {
    collect(scenes_->skin[character], from, direction, tFar, hits);
}

void RayScene::findAll(const glm::dvec3& from, const glm::dvec3& direction, double tFar,
                       std::vector<Hit>& hits) const {
    collect(scenes_->all, from, direction, tFar, hits);
}

double RayScene::clearance(const glm::dvec3& p) const {
    // Rounding a coordinate costs 6e-8 of it, and Embree's intersections a few times that.
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 0.05 * radius_});
    return std::max(2e-6 * size, 1e-12);
}

}  // namespace cutis::reference
