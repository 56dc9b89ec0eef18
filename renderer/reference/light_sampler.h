// Lights with their true extent: random points of them in place of the renderer's fixed samples.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/reference/random.h"
#include "renderer/scene/light.h"

namespace cutis::reference {

// One point of a light as a surface sees it.
struct LightPoint {
    glm::dvec3 direction{0};  // unit, to the light
    double distance = 0;      // metres; infinite for a directional light
    glm::dvec3 irradiance{
        0};          // on a surface that faces it, nothing in between; the whole light's from this point
    double pdf = 0;  // of its direction per steradian; 0: a lobe sampled by itself never finds this light
    bool shadow = true;
};

class LightSampler {
  public:
    // Positions become relative to `origin`.
    LightSampler(const Rig& rig, const glm::dvec3& origin);

    std::size_t count() const { return lights_.size(); }
    // A random point of light i as seen from p, drawn with the pair of `purpose` and, for a ball, the one
    // after. A rect light is drawn evenly by area; a point light with a radius from the ball and a spot with
    // one from the disc that light_samples.h describes.
    LightPoint sample(std::size_t i, const glm::dvec3& p, const RandomNumbers& random,
                      std::uint32_t purpose) const;
    // The point of light i that a direction meets, rect lights only.
    std::optional<LightPoint> find(std::size_t i, const glm::dvec3& p, const glm::dvec3& direction) const;

  private:
    struct Placed {
        Light light;
        LightSample whole;  // of all its light at its centre, relative to the origin
        glm::dvec3 x, y;    // half extents of a rect; radius vectors of a disc
    };
    LightPoint pointOf(const Placed& placed, const glm::dvec3& offset, const glm::dvec3& p) const;
    std::vector<Placed> lights_;
};

}  // namespace cutis::reference
