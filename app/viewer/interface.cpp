#include "app/viewer/interface.h"

#include <imgui.h>

#include <filesystem>

#include "app/viewer/legend.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/view_input.h"
#include "app/viewer/view_layout.h"

namespace cutis::app {
namespace {

std::string shortName(const std::string& scene) {
    return std::filesystem::path(scene).filename().string();
}

// `tight`: little about the names of tabs, so that all seven find room in one row.
void pushTabStyle(bool tight) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 padding = style.FramePadding, gap = style.ItemInnerSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {tight ? 0.2f * padding.x : padding.x, padding.y});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {tight ? 0.5f * gap.x : gap.x, gap.y});
}
void popTabStyle() {
    ImGui::PopStyleVar(2);
}

template <class Draw>
void drawSide(const char* name, float x, const Layout& layout, const Draw& draw) {
    ImGui::SetNextWindowPos({x, layout.top});
    ImGui::SetNextWindowSize({layout.side, ImGui::GetIO().DisplaySize.y - layout.top - layout.bottom});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoBackground);
    pushTabStyle(!layout.both);
    const bool shown =
        ImGui::BeginTabBar(name, ImGuiTabBarFlags_FittingPolicyScroll | ImGuiTabBarFlags_NoTooltip);
    popTabStyle();
    if (shown) {
        draw();
        ImGui::EndTabBar();
    }
    ImGui::End();
}

template <class Draw>
void drawTab(const char* name, bool tight, const Draw& draw) {
    pushTabStyle(tight);
    const bool shown = ImGui::BeginTabItem(name);
    popTabStyle();
    if (!shown) return;
    ImGui::BeginChild(name);
    draw();
    ImGui::EndChild();
    ImGui::EndTabItem();
}

void drawRigTabs(Session& session, bool tight) {
    drawTab("Rig", tight, [&] {
        drawRigPanel(session);
        drawLightPanel(session);
    });
    drawTab("Presets", tight, [&] { drawPresetPanel(session); });
}

void drawLookTabs(Session& session, EnvironmentThumbnails& environments, bool tight) {
    drawTab("View", tight, [&] { drawCameraPanel(session); });
    drawTab("HDRI", tight, [&] {
        environments.start();
        drawEnvironmentPanel(session);
    });
    drawTab("Skin", tight, [&] { drawSkinPanel(session); });
    drawTab("Compare", tight, [&] { drawComparePanel(session); });
    drawTab("Plan", tight, [&] { drawPlanPanel(session); });
}

void drawSides(Session& session, const Layout& layout, EnvironmentThumbnails& environments) {
    if (layout.side <= 0) return;
    drawSide("##rig", 0, layout, [&] {
        drawRigTabs(session, !layout.both);
        if (!layout.both) drawLookTabs(session, environments, true);
    });
    if (layout.both)
        drawSide("##look", ImGui::GetIO().DisplaySize.x - layout.side, layout,
                 [&] { drawLookTabs(session, environments, false); });
}

void drawLoading(const Session& session) {
    if (session.loading.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float scale = static_cast<float>(session.uiScale);
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({320 * scale, 0});
    ImGui::Begin("##loading", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
    ImGui::Text("Loading %s", shortName(session.loading).c_str());
    // Nobody knows how long a scene takes: the bar nears its end and never gets there.
    const double seconds = session.loadingSeconds;
    ImGui::ProgressBar(static_cast<float>(seconds / (seconds + 2)), {-1, 6 * scale}, "");
    ImGui::End();
}

}  // namespace

std::string titleOf(const std::string& scene) {
    return "cutis - " + shortName(scene);
}

std::vector<PicturePart> drawInterface(Session& session, EnvironmentThumbnails& environments) {
    session.thumbnails.clear();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float top = drawMenuBar(session);
    const float bottom = ImGui::GetFrameHeight() + 4 * static_cast<float>(session.uiScale);
    const Layout layout = layOut(session, display.x, display.y, top, bottom);
    if (session.geometry) {
        drawViewBar(session, layout.bar);
        if (layout.timeLine.height > 0) drawTimeLine(session, layout.timeLine);
        if (session.mixer.shown) drawMixerStrip(session, layout.mixer);
        drawSides(session, layout, environments);
    }
    drawStatusBar(session, bottom);
    drawHelp(session);
    drawDialogs(session);
    drawLegend(session);
    handleView(session);
    drawLoading(session);
    return pictureParts(session);
}

}  // namespace cutis::app
