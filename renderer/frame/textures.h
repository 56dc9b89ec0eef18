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

// Uploads the textures that `used` marks. When there are more kinds than arrays, images are resampled to fewer sizes.
TextureArrays uploadTextures(gpu::Device& device, gpu::Commands& commands, const Scene& scene,
                             const std::vector<bool>& used);

}  // namespace cutis
