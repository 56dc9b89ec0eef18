#include "renderer/frame/mips.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "renderer/core/parallel.h"

namespace cutis {
namespace {

constexpr int kEncodeSteps = 4096;

double srgbToLinear(double x) {
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}
double linearToSrgb(double x) {
    return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

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
            const float mean =
                0.25f * (decode[from[0][c]] + decode[from[1][c]] + decode[from[2][c]] + decode[from[3][c]]);
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

// Between half floats from 0 to 1 and floats, in a few operations where GLM takes any value apart: a half's bits, moved to
// a float's place, are those of a float whose exponent is less by 127 - 15 = 112.
float fromHalf(std::uint16_t half) {
    return std::bit_cast<float>(std::uint32_t(half) << 13) * 0x1p112f;
}
std::uint16_t toHalf(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value * 0x1p-112f);
    return static_cast<std::uint16_t>((bits + 0xfff + (bits >> 13 & 1)) >> 13);  // ties to even
}

// A unit vector from its encoded x and y, and back. Shorter or longer ones in the file are made unit
// (glTF 2.0, 3.9.3).
glm::vec3 decodeNormal(const std::uint16_t* from) {
    const glm::vec2 xy(fromHalf(from[0]) * 2 - 1, fromHalf(from[1]) * 2 - 1);
    return {xy, std::sqrt(std::max(1 - glm::dot(xy, xy), 0.0f))};
}

void encodeNormal(const glm::vec3& n, std::uint16_t* to) {
    const float length = glm::length(n);
    const glm::vec2 xy = length > 0 ? glm::vec2(n) / length : glm::vec2(0);
    for (int c = 0; c < 2; ++c) to[c] = toHalf(xy[c] * 0.5f + 0.5f);
}

void halveNormals(const std::uint16_t* from[4], std::uint16_t* to) {
    encodeNormal(
        decodeNormal(from[0]) + decodeNormal(from[1]) + decodeNormal(from[2]) + decodeNormal(from[3]), to);
}

template <class T>
const T* as(const std::byte* bytes) {
    return reinterpret_cast<const T*>(bytes);
}

template <class T>
T* as(std::byte* bytes) {
    return reinterpret_cast<T*>(bytes);
}

void halveTexel(const std::byte* from[4], std::byte* to, TexelEncoding encoding) {
    if (encoding == TexelEncoding::srgb8 || encoding == TexelEncoding::linear8) {
        const std::uint8_t* source[4];
        for (int i = 0; i < 4; ++i) source[i] = as<std::uint8_t>(from[i]);
        return halve8(source, as<std::uint8_t>(to), encoding == TexelEncoding::srgb8);
    }
    const std::uint16_t* source[4];
    for (int i = 0; i < 4; ++i) source[i] = as<std::uint16_t>(from[i]);
    if (encoding == TexelEncoding::half4) return halve16(source, as<std::uint16_t>(to));
    halveNormals(source, as<std::uint16_t>(to));
}

constexpr std::size_t kRowsPerTask = 64;

void forRows(int height, const std::function<void(int)>& row) {
    parallelFor((static_cast<std::size_t>(height) + kRowsPerTask - 1) / kRowsPerTask, [&](std::size_t task) {
        const std::size_t last = std::min<std::size_t>(height, (task + 1) * kRowsPerTask);
        for (std::size_t y = task * kRowsPerTask; y < last; ++y) row(static_cast<int>(y));
    });
}

}  // namespace

std::size_t bytesPerTexel(TexelEncoding encoding) {
    return encoding == TexelEncoding::half4 ? 8 : 4;
}

std::vector<std::byte> encodeNormals(const Image& image) {
    const bool bytes = image.format == TexelFormat::rgba8;
    const std::size_t texel = bytes ? 4 : 8, width = static_cast<std::size_t>(image.width);
    std::vector<std::byte> result(bytesPerTexel(TexelEncoding::normal2) * width * image.height);
    forRows(image.height, [&](int y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
            glm::vec3 n;
            for (int c = 0; c < 3; ++c) {
                const float value = bytes
                                        ? std::to_integer<int>(image.texels[i * texel + c]) / 255.0f
                                        : glm::unpackHalf1x16(as<std::uint16_t>(&image.texels[i * texel])[c]);
                n[c] = value * 2 - 1;
            }
            encodeNormal(n, as<std::uint16_t>(&result[i * bytesPerTexel(TexelEncoding::normal2)]));
        }
    });
    return result;
}

std::vector<std::byte> halveTexels(const std::vector<std::byte>& texels, int width, int height,
                                   TexelEncoding encoding) {
    const int w = std::max(1, width / 2), h = std::max(1, height / 2);
    const std::size_t bytes = bytesPerTexel(encoding);
    std::vector<std::byte> result(bytes * w * h);
    forRows(h, [&](int y) {
        for (int x = 0; x < w; ++x) {
            const std::byte* from[4];
            for (int i = 0; i < 4; ++i) {
                const int sx = std::min(2 * x + (i & 1), width - 1),
                          sy = std::min(2 * y + (i >> 1), height - 1);
                from[i] = &texels[(static_cast<std::size_t>(sy) * width + sx) * bytes];
            }
            halveTexel(from, &result[(static_cast<std::size_t>(y) * w + x) * bytes], encoding);
        }
    });
    return result;
}

}  // namespace cutis
