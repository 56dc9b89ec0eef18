// How scene-linear radiance becomes a picture for a screen.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace cutis {

// Khronos PBR Neutral tone mapper (Khronos 2024, "PBR Neutral Tone Mapper Specification"): keeps base colours
// up to 0.8 - 0.04 as they are, save for the 0.04 that Fresnel reflection adds to them, and compresses and
// desaturates what is brighter into [0, 1). Linear Rec.709 in and out.
inline glm::vec3 toneMapNeutral(glm::vec3 color) {
    constexpr float kF0 = 0.04f, kStart = 0.8f - kF0, kDesaturation = 0.15f;
    color = glm::max(color, glm::vec3(0));
    const float x = std::min({color.r, color.g, color.b});
    color -= x < 2 * kF0 ? x - x * x / (4 * kF0) : kF0;
    const float peak = std::max({color.r, color.g, color.b});
    if (peak <= kStart) return color;
    const float d = 1 - kStart;
    const float newPeak = 1 - d * d / (peak + d - kStart);
    const float g = 1 - 1 / (kDesaturation * (peak - newPeak) + 1);
    return glm::mix(color * (newPeak / peak), glm::vec3(newPeak), g);
}

// IEC 61966-2-1: linear [0, 1] to the sRGB code value, and back.
inline float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}
inline float decodeSrgb(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

}  // namespace cutis
