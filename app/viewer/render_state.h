// All that a picture depends on, and what two of them have in common.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/viewer/overlay.h"
#include "app/viewer/playback.h"
#include "renderer/frame/background.h"
#include "renderer/frame/renderer.h"

namespace cutis::app {

struct RenderState {
    std::shared_ptr<Scene> scene;  // with texels; the worker alone touches it once it has been handed over
    std::vector<std::optional<SkinMaterial>> skin;  // per material, put into the scene before rendering
    Pose pose;                                      // the scene is put into it before rendering
    Rig rig;                                        // placements resolved, solo and mute applied
    Camera camera;
    RenderSettings settings;  // width and height of the full picture
    Shown overlay;            // no AOV: the picture
    Background background = Background::none;
};

bool sameCamera(const Camera& a, const Camera& b);
// All that lights the scene is the same: what is left is the camera, the exposure and what is shown.
bool sameLight(const RenderState& a, const RenderState& b);

// Turned by so little that samples fall elsewhere within a third of a pixel, which is how far apart they are:
// the points of a Halton sequence in bases 2 and 3. `height` of the picture in pixels.
Camera jittered(Camera camera, int index, int height);

// The same with small light maps and few light samples, which are most of what a light that moves costs.
RenderSettings draftOf(RenderSettings settings);
RenderState draftOf(RenderState state);

// Other samples of its lights would light it differently.
bool hasSoftShadows(const RenderState& state);

}  // namespace cutis::app
