// F1: hot keys and what the mouse does.
#include <imgui.h>

#include "app/viewer/hot_keys.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace {

// Width of the window in which keys find room in two columns, and how wide text is then and otherwise; in
// sizes of the font.
constexpr float kRoomForColumns = 54, kWideText = 48, kNarrowText = 34;

void drawKeys(std::size_t columns) {
    if (!ImGui::BeginTable("keys", 2 * static_cast<int>(columns), ImGuiTableFlags_SizingFixedFit)) return;
    const std::span<const HotKey> keys = hotKeys();
    const std::size_t rows = (keys.size() + columns - 1) / columns;
    for (std::size_t i = 0; i < rows; ++i) {
        ImGui::TableNextRow();
        for (std::size_t k = i; k < keys.size(); k += rows) {
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", keys[k].keys);
            ImGui::TableNextColumn();
            ImGui::Text("%s      ", keys[k].meaning);
        }
    }
    ImGui::EndTable();
}

}  // namespace

void drawHelp(Session& session) {
    if (!session.showHelp) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    const bool wide = display.x >= kRoomForColumns * font;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {0.98f * display.x, 0.9f * display.y});
    ImGui::Begin("Hot keys", &session.showHelp,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    drawKeys(wide ? 2 : 1);
    ImGui::PushTextWrapPos(font * (wide ? kWideText : kNarrowText));
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
    ImGui::TextUnformatted(
        "Drop a glTF scene, a rig, a skin file or an HDR environment on the window to open it.");
    ImGui::PopTextWrapPos();
    ImGui::End();
}

}  // namespace cutis::app
