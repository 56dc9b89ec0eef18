#include "renderer/reference/textures.h"

#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "renderer/scene/tonemap.h"

namespace cutis::reference {
namespace {

const std::array<float, 256>& srgbTable() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (int i = 0; i < 256; ++i) values[i] = static_cast<float>(decodeSrgb(static_cast<float>(i) / 255));
        return values;
    }();
    return table;
}

int wrapped(long long i, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::clampToEdge:
            return static_cast<int>(std::clamp<long long>(i, 0, size - 1));
        case Wrap::mirroredRepeat: {
            const long long period = 2LL * size, at = ((i % period) + period) % period;
            return static_cast<int>(at < size ? at : period - 1 - at);
        }
        case Wrap::repeat:
            break;
    }
    return static_cast<int>(((i % size) + size) % size);
}

glm::dvec4 texelAt(const Image& image, bool srgb, std::size_t index) {
    if (image.format == TexelFormat::rgba16f) {
        std::uint16_t half[4];
        std::memcpy(half, &image.texels[index * 8], 8);
        return {glm::unpackHalf1x16(half[0]), glm::unpackHalf1x16(half[1]), glm::unpackHalf1x16(half[2]),
                glm::unpackHalf1x16(half[3])};
    }
    const std::byte* t = &image.texels[index * 4];
    const auto channel = [&](int c) { return static_cast<unsigned>(t[c]); };
    if (srgb) {
        const std::array<float, 256>& table = srgbTable();
        return {table[channel(0)], table[channel(1)], table[channel(2)], channel(3) / 255.0};
    }
    return glm::dvec4(channel(0), channel(1), channel(2), channel(3)) / 255.0;
}

double alphaAt(const Image& image, std::size_t index) {
    if (image.format == TexelFormat::rgba16f) return texelAt(image, false, index).a;
    return static_cast<unsigned>(image.texels[index * 4 + 3]) / 255.0;
}

// The four texels around a point of a texture and their weights: all on the first where it is not
// interpolated.
struct Footprint {
    std::size_t index[4];
    double weight[4];
};

Footprint footprint(const Image& image, const Sampler& sampler, const TextureSlot& slot,
                    const glm::dvec2& uv) {
    const glm::dvec3 at = glm::dmat3(slot.transform) * glm::dvec3(uv, 1);
    // Coordinates beyond this have no fraction left in the float32 of the file; it also bounds the integers
    // below.
    const auto texel = [](double x, int size) {
        return std::isfinite(x) ? std::clamp(x, -1e6, 1e6) * size : 0.0;
    };
    const double x = texel(at.x, image.width), y = texel(at.y, image.height);
    const auto index = [&](long long column, long long row) {
        return std::size_t(wrapped(row, image.height, sampler.wrapV)) * image.width +
               wrapped(column, image.width, sampler.wrapU);
    };
    if (sampler.nearest) {
        const std::size_t only =
            index(static_cast<long long>(std::floor(x)), static_cast<long long>(std::floor(y)));
        return {{only, only, only, only}, {1, 0, 0, 0}};
    }
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), fx = x - 0.5 - left,
                 fy = y - 0.5 - top;
    const auto c = static_cast<long long>(left), r = static_cast<long long>(top);
    return {{index(c, r), index(c + 1, r), index(c, r + 1), index(c + 1, r + 1)},
            {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

}  // namespace

glm::dvec4 sampleTexture(const Scene& scene, const TextureSlot& slot, const glm::dvec2& uv) {
    const Texture& texture = scene.textures[slot.texture];
    const Image& image = scene.images[texture.image];
    const Footprint from = footprint(image, texture.sampler, slot, uv);
    glm::dvec4 sum(0);
    for (int i = 0; i < 4; ++i) sum += from.weight[i] * texelAt(image, texture.srgb, from.index[i]);
    return sum;
}

double sampleAlpha(const Scene& scene, const TextureSlot& slot, const glm::dvec2& uv) {
    const Texture& texture = scene.textures[slot.texture];
    const Image& image = scene.images[texture.image];
    if (image.opaque) return 1;
    const Footprint from = footprint(image, texture.sampler, slot, uv);
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += from.weight[i] * alphaAt(image, from.index[i]);
    return sum;
}

}  // namespace cutis::reference
