#include "renderer/reference/pores.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/directions.h"
#include "renderer/skin/detail.h"

namespace cutis::reference {
namespace {

// Slopes on three planes across the axes, as a gradient in space, of weights whose squares sum to 1.
glm::dvec3 gradientAt(const glm::dvec3& place, const glm::dvec3& n, double level) {
    const skin::DetailTile& tile = skin::detailTile();
    const glm::dvec3 weight = glm::normalize(n * n * n * n);
    const glm::dvec2 x = tile.lookUp(level, {place.y, place.z}), y = tile.lookUp(level, {place.z, place.x}),
                     z = tile.lookUp(level, {place.x, place.y});
    return weight.x * glm::dvec3(0, x.x, x.y) + weight.y * glm::dvec3(y.y, 0, y.x) +
           weight.z * glm::dvec3(z, 0);
}

glm::dmat3 triangleFrame(const glm::dvec3 (&corner)[3]) {
    const glm::dvec3 n = safeNormalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), {0, 0, 1});
    const glm::dvec3 t = safeNormalize(corner[1] - corner[0], {1, 0, 0});
    return {t, glm::cross(n, t), n};
}

// The level of the tile whose texels are as wide as those of the triangle's normal map. `tiles`: its area.
double mappedLevel(const Hit& hit, double tiles) {
    constexpr double kCoarsest = skin::kDetailLevels - 1;
    const TextureSlot& slot = hit.mesh->material->normalTexture;
    if (!slot) return kCoarsest;
    const Scene& scene = *hit.mesh->scene;
    const Image& map = scene.images[scene.textures[slot.texture].image];
    const glm::dvec2 a = hit.mesh->uvAt(slot.texCoord, hit.triangle, 0, 0),
                     e = hit.mesh->uvAt(slot.texCoord, hit.triangle, 1, 0) - a,
                     f = hit.mesh->uvAt(slot.texCoord, hit.triangle, 0, 1) - a;
    const double turned = std::abs(glm::determinant(glm::dmat2(glm::dmat3(slot.transform))));
    const double texels = 0.5 * std::abs(e.x * f.y - e.y * f.x) * turned * double(map.width) * map.height;
    constexpr double kTexels = double(skin::kDetailSize) * skin::kDetailSize;
    return std::min(0.5 * std::log2(std::max(tiles * kTexels / std::max(texels, 1e-12), 1.0)), kCoarsest);
}

}  // namespace

Pores poresAt(const Hit& hit, const SurfacePoint& point) {
    const SkinMaterial& skin = *point.material->skin;
    Pores pores{point.normal};
    const double strength = skin::detailStrength(
        skin.detail, skin::narrowestSlope(skin.roughness, skin.lobeWeight, skin.lobeRatio));
    if (!(strength > 0)) return pores;
    const auto vertex = hit.mesh->triangle(hit.triangle);
    glm::dvec3 rest[3], posed[3];
    for (int i = 0; i < 3; ++i) {
        rest[i] = hit.mesh->restPositions[vertex[i]];
        posed[i] = hit.mesh->position(vertex[i]);
    }
    const double tiles = skin.mmPerUnit / skin.detailScale;
    const glm::dvec3 place = (rest[0] * (1 - hit.u - hit.v) + rest[1] * hit.u + rest[2] * hit.v) * tiles;
    const double area = 0.5 * glm::length(glm::cross(rest[1] - rest[0], rest[2] - rest[0])) * tiles * tiles;
    const double mapped = mappedLevel(hit, area);
    const glm::dmat3 atRest = triangleFrame(rest), now = triangleFrame(posed);
    const glm::dvec3 restNormal = atRest * (point.smooth * now);
    const glm::dvec3 difference = gradientAt(place, restNormal, 0) - gradientAt(place, restNormal, mapped);
    const glm::dvec3 gradient = now * (difference * atRest) * strength;
    pores.normal = safeNormalize(point.normal - (gradient - point.normal * glm::dot(point.normal, gradient)),
                                 point.normal);
    const skin::DetailTile& tile = skin::detailTile();
    pores.removed = strength * strength * (tile.varianceAt(0) - tile.varianceAt(mapped));
    return pores;
}

}  // namespace cutis::reference
