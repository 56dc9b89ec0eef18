#include "tests/env/texel_sums.h"

#include <cmath>
#include <numbers>

#include "renderer/scene/environment_clusters.h"

namespace cutis::test {

std::vector<Texel> listTexels(const Environment& e) {
    const double pi = std::numbers::pi;
    const auto solidAngle = [&](int y, int parts, int row) {
        const double top = y + double(row) / parts, bottom = y + double(row + 1) / parts;
        return (std::cos(pi * top / e.height) - std::cos(pi * bottom / e.height)) * 2 * pi /
               (e.width * parts);
    };
    glm::dvec3 total(0);
    for (int y = 0; y < e.height; ++y)
        for (int x = 0; x < e.width; ++x)
            total += glm::dvec3(e.radiance[std::size_t(y) * e.width + x]) * solidAngle(y, 1, 0);
    std::vector<Texel> texels;
    for (int y = 0; y < e.height; ++y)
        for (int x = 0; x < e.width; ++x) {
            const glm::dvec3 radiance(e.radiance[std::size_t(y) * e.width + x]);
            const int parts = radiance.y * solidAngle(y, 1, 0) > 1e-3 * total.y ? 16 : 1;
            for (int j = 0; j < parts; ++j)
                for (int i = 0; i < parts; ++i)
                    texels.push_back({environmentDirection((x + (i + 0.5) / parts) / e.width,
                                                           (y + (j + 0.5) / parts) / e.height),
                                      radiance * solidAngle(y, parts, j)});
        }
    return texels;
}

std::vector<glm::dvec3> sumTexels(const Environment& environment, std::span<const glm::dvec3> normals,
                                  const std::function<double(double)>& weight) {
    const std::vector<Texel> texels = listTexels(environment);
    // weight(cosine) is tabulated: a call for each texel and normal would take minutes.
    constexpr int kTable = 1 << 16;
    std::vector<double> table(kTable + 2);
    for (int i = 0; i < kTable + 2; ++i) table[i] = weight(2.0 * i / kTable - 1);
    return sumShares(texels, normals, [&](const glm::dvec3& normal, const Texel& texel) {
        const double x = (glm::dot(normal, texel.direction) + 1) * (kTable / 2);
        const int i = int(x);
        return texel.flux * (table[i] + (table[i + 1] - table[i]) * (x - i));
    });
}

}  // namespace cutis::test
