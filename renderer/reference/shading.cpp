#include "renderer/reference/shading.h"

#include <algorithm>

#include "renderer/reference/directions.h"
#include "renderer/reference/metallic_roughness.h"

namespace cutis::reference {
namespace {

enum Part : std::uint32_t { kReflected, kDiffused };

constexpr double kHorizon = 0.02;     // least cosine between shading normal and view
constexpr double kLeastAlpha = 1e-3;  // of GGX

}  // namespace

SurfacePoint seenPoint(const RayScene& rays, const Hit& hit, const glm::dvec3& view) {
    SurfacePoint point = surfaceAt(rays, hit);
    const bool back = glm::dot(point.face, view) < 0;
    if (back) point = surfaceAt(rays, hit, true);
    readTextures(point, hit, back);
    const double facing = glm::dot(point.normal, view);
    if (facing < kHorizon)
        point.normal = safeNormalize(point.normal + view * (kHorizon - facing), point.smooth);
    return point;
}

// L_d = ρ^(1-mix) · M/π · X(N·V), and f_s of all that arrives.
Shade Shading::shadeSkin(const SurfacePoint& point, const glm::dvec3& view,
                         const RandomNumbers& random) const {
    const SkinModel& model = diffusion_->modelOf(point);
    const double mu = std::max(glm::dot(point.normal, view), 1e-4);
    Shade shade;
    shade.diffuse = model.after(albedoOf(point)) * diffusion_->exitance(point, random.branch(kDiffused)) *
                    (model.exitScale(mu) / kPi);
    if (!(model.material().specular > 0)) return shade;
    thread_local std::vector<Incident> incident;
    const Lobe lobe{false, model.roughness(), view};
    lighting_->gather(point, point.normal, &lobe, random.branch(kReflected), incident);
    for (const Incident& from : incident) {
        shade.specular += from.irradiance * model.specular(point.normal, view, from.direction);
    }
    return shade;
}

Shade Shading::shadeOther(const Hit& hit, const SurfacePoint& point, const glm::dvec3& view,
                          const RandomNumbers& random) const {
    const Material& material = *point.material;
    const glm::dvec4 texel = textureAt(hit, material.metallicRoughnessTexture);
    const double metallic = std::clamp(material.metallic * texel.b, 0.0, 1.0);
    const double roughness = std::clamp(material.roughness * texel.g, 0.0, 1.0);
    const double alpha = std::max(roughness * roughness, kLeastAlpha);
    const double occlusion =
        1 + material.occlusionStrength * (textureAt(hit, material.occlusionTexture).r - 1);
    const glm::dvec3 albedo = albedoOf(point), f0 = glm::mix(glm::dvec3(0.04), albedo, metallic);
    const glm::dvec3 matte = albedo * (1 - metallic);
    thread_local std::vector<Incident> incident;
    const Lobe lobe{true, alpha, view};
    lighting_->gather(point, point.normal, &lobe, random.branch(kReflected), incident);
    Shade shade;
    for (const Incident& from : incident) {
        const glm::dvec3 h = safeNormalize(from.direction + view, point.normal);
        const glm::dvec3 fresnel = schlick(f0, glm::dot(view, h));
        const glm::dvec3 e = from.irradiance * (from.environment ? occlusion : 1.0);
        shade.diffuse += e * matte * (1.0 - fresnel) / kPi;
        shade.specular += e * fresnel * ggx(point.normal, view, from.direction, h, alpha);
    }
    return shade;
}

Shade Shading::shade(const Hit& hit, const glm::dvec3& view, const RandomNumbers& random) const {
    const SurfacePoint point = seenPoint(*rays_, hit, view);
    const Material& material = *point.material;
    if (material.unlit) return {glm::dvec3(point.base), glm::dvec3(0)};
    Shade shade = point.mesh->skin ? shadeSkin(point, view, random) : shadeOther(hit, point, view, random);
    shade.diffuse += glm::dvec3(material.emissive) * glm::dvec3(textureAt(hit, material.emissiveTexture));
    return shade;
}

glm::dvec3 Shading::irradiance(const Hit& hit, const glm::dvec3& view, const RandomNumbers& random) const {
    SurfacePoint point = seenPoint(*rays_, hit, view);
    if (point.material->unlit) return glm::dvec3(0);
    // Skin is lit from its outside and by its own normal, whoever looks; so is what diffuses.
    if (point.mesh->skin) {
        point = surfaceAt(*rays_, hit);
        readTextures(point, hit);
    }
    thread_local std::vector<Incident> incident;
    lighting_->gather(point, point.normal, nullptr, random.branch(kReflected), incident);
    glm::dvec3 sum(0);
    for (const Incident& from : incident) sum += from.irradiance;
    return sum;
}

}  // namespace cutis::reference
