// What ran for the picture, what did not and why.
#include <imgui.h>

#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {

void drawPlanPanel(Session& session) {
    if (!session.picture) {
        ImGui::TextDisabled("No picture yet");
        return;
    }
    const RenderStats& stats = session.picture->stats;
    heading("Picture");
    const DisplayPicture& display = session.picture->display;
    label("Size");
    ImGui::Text("%d \xc3\x97 %d%s", display.width, display.height, session.picture->full ? "" : " preview");
    label("Time");
    ImGui::Text("%.2f s", session.picture->seconds);
    label("Lights");
    ImGui::Text("%d in %d samples", stats.lights, stats.lightSamples);
    label("Atlas");
    ImGui::Text("%d\xc2\xb2, %.2f mm a texel", stats.atlasWidth, stats.atlasMmPerTexel);
    label("Gaussians");
    ImGui::Text("%d", stats.gaussians);
    label("Memory");
    ImGui::Text("%.0f MiB", double(stats.bytesGpu) / (1 << 20));
    if (stats.nonfinite) {
        label("Not finite");
        ImGui::Text("%llu values", static_cast<unsigned long long>(stats.nonfinite));
    }
    heading("Passes");
    if (ImGui::BeginTable("passes", 2, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("00000.0 ms").x);
        for (const PassStats& pass : stats.passes) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(pass.name.c_str());
            hint(pass.reason.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.1f ms", pass.gpuMs);
        }
        ImGui::EndTable();
    }
    heading("Left out");
    ImGui::PushTextWrapPos();
    for (const LeftOut& left : stats.leftOut) {
        ImGui::TextUnformatted(left.name.c_str());
        ImGui::TextDisabled("%s", left.reason.c_str());
    }
    if (stats.leftOut.empty()) ImGui::TextDisabled("Nothing: this scene needs all passes");
    ImGui::PopTextWrapPos();
}

}  // namespace cutis::app
