// The chosen light: what it gives, what shape it has, where it stands.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "renderer/core/error.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/tonemap.h"

namespace cutis::app {
namespace {

constexpr double kMaxIntensity = 1e6;

const char* intensityFormat(LightType type) {
    switch (type) {
        case LightType::directional:
            return "%.3g lux";
        case LightType::rect:
            return "%.3g W/(m\xc2\xb2 sr)";
        default:
            return "%.3g cd";
    }
}

void drawName(Session& session) {
    std::string name = session.light().name;
    if (textRow("Name", name)) {
        const auto index = static_cast<std::size_t>(session.selectedLight);
        session.edits.apply("Rename light",
                            [&](Document& document) { document.rig.lights[index].name = name; });
    }
    label("Type");
    if (!ImGui::BeginCombo("##type", lightTypeName(session.light().type))) return;
    for (const LightType type :
         {LightType::rect, LightType::spot, LightType::point, LightType::directional}) {
        if (!ImGui::Selectable(lightTypeName(type), type == session.light().type)) continue;
        const Light& light = session.light();
        const double distance =
            light.place ? light.place->distance : glm::length(light.position - session.headCentre);
        editLight(session, "Type", [&](Light& l) { changeType(l, type, std::max(distance, 0.01)); });
    }
    ImGui::EndCombo();
}

void drawStops(Session& session) {
    label("Stops");
    const std::pair<const char*, double> steps[] = {
        {"-1", -1}, {"-1/3", -1 / 3.0}, {"+1/3", 1 / 3.0}, {"+1", 1}};
    const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
    const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
    for (const auto& [text, stops] : steps) {
        if (text != steps[0].first) ImGui::SameLine(0, gap);
        if (ImGui::Button(text, {width, 0}))
            editLight(session, "Intensity", [&](Light& light) { light.intensity *= std::exp2(stops); });
    }
}

void drawOutput(Session& session) {
    Light light = session.light();
    if (dragRow("Intensity", light.intensity, 0.01f, 0, kMaxIntensity, intensityFormat(light.type), true))
        editLight(session, "Intensity", [&](Light& l) { l.intensity = light.intensity; });
    drawStops(session);
    float color[3];
    for (int c = 0; c < 3; ++c) color[c] = encodeSrgb(static_cast<float>(light.color[c]));
    label("Colour");
    if (ImGui::ColorEdit3(
            "##color", color,
            ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_PickerHueWheel)) {
        editLight(session, "Colour", [&](Light& l) {
            for (int c = 0; c < 3; ++c) l.color[c] = decodeSrgb(color[c]);
        });
    }
    ImGui::SameLine();
    bool kelvin = light.temperature.has_value();
    if (ImGui::Checkbox("Kelvin", &kelvin))
        editLight(session, "Temperature",
                  [&](Light& l) { l.temperature = kelvin ? std::optional<double>(5600) : std::nullopt; });
    if (light.temperature && sliderRow("Temperature", *light.temperature, 1500, 15000, "%.0f K", true))
        editLight(session, "Temperature", [&](Light& l) { l.temperature = std::round(*light.temperature); });
}

void drawShape(Session& session) {
    Light light = session.light();
    constexpr double kDegree = std::numbers::pi / 180;
    const LightType type = light.type;
    if (type == LightType::directional) return;
    heading("Shape and shadow");
    if (type == LightType::rect) {
        bool changed = dragRow("Width", light.size.x, 0.005f, 0.01, 20, "%.2f m");
        changed |= dragRow("Height", light.size.y, 0.005f, 0.01, 20, "%.2f m");
        if (changed) editLight(session, "Size", [&](Light& l) { l.size = light.size; });
    } else if (dragRow("Radius", light.radius, 0.002f, 0, 5, "%.3f m")) {
        editLight(session, "Radius", [&](Light& l) { l.radius = light.radius; });
    }
    if (type == LightType::spot) {
        double inner = light.innerConeAngle / kDegree, outer = light.outerConeAngle / kDegree;
        if (sliderRow("Cone", outer, 0.5, 90, "%.1f\xc2\xb0 to dark"))
            editLight(session, "Cone", [&](Light& l) {
                l.outerConeAngle = std::min(outer * kDegree, std::numbers::pi / 2);
                l.innerConeAngle = std::min(l.innerConeAngle, 0.98 * l.outerConeAngle);
            });
        if (sliderRow("Hot spot", inner, 0, 89, "%.1f\xc2\xb0"))
            editLight(session, "Cone", [&](Light& l) {
                l.innerConeAngle = std::min(inner * kDegree, 0.98 * l.outerConeAngle);
            });
    }
    if (sampleCount(light) > 1 || light.samples > 0)
        if (intRow("Samples", light.samples, 0, 64, light.samples ? "%d" : "automatic"))
            editLight(session, "Samples", [&](Light& l) { l.samples = light.samples; });
    if (checkRow("Shadow", light.shadow))
        editLight(session, "Shadow", [&](Light& l) { l.shadow = light.shadow; });
}

void drawSubject(Session& session, const Placement& place) {
    label("Subject");
    if (!ImGui::BeginCombo("##subject", place.subject == "*" ? "everyone" : place.subject.c_str())) return;
    if (ImGui::Selectable("everyone", place.subject == "*"))
        editLight(session, "Subject", [](Light& l) { l.place->subject.assign(1, '*'); });
    for (const Character& character : session.geometry->characters)
        if (ImGui::Selectable(character.name.c_str(), place.subject == character.name))
            editLight(session, "Subject", [&](Light& l) { l.place->subject = character.name; });
    ImGui::EndCombo();
}

void drawRoundSubject(Session& session) {
    Placement place = *session.light().place;
    drawSubject(session, place);
    bool changed = sliderRow("Azimuth", place.azimuth, -180, 180, "%.1f\xc2\xb0");
    hint("0 is in front, positive towards the subject's left");
    changed |= sliderRow("Elevation", place.elevation, -90, 90, "%.1f\xc2\xb0");
    changed |= dragRow("Distance", place.distance, 0.005f, 0.05, 100, "%.2f m", true);
    if (!changed) return;
    const std::string subject = session.light().place->subject;
    place.subject = subject;
    editLight(session, "Placement", [&](Light& l) { l.place = place; });
}

void drawFree(Session& session) {
    Light light = session.light();
    for (const auto& [text, axis] : {std::pair("X", 0), std::pair("Y", 1), std::pair("Z", 2)}) {
        if (light.type == LightType::directional) break;
        if (dragRow(text, light.position[axis], 0.005f, -1e4, 1e4, "%.3f m"))
            editLight(session, "Position", [&](Light& l) { l.position = light.position; });
    }
    if (light.type == LightType::point) return;
    double azimuth = glm::degrees(std::atan2(light.direction.x, light.direction.z));
    double elevation = glm::degrees(std::asin(std::clamp(light.direction.y, -1.0, 1.0)));
    bool changed = sliderRow("Aim around", azimuth, -180, 180, "%.1f\xc2\xb0");
    changed |= sliderRow("Aim up", elevation, -90, 90, "%.1f\xc2\xb0");
    if (changed) {
        const double az = glm::radians(azimuth), el = glm::radians(elevation);
        editLight(session, "Aim", [&](Light& l) {
            l.direction = {std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)};
        });
    }
    if (light.type != LightType::directional && ImGui::Button("Aim at the head", {-1, 0}))
        editLight(session, "Aim", [&](Light& l) {
            const glm::dvec3 to = session.headCentre - l.position;
            if (glm::length(to) > 1e-6) l.direction = glm::normalize(to);
        });
}

void drawPlacement(Session& session) {
    heading("Placement");
    const bool placed = session.light().place.has_value();
    if (ImGui::RadioButton("Round the subject", placed) && !placed)
        editLight(session, "Placement", [&](Light& l) { placeLight(l, session.headCentre); });
    ImGui::SameLine();
    if (ImGui::RadioButton("Free", !placed) && placed) {
        try {
            Rig resolved;
            resolved.lights = {session.light()};
            resolvePlacements(resolved, *session.geometry);
            editLight(session, "Placement", [&](Light& l) {
                l = resolved.lights[0];
                l.place.reset();
            });
        } catch (const Error& error) {  // its subject is not in this scene
            session.complain(error.what());
        }
    }
    session.light().place ? drawRoundSubject(session) : drawFree(session);
}

}  // namespace

void drawLightPanel(Session& session) {
    if (!session.hasLight()) {
        ImGui::TextDisabled("No light is chosen");
        return;
    }
    ImGui::PushID(session.selectedLight);
    heading("Light");
    drawName(session);
    drawOutput(session);
    drawShape(session);
    drawPlacement(session);
    ImGui::PopID();
}

}  // namespace cutis::app
