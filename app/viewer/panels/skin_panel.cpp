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

// One Gaussian: its variance, and its weight of each channel.
bool drawGaussian(skin::Profile& profile, std::size_t index, bool& removed) {
    skin::Gaussian& gaussian = profile.gaussians[index];
    ImGui::PushID(static_cast<int>(index));
    ImGui::TableNextRow();
    bool changed = false;
    double* const values[] = {&gaussian.variance, &gaussian.weight.x, &gaussian.weight.y, &gaussian.weight.z};
    for (int i = 0; i < 4; ++i) {
        ImGui::TableNextColumn();
        ImGui::SetNextItemWidth(-1);
        ImGui::PushID(i);
        changed |= fieldCell(i == 0 ? fields::kVariance : fields::kWeight, *values[i]);
        ImGui::PopID();
    }
    ImGui::TableNextColumn();
    ImGui::BeginDisabled(profile.gaussians.size() == 1);
    removed = ImGui::SmallButton("x");
    ImGui::EndDisabled();
    hint("Removes this Gaussian");
    ImGui::PopID();
    return changed;
}

void drawTotals(const skin::Profile& profile) {
    const glm::dvec3 total = skin::totalWeight(profile);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("sum");
    for (int c = 0; c < 3; ++c) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%.3f", total[c]);
    }
    hint("What skin gives back of the light that enters it: 1 is all");
}

void drawProfile(Session& session, std::size_t index, const std::string& name) {
    const skin::Profile before = session.document().skin[index]->profile;
    skin::Profile profile = before;
    std::string edit = "Profile of " + name;
    heading(fields::kProfile.label, fields::kProfile.help);
    if (ImGui::BeginTable("profile", 5)) {
        ImGui::TableSetupColumn(fields::kVariance.unit);
        for (const char* channel : {"red", "green", "blue"}) ImGui::TableSetupColumn(channel);
        const float cross = ImGui::CalcTextSize("x").x + 2 * ImGui::GetStyle().FramePadding.x;
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, cross);
        ImGui::TableHeadersRow();
        std::size_t remove = profile.gaussians.size();
        for (std::size_t i = 0; i < profile.gaussians.size(); ++i) {
            bool removed = false;
            drawGaussian(profile, i, removed);
            if (removed) remove = i;
        }
        if (remove < profile.gaussians.size()) removeGaussian(profile, remove), edit = "Remove a Gaussian";
        drawTotals(profile);
        ImGui::EndTable();
    }
    const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (ImGui::Button("Add", {width, 0})) addGaussian(profile), edit = "Add a Gaussian";
    hint("A Gaussian three times as wide, without weight");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Normalise", {width, 0})) profile = normalized(profile), edit = "Normalise the profile";
    hint("Sorts by variance and scales weights so that each channel sums to 1");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Three-layer", {width, 0}))
        profile = skin::threeLayerProfile(), edit = "Three-layer skin";
    hint("The six Gaussians of three-layer skin, GPU Gems 3, ch. 14");
    if (profile != before)
        session.edits.apply(edit, [&](Document& document) { setProfile(document, index, profile); });
}

void drawParameters(Session& session, std::size_t index) {
    SkinMaterial skin = *session.document().skin[index];
    bool changed = fieldRow(fields::kScale, skin.scale);
    changed |= fieldRow(fields::kMix, skin.mix);
    changed |= fieldRow(fields::kRoughness, skin.roughness);
    changed |= fieldRow(fields::kSpecular, skin.specular);
    changed |= fieldRow(fields::kLobeWeight, skin.lobeWeight);
    changed |= fieldRow(fields::kLobeRatio, skin.lobeRatio);
    changed |= fieldRow(fields::kDetail, skin.detail);
    changed |= fieldRow(fields::kDetailScale, skin.detailScale);
    changed |= fieldRow(fields::kTranslucency, skin.translucency);
    changed |= fieldRow(fields::kMmPerUnit, skin.mmPerUnit);
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
    drawProfile(session, index, name);
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
    heading(session.geometry->materials[index].name);
    if (skin[index]) {
        ImGui::PushID(session.selectedMaterial);
        drawParameters(session, index);
        ImGui::PopID();
    } else {
        ImGui::TextDisabled("Not skin");
    }
}

}  // namespace cutis::app
