// F1: hot keys and what the mouse does.
#include <imgui.h>

#include "app/viewer/hot_keys.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {

void drawHelp(Session& session) {
    if (!session.showHelp) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Hot keys", &session.showHelp,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
        const std::span<const HotKey> keys = hotKeys();
        const std::size_t half = (keys.size() + 1) / 2;
        for (std::size_t i = 0; i < half; ++i) {
            ImGui::TableNextRow();
            for (const std::size_t k : {i, i + half}) {
                if (k >= keys.size()) break;
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", keys[k].keys);
                ImGui::TableNextColumn();
                ImGui::Text("%s      ", keys[k].meaning);
            }
        }
        ImGui::EndTable();
    }
    heading("Mouse in the picture");
    ImGui::TextUnformatted(
        "Left drag: turn the view, or move a light by its handle (Shift: its distance, Alt: its cone or "
        "size)\n"
        "The cross is where the chosen light aims, the square the edge of its cone: drag them\n"
        "Ctrl and left drag on a face: the chosen light's highlight follows the mouse (with Shift: its "
        "shadow's edge)\n"
        "Middle or right drag: move the view.  Wheel: nearer or farther\n"
        "Double click: frame the person.  F: look at the point under the mouse");
    heading("Files");
    ImGui::TextUnformatted("Drop a glTF scene, a rig, a skin file or an HDR environment on the window to open it.");
    ImGui::End();
}

}  // namespace cutis::app
