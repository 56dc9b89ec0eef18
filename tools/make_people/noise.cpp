#include "noise.h"

#include <cmath>

namespace cutis::people {
namespace {

// PCG output permutation (O'Neill 2014) used as an integer hash, after Jarzynski & Olano (2020).
unsigned hash(unsigned x) {
    const unsigned state = x * 747796405u + 2891336453u;
    const unsigned word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

unsigned hashCell(int x, int y, int z, unsigned seed) {
    return hash(unsigned(x) + hash(unsigned(y) + hash(unsigned(z) + hash(seed))));
}

double gradient(unsigned h, const glm::dvec3& d) {
    // One of the twelve edges of a cube (Perlin 2002).
    const double u = (h & 8u) == 0 ? d.x : d.y;
    const double v = (h & 12u) == 0 ? d.y : ((h & 13u) == 12u ? d.x : d.z);
    return ((h & 1u) ? -u : u) + ((h & 2u) ? -v : v);
}

}  // namespace

double hashUnit(unsigned x) {
    return hash(x) * (1.0 / 4294967296.0);
}

double gradientNoise(const glm::dvec3& p, unsigned seed) {
    const glm::dvec3 base = glm::floor(p), f = p - base;
    const glm::dvec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    const int x = int(base.x), y = int(base.y), z = int(base.z);
    double corner[8];
    for (int i = 0; i < 8; ++i) {
        const int dx = i & 1, dy = (i >> 1) & 1, dz = i >> 2;
        corner[i] = gradient(hashCell(x + dx, y + dy, z + dz, seed), f - glm::dvec3(dx, dy, dz));
    }
    const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
    return mix(mix(mix(corner[0], corner[1], w.x), mix(corner[2], corner[3], w.x), w.y),
               mix(mix(corner[4], corner[5], w.x), mix(corner[6], corner[7], w.x), w.y), w.z);
}

double fractalNoise(const glm::dvec3& p, int octaves, unsigned seed) {
    double sum = 0, weight = 0.5;
    glm::dvec3 q = p;
    for (int i = 0; i < octaves; ++i, weight *= 0.5, q *= 2.0)
        sum += weight * gradientNoise(q, seed + unsigned(i));
    return sum;
}

Cells cellNoise(const glm::dvec3& p, unsigned seed) {
    const glm::dvec3 base = glm::floor(p);
    Cells out{1e9, 1e9, 0};
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const unsigned h = hashCell(int(base.x) + i, int(base.y) + j, int(base.z) + k, seed);
                const glm::dvec3 point =
                    base + glm::dvec3(i, j, k) + glm::dvec3(hashUnit(h), hashUnit(h + 1), hashUnit(h + 2));
                const double d2 = glm::dot(point - p, point - p);
                if (d2 < out.nearest) {
                    out.second = out.nearest;
                    out.nearest = d2;
                    out.id = h;
                } else if (d2 < out.second) {
                    out.second = d2;
                }
            }
    out.nearest = std::sqrt(out.nearest);
    out.second = std::sqrt(out.second);
    return out;
}

}  // namespace cutis::people
