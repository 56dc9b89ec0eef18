#include "renderer/reference/data_channels.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/parallel.h"
#include "renderer/reference/layers.h"
#include "renderer/scene/light_samples.h"

namespace cutis::reference {
namespace {

constexpr int kGrid = 3;                // samples along each side of a pixel
constexpr double kNoThickness = 60000;  // mm
constexpr double kSolid = 0.5;  // what is less opaque than this does not count as the surface first lit

struct Seen {
    PixelPoint point;
    glm::dvec2 place;
    bool solid;
};

// The renderer's definition (docs/model.md): millimetres from the point to where the light of one sample
// first enters this character, along the ray, corrected by the angle between the normals.
double thicknessTowards(const LightSample& light, const SurfacePoint& point, const RayScene& rays) {
    const glm::dvec3 towards = light.position - point.position;
    const glm::dvec3 l = light.directional ? -light.direction : glm::normalize(towards);
    if (!light.shadow || glm::dot(point.smooth, l) >= 0) return kNoThickness;
    const glm::dvec3 irradiance = irradianceFrom(light, point.position, l);
    if (!(std::max({irradiance.r, irradiance.g, irradiance.b}) > 0)) return kNoThickness;
    std::vector<Hit> hits;
    const glm::dvec3 inside = point.position - point.smooth * rays.clearance(point.position);
    rays.findAll(inside, l, light.directional ? INFINITY : glm::length(towards), hits);
    std::erase_if(hits, [](const Hit& hit) {
        const glm::dvec3 passed = lightThrough(hit, 1);
        return (passed.r + passed.g + passed.b) / 3 > 1 - kSolid;
    });
    const auto first =
        std::max_element(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
    if (first == hits.end() || !first->mesh->skin || first->mesh->character != point.mesh->character)
        return kNoThickness;
    const glm::dvec3 entry = surfaceAt(rays, *first).smooth;
    const double opposite = std::clamp(-glm::dot(entry, point.smooth), 0.0, 1.0);
    const double cosine = std::clamp(std::max(-glm::dot(point.smooth, l), glm::dot(entry, l)), 0.0, 1.0);
    return first->t * point.material->skin->mmPerUnit * (1 + opposite * (cosine - 1));
}

double thicknessAt(const PixelPoint& at, const RayScene& rays, const std::vector<LightSample>& lights) {
    if (!at.hit.mesh->skin) return 0;
    const SurfacePoint point = surfaceAt(rays, at.hit);
    double least = kNoThickness;
    if (!point.material->skin->translucency) return least;
    for (const LightSample& light : lights) least = std::min(least, thicknessTowards(light, point, rays));
    return least;
}

}  // namespace

std::optional<PixelPoint> findPixelPoint(const RayScene& rays, const View& view, int x, int y) {
    thread_local std::vector<Hit> hits;
    std::vector<Seen> seen;
    for (int s = 0; s < kGrid * kGrid; ++s) {
        const glm::dvec2 place = (glm::dvec2(s % kGrid, s / kGrid) + 0.5) / double(kGrid);
        const ViewRay ray = view.rayThrough(glm::dvec2(x, y) + place);
        rays.findVisible(ray.from, ray.direction, ray.tNear, ray.tFar, hits);
        if (hits.empty()) continue;
        const bool solid = !hits.back().mesh->material->seenThrough();
        seen.push_back({{solid ? hits.back() : hits.front(), -ray.direction}, place, solid});
    }
    const bool solid = std::any_of(seen.begin(), seen.end(), [](const Seen& s) { return s.solid; });
    if (solid) std::erase_if(seen, [](const Seen& s) { return !s.solid; });
    const Seen* leader = nullptr;
    std::ptrdiff_t most = 0;
    const auto alike = [](const Seen& a, const Seen& b) { return a.point.hit.mesh == b.point.hit.mesh; };
    for (const Seen& s : seen) {
        const auto size =
            std::count_if(seen.begin(), seen.end(), [&](const Seen& other) { return alike(s, other); });
        if (size > most) most = size, leader = &s;
    }
    if (!leader) return {};
    glm::dvec2 middle(0);
    for (const Seen& s : seen) middle += alike(s, *leader) ? s.place / double(most) : glm::dvec2(0);
    const Seen* nearest = leader;
    for (const Seen& s : seen) {
        if (alike(s, *leader) && glm::distance(s.place, middle) < glm::distance(nearest->place, middle))
            nearest = &s;
    }
    return nearest->point;
}

Picture makeDataChannel(const std::string& name, const std::vector<std::optional<PixelPoint>>& points,
                        int width, int height, const RayScene& rays, const PlacedScene& placed,
                        const View& view, const Rig& rig) {
    const int channels = name == "depth" || name == "character" || name == "thickness" ? 1 : 3;
    Picture picture{width, height, channels, std::vector<float>(points.size() * channels)};
    const std::vector<LightSample> lights = [&] {
        std::vector<LightSample> samples =
            name == "thickness" ? sampleLights(rig) : std::vector<LightSample>{};
        for (LightSample& sample : samples) sample.position -= placed.origin;
        return samples;
    }();
    const auto valueAt = [&](const PixelPoint& at) -> glm::dvec3 {
        if (name == "thickness") return glm::dvec3(thicknessAt(at, rays, lights));
        if (name == "character") return glm::dvec3(at.hit.mesh->character + 1);
        const SurfacePoint point = seenPoint(rays, at.hit, at.view);
        if (name == "albedo") return albedoOf(point);
        if (name == "normal") return point.normal;
        if (name == "depth") return glm::dvec3(view.depthOf(point.position));
        return point.position + placed.origin;
    };
    parallelFor(std::size_t(height), [&](std::size_t y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
            if (!points[i]) continue;
            const glm::dvec3 value = valueAt(*points[i]);
            for (int c = 0; c < channels; ++c)
                picture.values[i * channels + c] = static_cast<float>(value[c]);
        }
    });
    return picture;
}

}  // namespace cutis::reference
