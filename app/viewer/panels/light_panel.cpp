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

const char* intensityUnit(LightType type) {
    switch (type) {
        case LightType::directional:
            return "lux";
        case LightType::rect:
            return "W/(m\xc2\xb2 sr)";
        default:
            return "cd";
    }
}

void drawName(Session& session) {
    std::string name = session.light().name;
    if (fieldRow(fields::kLightName, name)) {
        const auto index = static_cast<std::size_t>(session.selectedLight);
        session.edits.apply("Rename light",
                            [&](Document& document) { document.rig.lights[index].name = name; });
    }
    label(fields::kType.label);
    if (!ImGui::BeginCombo("##type", lightTypeName(session.light().type))) return hint(fields::kType.help);
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
            editLight(session, "Intensity", [&](Light& light) { brighten(light, stops); });
    }
}

void drawOutput(Session& session) {
    Light light = session.light();
    if (fieldRow(fields::kIntensity, light.intensity, intensityUnit(light.type)))
        editLight(session, "Intensity", [&](Light& l) { l.intensity = light.intensity; });
    drawStops(session);
    float color[3];
    for (int c = 0; c < 3; ++c) color[c] = encodeSrgb(static_cast<float>(light.color[c]));
    label(fields::kColor.label);
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
    if (light.temperature && fieldRow(fields::kTemperature, *light.temperature))
        editLight(session, "Temperature", [&](Light& l) { l.temperature = std::round(*light.temperature); });
}

void drawShape(Session& session) {
    Light light = session.light();
    const LightType type = light.type;
    if (type == LightType::directional) return;
    heading("Shape and shadow");
    if (type == LightType::rect) {
        bool changed = fieldPartRow(fields::kSize, "Width", light.size.x);
        changed |= fieldPartRow(fields::kSize, "Height", light.size.y);
        if (changed) editLight(session, "Size", [&](Light& l) { l.size = light.size; });
    } else if (fieldRow(fields::kRadius, light.radius)) {
        editLight(session, "Radius", [&](Light& l) { l.radius = light.radius; });
    }
    if (type == LightType::spot) {
        if (fieldRow(fields::kOuterCone, light.outerConeAngle))
            editLight(session, "Cone", [&](Light& l) {
                l.outerConeAngle = std::min(light.outerConeAngle, std::numbers::pi / 2);
                l.innerConeAngle = std::min(l.innerConeAngle, 0.98 * l.outerConeAngle);
            });
        if (fieldRow(fields::kInnerCone, light.innerConeAngle))
            editLight(session, "Cone", [&](Light& l) {
                l.innerConeAngle = std::min(light.innerConeAngle, 0.98 * l.outerConeAngle);
            });
    }
    if (sampleCount(light) > 1 || light.samples > 0)
        if (fieldRow(fields::kSamples, light.samples))
            editLight(session, "Samples", [&](Light& l) { l.samples = light.samples; });
    if (fieldRow(fields::kShadow, light.shadow))
        editLight(session, "Shadow", [&](Light& l) { l.shadow = light.shadow; });
}

void drawSubject(Session& session, const Placement& place) {
    label(fields::kSubject.label);
    if (!ImGui::BeginCombo("##subject", place.subject == "*" ? "everyone" : place.subject.c_str()))
        return hint(fields::kSubject.help);
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
    bool changed = fieldRow(fields::kAzimuth, place.azimuth);
    changed |= fieldRow(fields::kElevation, place.elevation);
    changed |= fieldRow(fields::kDistance, place.distance);
    if (!changed) return;
    const std::string subject = session.light().place->subject;
    place.subject = subject;
    editLight(session, "Placement", [&](Light& l) { l.place = place; });
}

void drawFree(Session& session) {
    Light light = session.light();
    for (const auto& [text, axis] : {std::pair("X", 0), std::pair("Y", 1), std::pair("Z", 2)}) {
        if (light.type == LightType::directional) break;
        if (fieldPartRow(fields::kPosition, text, light.position[axis]))
            editLight(session, "Position", [&](Light& l) { l.position = light.position; });
    }
    if (light.type == LightType::point) return;
    double azimuth = glm::degrees(std::atan2(light.direction.x, light.direction.z));
    double elevation = glm::degrees(std::asin(std::clamp(light.direction.y, -1.0, 1.0)));
    bool changed = fieldPartRow(fields::kAzimuth, "Aim around", azimuth);
    changed |= fieldPartRow(fields::kElevation, "Aim up", elevation);
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
    if (ImGui::RadioButton(fields::kPlace.label, placed) && !placed)
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
