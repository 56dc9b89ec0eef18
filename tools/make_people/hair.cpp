#include "hair.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/parallel.h"

namespace cutis::people {
namespace {

constexpr int kAlpha = 3;  // channel

double smoothstep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace

Raster makeHairColors(const Raster& picture, const HairRecipe& recipe) {
    Raster colors = picture;
    for (std::size_t i = 0; i < colors.values.size(); i += std::size_t(colors.channels)) {
        float* texel = &colors.values[i];
        const double grey = 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
        for (int c = 0; c < 3; ++c)
            texel[c] = float(recipe.gain[c] * glm::mix(grey, double(texel[c]), recipe.saturation));
    }
    return colors;
}

void liftHair(TriangleMesh& hair, const TriangleMesh& skin) {
    // Heights of 0 to kFree map to kLift to kFree; what is further inside is hidden and comes up less and
    // less.
    constexpr double kLift = 0.0025, kFree = 0.007, kInside = -0.012, kReach = 0.02;  // metres
    parallelFor(hair.positions.size(), [&](std::size_t i) {
        glm::dvec3& p = hair.positions[i];
        double nearest = kReach * kReach;
        std::size_t at = skin.positions.size();
        for (std::size_t j = 0; j < skin.positions.size(); ++j) {
            const glm::dvec3 d = p - skin.positions[j];
            if (const double r2 = glm::dot(d, d); r2 < nearest) nearest = r2, at = j;
        }
        if (at == skin.positions.size()) return;
        const double height = glm::dot(p - skin.positions[at], skin.normals[at]);
        if (height >= kFree || height <= kInside) return;
        const double lifted = kLift + std::max(height, 0.0) * (kFree - kLift) / kFree;
        p += (lifted - height) * smoothstep(kInside, 0.5 * kInside, height) * skin.normals[at];
    });
}

glm::dvec3 meanHairColor(const Raster& colors) {
    glm::dvec3 sum(0);
    double weight = 1e-9;
    for (int y = 0; y < colors.height; ++y)
        for (int x = 0; x < colors.width; ++x) {
            const float* texel = colors.at(x, y);
            const double alpha = colors.channels > kAlpha ? texel[kAlpha] : 1;
            sum += alpha * glm::dvec3(texel[0], texel[1], texel[2]);
            weight += alpha;
        }
    return sum / weight;
}

std::vector<double> computeCover(const TriangleMesh& skin, const TriangleMesh& hair, const Raster& colors) {
    constexpr double kSigma = 0.0045, kReach = 0.014;  // metres
    constexpr double kLow = 0.0, kHigh = 0.03;         // metres above the eyes where scalp begins
    constexpr double kPi = 3.14159265358979323846;
    struct Patch {
        glm::dvec3 position;
        double area;  // covered by hair, m²
    };
    std::vector<Patch> patches;
    for (std::size_t t = 0; t + 2 < hair.indices.size(); t += 3) {
        const std::uint32_t* v = &hair.indices[t];
        const glm::dvec3 e1 = hair.positions[v[1]] - hair.positions[v[0]],
                         e2 = hair.positions[v[2]] - hair.positions[v[0]];
        constexpr int kSplit = 3;  // 9 patches a triangle
        const double area = 0.5 * glm::length(glm::cross(e1, e2)) / (kSplit * kSplit);
        for (int i = 0; i < kSplit; ++i)
            for (int j = 0; j < 2 * (kSplit - i) - 1; ++j) {
                // Centroids of the triangle's kSplit² equal parts, row by row.
                const double a = (i + (j % 2 ? 2.0 : 1.0) / 3) / kSplit;
                const double b = (j / 2 + (j % 2 ? 2.0 : 1.0) / 3) / kSplit;
                const glm::dvec2 uv = hair.uvs[v[0]] + a * (hair.uvs[v[1]] - hair.uvs[v[0]]) +
                                      b * (hair.uvs[v[2]] - hair.uvs[v[0]]);
                const int x = std::clamp(int(uv.x * colors.width), 0, colors.width - 1),
                          y = std::clamp(int(uv.y * colors.height), 0, colors.height - 1);
                const double alpha = colors.channels > kAlpha ? colors.at(x, y)[kAlpha] : 1;
                const glm::dvec3 p = hair.positions[v[0]] + a * e1 + b * e2;
                if (alpha > 0.05 && p.y > kLow - kReach) patches.push_back({p, alpha * area});
            }
    }
    std::vector<double> cover(skin.positions.size(), 0.0);
    parallelFor(cover.size(), [&](std::size_t i) {
        const glm::dvec3& p = skin.positions[i];
        if (p.y < kLow) return;
        double layers = 0;
        for (const Patch& patch : patches) {
            const glm::dvec3 d = patch.position - p;
            const double r2 = glm::dot(d, d);
            if (r2 < kReach * kReach)
                layers += patch.area * std::exp(-r2 / (2 * kSigma * kSigma)) / (2 * kPi * kSigma * kSigma);
        }
        cover[i] = smoothstep(kLow, kHigh, p.y) * (1 - std::exp(-layers));
    });
    return cover;
}

}  // namespace cutis::people
