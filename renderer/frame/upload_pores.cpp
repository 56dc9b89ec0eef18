// Pores on the device: their tile, what each material says of them, and where skin was at rest.
#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "renderer/frame/frame.h"
#include "renderer/frame/upload.h"
#include "renderer/frame/upload_parts.h"
#include "renderer/gpu/device.h"
#include "renderer/skin/detail.h"

namespace cutis {
namespace {

shared::Pores poresOf(const Scene& scene, const Material& material, const glm::dvec3& origin) {
    const SkinMaterial& skin = *material.skin;
    const double strength = skin::detailStrength(
        skin.detail, skin::narrowestSlope(skin.roughness, skin.lobeWeight, skin.lobeRatio));
    const double tiles = skin.mmPerUnit / skin.detailScale;
    shared::Pores pores{};
    pores.strength = static_cast<float>(strength);
    pores.tiles = static_cast<float>(tiles);
    pores.offset = glm::vec3(glm::fract(origin * tiles));
    if (material.normalTexture) {
        const Image& map = scene.images[scene.textures[material.normalTexture.texture].image];
        pores.normalTexels = static_cast<float>(map.width) * static_cast<float>(map.height);
    }
    for (int level = 0; level < skin::kDetailLevels; ++level) {
        const double variance = strength * strength * skin::detailTile().variance[level];
        pores.variance[level] = static_cast<float>(variance);
    }
    return pores;
}

gpu::Image uploadTile(FrameContext& frame) {
    constexpr auto kSize = static_cast<std::uint32_t>(skin::kDetailSize);
    constexpr auto kLevels = static_cast<std::uint32_t>(skin::kDetailLevels);
    gpu::Image tile(*frame.device, {.name = "pores",
                                    .format = VK_FORMAT_R16G16_SFLOAT,
                                    .width = kSize,
                                    .height = kSize,
                                    .mips = kLevels,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    for (std::uint32_t level = 0; level < kLevels; ++level) {
        std::vector<std::uint32_t> texels;
        for (const glm::vec2& slope : skin::detailTile().slopes[level])
            texels.push_back(glm::packHalf2x16(slope));
        frame.commands->upload(tile.layer(0).mip(level), texels);
    }
    return tile;
}

}  // namespace

void uploadPores(FrameContext& frame) {
    const Scene& scene = *frame.input->scene;
    gpu::Device& device = *frame.device;
    PoreBuffers& buffers = frame.scene.buffers.pores;
    std::vector<shared::Pores> pores(scene.materials.size());
    for (const int index : skinMaterials(scene, frame.geometry)) {
        pores[index] = poresOf(scene, scene.materials[index], frame.geometry.origin);
    }
    buffers.materials = uploadBuffer(device, *frame.commands, "pores of materials", pores);
    if (!frame.geometry.restPositions.empty()) {
        buffers.restPositions =
            uploadBuffer(device, *frame.commands, "positions at rest", frame.geometry.restPositions);
    }
    buffers.tile = uploadTile(frame);
    buffers.slopes = gpu::sampled(buffers.tile, device.sampler({.filter = VK_FILTER_LINEAR,
                                                                .u = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                                                .v = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                                                .anisotropy = 1}));
}

void forgetPores(FrameContext& frame) {
    frame.scene.buffers.pores = {};
}

}  // namespace cutis
