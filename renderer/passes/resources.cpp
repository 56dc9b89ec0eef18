#include "renderer/passes/resources.h"

#include "renderer/gpu/device.h"

namespace cutis {

gpu::SampledImage nearest(gpu::Device& device, const gpu::Image& image) {
    return gpu::sampled(image, device.sampler({.filter = VK_FILTER_NEAREST,
                                               .mipFilter = VK_SAMPLER_MIPMAP_MODE_NEAREST}));
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
