#include "renderer/frame/mips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "renderer/core/parallel.h"

namespace cutis {
namespace {

constexpr int kEncodeSteps = 4096;

double srgbToLinear(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }
double linearToSrgb(double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

std::array<float, 256> makeDecodeTable() {
    std::array<float, 256> table;
    for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(srgbToLinear(i / 255.0));
    return table;
}

// By the square root of linear light, in which 8-bit sRGB is nearly even.
std::array<std::uint8_t, kEncodeSteps + 1> makeEncodeTable() {
    std::array<std::uint8_t, kEncodeSteps + 1> table;
    for (int i = 0; i <= kEncodeSteps; ++i) {
        const double root = static_cast<double>(i) / kEncodeSteps;
        table[i] = static_cast<std::uint8_t>(std::lround(255 * linearToSrgb(root * root)));
    }
    return table;
}

void halve8(const std::uint8_t* from[4], std::uint8_t* to, bool srgb) {
    static const std::array<float, 256> decode = makeDecodeTable();
    static const std::array<std::uint8_t, kEncodeSteps + 1> encode = makeEncodeTable();
    for (int c = 0; c < 4; ++c) {
        if (srgb && c < 3) {
            const float mean = 0.25f * (decode[from[0][c]] + decode[from[1][c]] + decode[from[2][c]] + decode[from[3][c]]);
            to[c] = encode[static_cast<std::size_t>(std::lround(std::sqrt(mean) * kEncodeSteps))];
        } else {
            to[c] = static_cast<std::uint8_t>((from[0][c] + from[1][c] + from[2][c] + from[3][c] + 2) / 4);
        }
    }
}

void halve16(const std::uint16_t* from[4], std::uint16_t* to) {
    for (int c = 0; c < 4; ++c) {
        float sum = 0;
        for (int i = 0; i < 4; ++i) sum += glm::unpackHalf1x16(from[i][c]);
        to[c] = glm::packHalf1x16(0.25f * sum);
    }
}

}  // namespace

std::vector<std::byte> halveTexels(const std::vector<std::byte>& texels, int width, int height, TexelFormat format,
                                   bool srgb) {
    const int w = std::max(1, width / 2), h = std::max(1, height / 2);
    const std::size_t bytes = format == TexelFormat::rgba8 ? 4 : 8;
    std::vector<std::byte> result(bytes * w * h);
    parallelFor((static_cast<std::size_t>(h) + 63) / 64, [&](std::size_t band) {
        for (int y = static_cast<int>(band) * 64; y < std::min(h, static_cast<int>(band + 1) * 64); ++y) {
            for (int x = 0; x < w; ++x) {
                const std::byte* from[4];
                for (int i = 0; i < 4; ++i) {
                    const int sx = std::min(2 * x + (i & 1), width - 1), sy = std::min(2 * y + (i >> 1), height - 1);
                    from[i] = &texels[(static_cast<std::size_t>(sy) * width + sx) * bytes];
                }
                std::byte* to = &result[(static_cast<std::size_t>(y) * w + x) * bytes];
                if (format == TexelFormat::rgba8) {
                    const std::uint8_t* source[4];
                    for (int i = 0; i < 4; ++i) source[i] = reinterpret_cast<const std::uint8_t*>(from[i]);
                    halve8(source, reinterpret_cast<std::uint8_t*>(to), srgb);
                } else {
                    const std::uint16_t* source[4];
                    for (int i = 0; i < 4; ++i) source[i] = reinterpret_cast<const std::uint16_t*>(from[i]);
                    halve16(source, reinterpret_cast<std::uint16_t*>(to));
                }
            }
        }
    });
    return result;
}

}  // namespace cutis
