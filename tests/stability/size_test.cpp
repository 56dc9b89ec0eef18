// Sizes of atlas and picture at their ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "extreme.h"

namespace cutis::test {
namespace {

RenderJob withAtlas(int size) {
    RenderJob job = inUniformLight(sphereJob(SceneBuilder::plainSkin()));
    job.irradianceSize = size;
    return job;
}

// A decimetre of the sphere along the longer side, in the atlas of a picture of 48 x 48: pixels of a
// hundredth of a millimetre would have the largest.
RenderJob withPicture(int width, int height) {
    SceneBuilder builder;
    builder.addObject("body", sphere(), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.1 * width / std::max(width, height));
    RenderJob job = inUniformLight(pictureOf(builder));
    job.irradianceSize = 192;
    job.width = width, job.height = height;
    return job;
}

// Six charts, each with its gutter, in the smallest power of two that holds them.
RenderJob chartsOneTexelWide() {
    SceneBuilder builder;
    builder.addObject("body", sphere(100 * kMm, SphereMapping::cube),
                      builder.addSkin(SceneBuilder::plainSkin()));
    RenderJob job = inUniformLight(pictureOf(builder));
    job.irradianceSize = 32;
    return job;
}

RenderJob crowd() {
    SceneBuilder builder;
    const int skin = builder.addSkin(SceneBuilder::plainSkin());
    for (int i = 0; i < 16; ++i) {
        builder.addObject(
            "body " + std::to_string(i), sphere(20 * kMm), skin,
            glm::translate(glm::dmat4(1), {-0.075 + 0.05 * (i % 4), -0.075 + 0.05 * (i / 4), 0.0}));
    }
    RenderJob job = inUniformLight(pictureOf(builder));
    job.irradianceSize = 256;
    return job;
}

std::vector<Extreme> sizes() {
    // All skin in one texel: one light from the front gives one radiance, at the most that of what faces it.
    const auto lit = [] {
        RenderJob job = sphereJob(SceneBuilder::plainSkin());
        job.irradianceSize = 1;
        return inLight(job, {directionalLight("key", {-0.3, -0.2, -1}, std::numbers::pi)});
    };
    return {{"atlas_1", [] { return withAtlas(1); }, Bounds3::near(1, 0.05)},
            {"atlas_1_in_one_light", lit, {glm::dvec3(0.05), glm::dvec3(1.02)}},
            {"atlas_2", [] { return withAtlas(2); }, Bounds3::near(1, 0.05)},
            {"atlas_4", [] { return withAtlas(4); }, Bounds3::near(1, 0.05)},
            {"atlas_8", [] { return withAtlas(8); }, Bounds3::near(1, 0.05)},
            {"charts_one_texel_wide", chartsOneTexelWide, Bounds3::atMost(1.05)},
            {"atlas_16", [] { return withAtlas(16); }, Bounds3::near(1, 0.05)},
            {"atlas_1024", [] { return withAtlas(1024); }, Bounds3::near(1, 0.03)},
            {"picture_1x1", [] { return withPicture(1, 1); }, Bounds3::near(1, 0.03)},
            {"picture_16384x1", [] { return withPicture(16384, 1); }, Bounds3::near(1, 0.03)},
            {"picture_1x2000", [] { return withPicture(1, 2000); }, Bounds3::near(1, 0.03)},
            {"sixteen_characters_in_an_atlas_of_256", crowd, Bounds3::atMost(1.02)}};
}

CUTIS_EXTREME_CASES(Sizes, sizes());

}  // namespace
}  // namespace cutis::test
