// The environment behind what a picture shows.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/picture.h"
#include "renderer/scene/scene.h"

namespace cutis {

// blurred: smoothed over some 8 degrees, so that it lights the picture without competing with its subject.
enum class Background { none, environment, blurred };
inline constexpr const char* kBackgroundNames[] = {"none", "env", "blurred"};

// Made once for an environment, to be painted behind any number of pictures.
class BackgroundPainter {
  public:
    // Uses the environment, not a copy, unless it is blurred.
    BackgroundPainter(const Environment& environment, Background background);

    // Adds to each pixel of `picture` (RGBA, colours times coverage) the radiance that the camera sees past
    // what covers it: rgb += (1 - a) L. Alpha stays the coverage.
    void paint(Picture& picture, const Camera& camera, const EnvironmentSettings& settings) const;

  private:
    Environment blurred_;
    const Environment* sharp_ = nullptr;
};

}  // namespace cutis
