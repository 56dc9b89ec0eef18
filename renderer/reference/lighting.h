// Light that arrives at a point: from every light and from the environment, with what stands in between.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/reference/environment_sampler.h"
#include "renderer/reference/light_sampler.h"
#include "renderer/reference/random.h"
#include "renderer/reference/surface.h"

namespace cutis::reference {

// A reflecting lobe that is worth sampling by itself: half-vectors with density D cosθ.
struct Lobe {
    bool ggx = false;    // else Beckmann
    double width = 1;    // alpha or m
    glm::dvec3 view{0};  // unit, to the viewer

    glm::dvec3 sample(const glm::dvec3& n, const glm::dvec2& u) const;
    double pdf(const glm::dvec3& n, const glm::dvec3& direction) const;  // per steradian
};

// Light from one direction. The sum of f(direction) · irradiance over the samples of gather() estimates
// ∫ f(ω) L(ω) V(ω) (N·ω) dω without bias, for any f.
struct Incident {
    glm::dvec3 direction{0};   // unit, to the light
    glm::dvec3 irradiance{0};  // on the surface: cosine, visibility and 1/pdf included
    bool environment = false;
};

class Lighting {
  public:
    Lighting(const RayScene& rays, LightSampler lights, EnvironmentSampler environment)
        : rays_(&rays), lights_(std::move(lights)), environment_(std::move(environment)) {}

    // Samples of the light at `point` on a surface of shading normal n, into `incident`. Light counts where
    // it is above both the smooth surface and the shading normal's horizon. `lobe`, if any, is what the light
    // will be reflected by: samples are then drawn from it too, and weighted by the balance heuristic (Veach
    // 1997).
    void gather(const SurfacePoint& point, const glm::dvec3& n, const Lobe* lobe, const RandomNumbers& random,
                std::vector<Incident>& incident) const;

  private:
    void gatherLights(const SurfacePoint& point, const glm::dvec3& n, const Lobe* lobe,
                      const RandomNumbers& random, std::vector<Incident>& incident) const;
    void gatherLobe(const SurfacePoint& point, const glm::dvec3& n, const Lobe& lobe, const glm::dvec2& u,
                    std::vector<Incident>& incident) const;
    void gatherEnvironment(const SurfacePoint& point, const glm::dvec3& n, const Lobe* lobe,
                           const RandomNumbers& random, std::vector<Incident>& incident) const;
    glm::dvec3 visibility(const SurfacePoint& point, const LightPoint& light) const;

    const RayScene* rays_;
    LightSampler lights_;
    EnvironmentSampler environment_;
};

}  // namespace cutis::reference
