#include "app/viewer/view_input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/viewer/light_handles.h"
#include "app/viewer/style.h"
#include "app/viewer/view_layout.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace {

enum class Drag { none, view, handle, wipe, place };

// Which picture is whose, where two are compared: left and right of a line, of each other, or in turn.
void drawCompared(const Session& session, float wipe) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(session.uiScale), gap = 8 * scale;
    const float top = float(session.view.y), bottom = float(session.view.y + session.view.height);
    const float left = float(session.view.x), middle = left + float(session.view.width) / 2;
    const char* other = session.compared[1].stored ? "B" : "Now";
    const auto write = [&](float x, float y, const char* text) {
        draw.AddText({x + 1, y + 1}, IM_COL32(0, 0, 0, 180), text);
        draw.AddText({x, y}, accentColor(), text);
    };
    switch (session.compareMode) {
        case CompareMode::wipe:
            draw.AddLine({wipe, top}, {wipe, bottom}, accentColor(), 2 * scale);
            write(wipe - ImGui::CalcTextSize("A").x - gap, top + gap, "A");
            write(wipe + gap, top + gap, other);
            break;
        case CompareMode::sideBySide:
            write(left + gap, top + float(session.view.height) / 4 + gap, "A");
            write(middle + gap, top + float(session.view.height) / 4 + gap, other);
            break;
        case CompareMode::blink:
            write(left + gap, top + gap, blinkShowsFirst() ? "A" : other);
            break;
        default:
            break;
    }
}

// What is shown is the scene where the view has it, so that handles lie on it.
bool seesScene(const Session& session) {
    const bool beside = session.compareMode == CompareMode::sideBySide && session.compared[0].stored;
    return !beside && session.overlay.inspect.what != Inspect::What::lightMap;
}

// What dragging in the picture places the chosen light by: as chosen above the picture, or by the keys held.
std::optional<PlaceBy> placedBy(const Session& session) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl) return io.KeyShift ? PlaceBy::shadowEdge : PlaceBy::highlight;
    return session.placing;
}

void placeAt(Session& session, const Camera& camera, const ImVec2& mouse, PlaceBy by) {
    const std::optional<Hit> hit = pickAt(session, camera, mouse);
    if (!hit || !session.hasLight()) return;
    const glm::dvec3 axis(camera.world[2]);
    constexpr double kFar = 1e6;  // metres: an orthographic camera sees from there
    const glm::dvec3 eye = camera.orthographic ? hit->position + kFar * axis : glm::dvec3(camera.world[3]);
    glm::dvec3 subject = session.headCentre;
    if (session.light().place)
        subject = headBounds(*session.geometry, session.light().place->subject).centre();
    editLight(session, "Placement", [&](Light& light) { placeByLight(light, by, *hit, eye, subject); });
    const glm::dvec3 seen = project(camera, session.aspect(), hit->position);
    ImGui::GetBackgroundDrawList()->AddCircle(onScreen(session, seen), 5 * float(session.uiScale),
                                              accentColor(), 0, float(session.uiScale));
}

// The character that the mouse is on, else the one whose head is the nearest.
int characterAt(const Session& session, const Camera& camera, const ImVec2& mouse) {
    const Scene& scene = *session.geometry;
    if (const std::optional<Hit> hit = pickAt(session, camera, mouse)) {
        const int character = scene.nodeCharacter[static_cast<std::size_t>(hit->node)];
        if (character >= 0) return character;
    }
    int nearest = -1;
    float best = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < scene.characters.size(); ++i) {
        const Bounds head = headBounds(scene, scene.characters[i].name);
        const glm::dvec3 seen = project(camera, session.aspect(), head.centre());
        if (seen.z <= 0 || distanceOf(onScreen(session, seen), mouse) >= best) continue;
        best = distanceOf(onScreen(session, seen), mouse);
        nearest = static_cast<int>(i);
    }
    return nearest;
}

void framePersonAt(Session& session, const Camera& camera, const ImVec2& mouse) {
    const int nearest = characterAt(session, camera, mouse);
    session.selectedCharacter = nearest;
    editView(session, "Frame Bust", [&](OrbitCamera& orbit) {
        frameSubject(orbit, *session.geometry, nearest, Framing::bust, session.aspect());
    });
}

