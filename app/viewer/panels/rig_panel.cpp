// The lights of the rig as a mixer: solo, mute, name, and how bright each is beside the brightest.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/viewer/actions.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/style.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/presets.h"
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

// "-1.3" stops below the brightest light at the head.
std::string stopsText(const Session& session, std::size_t index) {
    if (index >= session.headIrradiance.size()) return "";
    const double brightest = *std::max_element(session.headIrradiance.begin(), session.headIrradiance.end());
    const double own = session.headIrradiance[index];
    if (!(own > 0) || !(brightest > 0)) return "dark";
    char text[16];
    std::snprintf(text, sizeof text, "%+.1f", std::min(0.0, std::log2(own / brightest)) + 0.0);
    return std::string(text) == "-0.0" ? "+0.0" : text;
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
    const float size = ImGui::GetTextLineHeight();
    ImGui::ColorButton(
        "##color", shownColor(light),
        ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop | ImGuiColorEditFlags_NoBorder,
        {size, size});
    ImGui::TableNextColumn();
    if (!on) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    const std::string shown = (name.empty() ? "(no name)" : name) + "##name";
    if (ImGui::Selectable(shown.c_str(), index == session.selectedLight)) session.selectedLight = index;
    if (!on) ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", stopsText(session, i).c_str());
    hint("Stops below the brightest light, at the head");
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

void drawPresetMenu(Session& session) {
    if (!ImGui::BeginPopup("presets")) return;
    for (const Preset& preset : presets()) {
        if (ImGui::MenuItem(preset.name.c_str())) openPreset(session, preset.name);
        hint(preset.summary.c_str());
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
    ImGui::SameLine();
    if (ImGui::Button("Presets")) ImGui::OpenPopup("presets");
    drawPresetMenu(session);
}

}  // namespace

void drawRigPanel(Session& session) {
    const Document& document = session.document();
    const std::string name = document.rig.name.empty() ? "Lights" : document.rig.name;
    heading(name.c_str());
    const float rows = static_cast<float>(std::clamp<std::size_t>(document.rig.lights.size(), 4, 8));
    const float height = rows * (ImGui::GetTextLineHeightWithSpacing() + 2) + 6;
    if (ImGui::BeginTable("lights", 5, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) {
        const float letter = ImGui::CalcTextSize("M").x + 2 * ImGui::GetStyle().FramePadding.x;
        ImGui::TableSetupColumn("solo", ImGuiTableColumnFlags_WidthFixed, letter);
        ImGui::TableSetupColumn("mute", ImGuiTableColumnFlags_WidthFixed, letter);
        ImGui::TableSetupColumn("color", ImGuiTableColumnFlags_WidthFixed, ImGui::GetTextLineHeight());
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("stops", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("-10.0 ").x);
        for (int i = 0; i < static_cast<int>(session.document().rig.lights.size()); ++i) drawRow(session, i);
        ImGui::EndTable();
    }
    drawButtons(session);
}

}  // namespace cutis::app
