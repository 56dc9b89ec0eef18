// The light that one visible point of a surface sends to the eye.
#pragma once

#include "renderer/reference/diffusion.h"

namespace cutis::reference {

struct Shade {
    glm::dvec3 diffuse{0}, specular{0};  // radiance; what is emitted counts as diffuse
    glm::dvec3 through{0};               // share of the light from behind that goes straight through
};

class Shading {
  public:
    Shading(const RayScene& rays, const Lighting& lighting, const Diffusion& diffusion)
        : rays_(&rays), lighting_(&lighting), diffusion_(&diffusion) {}

    // An unbiased estimate for the point of `hit`, seen from the unit direction `view`.
    Shade shade(const Hit& hit, const glm::dvec3& view, const RandomNumbers& random) const;
    // An unbiased estimate of what arrives there before anything else happens to it: Σ E and the environment.
    glm::dvec3 irradiance(const Hit& hit, const glm::dvec3& view, const RandomNumbers& random) const;

  private:
    Shade shadeSkin(const Hit& hit, const SurfacePoint& point, const glm::dvec3& view,
                    const RandomNumbers& random) const;
    Shade shadeOther(const Hit& hit, const SurfacePoint& point, const glm::dvec3& view,
                     const RandomNumbers& random) const;

    const RayScene* rays_;
    const Lighting* lighting_;
    const Diffusion* diffusion_;
};

// The point as the viewer sees it: normals on the viewer's side, the shading normal bent to at least the
// horizon, so that neither interpolation nor a normal map looks away.
SurfacePoint seenPoint(const RayScene& rays, const Hit& hit, const glm::dvec3& view);

}  // namespace cutis::reference
