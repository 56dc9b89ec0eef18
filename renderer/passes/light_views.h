// The cameras of light maps: one for each light sample and each group of receivers, fitted to what it serves.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/light.h"
#include "renderer/scene/scene.h"
#include "shaders/shared/scene.h"

namespace cutis {

// A view from infinity along `direction` (unit, where light shines to) that holds `receivers`; its near plane lies
// before everything in `casters`. Bounds in metres, world; the matrix takes positions relative to `origin`.
shared::LightView directionalView(const glm::dvec3& direction, const Bounds& receivers, const Bounds& casters,
                                  const glm::dvec3& origin, int mapSize);

// A view from `position` that holds `receivers`. A receiver that surrounds the light is seen as far as a wide field
// of view reaches.
shared::LightView perspectiveView(const glm::dvec3& position, const Bounds& receivers, const Bounds& casters,
                                  const glm::dvec3& origin, int mapSize);

// Views of all samples, group by group: view of sample i and group g is i · groups + g, and so is its layer.
std::vector<shared::LightView> computeLightViews(std::span<const LightSample> samples, std::span<const Bounds> groups,
                                                 const Bounds& casters, const glm::dvec3& origin, int mapSize);

// Whether a box (metres from the origin) lies in the frustum or between it and the eye: whether it can cast a shadow
// there, or be seen.
bool reaches(const glm::mat4& worldToClip, const glm::vec3& boxMin, const glm::vec3& boxMax);

}  // namespace cutis
