#include "renderer/reference/shading.h"

#include <algorithm>

#include "renderer/reference/directions.h"
#include "renderer/reference/layers.h"
#include "renderer/reference/metallic_roughness.h"
#include "renderer/reference/pores.h"

namespace cutis::reference {
namespace {

enum Part : std::uint32_t { kReflected, kDiffused, kCoated };

constexpr double kHorizon = 0.02;  // least cosine between shading normal and view

glm::dvec3 facing(const glm::dvec3& normal, const glm::dvec3& view, const glm::dvec3& smooth) {
    const double cosine = glm::dot(normal, view);
    return cosine < kHorizon ? safeNormalize(normal + view * (kHorizon - cosine), smooth) : normal;
}

}  // namespace

SurfacePoint seenPoint(const RayScene& rays, const Hit& hit, const glm::dvec3& view) {
    SurfacePoint point = surfaceAt(rays, hit);
    const bool back = glm::dot(point.face, view) < 0;
    if (back) point = surfaceAt(rays, hit, true);
    readTextures(point, hit, back);
    point.normal = facing(point.normal, view, point.smooth);
    return point;
}

// L_d = ρ^(1-mix) · M/π · X(N·V), and f_s of all that arrives.
Shade Shading::shadeSkin(const Hit& hit, const SurfacePoint& point, const glm::dvec3& view,
                         const RandomNumbers& random) const {
    const SkinModel& model = diffusion_->modelOf(point);
    const double mu = std::max(glm::dot(point.normal, view), 1e-4);
    Shade shade;
    shade.diffuse = model.after(albedoOf(point)) * diffusion_->exitance(point, random.branch(kDiffused)) *
                    (model.exitScale(mu) / kPi);
    if (!(model.material().specular > 0)) return shade;
    thread_local std::vector<Incident> incident;
    const Pores pores = poresAt(hit, point);
    const glm::dvec3 n = facing(pores.normal, view, point.smooth);
    std::uint32_t part = kReflected;
    for (const SkinModel::SpecularLobe& lobe : model.lobes(pores.removed)) {
        const Lobe sampled{false, lobe.roughness, view};
        lighting_->gather(point, n, &sampled, random.branch(part), incident);
        for (const Incident& from : incident) {
            shade.specular += from.irradiance * model.specular(lobe, n, view, from.direction);
        }
        part = kCoated;
    }
    return shade;
}

Shade Shading::shadeOther(const Hit& hit, const SurfacePoint& point, const glm::dvec3& view,
                          const RandomNumbers& random) const {
    const Material& material = *point.material;
    const Layers layers = layersAt(hit, point.base);
    const double mu = glm::dot(point.normal, view);
    const glm::dvec3 matte = layers.albedo * ((1 - layers.metallic) * (1 - layers.transmission));
    thread_local std::vector<Incident> incident;
    const Lobe lobe{true, layers.alpha, view};
    lighting_->gather(point, point.normal, &lobe, random.branch(kReflected), incident);
    Shade shade;
    glm::dvec3 sheen(0);
    for (const Incident& from : incident) {
        const glm::dvec3 h = safeNormalize(from.direction + view, point.normal);
        const double vh = glm::dot(view, h);
        const glm::dvec3 e = from.irradiance * (from.environment ? layers.occlusion : 1.0);
        shade.diffuse += e * matte * (layers.belowFresnel(vh) / kPi);
        shade.specular += e * layers.fresnel(vh) * ggx(point.normal, view, from.direction, h, layers.alpha);
        if (layers.sheen == glm::dvec3(0)) continue;
        sheen += e * layers.sheen * sheenLobe(point.normal, view, from.direction, layers.sheenRoughness);
    }
    const double below = layers.belowSheen(mu);
    shade.diffuse *= below;
    shade.specular = shade.specular * below + sheen;
    shade.diffuse += glm::dvec3(material.emissive) * glm::dvec3(textureAt(hit, material.emissiveTexture));

    const bool back = glm::dot(surfaceAt(*rays_, hit).face, point.face) < 0;
    const glm::dvec3 coatNormal = facing(mappedNormal(hit, material.clearcoat.normalTexture,
                                                      material.clearcoat.normalScale, point.smooth, back),
                                         view, point.smooth);
    const double coatMu = glm::dot(coatNormal, view), coat = layers.coatReflection(coatMu);
    shade.through = layers.through(mu, coatMu);
    if (!(coat > 0)) return shade;
    glm::dvec3 reflected(0);
    const Lobe coatLobe{true, layers.coatAlpha, view};
    lighting_->gather(point, coatNormal, &coatLobe, random.branch(kCoated), incident);
    for (const Incident& from : incident) {
        const glm::dvec3 h = safeNormalize(from.direction + view, coatNormal);
        reflected += from.irradiance * (ggx(coatNormal, view, from.direction, h, layers.coatAlpha) *
                                        (from.environment ? layers.occlusion : 1.0));
    }
    shade.diffuse *= 1 - coat;
    shade.specular = shade.specular * (1 - coat) + reflected * coat;
    return shade;
}

Shade Shading::shade(const Hit& hit, const glm::dvec3& view, const RandomNumbers& random) const {
    const SurfacePoint point = seenPoint(*rays_, hit, view);
    const Material& material = *point.material;
    if (material.unlit) return {.diffuse = glm::dvec3(point.base)};
    if (!point.mesh->skin) return shadeOther(hit, point, view, random);
    Shade shade = shadeSkin(hit, point, view, random);
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
