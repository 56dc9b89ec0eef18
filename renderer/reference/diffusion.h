// M(x) = Σ_k w_k ∫_S G(v_k, |x-y|) E'(y) dA(y): the integral over all skin of the character (DESIGN §1.1).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/reference/lighting.h"
#include "renderer/reference/skin_model.h"

namespace cutis::reference {

class Diffusion {
  public:
    // `models` has an entry for each material of the scene that is drawn as skin, in the order of
    // Scene::materials.
    Diffusion(const RayScene& rays, const Lighting& lighting, const Scene& scene,
              const std::vector<std::optional<SkinModel>>& models)
        : rays_(&rays), lighting_(&lighting), scene_(&scene), models_(&models) {}

    // An unbiased estimate of M at x.
    glm::dvec3 exitance(const SurfacePoint& x, const RandomNumbers& random) const;
    const SkinModel& modelOf(const SurfacePoint& point) const {
        return *(*models_)[static_cast<std::size_t>(point.material - scene_->materials.data())];
    }

  private:
    glm::dvec3 enteringAt(const SurfacePoint& y, const RandomNumbers& random) const;

    const RayScene* rays_;
    const Lighting* lighting_;
    const Scene* scene_;
    const std::vector<std::optional<SkinModel>>* models_;
};

}  // namespace cutis::reference
