#include "renderer/reference/layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/reference/directions.h"
#include "renderer/reference/metallic_roughness.h"
#include "renderer/reference/surface.h"
#include "renderer/skin/quadrature.h"

namespace cutis::reference {
namespace {

constexpr double kLeastAlpha = 1e-3;          // of GGX
constexpr double kLeastSheenRoughness = 0.1;  // below it the lobe is nothing but an edge
constexpr double kCoatF0 = 0.04;              // of a coat with an index of refraction of 1.5
constexpr double kLeastCosine = 1e-4;

double largest(const glm::dvec3& v) {
    return std::max({v.r, v.g, v.b});
}

double alphaOf(double roughness) {
    const double r = std::clamp(roughness, 0.0, 1.0);
    return std::max(r * r, kLeastAlpha);
}

double schlick(double f0, double f90, double cosine) {
    const double x = std::clamp(1 - cosine, 0.0, 1.0), x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Masking of fibres, fitted by Estevez & Kulla, "Production Friendly Microfacet Sheen BRDF", 2017.
double maskingFit(double x, double t) {
    const auto mixed = [&](double rough, double smooth) { return rough + (smooth - rough) * t; };
    return mixed(21.5473, 25.3245) / (1 + mixed(3.82987, 3.32435) * std::pow(x, mixed(0.19823, 0.16801))) +
           mixed(-1.97760, -1.27393) * x + mixed(-4.32054, -4.85967);
}

double masking(double cosine, double alpha) {
    const double t = (1 - alpha) * (1 - alpha);
    return std::exp(cosine < 0.5 ? maskingFit(cosine, t)
                                 : 2 * maskingFit(0.5, t) - maskingFit(std::max(1 - cosine, 0.0), t));
}

double unscaledSheen(double nh, double nv, double nl, double alpha) {
    const double sine2 = std::max(1 - nh * nh, 0.0);
    const double d = (2 + 1 / alpha) * std::pow(sine2, 0.5 / alpha) / (2 * kPi);
    return d / ((1 + masking(nv, alpha) + masking(nl, alpha)) * 4 * nv * nl);
}

double integrateSheen(double mu, double alpha) {
    static const skin::GaussLegendre<40> rule;
    const double sigma = std::sqrt((1 - mu) * (1 + mu));
    // cosθ = u²: the lobe is steepest at the horizon.
    return rule.integrate(0, 1, [&](double u) {
        const double nl = u * u, sine = std::sqrt((1 - nl) * (1 + nl));
        return 2 * u * nl * rule.integrate(0, kPi, [&](double phi) {
            const double nh = (mu + nl) / std::sqrt(2 + 2 * (mu * nl + sigma * sine * std::cos(phi)));
            return 2 * unscaledSheen(std::min(nh, 1.0), mu, nl, alpha);
        });
    });
}

// E at even steps of √μ and of roughness.
class SheenTable {
  public:
    SheenTable() {
        for (int i = 0; i < kSize; ++i) {
            const double r = kLeastSheenRoughness + (1 - kLeastSheenRoughness) * i / (kSize - 1);
            for (int j = 0; j < kSize; ++j) {
                const double root = double(j) / (kSize - 1);
                value_[i][j] = integrateSheen(std::max(root * root, kLeastCosine), r * r);
            }
        }
    }
    double at(double mu, double roughness) const {
        const double y =
            std::clamp((roughness - kLeastSheenRoughness) / (1 - kLeastSheenRoughness), 0.0, 1.0);
        return interpolate(y, std::sqrt(std::clamp(mu, 0.0, 1.0)));
    }

  private:
    static constexpr int kSize = 40;
    double interpolate(double y, double x) const {
        const double row = y * (kSize - 1), column = x * (kSize - 1);
        const int i = std::min(int(row), kSize - 2), j = std::min(int(column), kSize - 2);
        const double f = row - i, g = column - j;
        return (value_[i][j] * (1 - g) + value_[i][j + 1] * g) * (1 - f) +
               (value_[i + 1][j] * (1 - g) + value_[i + 1][j + 1] * g) * f;
    }
    std::array<std::array<double, kSize>, kSize> value_;
};

}  // namespace

double sheenAlbedo(double mu, double roughness) {
    static const SheenTable table;
    return table.at(mu, roughness);
}

double sheenLobe(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l, double roughness) {
    const double r = std::clamp(roughness, kLeastSheenRoughness, 1.0);
    const double nv = std::max(glm::dot(n, v), kLeastCosine), nl = std::max(glm::dot(n, l), kLeastCosine);
    const double nh = std::clamp(glm::dot(n, safeNormalize(l + v, n)), 0.0, 1.0);
    return unscaledSheen(nh, nv, nl, r * r) / std::max(sheenAlbedo(nv, r), 1.0);
}

glm::dvec3 Layers::fresnel(double cosine) const {
    const double f90 = deepF90 + (1 - deepF90) * metallic;
    const glm::dvec3 f0 = glm::mix(deepF0, albedo, metallic);
    return {schlick(f0.r, f90, cosine), schlick(f0.g, f90, cosine), schlick(f0.b, f90, cosine)};
}

double Layers::belowFresnel(double cosine) const {
    return 1 - schlick(largest(deepF0), deepF90, cosine);
}

double Layers::belowSheen(double cosine) const {
    if (sheen == glm::dvec3(0)) return 1;
    return 1 - largest(sheen) * std::min(sheenAlbedo(std::max(cosine, kLeastCosine), sheenRoughness), 1.0);
}

double Layers::coatReflection(double cosine) const {
    return coat * schlick(kCoatF0, 1, cosine);
}

glm::dvec3 Layers::through(double cosine, double coatCosine) const {
    if (!(transmission > 0)) return glm::dvec3(0);
    return albedo * (transmission * (1 - metallic) * belowFresnel(cosine) * belowSheen(cosine) *
                     (1 - coatReflection(coatCosine)));
}

Layers layersAt(const Hit& hit, const glm::dvec4& base) {
    const Material& m = *hit.mesh->material;
    const glm::dvec4 texel = textureAt(hit, m.metallicRoughnessTexture);
    Layers layers;
    layers.albedo = glm::clamp(glm::dvec3(base), 0.0, 1.0);
    layers.metallic = std::clamp(m.metallic * texel.b, 0.0, 1.0);
    layers.alpha = alphaOf(m.roughness * texel.g);
    const Dielectric& d = m.dielectric;
    const double ior = d.ior, root = ior > 0 ? (ior - 1) / (ior + 1) : 1;
    layers.deepF90 = d.specular * textureAt(hit, d.specularTexture).a;
    const glm::dvec3 color = glm::dvec3(d.specularColor) * glm::dvec3(textureAt(hit, d.specularColorTexture));
    layers.deepF0 = glm::min(color * (root * root), 1.0) * layers.deepF90;
    layers.occlusion = 1 + m.occlusionStrength * (textureAt(hit, m.occlusionTexture).r - 1);
    if (!m.layered()) return layers;
    if (m.transmission > 0) layers.transmission = m.transmission * textureAt(hit, m.transmissionTexture).r;
    if (m.sheen.color != glm::vec3(0)) {
        layers.sheen = glm::dvec3(m.sheen.color) * glm::dvec3(textureAt(hit, m.sheen.colorTexture));
        layers.sheenRoughness = m.sheen.roughness * textureAt(hit, m.sheen.roughnessTexture).a;
    }
    if (m.clearcoat.factor > 0) {
        layers.coat = m.clearcoat.factor * textureAt(hit, m.clearcoat.texture).r;
        layers.coatAlpha = alphaOf(m.clearcoat.roughness * textureAt(hit, m.clearcoat.roughnessTexture).g);
    }
    return layers;
}

glm::dvec3 lightThrough(const Hit& hit, double cosine) {
    const Material& material = *hit.mesh->material;
    const double covered = hit.mesh->alphaAt(hit.triangle, hit.u, hit.v);
    if (!material.layered() || !(material.transmission > 0)) return glm::dvec3(1 - covered);
    const glm::dvec4 base = glm::dvec4(material.baseColor) * hit.mesh->colorAt(hit.triangle, hit.u, hit.v) *
                            textureAt(hit, material.baseColorTexture);
    return 1.0 - covered + covered * layersAt(hit, base).through(cosine, cosine);
}

}  // namespace cutis::reference