// From now on the view turns about what is under the mouse, which moves to its middle.
void turnRoundPointAt(Session& session, const Camera& camera, const ImVec2& mouse) {
    const std::optional<Hit> hit = pickAt(session, camera, mouse);
    if (!hit) return;
    editView(session, "Look at a point", [&](OrbitCamera& orbit) { orbit.target = hit->position; });
}

}  // namespace

void handleView(Session& session) {
    static Drag drag = Drag::none;
    if (!session.geometry || session.view.width <= 0 || session.view.height <= 0) return;
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 mouse = io.MousePos;
    const float scale = static_cast<float>(session.uiScale);
    const bool inside = !io.WantCaptureMouse && session.view.contains(mouse.x, mouse.y);
    const Camera camera = currentCamera(session);

    static LightHandle held;
    const std::vector<LightHandle> handles = session.showHandles && seesScene(session)
                                                 ? lightHandles(session, camera)
                                                 : std::vector<LightHandle>();
    int hovered = -1;  // a light lies over what it aims at
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const bool ofLight = handles[i].part == LightHandle::Part::light;
        // Where keys or a mode place the light, what it aims at is in the way.
        if (inside && distanceOf(handles[i].at, mouse) < 11 * scale && (ofLight || !placedBy(session)))
            hovered = static_cast<int>(i);
    }
    const bool wiping = session.compareMode == CompareMode::wipe && session.compared[0].stored;
    const float wipeX = static_cast<float>(session.view.x + session.wipe * session.view.width);
    const bool onWipe = wiping && inside && std::abs(mouse.x - wipeX) < 6 * scale;
    if (onWipe) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (hovered >= 0) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);

    if (inside && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && hovered < 0) {
        framePersonAt(session, camera, mouse);
    } else if (inside && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        const bool places = placedBy(session).has_value() && session.hasLight();
        drag = hovered >= 0 ? Drag::handle : onWipe ? Drag::wipe : places ? Drag::place : Drag::view;
        if (hovered >= 0) {
            held = handles[static_cast<std::size_t>(hovered)];
            session.selectedLight = held.light;
        }
    }
    static bool panning = false;
    if (inside &&
        (ImGui::IsMouseClicked(ImGuiMouseButton_Middle) || ImGui::IsMouseClicked(ImGuiMouseButton_Right)))
        panning = true;
    if (!io.MouseDown[ImGuiMouseButton_Left]) drag = Drag::none;
    if (!io.MouseDown[ImGuiMouseButton_Middle] && !io.MouseDown[ImGuiMouseButton_Right]) panning = false;

    const ImVec2 by = io.MouseDelta;
    const bool moved = by.x != 0 || by.y != 0;
    const double height = session.view.height;
    if (moved && drag == Drag::view)
        editView(session, "Turn the view", [&](OrbitCamera& c) { orbitBy(c, by.x, by.y, height); });
    if (moved && drag == Drag::handle) {
        dragLightHandle(session, camera, held, by);
        held.at = mouse;
    }
    if (drag == Drag::place && (moved || ImGui::IsMouseClicked(ImGuiMouseButton_Left)))
        placeAt(session, camera, mouse, placedBy(session).value_or(PlaceBy::highlight));
    if (moved && drag == Drag::wipe)
        session.wipe = std::clamp((mouse.x - session.view.x) / double(session.view.width), 0.0, 1.0);
    if (moved && panning)
        editView(session, "Move the view", [&](OrbitCamera& c) { panBy(c, by.x, by.y, height); });
    if (inside && io.MouseWheel != 0)
        editView(session, "Near the view", [&](OrbitCamera& c) { dollyBy(c, io.MouseWheel); });

    if (inside && !io.WantTextInput && ImGui::IsKeyPressed(GLFW_KEY_F, false))
        turnRoundPointAt(session, camera, mouse);

    drawLightHandles(session, camera, handles, hovered);
    if (session.compared[0].stored) drawCompared(session, wipeX);
}

}  // namespace cutis::app
