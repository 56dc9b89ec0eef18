// Material textures at full resolution: what mip levels lose is an error of whoever uses them.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace cutis::reference {

// The texture of a slot at texture coordinates uv (before the slot's transform): bilinear between texels,
// colour decoded from sRGB before it is interpolated. `slot` must hold a texture.
glm::dvec4 sampleTexture(const Scene& scene, const TextureSlot& slot, const glm::dvec2& uv);
// Its alpha alone.
double sampleAlpha(const Scene& scene, const TextureSlot& slot, const glm::dvec2& uv);

}  // namespace cutis::reference
