// Skin parameters at and beyond their ends. In a uniform environment of radiance 1, white skin has radiance 1
// whatever they are.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>

#include "extreme.h"
#include "tests/support/closed_forms.h"

namespace cutis::test {
namespace {

constexpr double kFurnace = 0.03;  // of these coarse pictures; tests/figures holds finer ones to 0.01

SkinMaterial skinOf(double roughness, double specular, double mix = 0.5) {
    SkinMaterial skin;
    skin.roughness = roughness, skin.specular = specular, skin.mix = mix;
    return skin;
}

// Equal weights, variances in mm².
SkinMaterial skinOf(const std::vector<double>& variances, const std::vector<double>& weights = {}) {
    SkinMaterial skin = SceneBuilder::plainSkin();
    skin.profile.gaussians.clear();
    double sum = 0;
    for (const double weight : weights) sum += weight;
    for (std::size_t k = 0; k < variances.size(); ++k) {
        const double weight =
            weights.empty() ? 1.0 / static_cast<double>(variances.size()) : weights[k] / sum;
        skin.profile.gaussians.push_back({variances[k], glm::dvec3(weight)});
    }
    return skin;
}

Extreme furnace(const std::string& name, const SkinMaterial& skin) {
    return {name, [skin] { return inUniformLight(sphereJob(skin)); }, Bounds3::near(1, kFurnace)};
}

std::vector<Extreme> lobes() {
    std::vector<Extreme> cases;
    for (const double roughness : {1e-3, 1e-2, 1.0})
        for (const double specular : {0.0, 1.0, 4.0}) {
            if (specular == 0 && roughness < 1) continue;  // the lobe is not there
            cases.push_back(furnace("roughness_1e" +
                                        std::to_string(std::lround(10 * std::log10(roughness)) + 30) +
                                        "_specular_" + std::to_string(std::lround(specular)),
                                    skinOf(roughness, specular)));
        }
    // A mirror-like lobe under a light of no size: its peak is 1/(π m²), and must stay finite.
    cases.push_back({"mirror_under_a_light", [] {
                         return inLight(sphereJob(skinOf(1e-3, 1)), {directionalLight("key", {0, 0, -1}, 1)});
                     }});
    cases.push_back(
        {"grazing_light", [] {
             return inLight(sphereJob(skinOf(0.1, 4)), {directionalLight("rim", {1, 0, 1e-4}, 1)});
         }});
    // A plate of 1 km seen at N·V = 1e-4 fills half of the picture.
    for (const double roughness : {1e-3, 0.3}) {
        cases.push_back(
            {"grazing_view_roughness_1e" + std::to_string(std::lround(10 * std::log10(roughness)) + 30),
             [roughness] {
                 SceneBuilder builder;
                 const glm::dmat4 tilt =
                     glm::rotate(glm::dmat4(1), -(std::acos(-1.0) / 2 - 1e-4), glm::dvec3(1, 0, 0));
                 builder.addObject("plate", makePlate(1000), builder.addSkin(skinOf(roughness, 1)), tilt);
                 RenderJob job = inUniformLight(pictureOf(builder));
                 job.irradianceSize = 256;  // for pixels of 4 mm it would be the largest
                 job.scene.cameras[0].znear = 0.01, job.scene.cameras[0].zfar = 2000;
                 return job;
             },
             Bounds3::atMost(1 + kFurnace)});
        cases.back().leastCosine = 0;
    }
    return cases;
}

std::vector<Extreme> albedos() {
    std::vector<Extreme> cases;
    for (const double mix : {0.0, 0.5, 1.0}) {
        const std::string suffix = "_mix_" + std::to_string(std::lround(mix * 10));
        cases.push_back(furnace("white" + suffix, skinOf(0.3, 1, mix)));
        // What a black body sends back is its highlight alone.
        cases.push_back({"black" + suffix,
                         [mix] { return inUniformLight(sphereJob(skinOf(0.3, 1, mix), glm::dvec3(0))); },
                         Bounds3::atMost(0.7)});
        cases.push_back({"red" + suffix,
                         [mix] {
                             return inUniformLight(sphereJob(skinOf(0.3, 0, mix), {1, 0, 0}));
                         },
                         {{1 - kFurnace, 0, 0}, {1 + kFurnace, 1e-6, 1e-6}}});
    }
    // Vertices white and black in turn.
    cases.push_back({"black_and_white_texels",
                     [] {
                         SceneBuilder builder;
                         Primitive body = makeSphere(100 * kMm, SphereMapping::latLong);
                         for (std::size_t v = 0; v < body.positions.size(); ++v)
                             body.colors.emplace_back(glm::vec3(v % 2), 1);
                         builder.addObject("body", body, builder.addSkin(skinOf(0.3, 0)));
                         return inUniformLight(pictureOf(builder));
                     },
                     Bounds3::atMost(1 + kFurnace)});
    return cases;
}

// In even light a sphere of radius 100 mm gives back Σ w_k (1 - exp(-2a²/v_k)) of each channel.
Extreme wideFurnace(const std::string& name, const SkinMaterial& skin) {
    glm::dvec3 expected(0);
    for (const skin::Gaussian& g : skin.profile.gaussians)
        expected += g.weight * -std::expm1(-2 * 100 * 100 / (g.variance * skin.scale * skin.scale));
    return {
        name, [skin] { return inUniformLight(sphereJob(skin)); }, {expected - kFurnace, expected + kFurnace}};
}

// One Gaussian (mm²), the sphere lit from its side.
Extreme sideLit(const std::string& name, double variance, double tolerance) {
    const SkinMaterial skin = skinOf(std::vector<double>{variance});
    Extreme extreme{
        name, [skin] {
            return inLight(sphereJob(skin), {directionalLight("side", {-1, 0, 0}, std::numbers::pi)});
        }};
    const auto exact = std::make_shared<SphereDiffusion>(skin.profile, 100);
    extreme.exact = [exact](const glm::dvec3& normal) { return glm::dvec3((*exact)(normal.x, 0)); };
    extreme.tolerance = tolerance;
    return extreme;
}

std::vector<Extreme> profiles() {
    std::vector<Extreme> cases;
    for (const double scale : {1e-3, 30.0, 1e3}) {
        SkinMaterial skin = SceneBuilder::plainSkin();
        skin.scale = scale;
        cases.push_back(wideFurnace("scale_1e" + std::to_string(std::lround(std::log10(scale)) + 3), skin));
    }
    // The stiff case: one Gaussian far below a texel, the next wider than the body.
    cases.push_back(wideFurnace("eight_decades", skinOf({1e-4, 1e4})));
    // Wide ones that nothing leads up to, seen as the light of one side spreads to the other: blurred over the
    // charts up to a variance of 1,256 mm², a hundredth of the body's area, and summed over its skin above.
    cases.push_back(sideLit("side_lit_variance_1e2", 1e2, 0.0055));
    cases.push_back(sideLit("side_lit_variance_1e3", 1e3, 0.047));
    cases.push_back(sideLit("side_lit_variance_2e3", 2e3, 0.008));
    cases.push_back(sideLit("side_lit_variance_1e4", 1e4, 0.0042));
    cases.push_back(sideLit("side_lit_variance_1e6", 1e6, 0.0034));
    cases.push_back(furnace("one_gaussian", skinOf({1.0})));
    cases.push_back(furnace("sixteen_gaussians", skinOf({1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.06, 0.1, 0.2, 0.4,
                                                         0.8, 1.6, 3.2, 5, 7, 9, 12})));
    cases.push_back(furnace("zero_weights", skinOf({0.01, 0.1, 1, 5}, {0, 1, 0, 1})));
    cases.push_back(furnace("weights_near_zero", skinOf({0.01, 0.1, 1, 5}, {1e-30, 1, 1e-12, 1})));
    cases.push_back(furnace("equal_variances", skinOf({1.0, 1.0 + 1e-12, 1.0 + 2e-12})));
    return cases;
}

CUTIS_EXTREME_CASES(Lobes, lobes());
CUTIS_EXTREME_CASES(Albedos, albedos());
CUTIS_EXTREME_CASES(Profiles, profiles());

}  // namespace
}  // namespace cutis::test
