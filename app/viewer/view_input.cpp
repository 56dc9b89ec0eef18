#include "app/viewer/view_input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/viewer/style.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace {

enum class Drag { none, view, handle, wipe, place };

ImVec2 onScreen(const Session& session, const glm::dvec3& point) {
    return {static_cast<float>(session.view.x + point.x * session.view.width),
            static_cast<float>(session.view.y + point.y * session.view.height)};
}

float distance(const ImVec2& a, const ImVec2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

struct Handle {
    int light;
    ImVec2 at, centre;
    bool behind;  // the head: away from the viewer
};

// A handle lies in the light's direction from the head, on a ball that fits the view: lights are mostly
// outside.
std::vector<Handle> handlesOf(const Session& session, const Camera& camera) {
    std::vector<Handle> handles;
    const glm::dvec3 eye(camera.world[3]), back(camera.world[2]);
    const double depth = glm::dot(eye - session.headCentre, back);
    if (depth <= 0) return handles;
    const double halfHeight = camera.orthographic ? camera.ymag : depth * std::tan(camera.yfov / 2);
    const double radius = 0.8 * halfHeight * std::min(1.0, session.aspect());
    const ImVec2 centre = onScreen(session, project(camera, session.aspect(), session.headCentre));
    const auto& lights = session.document().rig.lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light placed = lights[i];
        placeLight(placed, session.headCentre);
        const double az = glm::radians(placed.place->azimuth), el = glm::radians(placed.place->elevation);
        const glm::dvec3 towards(std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el));
        // Drawn as if from afar, so that a handle in front of the head does not run into the camera.
        const glm::dmat3 axes(camera.world);
        const float pixels = static_cast<float>(0.5 * session.view.height * radius / halfHeight);
        const ImVec2 at(centre.x + pixels * static_cast<float>(glm::dot(axes[0], towards)),
                        centre.y - pixels * static_cast<float>(glm::dot(axes[1], towards)));
        handles.push_back({static_cast<int>(i), at, centre, glm::dot(axes[2], towards) < 0});
    }
    return handles;
}

void drawHandles(const Session& session, const std::vector<Handle>& handles, int hovered) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(session.uiScale);
    const Rig shining = effectiveRig(session.document());
    std::vector<ImVec4> taken;  // left, top, right, bottom of the handles, and of labels that are drawn
    for (const Handle& handle : handles) {
        const float radius = 8 * scale;
        taken.emplace_back(handle.at.x - radius, handle.at.y - radius, handle.at.x + radius,
                           handle.at.y + radius);
    }
    for (const Handle& handle : handles) {
        const auto index = static_cast<std::size_t>(handle.light);
        const bool chosen = handle.light == session.selectedLight;
        const bool on = shining.lights[index].enabled;
        const float alpha = on ? (handle.behind ? 0.6f : 1.0f) : 0.35f;
        const ImU32 color = chosen ? accentColor(alpha) : IM_COL32(235, 235, 235, int(200 * alpha));
        if (chosen) draw.AddLine(handle.centre, handle.at, accentColor(0.35f), scale);
        const float radius = (chosen || handle.light == hovered ? 8.f : 6.f) * scale;
        draw.AddCircleFilled(handle.at, radius + scale, IM_COL32(0, 0, 0, 110));
        handle.behind ? draw.AddCircle(handle.at, radius, color, 0, 2 * scale)
                      : draw.AddCircleFilled(handle.at, radius, color);
        const std::string& name = shining.lights[index].name;
        const ImVec2 size = ImGui::CalcTextSize(name.c_str());
        ImVec2 text(handle.at.x - size.x / 2, handle.at.y + radius + 2 * scale);
        const float left = float(session.view.x), right = left + float(session.view.width) - size.x;
        text.x = std::max(std::min(text.x, right), left);
        // Below what is there already.
        for (const ImVec4& other : taken)
            if (text.x < other.z && text.x + size.x > other.x && text.y < other.w &&
                text.y + size.y > other.y)
                text.y = other.w;
        taken.emplace_back(text.x, text.y, text.x + size.x, text.y + size.y);
        draw.AddText({text.x + 1, text.y + 1}, IM_COL32(0, 0, 0, 180), name.c_str());
        draw.AddText(text, color, name.c_str());
    }
}

