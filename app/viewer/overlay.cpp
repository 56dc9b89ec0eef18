#include "app/viewer/overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <iterator>

#include "renderer/core/parallel.h"
#include "renderer/scene/tonemap.h"

namespace cutis::app {
namespace {

constexpr Overlay kOverlays[] = {
    {"", "Picture", ""},
    {"diffuse", "Diffuse", "light that left the skin diffusely, exposed"},
    {"specular", "Specular", "light that was reflected, exposed"},
    {"irradiance", "Irradiance", "light that arrives, over pi, exposed"},
    {kInspectedName, "Blurred level",
     "the light within the skin, blurred to the width of one Gaussian, over pi, exposed",
     Inspect::What::level},
    {kInspectedName, "Shadow", "of the chosen light: white where it arrives, black where it does not",
     Inspect::What::shadow},
    {kInspectedName, "Light map",
     "depth as the chosen light sees it, a map for each character: white the nearest, black nothing",
     Inspect::What::lightMap},
    {"thickness", "Thickness", "white 0 mm, through yellow and red, black 30 mm and more",
     Inspect::What::none, "30 mm", "0 mm"},
    {"albedo", "Albedo", "as sRGB"},
    {"normal", "Normal", "red +X, green +Y, blue +Z"},
    {"depth", "Depth", "white the nearest, black the farthest"},
    {"character", "Character", "one colour a character"},
    {kInspectedName, "Stretch",
     "of the atlas: black even, through red and yellow, white 4 times longer one way",
     Inspect::What::stretch, "even", "4 times as long"},
    {kInspectedName, "Texel density",
     "of the atlas: black 0, through red and yellow, white 8 texels a millimetre",
     Inspect::What::texelDensity, "0", "8 texels / mm"},
};

constexpr float kStretched = 4;  // times as long as across
constexpr float kDense = 8;      // texels per millimetre
constexpr float kThick = 30;  // mm: nothing shines through more

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
}

// `color` of each pixel, from its values, as code values.
template <class Color>
DisplayPicture paint(const Picture& values, const Color& color) {
    DisplayPicture display{values.width, values.height, {}};
    const auto width = static_cast<std::size_t>(values.width),
               channels = static_cast<std::size_t>(values.channels);
    display.rgba.resize(width * static_cast<std::size_t>(values.height) * 4, 255);
    parallelFor(static_cast<std::size_t>(values.height), [&](std::size_t y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
            const glm::vec3 code = color(&values.values[i * channels]);
            for (std::size_t c = 0; c < 3; ++c) display.rgba[i * 4 + c] = toByte(code[int(c)]);
        }
    });
    return display;
}

glm::vec3 encode(const glm::vec3& linear) {
    return {encodeSrgb(linear.x), encodeSrgb(linear.y), encodeSrgb(linear.z)};
}

DisplayPicture showDepth(const Picture& values) {
    // The first channel counts, of however many.
    float near = std::numeric_limits<float>::infinity(), far = 0;
    for (const float depth : values.values)
        if (depth > 0) near = std::min(near, depth), far = std::max(far, depth);
    return paint(values, [=](const float* p) {
        return *p > 0 ? glm::vec3(1 - 0.9f * (*p - near) / std::max(far - near, 1e-6f)) : glm::vec3(0);
    });
}

DisplayPicture showInspected(const Inspect& inspect, const Picture& values, float gain) {
    switch (inspect.what) {
        case Inspect::What::stretch:
            return paint(values, [](const float* p) {
                return *p > 0 ? heatColor((*p - 1) / (kStretched - 1)) : glm::vec3(0);
            });
        case Inspect::What::texelDensity:
            return paint(values, [](const float* p) { return heatColor(*p / kDense); });
        case Inspect::What::lightMap:
            return showDepth(values);
        case Inspect::What::shadow:
            return paint(values, [](const float* p) { return glm::vec3(*p); });
        default:
            return paint(values, [=](const float* p) {
                return encode(glm::min(toneMapNeutral(glm::vec3(p[0], p[1], p[2]) * gain * 0.318310f), 1.0f));
            });
    }
}

}  // namespace

std::span<const Overlay> overlays() {
    return kOverlays;
}

DisplayPicture showAov(const Shown& shown, const Picture& values, double exposure) {
    const std::string& aov = shown.aov;
    const float gain = static_cast<float>(std::exp2(exposure));
    const auto rgb = [](const float* p) { return glm::vec3(p[0], p[1], p[2]); };
    if (aov == kInspectedName) return showInspected(shown.inspect, values, gain);
    if (aov == "thickness")
        return paint(values, [](const float* p) { return *p > 0 ? heatColor(1 - *p / kThick) : glm::vec3(0); });
    if (aov == "depth") return showDepth(values);
    if (aov == "character")
        return paint(values, [](const float* p) {
            // Hues a golden ratio apart differ for any number of characters.
            const float hue = std::fmod(*p * 0.618034f, 1.0f) * 6;
            const glm::vec3 color(std::abs(hue - 3) - 1, 2 - std::abs(hue - 2), 2 - std::abs(hue - 4));
            return *p > 0 ? 0.25f + 0.65f * glm::clamp(color, 0.0f, 1.0f) : glm::vec3(0);
        });
    if (aov == "normal")
        return paint(values, [&](const float* p) {
            return rgb(p) == glm::vec3(0) ? glm::vec3(0) : 0.5f + 0.5f * rgb(p);
        });
    if (aov == "albedo")
        return paint(values, [&](const float* p) { return encode(glm::clamp(rgb(p), 0.0f, 1.0f)); });
    const float scale = aov == "irradiance" ? gain * 0.318310f : gain;
    return paint(values,
                 [&](const float* p) { return encode(glm::min(toneMapNeutral(rgb(p) * scale), 1.0f)); });
}

DisplayPicture showMap(const Picture& map, double whole) {
    const float scale = static_cast<float>(1 / whole);
    return paint(map, [=](const float* p) { return heatColor(*p * scale); });
}

}  // namespace cutis::app
