// Handles of lights in the picture: where each shines from, and of the chosen one where it aims and how wide
// its cone is.
#pragma once

#include <imgui.h>

#include <optional>
#include <vector>

#include "app/viewer/pick.h"
#include "app/viewer/session.h"

namespace cutis::app {

struct LightHandle {
    enum class Part { light, aim, cone };
    int light = -1;  // index into Rig::lights
    Part part = Part::light;
    ImVec2 at, centre;    // pixels of the window: of the handle, and of what it turns round
    bool behind = false;  // its light stands behind the head
};

// A light's lies in its direction from the head, on a ball that fits the view, for lights are mostly outside
// of it; aim and cone lie where they are in the scene.
std::vector<LightHandle> lightHandles(const Session& session, const Camera& camera);
void drawLightHandles(const Session& session, const Camera& camera, const std::vector<LightHandle>& handles,
                      int hovered);
// The mouse has moved by so many pixels with that handle, as one edit. Of a light: Shift its distance, Alt
// its cone or size. One that is placed round a subject and aimed elsewhere stands free from then on.
void dragLightHandle(Session& session, const Camera& camera, const LightHandle& handle, const ImVec2& by);

// A place in the view, as project() gives it, in pixels of the window; what a pixel of the window looks at.
ImVec2 onScreen(const Session& session, const glm::dvec3& point);
float distanceOf(const ImVec2& a, const ImVec2& b);
Ray rayAt(const Session& session, const Camera& camera, const ImVec2& mouse);
std::optional<Hit> pickAt(const Session& session, const Camera& camera, const ImVec2& mouse);

}  // namespace cutis::app