void drawWipe(const Session& session, float x) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(session.uiScale);
    const float top = float(session.view.y), bottom = float(session.view.y + session.view.height);
    draw.AddLine({x, top}, {x, bottom}, accentColor(), 2 * scale);
    draw.AddText({x - ImGui::CalcTextSize("A").x - 8 * scale, top + 8 * scale}, accentColor(), "A");
    draw.AddText({x + 8 * scale, top + 8 * scale}, accentColor(), session.compared[1].stored ? "B" : "Now");
}

std::optional<Hit> pickAt(const Session& session, const Camera& camera, const ImVec2& mouse) {
    const double x = (mouse.x - session.view.x) / session.view.width;
    const double y = (mouse.y - session.view.y) / session.view.height;
    return pick(*session.geometry, rayThrough(camera, session.aspect(), x, y));
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
        if (seen.z <= 0 || distance(onScreen(session, seen), mouse) >= best) continue;
        best = distance(onScreen(session, seen), mouse);
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

// A drag to the right or up by half the view's height doubles.
double dragFactor(const Session& session, const ImVec2& by) {
    return std::exp2(2.0 * (by.x - by.y) / std::max(session.view.height, 1));
}

void dragDistance(Session& session, double factor) {
    editLight(session, "Distance", [&](Light& light) {
        if (light.place) {
            light.place->distance = std::clamp(light.place->distance * factor, 0.05, 100.0);
        } else if (light.type != LightType::directional) {
            light.position = session.headCentre + factor * (light.position - session.headCentre);
        }
    });
}

// The cone of a spot, the size of any other light that has one.
void dragSize(Session& session, double factor) {
    editLight(session, "Size", [&](Light& light) {
        if (light.type == LightType::spot) {
            light.outerConeAngle = std::clamp(light.outerConeAngle * factor, 0.01, glm::radians(89.0));
            light.innerConeAngle = std::min(light.innerConeAngle * factor, 0.98 * light.outerConeAngle);
        } else if (light.type == LightType::rect) {
            light.size = glm::clamp(light.size * factor, 0.01, 20.0);
        } else if (light.type == LightType::point) {
            light.radius = std::clamp(std::max(light.radius, 0.005) * factor, 0.0, 5.0);
        }
    });
}

void dragHandle(Session& session, const Camera& camera, const ImVec2& by) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyShift) return dragDistance(session, dragFactor(session, by));
    if (io.KeyAlt) return dragSize(session, dragFactor(session, by));
    // Sideways in the picture is the azimuth as it is seen: a light behind the head turns the other way.
    Light placed = session.light();
    placeLight(placed, session.headCentre);
    const glm::dvec3 right(camera.world[0]);
    const double az = glm::radians(placed.place->azimuth);
    const double along = glm::dot(right, glm::dvec3(std::cos(az), 0, -std::sin(az)));
    const double degreesPerPixel = 180.0 / std::max(session.view.height, 1);
    const double azimuth = by.x * degreesPerPixel * (along < 0 ? -1 : 1), elevation = -by.y * degreesPerPixel;
    editLight(session, "Direction",
              [&](Light& light) { turnLight(light, azimuth, elevation, session.headCentre); });
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

    const std::vector<Handle> handles =
        session.showHandles ? handlesOf(session, camera) : std::vector<Handle>();
    int hovered = -1;
    for (const Handle& handle : handles)
        if (inside && distance(handle.at, mouse) < 11 * scale) hovered = handle.light;
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
        if (hovered >= 0) session.selectedLight = hovered;
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
    if (moved && drag == Drag::handle && session.hasLight()) dragHandle(session, camera, by);
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

    drawHandles(session, handles, hovered);
    if (wiping) drawWipe(session, wipeX);
}

}  // namespace cutis::app
