// A scene that lacks nothing and costs little, and a device with validation layers to draw it on.
#pragma once

#include <gtest/gtest.h>

#include "renderer/frame/renderer.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/characters.h"
#include "tests/support/render.h"

namespace cutis::test {

// A head with a thin ear, both of textured skin, another character, a pane of glass before a wall; a point light, a
// directional one that shines through the ear, a softbox, and a sky with a sun.
struct SmallScene {
    SmallScene();
    SkinMaterial& skin() { return *scene.materials[skinMaterial].skin; }
    // Looks at the middle, or past it.
    Camera cameraAt(double x, double width = 0.5) const;

    Scene scene;
    Environment sky;
    int skinMaterial = 0, glassMaterial = 0;
    RenderInput input;
    RenderSettings settings;
};

Environment skyOf(double low, double high);

class SmallSceneTest : public ::testing::Test {
  protected:
    static gpu::Device& device();
    void SetUp() override { messages_ = gpu::validationMessages(); }
    void TearDown() override { EXPECT_EQ(gpu::validationMessages(), messages_) << "validation messages, see above"; }

  private:
    std::uint64_t messages_ = 0;
};

}  // namespace cutis::test
