// Material textures on the device: textures of equal size, format and sampler share one array image, since shaders may
// index few samplers but any layer.
#pragma once

#include <vector>

#include "renderer/gpu/commands.h"
#include "renderer/gpu/image.h"
#include "renderer/scene/scene.h"

namespace cutis {

struct TextureArrays {
    std::vector<gpu::Image> images;
    std::vector<gpu::SampledImage> sampled;  // MAX_TEXTURE_GROUPS of them, or none when nothing is used
    struct Place {
        int group = -1, layer = 0;
    };
    std::vector<Place> places;  // per Scene::textures
};

// What materials sample a texture for. Normals alone are stored as such (TexelEncoding::normal2).
enum class TextureUse { none, values, normals };

// Uploads the textures that `uses` (one a texture of the scene) says are sampled. When there are more kinds than arrays,
// images are resampled to fewer sizes.
TextureArrays uploadTextures(gpu::Device& device, gpu::Commands& commands, const Scene& scene,
                             const std::vector<TextureUse>& uses);

}  // namespace cutis
