#include "skin_map.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "renderer/core/parallel.h"

namespace cutis::people {
namespace {

// MakeHuman's map, measured: where the charts that a bust needs lie.
constexpr double kHeadLeft = 0.641, kHeadRight = 0.994, kHeadTop = 0.181, kHeadBottom = 0.853;
constexpr double kShouldersLeft = 0.20, kShouldersRight = 0.56, kShouldersTop = 0.02, kShouldersBottom = 0.22;
// Ours: the head takes this share of the map's height, the shoulders the rest less a gap.
constexpr double kHeadShare = 0.80, kGap = 0.01;

constexpr double kPi = 3.14159265358979323846;

// A monotone map of [0,1] to itself whose density is 1 + gain·cos² around `centre`, before normalising.
double widen(double t, double centre, double halfWidth, double gain) {
    const double x = std::clamp((t - centre) / halfWidth, -1.0, 1.0);
    return (t + gain * halfWidth * ((x + 1) / 2 + std::sin(kPi * x) / (2 * kPi)) * 1.0) /
           (1 + gain * halfWidth);
}

// 1 at the centre of an ellipse on MakeHuman's map, falling smoothly to 0 at `1` of its radii.
double blob(glm::dvec2 p, glm::dvec2 centre, glm::dvec2 radii) {
    const glm::dvec2 d = (p - centre) / radii;
    const double t = std::clamp(1 - glm::dot(d, d), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double both(glm::dvec2 p, glm::dvec2 centre, glm::dvec2 radii) {
    constexpr double kMidline = 0.517;
    return std::max(blob(p, centre, radii), blob(p, {centre.x, 2 * kMidline - centre.y}, radii));
}

// How much a point belongs to each region of the face; the head lies on its side on MakeHuman's map, forehead
// left.
struct Regions {
    double lips, nose, cheeks, eyelids, beard, face;
};

Regions regionsAt(glm::dvec2 p) {
    Regions r{};
    r.lips = blob(p, {0.909, 0.517}, {0.021, 0.030});
    r.nose = blob(p, {0.876, 0.517}, {0.030, 0.028});
    r.cheeks = both(p, {0.885, 0.455}, {0.045, 0.055});
    r.eyelids = both(p, {0.837, 0.483}, {0.020, 0.026});
    const double mouthArea = blob(p, {0.925, 0.517}, {0.060, 0.085});
    const double jaw = both(p, {0.925, 0.43}, {0.050, 0.075});
    r.beard = std::max(mouthArea, jaw) * (1 - std::min(1.0, 1.6 * r.lips)) *
              (1 - blob(p, {0.872, 0.517}, {0.026, 0.04}));
    r.face = blob(p, {0.87, 0.517}, {0.15, 0.19});
    return r;
}

// Optical densities per unit of pigment, relative: melanin absorbs more towards blue, haemoglobin mostly
// green.
constexpr glm::dvec3 kMelanin{0.45, 0.70, 1.0}, kHaemoglobin{0.12, 1.0, 0.75};

constexpr double kMillimetres = 1000;  // in a metre

// Depth of the relief in mm, upwards.
double reliefAt(const glm::dvec3& mm, const Regions& region, const SkinRecipe& recipe, unsigned seed) {
    // Pores: small pits about 1.1 mm apart, widest and deepest on the nose and the inner cheeks.
    const Cells pore = cellNoise(mm / 1.15, seed);
    const double poreSize = 0.24 + 0.16 * hashUnit(pore.id + 7);
    const double pit = std::exp(-pore.nearest * pore.nearest / (2 * poreSize * poreSize));
    const double poreDepth = 0.035 + 0.075 * std::max(region.nose, 0.8 * region.cheeks);
    // The net of fine lines that skin has everywhere: cells of 0.7 and 1.6 mm, their borders sunk.
    const glm::dvec3 warped =
        mm + 0.25 * glm::dvec3(gradientNoise(mm / 2.0, seed + 11), gradientNoise(mm / 2.0, seed + 12),
                               gradientNoise(mm / 2.0, seed + 13));
    const Cells fine = cellNoise(warped / 0.75, seed + 1), coarse = cellNoise(warped / 1.7, seed + 2);
    const auto line = [](const Cells& c, double width) {
        return std::exp(-std::pow((c.second - c.nearest) / width, 2));
    };
    const double net = 0.022 * line(fine, 0.20) + 0.032 * line(coarse, 0.14);
    // Lips: vertical creases, so fast across x and slow along y.
    const double creases = 0.16 * fractalNoise({mm.x / 0.9, mm.y / 5.0, mm.z / 5.0}, 2, seed + 3);
    const double bumps = 0.07 * fractalNoise(mm / 2.4, 3, seed + 4);
    const double skin = bumps - recipe.pores * poreDepth * pit - recipe.wrinkles * net;
    return skin * (1 - region.lips) + (creases + 0.3 * bumps) * region.lips;
}

// What the map's texels are too coarse to show, as a factor on albedo.
glm::dvec3 pigmentAt(const glm::dvec3& mm, const Regions& region, const SkinRecipe& recipe, unsigned seed) {
    double melanin =
        0.05 * fractalNoise(mm / 6.0, 3, seed + 20) + 0.05 * fractalNoise(mm / 1.1, 2, seed + 21);
    double blood = recipe.blotches * (0.14 * fractalNoise(mm / 16.0, 3, seed + 22) +
                                      0.07 * fractalNoise(mm / 2.5, 2, seed + 23));
    blood += recipe.lips * region.lips + recipe.flush * std::max({0.8 * region.cheeks, region.nose});
    const double sunlit = std::max({region.nose, region.cheeks, 0.35 * region.face});
    if (recipe.freckles > 0) {
        for (const double spacing : {2.2, 4.0}) {
            const Cells spot = cellNoise(mm / spacing, seed + 30 + unsigned(10 * spacing));
            const double radius = (0.12 + 0.16 * hashUnit(spot.id + 3));
            const double shown = hashUnit(spot.id + 5) < recipe.freckles * sunlit ? 1 : 0;
            const double edge = std::clamp((radius - spot.nearest) / (0.6 * radius), 0.0, 1.0);
            melanin += 0.35 * shown * edge * (0.4 + 0.6 * hashUnit(spot.id + 6));
        }
    }
    const Cells pore = cellNoise(mm / 1.15, seed);
    melanin += 0.10 * recipe.pores * std::max(region.nose, 0.7 * region.cheeks) *
               std::exp(-pore.nearest * pore.nearest / (2 * 0.2 * 0.2));
    if (recipe.stubble > 0 && region.beard > 0) {
        const Cells hair = cellNoise(mm / 0.85, seed + 40);
        const double dot = std::exp(-hair.nearest * hair.nearest / (2 * 0.17 * 0.17));
        melanin += recipe.stubble * region.beard * (1.2 * dot + 0.12);
    }
    return glm::exp(-melanin * kMelanin - blood * kHaemoglobin);
}

// Spreads covered values outwards over the gaps between charts, so that filtering never meets a foreign
// colour.
void fillGaps(Raster& image, std::vector<char> covered) {
    constexpr int kRings = 24;
    const int n = image.width;
    for (int ring = 0; ring < kRings; ++ring) {
        std::vector<char> next = covered;
        parallelFor(n, [&](std::size_t row) {
            const int y = int(row);
            for (int x = 0; x < n; ++x) {
                if (covered[std::size_t(y) * n + x]) continue;
                glm::dvec3 sum(0);
                int count = 0;
                for (int j = std::max(0, y - 1); j <= std::min(n - 1, y + 1); ++j)
                    for (int i = std::max(0, x - 1); i <= std::min(n - 1, x + 1); ++i)
                        if (covered[std::size_t(j) * n + i]) {
                            const float* v = image.at(i, j);
                            sum += glm::dvec3(v[0], v[1], v[2]);
                            ++count;
                        }
                if (count == 0) continue;
                for (int c = 0; c < 3; ++c) image.at(x, y)[c] = float(sum[c] / count);
                next[std::size_t(y) * n + x] = 1;
            }
        });
        covered = std::move(next);
    }
}

}  // namespace

bool onHead(glm::dvec2 s) {
    return s.x > kHeadLeft - 0.002 && s.y > kHeadTop - 0.002 && s.y < kHeadBottom + 0.002;
}

bool onShoulders(glm::dvec2 s) {
    return !onHead(s) && s.x > kShouldersLeft && s.x < kShouldersRight && s.y > kShouldersTop &&
           s.y < kShouldersBottom;
}

glm::dvec2 layoutUv(glm::dvec2 s) {
    if (onHead(s)) {
        const double across = (s.y - kHeadTop) / (kHeadBottom - kHeadTop);
        const double down = (s.x - kHeadLeft) / (kHeadRight - kHeadLeft);
        return {0.004 + 0.992 * widen(across, 0.5, 0.38, 1.5),
                0.004 + (kHeadShare - 0.004) * widen(down, 0.65, 0.35, 1.0)};
    }
    const double scale = (1 - kHeadShare - kGap) / (kShouldersBottom - kShouldersTop);
    return {0.3 + scale * (s.x - kShouldersLeft), kHeadShare + kGap + scale * (s.y - kShouldersTop)};
}

Surfels rasterizeSurfels(const TriangleMesh& mesh, int size) {
    Surfels out;
    out.size = size;
    const std::size_t count = std::size_t(size) * size;
    out.position.resize(count);
    out.positionDu.resize(count);
    out.positionDv.resize(count);
    out.source.resize(count);
    out.cover.resize(count);
    out.covered.resize(count);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const std::uint32_t* v = &mesh.indices[t];
        const glm::dvec2 a = mesh.uvs[v[0]] * double(size) - 0.5, b = mesh.uvs[v[1]] * double(size) - 0.5,
                         c = mesh.uvs[v[2]] * double(size) - 0.5;
        const glm::dvec2 d1 = b - a, d2 = c - a;
        const double det = d1.x * d2.y - d1.y * d2.x;
        if (std::abs(det) < 1e-12) continue;
        const glm::dvec3 e1 = mesh.positions[v[1]] - mesh.positions[v[0]],
                         e2 = mesh.positions[v[2]] - mesh.positions[v[0]];
        const glm::vec3 du((e1 * d2.y - e2 * d1.y) / det), dv((e2 * d1.x - e1 * d2.x) / det);
        const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        for (int y = std::max(0, int(std::ceil(low.y))); y <= std::min(size - 1, int(std::floor(high.y)));
             ++y)
            for (int x = std::max(0, int(std::ceil(low.x))); x <= std::min(size - 1, int(std::floor(high.x)));
                 ++x) {
                const glm::dvec2 p = glm::dvec2(x, y) - a;
                const double wb = (p.x * d2.y - p.y * d2.x) / det, wc = (d1.x * p.y - d1.y * p.x) / det;
                const double wa = 1 - wb - wc;
                if (wa < -1e-9 || wb < -1e-9 || wc < -1e-9) continue;
                const std::size_t i = std::size_t(y) * size + x;
                out.position[i] = glm::vec3(wa * mesh.positions[v[0]] + wb * mesh.positions[v[1]] +
                                            wc * mesh.positions[v[2]]);
                out.source[i] = glm::vec2(wa * mesh.sourceUvs[v[0]] + wb * mesh.sourceUvs[v[1]] +
                                          wc * mesh.sourceUvs[v[2]]);
                if (!mesh.cover.empty())
                    out.cover[i] =
                        float(wa * mesh.cover[v[0]] + wb * mesh.cover[v[1]] + wc * mesh.cover[v[2]]);
                out.positionDu[i] = du;
                out.positionDv[i] = dv;
                out.covered[i] = 1;
            }
    }
    return out;
}

Raster computeDetail(const Raster& map) {
    constexpr int kRadius = 12;
    constexpr double kSigma = 5;  // texels
    Raster logs(map.width, map.height, 3), across = logs, out = logs;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            for (int c = 0; c < 3; ++c) logs.at(x, y)[c] = std::log(std::max(map.at(x, y)[c], 1e-3f));
    std::vector<double> kernel;
    double total = 0;
    for (int i = -kRadius; i <= kRadius; ++i) kernel.push_back(std::exp(-i * i / (2 * kSigma * kSigma)));
    for (const double k : kernel) total += k;
    const auto blur = [&](const Raster& from, Raster& to, int dx, int dy) {
        parallelFor(std::size_t(map.height), [&](std::size_t row) {
            for (int x = 0; x < map.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0;
                    for (int i = -kRadius; i <= kRadius; ++i)
                        sum += kernel[i + kRadius] *
                               from.at(std::clamp(x + i * dx, 0, map.width - 1),
                                       std::clamp(int(row) + i * dy, 0, map.height - 1))[c];
                    to.at(x, int(row))[c] = float(sum / total);
                }
        });
    };
    blur(logs, across, 1, 0);
    blur(across, out, 0, 1);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = logs.values[i] - out.values[i];
    return out;
}

SkinMaps makeSkinMaps(const Surfels& surfels, const Raster& source, const Raster* detail,
                      const SkinRecipe& recipe, const glm::dvec3& scalp, unsigned seed) {
    const int n = surfels.size;
    SkinMaps maps{Raster(n, n, 3), Raster(n, n, 3)};
    std::vector<float> height(std::size_t(n) * n);

    // The map's own mean over the cheeks: what `contrast` turns about.
    glm::dvec3 mean(0);
    for (int i = 0; i < 64; ++i)
        mean +=
            sampleLanczos(source, {0.87 + 0.03 * hashUnit(2 * i), 0.44 + 0.03 * hashUnit(2 * i + 1)}) / 64.0;

    parallelFor(n, [&](std::size_t y) {
        for (int x = 0; x < n; ++x) {
            const std::size_t i = y * n + x;
            if (!surfels.covered[i]) continue;
            const glm::dvec3 mm = kMillimetres * glm::dvec3(surfels.position[i]);
            const glm::dvec2 uv(surfels.source[i]);
            const Regions region = regionsAt(uv);
            glm::dvec3 albedo = sampleLanczos(source, uv);
            albedo = mean * glm::pow(glm::max(albedo, 1e-4) / mean, glm::dvec3(recipe.contrast));
            albedo *= recipe.gain * pigmentAt(mm, region, recipe, seed);
            if (detail) {  // not where the two maps' features differ in shape
                const double share = 1.3 * (1 - std::max(region.lips, region.eyelids));
                albedo *= glm::exp(share * glm::clamp(sampleLanczos(*detail, uv), -0.25, 0.25));
            }
            albedo = glm::mix(albedo, scalp, double(surfels.cover[i]));
            for (int c = 0; c < 3; ++c)
                maps.albedo.at(x, int(y))[c] = float(std::clamp(albedo[c], 0.0, 0.95));
            height[i] = float(reliefAt(mm, region, recipe, seed));
        }
    });
    parallelFor(n, [&](std::size_t y) {
        for (int x = 0; x < n; ++x) {
            const std::size_t i = y * n + x;
            glm::dvec3 normal(0, 0, 1);
            const bool inside = x > 0 && x + 1 < n && y > 0 && int(y) + 1 < n && surfels.covered[i] &&
                                surfels.covered[i - 1] && surfels.covered[i + 1] && surfels.covered[i - n] &&
                                surfels.covered[i + n];
            if (inside) {
                // The gradient over the surface from differences along u and v, which need not be orthogonal:
                // with du = a T and dv = b T + c B, ∂h/∂T = h_u / a and ∂h/∂B = (h_v - b ∂h/∂T) / c.
                const glm::dvec3 du = kMillimetres * glm::dvec3(surfels.positionDu[i]),
                                 dv = kMillimetres * glm::dvec3(surfels.positionDv[i]);
                const double a = glm::length(du), b = glm::dot(dv, du) / a;
                const double c = std::sqrt(std::max(glm::dot(dv, dv) - b * b, 1e-12));
                const double hu = 0.5 * (height[i + 1] - height[i - 1]),
                             hv = 0.5 * (height[i + n] - height[i - n]);
                const double slopeT = hu / a, slopeB = (hv - b * slopeT) / c;
                normal = glm::normalize(glm::dvec3(-slopeT, -slopeB, 1));
                // glTF's bitangent points up the image where ours, ∂P/∂v with v down, points down it.
                normal.y = -normal.y;
            }
            for (int k = 0; k < 3; ++k) maps.normal.at(x, int(y))[k] = float(0.5 + 0.5 * normal[k]);
        }
    });
    fillGaps(maps.albedo, surfels.covered);
    return maps;
}

}  // namespace cutis::people
