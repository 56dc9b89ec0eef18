#include "renderer/frame/textures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "renderer/core/error.h"
#include "renderer/frame/mips.h"
#include "renderer/gpu/device.h"
#include "shaders/shared/scene.h"

namespace cutis {
namespace {

struct GroupKey {
    int width, height;
    TexelEncoding encoding;
    Sampler sampler;
    auto tie() const {
        return std::tuple(width, height, encoding, sampler.wrapU, sampler.wrapV, sampler.nearest, sampler.mipmapped);
    }
    bool operator<(const GroupKey& other) const { return tie() < other.tie(); }
};

// How far sizes are rounded so that more textures share an array: not at all, to powers of two, to one size.
enum class Rounding { none, powerOfTwo, largest };

int roundedSize(int size, Rounding rounding, int largest) {
    if (rounding == Rounding::none) return size;
    if (rounding == Rounding::largest) return largest;
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(size)));
}

TexelEncoding encodingOf(const Scene& scene, std::size_t texture, TextureUse use) {
    if (use == TextureUse::normals) return TexelEncoding::normal2;
    if (scene.images[scene.textures[texture].image].format == TexelFormat::rgba16f) return TexelEncoding::half4;
    return scene.textures[texture].srgb ? TexelEncoding::srgb8 : TexelEncoding::linear8;
}

std::map<GroupKey, std::vector<int>> groupTextures(const Scene& scene, const std::vector<TextureUse>& uses,
                                                   Rounding rounding) {
    int largest = 1;
    for (const Image& image : scene.images) largest = std::max({largest, image.width, image.height});
    std::map<GroupKey, std::vector<int>> groups;
    for (std::size_t t = 0; t < scene.textures.size(); ++t) {
        if (uses[t] == TextureUse::none) continue;
        const Texture& texture = scene.textures[t];
        const Image& image = scene.images[texture.image];
        groups[{roundedSize(image.width, rounding, largest), roundedSize(image.height, rounding, largest),
                encodingOf(scene, t, uses[t]), texture.sampler}]
            .push_back(static_cast<int>(t));
    }
    return groups;
}

VkFormat formatOf(const GroupKey& key) {
    switch (key.encoding) {
        case TexelEncoding::half4: return VK_FORMAT_R16G16B16A16_SFLOAT;
        case TexelEncoding::normal2: return VK_FORMAT_R16G16_SFLOAT;
        case TexelEncoding::srgb8: return VK_FORMAT_R8G8B8A8_SRGB;
        case TexelEncoding::linear8: break;
    }
    return VK_FORMAT_R8G8B8A8_UNORM;
}

VkSamplerAddressMode addressMode(Wrap wrap) {
    switch (wrap) {
        case Wrap::mirroredRepeat: return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
        case Wrap::clampToEdge: return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        case Wrap::repeat: break;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

// Nearest texels of another size: only reached when a scene has more kinds of textures than shaders have samplers.
std::vector<std::byte> resample(const std::vector<std::byte>& texels, const Image& image, const GroupKey& key) {
    const std::size_t bytes = bytesPerTexel(key.encoding);
    std::vector<std::byte> result(bytes * key.width * key.height);
    for (int y = 0; y < key.height; ++y) {
        const std::size_t sourceRow = std::size_t(y) * image.height / key.height;
        for (int x = 0; x < key.width; ++x) {
            const std::size_t source = sourceRow * image.width + std::size_t(x) * image.width / key.width;
            std::memcpy(&result[(std::size_t(y) * key.width + x) * bytes], &texels[source * bytes], bytes);
        }
    }
    return result;
}

std::vector<std::byte> texelsOf(const Image& image, const GroupKey& key) {
    std::vector<std::byte> texels = key.encoding == TexelEncoding::normal2 ? encodeNormals(image) : image.texels;
    if (image.width == key.width && image.height == key.height) return texels;
    return resample(texels, image, key);
}

}  // namespace

TextureArrays uploadTextures(gpu::Device& device, gpu::Commands& commands, const Scene& scene,
                             const std::vector<TextureUse>& uses) {
    TextureArrays arrays;
    arrays.places.resize(scene.textures.size());
    std::map<GroupKey, std::vector<int>> groups;
    for (Rounding rounding : {Rounding::none, Rounding::powerOfTwo, Rounding::largest}) {
        groups = groupTextures(scene, uses, rounding);
        if (groups.size() <= shared::MAX_TEXTURE_GROUPS) break;
    }
    if (groups.size() > shared::MAX_TEXTURE_GROUPS) {
        throw Error("too many kinds of textures",
                    std::to_string(groups.size()) + " combinations of format and sampler, the limit is " +
                        std::to_string(shared::MAX_TEXTURE_GROUPS), scene.file.string());
    }
    // Isotropic everywhere: anisotropic filters differ between devices, pictures should not, and nine samples a pixel
    // make up for it.
    for (const auto& [key, textures] : groups) {
        const auto width = static_cast<std::uint32_t>(key.width), height = static_cast<std::uint32_t>(key.height);
        gpu::Image array(device,
                         {.name = "material textures", .format = formatOf(key), .width = width, .height = height,
                          .layers = static_cast<std::uint32_t>(textures.size()),
                          .mips = key.sampler.mipmapped ? gpu::fullMipCount(width, height) : 1,
                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                   VK_IMAGE_USAGE_TRANSFER_DST_BIT});
        for (std::size_t layer = 0; layer < textures.size(); ++layer) {
            const Image& image = scene.images[scene.textures[textures[layer]].image];
            const gpu::ImageView target = array.layer(static_cast<std::uint32_t>(layer));
            std::vector<std::byte> texels = texelsOf(image, key);
            int levelWidth = key.width, levelHeight = key.height;
            for (std::uint32_t mip = 0; mip < array.desc().mips; ++mip) {
                if (mip > 0) {
                    texels = halveTexels(texels, levelWidth, levelHeight, key.encoding);
                    levelWidth = std::max(1, levelWidth / 2);
                    levelHeight = std::max(1, levelHeight / 2);
                }
                commands.upload(target.mip(mip), texels);
            }
            arrays.places[textures[layer]] = {static_cast<int>(arrays.images.size()), static_cast<int>(layer)};
        }
        const VkFilter filter = key.sampler.nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
        arrays.sampled.push_back(gpu::sampled(
            array, device.sampler({.filter = filter, .u = addressMode(key.sampler.wrapU),
                                   .v = addressMode(key.sampler.wrapV), .anisotropy = 1})));
        arrays.images.push_back(std::move(array));
    }
    return arrays;
}

}  // namespace cutis
