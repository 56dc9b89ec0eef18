#include "renderer/passes/resources.h"

#include <algorithm>

#include "renderer/gpu/device.h"

namespace cutis {

std::uint32_t DiffusionLevels::first(std::uint32_t shift) const {
    return static_cast<std::uint32_t>(std::lower_bound(shifts.begin(), shifts.end(), shift) - shifts.begin());
}

gpu::ImageView DiffusionLevels::view(std::uint32_t level) const {
    return images[shifts[level]].layer(level - first(shifts[level]));
}

gpu::SampledImage nearest(gpu::Device& device, const gpu::Image& image) {
    return gpu::sampled(
        image, device.sampler({.filter = VK_FILTER_NEAREST, .mipFilter = VK_SAMPLER_MIPMAP_MODE_NEAREST}));
}

gpu::SampledImage bilinear(gpu::Device& device, const gpu::Image& image) {
    return gpu::sampled(image, device.sampler({.mipFilter = VK_SAMPLER_MIPMAP_MODE_NEAREST}));
}

gpu::SampledImage trilinear(gpu::Device& device, const gpu::Image& image) {
    return gpu::sampled(image, device.sampler());
}

gpu::SampledImage depthComparison(gpu::Device& device, const gpu::Image& image) {
    return gpu::sampled(image, device.sampler({.mipFilter = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                               .compare = VK_COMPARE_OP_LESS_OR_EQUAL}));
}

}  // namespace cutis
