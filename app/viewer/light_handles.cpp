#include "app/viewer/light_handles.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "app/viewer/style.h"
#include "renderer/scene/characters.h"

namespace cutis::app {
namespace {

using Part = LightHandle::Part;

glm::dvec3 towards(const Placement& place) {
    const double az = glm::radians(place.azimuth), el = glm::radians(place.elevation);
    return {std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)};
}

// Where the light stands and the point that it aims at: its subject, or the surface that its axis meets, or
// what of the axis is next to the head.
struct Beam {
    glm::dvec3 position, aim;
};

Beam beamOf(const Session& session, const Light& light) {
    if (light.place) {
        const std::string& subject = light.place->subject;
        const glm::dvec3 centre =
            subject == "*" ? session.headCentre : headBounds(*session.geometry, subject).centre();
        return {centre + light.place->distance * towards(*light.place), centre};
    }
    if (const std::optional<Hit> hit = pick(*session.geometry, {light.position, light.direction}))
        return {light.position, hit->position};
    const glm::dvec3 toHead = session.headCentre - light.position;
    const double along = glm::dot(toHead, light.direction);
    return {light.position, light.position + (along > 0.01 ? along : glm::length(toHead)) * light.direction};
}

// Points of the cone's edge about the aim, in pixels; empty where the camera stands within it.
std::vector<ImVec2> coneRing(const Session& session, const Camera& camera, const Light& light,
                             const Beam& beam) {
    constexpr int kPoints = 64;
    const glm::dvec3 axis = beam.aim - beam.position, away = glm::normalize(axis);
    const glm::dvec3 side =
        glm::normalize(glm::cross(away, std::abs(away.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(side, away);
    const double radius = glm::length(axis) * std::tan(std::min(light.outerConeAngle, glm::radians(80.0)));
    std::vector<ImVec2> ring;
    for (int i = 0; i < kPoints; ++i) {
        const double angle = glm::two_pi<double>() * i / kPoints;
        const glm::dvec3 seen = project(camera, session.aspect(),
                                        beam.aim + radius * (std::cos(angle) * side + std::sin(angle) * up));
        if (seen.z <= 0) return {};
        ring.push_back(onScreen(session, seen));
    }
    return ring;
}

// Of the chosen light, where it has a direction.
void addBeam(const Session& session, const Camera& camera, std::vector<LightHandle>& handles) {
    if (!session.hasLight()) return;
    const Light& light = session.light();
    if (light.type != LightType::spot && light.type != LightType::rect) return;
    const Beam beam = beamOf(session, light);
    const glm::dvec3 seen = project(camera, session.aspect(), beam.aim);
    if (seen.z <= 0 || !(glm::length(beam.aim - beam.position) > 1e-6)) return;
    const ImVec2 aim = onScreen(session, seen);
    const float pixel = static_cast<float>(session.uiScale);
    if (light.type == LightType::spot) {
        // The point farthest to the right of those in the view.
        std::vector<ImVec2> ring = coneRing(session, camera, light, beam);
        std::erase_if(ring, [&](const ImVec2& p) { return !session.view.contains(p.x, p.y); });
        const auto rightmost = std::max_element(ring.begin(), ring.end(),
                                                [](const ImVec2& a, const ImVec2& b) { return a.x < b.x; });
        // Where a cone is seen as a point, there is nothing to take hold of.
        if (!ring.empty() && distanceOf(*rightmost, aim) > 20 * pixel)
            handles.push_back({session.selectedLight, Part::cone, *rightmost, aim, false});
    }
    handles.push_back({session.selectedLight, Part::aim, aim, aim, false});
}

// Dark all round: what lies behind may be as light as the text.
void outlinedText(ImDrawList& draw, const ImVec2& at, ImU32 color, const char* text) {
    for (const auto& [x, y] : {std::pair(1, 1), std::pair(-1, 1), std::pair(1, -1), std::pair(-1, -1)})
        draw.AddText({at.x + float(x), at.y + float(y)}, IM_COL32(0, 0, 0, 130), text);
    draw.AddText(at, color, text);
}

// Each light's dot with its name.
void drawDots(const Session& session, const std::vector<LightHandle>& handles, int hovered) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(session.uiScale);
    const Rig shining = effectiveRig(session.document());
    std::vector<ImVec4> taken;  // left, top, right, bottom of the handles, and of labels that are drawn
    for (const LightHandle& handle : handles) {
        const float radius = 8 * scale;
        taken.emplace_back(handle.at.x - radius, handle.at.y - radius, handle.at.x + radius,
                           handle.at.y + radius);
    }
    for (const LightHandle& handle : handles) {
        if (handle.part != LightHandle::Part::light) continue;
        const auto index = static_cast<std::size_t>(handle.light);
        const bool chosen = handle.light == session.selectedLight;
        const bool on = shining.lights[index].enabled;
        const float alpha = on ? (handle.behind ? 0.6f : 1.0f) : 0.35f;
        const ImU32 color = chosen ? accentColor(alpha) : IM_COL32(235, 235, 235, int(200 * alpha));
        if (chosen) draw.AddLine(handle.centre, handle.at, accentColor(0.35f), scale);
        const float radius = (chosen || &handle - handles.data() == hovered ? 8.f : 6.f) * scale;
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
        outlinedText(draw, text, color, name.c_str());
    }
}

// A cross where the chosen light aims, a ring about it for its cone.
void drawBeam(const Session& session, const Camera& camera, const std::vector<LightHandle>& handles,
              int hovered) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(session.uiScale);
    for (const LightHandle& handle : handles) {
        if (handle.part == Part::light) continue;
        const bool active = &handle - handles.data() == hovered;
        const ImU32 color = accentColor(active ? 1.0f : 0.7f);
        const ImVec2 at = handle.at;
        const float size = (active ? 7.f : 5.f) * scale;
        if (handle.part == Part::aim) {
            // Twice, first wider and dark: skin is as light as the cross.
            for (const bool under : {true, false}) {
                const ImU32 ink = under ? IM_COL32(0, 0, 0, 130) : color;
                const float width = (under ? 3.5f : 1.5f) * scale;
                draw.AddCircle(at, size, ink, 0, width);
                for (const auto& [x, y] :
                     {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
                    draw.AddLine({at.x + float(x) * size, at.y + float(y) * size},
                                 {at.x + 2 * float(x) * size, at.y + 2 * float(y) * size}, ink, width);
            }
        } else {
            const Light& light = session.light();
            const std::vector<ImVec2> ring = coneRing(session, camera, light, beamOf(session, light));
            draw.AddPolyline(ring.data(), static_cast<int>(ring.size()), accentColor(0.35f),
                             ImDrawFlags_Closed, scale);
            const float edge = size + scale;
            draw.AddRectFilled({at.x - edge, at.y - edge}, {at.x + edge, at.y + edge},
                               IM_COL32(0, 0, 0, 130));
            draw.AddRectFilled({at.x - size, at.y - size}, {at.x + size, at.y + size}, color);
        }
        if (active)
            outlinedText(draw, {at.x + 2 * size, at.y + size}, color,
                         handle.part == Part::aim ? "aim" : "cone");
    }
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

// Sideways in the picture is the azimuth as it is seen: a light behind the head turns the other way.
void dragDirection(Session& session, const Camera& camera, const ImVec2& by) {
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

// At the surface under the mouse, or beside it as far away as what it aims at now.
void dragAim(Session& session, const Camera& camera, const LightHandle& handle, const ImVec2& by) {
    const Beam beam = beamOf(session, session.light());
    const ImVec2 mouse(handle.at.x + by.x, handle.at.y + by.y);
    glm::dvec3 aim(0);
    if (const std::optional<Hit> hit = pickAt(session, camera, mouse)) {
        aim = hit->position;
    } else {
        const Ray ray = rayAt(session, camera, mouse);
        const glm::dvec3 back(camera.world[2]);
        const double slope = glm::dot(ray.direction, back);
        if (std::abs(slope) < 1e-6) return;
        aim = ray.origin + glm::dot(beam.aim - ray.origin, back) / slope * ray.direction;
    }
    editLight(session, "Aim", [&](Light& light) { aimAt(light, beam.position, aim); });
}

// As far from the aim as the mouse is: the tangent of the angle grows with it.
void dragCone(Session& session, const LightHandle& handle, const ImVec2& by) {
    const float before = distanceOf(handle.at, handle.centre);
    const float after = distanceOf({handle.at.x + by.x, handle.at.y + by.y}, handle.centre);
    const double outer = session.light().outerConeAngle;
    const double wanted = std::atan(std::tan(outer) * after / std::max(before, 1.0f));
    if (outer > 0) dragSize(session, wanted / outer);
}

}  // namespace

ImVec2 onScreen(const Session& session, const glm::dvec3& point) {
    return {static_cast<float>(session.view.x + point.x * session.view.width),
            static_cast<float>(session.view.y + point.y * session.view.height)};
}

float distanceOf(const ImVec2& a, const ImVec2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

Ray rayAt(const Session& session, const Camera& camera, const ImVec2& mouse) {
    const double x = (mouse.x - session.view.x) / session.view.width;
    const double y = (mouse.y - session.view.y) / session.view.height;
    return rayThrough(camera, session.aspect(), x, y);
}

std::optional<Hit> pickAt(const Session& session, const Camera& camera, const ImVec2& mouse) {
    return pick(*session.geometry, rayAt(session, camera, mouse));
}

std::vector<LightHandle> lightHandles(const Session& session, const Camera& camera) {
    std::vector<LightHandle> handles;
    const glm::dvec3 eye(camera.world[3]), back(camera.world[2]);
    const double depth = glm::dot(eye - session.headCentre, back);
    if (depth <= 0) return handles;
    const double halfHeight = camera.orthographic ? camera.ymag : depth * std::tan(camera.yfov / 2);
    const double radius = 0.8 * halfHeight * std::min(1.0, session.aspect());
    const ImVec2 centre = onScreen(session, project(camera, session.aspect(), session.headCentre));
    addBeam(session, camera, handles);
    const auto& lights = session.document().rig.lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light placed = lights[i];
        placeLight(placed, session.headCentre);
        const glm::dvec3 direction = towards(*placed.place);
        // Drawn as if from afar, so that a handle in front of the head does not run into the camera.
        const glm::dmat3 axes(camera.world);
        const float pixels = static_cast<float>(0.5 * session.view.height * radius / halfHeight);
        const ImVec2 at(centre.x + pixels * static_cast<float>(glm::dot(axes[0], direction)),
                        centre.y - pixels * static_cast<float>(glm::dot(axes[1], direction)));
        handles.push_back({static_cast<int>(i), Part::light, at, centre, glm::dot(axes[2], direction) < 0});
    }
    return handles;
}

void drawLightHandles(const Session& session, const Camera& camera, const std::vector<LightHandle>& handles,
                      int hovered) {
    // Panels have no background of their own: what lies beside the picture must not show through them.
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const PixelRect& room = session.room;
    draw.PushClipRect({float(room.x), float(room.y)},
                      {float(room.x + room.width), float(room.y + room.height)});
    drawBeam(session, camera, handles, hovered);
    drawDots(session, handles, hovered);
    draw.PopClipRect();
}

void dragLightHandle(Session& session, const Camera& camera, const LightHandle& handle, const ImVec2& by) {
    if (!session.hasLight()) return;
    if (handle.part == Part::aim) return dragAim(session, camera, handle, by);
    if (handle.part == Part::cone) return dragCone(session, handle, by);
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyShift) return dragDistance(session, dragFactor(session, by));
    if (io.KeyAlt) return dragSize(session, dragFactor(session, by));
    dragDirection(session, camera, by);
}

}  // namespace cutis::app
