#include "renderer/frame/inspect.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/core/parallel.h"
#include "shared/light_share.h"

namespace cutis {
namespace {

using Texel = glm::vec4;

// Texels of one layer: bytes where a share is stored, else floats.
class Texels {
  public:
    Texels(const Inspect& inspect, const InspectReadback& readback)
        : bytes_(readback.values.bytes()),
          side_(readback.side),
          shares_(inspect.what == Inspect::What::shadow) {}

    Texel at(int x, int y) const {
        const std::size_t index =
            std::size_t(std::clamp(y, 0, side_ - 1)) * side_ + std::clamp(x, 0, side_ - 1);
        if (shares_) {
            const float stored = float(std::to_integer<int>(bytes_[index])) / 255.0f;
            return Texel(std::min(stored / shared::LIGHT_ARRIVES, 1.0f));
        }
        Texel texel;
        std::memcpy(&texel, &bytes_[index * sizeof texel], sizeof texel);
        return texel;
    }

  private:
    std::span<const std::byte> bytes_;
    int side_;
    bool shares_;
};

// Singular values of the factor of (JᵀJ)⁻¹ in texels per millimetre, the larger first.
glm::vec2 texelsPerMillimetre(const Texel& factor) {
    const float a = factor.x, b = factor.y, c = factor.z;
    const float sum = a * a + b * b + c * c, determinant = std::abs(a * c);
    const float root = std::sqrt(std::max(sum * sum - 4 * determinant * determinant, 0.0f));
    const float large = std::sqrt(0.5f * (sum + root));
    return {large, large > 0 ? determinant / large : 0};
}

glm::vec3 shown(const Inspect& inspect, const Texel& texel) {
    switch (inspect.what) {
        case Inspect::What::stretch: {
            const glm::vec2 density = texelsPerMillimetre(texel);
            return glm::vec3(density.y > 0 ? density.x / density.y : 0);
        }
        case Inspect::What::texelDensity: {
            const glm::vec2 density = texelsPerMillimetre(texel);
            return glm::vec3(std::sqrt(density.x * density.y));
        }
        default:
            return glm::vec3(texel);
    }
}

InspectReadback recordLightMapsOf(const FrameContext& frame) {
    const LightMaps& maps = frame.lights;
    const Inspect& inspect = frame.settings->inspect;
    if (!maps.depth) return {};
    InspectReadback readback{.side = maps.size};
    std::size_t shadowed = 0;
    int part = 0;
    for (const LightSample& sample : frame.lighting.samples) {
        if (sample.light == inspect.index && part++ == inspect.part && sample.shadow) {
            for (std::size_t view = shadowed * maps.groupCount; view < (shadowed + 1) * maps.groupCount; ++view) {
                if (view >= maps.viewList.size() || !frame.lighting.mapsNeeded[view]) continue;
                const shared::LightView& from = maps.viewList[view];
                readback.lightMaps.push_back(
                    {frame.commands->readback(maps.depth.layer(from.layer)), from.depthToDistance});
            }
        }
        if (sample.shadow) ++shadowed;
    }
    return readback;
}

// Metres along the axis; 0 where nothing was drawn.
float distanceAt(float depth, const glm::vec3& depthToDistance) {
    if (depth >= 1) return 0;
    return depthToDistance.y == 0 ? depthToDistance.z * depth
                                  : depthToDistance.x / (depthToDistance.y + depthToDistance.z * depth);
}

// As many columns as make the squares largest.
int columnsFor(int squares, int width, int height) {
    int best = 1, largest = 0;
    for (int columns = 1; columns <= squares; ++columns) {
        const int rows = (squares + columns - 1) / columns, side = std::min(width / columns, height / rows);
        if (side > largest) largest = side, best = columns;
    }
    return best;
}

void placeLightMaps(const InspectReadback& readback, Picture& picture) {
    const int count = static_cast<int>(readback.lightMaps.size());
    if (count == 0) return;
    const int columns = columnsFor(count, picture.width, picture.height), rows = (count + columns - 1) / columns;
    const int side = std::min(picture.width / columns, picture.height / rows);
    const int left = (picture.width - columns * side) / 2, top = (picture.height - rows * side) / 2;
    for (int m = 0; m < count; ++m) {
        const InspectReadback::LightMap& map = readback.lightMaps[std::size_t(m)];
        const std::span<const std::byte> bytes = map.depth.bytes();
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                // Maps hold what is up at the bottom.
                const std::size_t row = std::size_t(side - 1 - y) * readback.side / side,
                                  column = std::size_t(x) * readback.side / side;
                float depth = 1;
                std::memcpy(&depth, &bytes[(row * readback.side + column) * sizeof depth], sizeof depth);
                const int toX = left + m % columns * side + x, toY = top + m / columns * side + y;
                float* to = &picture.values[(std::size_t(toY) * picture.width + toX) * 3];
                std::fill_n(to, 3, distanceAt(depth, map.depthToDistance));
            }
        }
    }
}

}  // namespace

InspectReadback recordInspect(const FrameContext& frame) {
    const Inspect& inspect = frame.settings->inspect;
    const auto index = static_cast<std::uint32_t>(std::max(inspect.index, 0));
    const SkinLight& skin = frame.skin;
    switch (inspect.what) {
        case Inspect::What::none:
            return {};
        case Inspect::What::level: {
            if (index >= skin.levels.shifts.size()) return {};
            const std::uint32_t shift = skin.levels.shifts[index];
            const int side =
                static_cast<int>((std::uint32_t(frame.surface.size) + (1u << shift) - 1) >> shift);
            return {frame.commands->readback(skin.levels.view(index)), side, static_cast<int>(shift)};
        }
        case Inspect::What::stretch:
        case Inspect::What::texelDensity:
            if (!frame.surface.stretch) return {};
            return {frame.commands->readback(frame.surface.stretch), frame.surface.size, 0};
        case Inspect::What::shadow: {
            // Layers are lights that have samples, in order.
            if (!skin.visibility) return {};
            std::uint32_t layer = 0;
            int last = -1;
            for (const LightSample& sample : frame.lighting.samples) {
                if (sample.light == inspect.index)
                    return {frame.commands->readback(skin.visibility.layer(layer)), frame.surface.size, 0};
                if (last != sample.light) ++layer;
                last = sample.light;
            }
            return {};
        }
        case Inspect::What::lightMap:
            return recordLightMapsOf(frame);
    }
    return {};
}

Picture lookUpInspected(const Inspect& inspect, const InspectReadback& readback, const Picture& atlas) {
    Picture picture{atlas.width, atlas.height, 3, {}};
    picture.values.resize(std::size_t(atlas.width) * atlas.height * 3, 0);
    if (readback.side == 0) return picture;
    if (inspect.what == Inspect::What::lightMap) {
        placeLightMaps(readback, picture);
        return picture;
    }
    const Texels texels(inspect, readback);
    const float scale = 1.0f / static_cast<float>(1 << readback.shift);
    parallelFor(std::size_t(atlas.height), [&](std::size_t y) {
        for (std::size_t i = y * atlas.width; i < (y + 1) * atlas.width; ++i) {
            const float* place = &atlas.values[i * 3];
            if (!(place[2] > 0)) continue;
            const Texel texel = texels.at(int(place[0] * scale), int(place[1] * scale));
            const glm::vec3 value = shown(inspect, texel);
            for (int c = 0; c < 3; ++c) picture.values[i * 3 + std::size_t(c)] = value[c];
        }
    });
    return picture;
}

}  // namespace cutis
