// Which materials are skin, and how each scatters.
#include <imgui.h>

#include <algorithm>

#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace {

void drawMaterials(Session& session) {
    const auto& materials = session.geometry->materials;
    const auto& skin = session.document().skin;
    const float row = ImGui::GetFrameHeightWithSpacing();
    const float rows = static_cast<float>(std::clamp<std::size_t>(materials.size(), 3, 8));
    ImGui::BeginChild("materials", {0, rows * row}, true);
    for (std::size_t i = 0; i < materials.size() && i < skin.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        bool isSkin = skin[i].has_value();
        if (ImGui::Checkbox("##skin", &isSkin)) {
            session.edits.apply("Skin of " + materials[i].name, [&](Document& document) {
                const bool knows = i < session.loadedSkin.size() && session.loadedSkin[i].has_value();
                document.skin[i] =
                    !isSkin ? std::nullopt : std::optional(knows ? *session.loadedSkin[i] : SkinMaterial{});
            });
        }
        hint("This material is skin");
        ImGui::SameLine();
        const std::string name = (materials[i].name.empty() ? "(no name)" : materials[i].name) + "##name";
        if (ImGui::Selectable(name.c_str(), session.selectedMaterial == static_cast<int>(i)))
            session.selectedMaterial = static_cast<int>(i);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void drawParameters(Session& session, std::size_t index) {
    SkinMaterial skin = *session.document().skin[index];
    bool changed = dragRow("Scale", skin.scale, 0.005f, 0.01, 100, "%.3g", true);
    hint("Multiplies how far light travels in the skin");
    changed |= sliderRow("Mix", skin.mix, 0, 1, "%.2f");
    hint("0: albedo colours the light after scattering, 1: before");
    changed |= sliderRow("Roughness", skin.roughness, 0.02, 1, "%.2f");
    changed |= sliderRow("Specular", skin.specular, 0, 3, "%.2f");
    changed |= checkRow("Translucent", skin.translucency);
    hint("Light from behind shines through");
    changed |= dragRow("mm per unit", skin.mmPerUnit, 1, 0.001, 1e6, "%.4g", true);
    ImGui::TextDisabled("Profile of %zu Gaussians", skin.profile.gaussians.size());
    const std::string& name = session.geometry->materials[index].name;
    if (changed)
        session.edits.apply("Skin of " + name, [&](Document& document) { document.skin[index] = skin; });
    if (ImGui::Button("The same for all skin", {-1, 0})) {
        session.edits.apply("Skin of all", [&](Document& document) {
            for (auto& other : document.skin) {
                if (!other) continue;
                const double mmPerUnit = other->mmPerUnit;
                other = skin;
                other->mmPerUnit = mmPerUnit;
            }
        });
    }
}

}  // namespace

void drawSkinPanel(Session& session) {
    heading("Materials");
    drawMaterials(session);
    const auto& skin = session.document().skin;
    if (session.selectedMaterial < 0) {
        for (std::size_t i = 0; i < skin.size() && session.selectedMaterial < 0; ++i)
            if (skin[i]) session.selectedMaterial = static_cast<int>(i);
    }
    const auto index = static_cast<std::size_t>(session.selectedMaterial);
    if (session.selectedMaterial < 0 || index >= skin.size() || index >= session.geometry->materials.size())
        return;
    heading(session.geometry->materials[index].name.c_str());
    if (skin[index]) {
        ImGui::PushID(session.selectedMaterial);
        drawParameters(session, index);
        ImGui::PopID();
    } else {
        ImGui::TextDisabled("Not skin");
    }
}

}  // namespace cutis::app
