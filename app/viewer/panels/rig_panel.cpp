// The lights of the rig: solo, mute, colour, name, and how bright each is beside the brightest.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/style.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/tonemap.h"

namespace cutis::app {
namespace {

ImVec4 shownColor(const Light& light) {
    glm::dvec3 color =
        light.color * (light.temperature ? colorFromTemperature(*light.temperature) : glm::dvec3(1));
    color /= std::max({color.x, color.y, color.z, 1e-6});
    return {encodeSrgb(float(color.x)), encodeSrgb(float(color.y)), encodeSrgb(float(color.z)), 1};
}

// Colour as on a screen; what is changed keeps the light's temperature.
void drawColor(Session& session, std::size_t index, const Light& light) {
    const float size = ImGui::GetTextLineHeight();
    constexpr ImGuiColorEditFlags kPlain =
        ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop | ImGuiColorEditFlags_NoBorder;
    if (ImGui::ColorButton("##color", shownColor(light), kPlain, {size, size})) ImGui::OpenPopup("color");
    hint("Colour");
    if (!ImGui::BeginPopup("color")) return;
    float color[3];
    for (int c = 0; c < 3; ++c) color[c] = encodeSrgb(static_cast<float>(light.color[c]));
    if (ImGui::ColorPicker3("##picker", color,
                            ImGuiColorEditFlags_PickerHueWheel | ImGuiColorEditFlags_NoSidePreview))
        session.edits.apply("Colour of " + light.name, [&](Document& document) {
            for (int c = 0; c < 3; ++c) document.rig.lights[index].color[c] = decodeSrgb(color[c]);
        });
    ImGui::EndPopup();
}

// Stops below the brightest light at the head; dragging makes the light brighter or darker.
void drawStops(Session& session, std::size_t index, const Light& light) {
    if (index >= session.headIrradiance.size()) return;
    const double brightest = *std::max_element(session.headIrradiance.begin(), session.headIrradiance.end());
    const double own = session.headIrradiance[index];
    const bool known = own > 0 && brightest > 0;
    float stops = known ? static_cast<float>(std::log2(own / brightest)) : 0.0f;
    if (std::abs(stops) < 0.005f) stops = 0;
    const float before = stops;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::DragFloat("##stops", &stops, 0.02f, -20, 20,
                         known                 ? "%+.2f"
                         : light.intensity > 0 ? "aside"
                                               : "dark",
                         ImGuiSliderFlags_NoInput) &&
        stops != before)
        session.edits.apply("Intensity of " + light.name, [&](Document& document) {
            brighten(document.rig.lights[index], double(stops) - before);
        });
    hint(known                 ? "Stops below the brightest light, at the head. Drag: brighter or darker"
         : light.intensity > 0 ? "Shines past the head. Drag: brighter or darker"
                               : "Gives no light: its intensity is 0");
}

void drawRow(Session& session, int index) {
    const auto i = static_cast<std::size_t>(index);
    const Light light = session.document().rig.lights[i];  // a copy: the row may change the document
    const bool solo = session.document().solo[i], on = light.enabled;
    const std::string name = light.name;
    ImGui::PushID(index);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (toggleButton("S", solo, accentColor()))
        session.edits.apply("Solo " + name, [&](Document& d) { d.solo[i] = !solo; });
    hint("Solo: only lights marked S shine");
    ImGui::TableNextColumn();
    if (toggleButton("M", !on, IM_COL32(150, 150, 155, 255)))
        session.edits.apply("Mute " + name, [&](Document& d) { d.rig.lights[i].enabled = !on; });
    hint("Mute: this light is off");
    ImGui::TableNextColumn();
    drawColor(session, i, light);
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (!on) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    const std::string shown = (name.empty() ? "(no name)" : name) + "##name";
    if (ImGui::Selectable(shown.c_str(), index == session.selectedLight)) session.selectedLight = index;
    if (!on) ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    drawStops(session, i, light);
    ImGui::PopID();
}

void drawAddMenu(Session& session) {
    if (!ImGui::BeginPopup("add")) return;
    for (const LightType type :
         {LightType::rect, LightType::spot, LightType::point, LightType::directional}) {
        if (!ImGui::MenuItem(lightTypeName(type))) continue;
        int added = -1;
        session.edits.apply(std::string("Add ") + lightTypeName(type),
                            [&](Document& document) { added = addLight(document, type); });
        session.selectedLight = added;
    }
    ImGui::EndPopup();
}

void drawButtons(Session& session) {
    const bool chosen = session.hasLight();
    const int count = static_cast<int>(session.document().rig.lights.size());
    const int selected = session.selectedLight;
    if (ImGui::Button("Add")) ImGui::OpenPopup("add");
    drawAddMenu(session);
    ImGui::SameLine();
    ImGui::BeginDisabled(!chosen);
    if (ImGui::Button("Copy")) {
        session.edits.apply("Duplicate " + session.light().name, [&](Document& document) {
            session.selectedLight = duplicateLight(document, selected);
        });
    }
    ImGui::SameLine();
    if (ImGui::Button("Delete")) {
        session.edits.apply("Delete " + session.light().name,
                            [&](Document& document) { deleteLight(document, selected); });
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!chosen || selected == 0);
    if (ImGui::ArrowButton("up", ImGuiDir_Up)) {
        session.edits.apply("Reorder",
                            [&](Document& document) { moveLight(document, selected, selected - 1); });
        session.selectedLight = selected - 1;
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!chosen || selected + 1 >= count);
    if (ImGui::ArrowButton("down", ImGuiDir_Down)) {
        session.edits.apply("Reorder",
                            [&](Document& document) { moveLight(document, selected, selected + 1); });
        session.selectedLight = selected + 1;
    }
    ImGui::EndDisabled();
}

}  // namespace

void drawRigPanel(Session& session) {
    const Document& document = session.document();
    const std::string name = document.rig.name.empty() ? "Lights" : document.rig.name;
    heading(name);
    const float rows = static_cast<float>(std::clamp<std::size_t>(document.rig.lights.size(), 4, 8));
    const float scale = static_cast<float>(session.uiScale);
    // Rows as high as a line of text, their fields too.
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {5 * scale, 1 * scale});
    const float height = rows * (ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().CellPadding.y) + 2 * scale;
    if (ImGui::BeginTable("lights", 5, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) {
        const float letter = ImGui::CalcTextSize("M").x + 2 * ImGui::GetStyle().FramePadding.x;
        ImGui::TableSetupColumn("solo", ImGuiTableColumnFlags_WidthFixed, letter);
        ImGui::TableSetupColumn("mute", ImGuiTableColumnFlags_WidthFixed, letter);
        ImGui::TableSetupColumn("color", ImGuiTableColumnFlags_WidthFixed, ImGui::GetTextLineHeight());
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("stops", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize(" -10.00 ").x);
        for (int i = 0; i < static_cast<int>(session.document().rig.lights.size()); ++i) drawRow(session, i);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    drawButtons(session);
}

}  // namespace cutis::app
