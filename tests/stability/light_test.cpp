// Lights and environments at and beyond their ends.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "extreme.h"
#include "tests/support/pictures.h"

namespace cutis::test {
namespace {

RenderJob lit(std::vector<Light> lights) {
    return inLight(sphereJob(SceneBuilder::plainSkin()), std::move(lights));
}

RenderJob lit(Light light) {
    return lit(std::vector<Light>{std::move(light)});
}

// Lights all round whose irradiance facing each adds up to `lux`.
std::vector<Light> ring(int count, double lux) {
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        lights.push_back(directionalLight("light " + std::to_string(i),
                                          {std::cos(angle), std::sin(angle), -2}, lux / count));
    }
    return lights;
}

std::vector<Extreme> numbers() {
    std::vector<Extreme> cases{{"no_light", [] { return lit(std::vector<Light>{}); }, Bounds3::atMost(0)}};
    for (const int count : {64, 512}) {
        cases.push_back({"lights_" + std::to_string(count),
                         [count] {
                             RenderJob job = lit(ring(count, std::numbers::pi));
                             job.irradianceSize = 64;  // each light is summed at each texel
                             return job;
                         },
                         Bounds3::atMost(1.02)});
    }
    return cases;
}

std::vector<Extreme> intensities() {
    std::vector<Extreme> cases;
    const Expected one = rendered([] { return lit(directionalLight("key", {0, 0, -1}, 1)); });
    for (const int exponent : {-12, 12}) {
        const double factor = std::pow(10.0, exponent);
        cases.push_back({"intensity_1e" + std::to_string(exponent + 12),
                         [factor] {
                             return lit(directionalLight("key", {0, 0, -1}, factor));
                         },
                         {},
                         one,
                         factor,
                         1e-5});
    }
    // The dim light beside the bright one must not turn into noise, nor the bright one into infinity.
    cases.push_back({"intensities_24_decades_apart",
                     [] {
                         return lit({directionalLight("bright", {0, 0, -1}, 1e12),
                                     directionalLight("dim", {0, 0, -1}, 1e-12)});
                     },
                     {},
                     one,
                     1e12,
                     1e-5});
    return cases;
}

std::vector<Extreme> places() {
    std::vector<Extreme> cases;
    const std::pair<const char*, double> heights[] = {
        {"in_the_middle", 0},    {"inside", 0.05},       {"under_the_surface", 0.09999},
        {"on_the_surface", 0.1}, {"touching", 0.100001}, {"a_millimetre_away", 0.101}};
    for (const auto& [name, z] : heights)
        cases.push_back({std::string("point_") + name, [z = z] {
                             return lit(pointLight("bulb", {0, 0, z}, 1));
                         }});
    // Far lights are parallel ones.
    const Expected parallel = rendered([] { return lit(directionalLight("sun", {0, 0, -1}, 1)); });
    const std::pair<const char*, double> distances[] = {
        {"30_metres_away", 30}, {"300_metres_away", 300}, {"a_thousand_kilometres_away", 1e6}};
    for (const auto& [name, z] : distances) {
        cases.push_back({std::string("point_") + name,
                         [z = z] {
                             return lit(pointLight("bulb", {0, 0, z}, 1));
                         },
                         {},
                         parallel,
                         1 / (z * z),
                         z < 100 ? 6e-3 : 6e-4});
    }
    // Before a plate that keeps all light off, also off the terminator, where highlights are strongest.
    cases.push_back({"behind_a_plate",
                     [] {
                         SceneBuilder builder;
                         builder.addObject("body", sphere(), builder.addSkin(SkinMaterial()));
                         builder.addObject("plate", makePlate(2), builder.addMatte(),
                                           glm::translate(glm::dmat4(1), {0, 0, -0.2}));
                         RenderJob job = pictureOf(builder);
                         job.scene.materials[1].doubleSided = true;
                         return inLight(job, {directionalLight("behind", {0.1, 0.05, 1}, 10)});
                     },
                     Bounds3::atMost(1e-6)});
    cases.back().leastCosine = -1;
    return cases;
}

std::vector<Extreme> shapes() {
    const double half = std::numbers::pi / 2;
    const auto spot = [](double inner, double outer) {
        return [=] { return lit(spotLight("spot", {0, 0, 0.5}, {0, 0, -1}, 1, inner, outer)); };
    };
    const auto rect = [](double width, double height) {
        return [=] { return lit(rectLight("box", {0, 0, 0.5}, {0, 0, -1}, 1, width, height, 4)); };
    };
    return {{"spot_of_no_cone", spot(0, 1e-6)},
            {"spot_of_a_half_space", spot(0, half)},
            {"spot_with_a_hard_edge", spot(half - 1e-9, half)},
            {"rect_of_no_size", rect(1e-9, 1e-9)},
            {"rect_a_line", rect(1e-9, 1)},
            // Seen from anywhere it fills the half space in front at the most.
            {"rect_huge", rect(1e4, 1e4), {glm::dvec3(0.2), glm::dvec3(1.4)}},
            {"rect_huge_of_64_samples",
             [] {
                 return lit(rectLight("box", {0, 0, 0.5}, {0, 0, -1}, 1, 1e4, 1e4, 64));
             },
             {glm::dvec3(0.4), glm::dvec3(1.1)}}};
}

Extreme environment(const std::string& name, int width, int height,
                    const std::function<glm::dvec3(const glm::dvec3&)>& radiance, Bounds3 bounds = {}) {
    return {name,
            [=] {
                RenderJob job = sphereJob({});
                job.environment = makeEnvironment(width, height, radiance);
                return job;
            },
            bounds};
}

// One of 64 x 32 texels, in the third row above the horizon and the first column beside +Z: the light of its
// solid angle, all from where it is. It is 5.6 degrees across.
Extreme oneLitTexel() {
    const double step = std::numbers::pi / 32, elevation = 2.5 * step, azimuth = 0.5 * step;
    const glm::dvec3 place(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                           std::cos(azimuth) * std::cos(elevation));
    const double solidAngle = step * (std::sin(3 * step) - std::sin(2 * step));
    Extreme extreme{"one_lit_texel", [=] {
                        RenderJob job = sphereJob(SceneBuilder::plainSkin());
                        job.environment = makeEnvironment(64, 32, [=](const glm::dvec3& d) {
                            return glm::dvec3(glm::dot(d, place) > std::cos(0.1 * step) ? 100 : 0);
                        });
                        return job;
                    }};
    extreme.other = rendered([=] { return lit(directionalLight("texel", -place, 100 * solidAngle)); });
    extreme.tolerance = 0.002;
    return extreme;
}

std::vector<Extreme> environments() {
    const auto one = [](const glm::dvec3&) { return glm::dvec3(1); };
    std::vector<Extreme> cases{
        environment(
            "black", 16, 8, [](const glm::dvec3&) { return glm::dvec3(0); }, Bounds3::atMost(0)),
        environment("one_texel", 1, 1, one, Bounds3::near(1, 0.03)),
        environment("odd_size", 7, 3, one, Bounds3::near(1, 0.03)),
        environment("one_column", 1, 64, one, Bounds3::near(1, 0.03)),
        environment("sun_of_1e9_beside_1e-6", 64, 32,
                    [](const glm::dvec3& d) { return glm::dvec3(d.y > 0.995 ? 1e9 : 1e-6); }),
        environment("near_the_largest_float", 16, 8, [](const glm::dvec3&) { return glm::dvec3(1e30); }),
        environment("near_the_least_float", 16, 8, [](const glm::dvec3&) { return glm::dvec3(1e-30); })};
    for (Extreme& extreme : cases)
        for (char& c : extreme.name)
            if (c == '-') c = 'm';
    cases.push_back(oneLitTexel());
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const auto& [name, value] : {std::pair{"one_texel_not_a_number", nan},
                                      {"one_texel_infinite", inf},
                                      {"one_texel_negative", -5.f}}) {
        cases.push_back({name,
                         [value = value] {
                             RenderJob job = inUniformLight(sphereJob({}));
                             job.environment->values[3 * 20] = value;
                             return job;
                         },
                         Bounds3::atMost(1.02)});
    }
    return cases;
}

CUTIS_EXTREME_CASES(Numbers, numbers());
CUTIS_EXTREME_CASES(Intensities, intensities());
CUTIS_EXTREME_CASES(Places, places());
CUTIS_EXTREME_CASES(Shapes, shapes());
CUTIS_EXTREME_CASES(Environments, environments());

}  // namespace
}  // namespace cutis::test
