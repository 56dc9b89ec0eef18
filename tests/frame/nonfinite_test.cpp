// Values that are not finite are counted, in the atlas and in the picture: what every other test relies on.
#include <gtest/gtest.h>

#include <cstdlib>

#include "renderer/frame/renderer.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/characters.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

TEST(Nonfinite, IsCounted) {
    setenv("CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR, 1);
    gpu::Device device({.select = "cpu", .validation = true});
    SceneBuilder builder;
    builder.addObject("plate", makePlate(0.1), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, 0.08);
    Scene scene = builder.scene();
    findCharacters(scene);
    RenderInput input;
    input.scene = &scene;
    input.camera = scene.cameras.at(0);
    input.rig.environment.enabled = false;
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.irradianceSize = 64;
    // Each is a float, their sum is not.
    const Light bright = directionalLight("bright", {0, 0, -1}, 3e38);
    input.rig.lights = {bright};
    EXPECT_EQ(renderPicture(device, input, settings).stats.nonfinite, 0u);
    input.rig.lights = {bright, bright};
    const std::uint64_t pixels = 16 * 16 * 3;
    EXPECT_GT(renderPicture(device, input, settings).stats.nonfinite, pixels)
        << "more than the picture holds: the atlas' too";
}

}  // namespace
}  // namespace cutis::test
