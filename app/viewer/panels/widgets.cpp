#include "app/viewer/panels/widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

namespace cutis::app {
namespace {

std::string hidden(const char* text) {
    return std::string("##") + text;
}

}  // namespace

void label(const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine(ImGui::GetFontSize() * 7);
    ImGui::SetNextItemWidth(-1);
}

bool dragRow(const char* text, double& value, float speed, double min, double max, const char* format,
             bool logarithmic) {
    label(text);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    return ImGui::DragScalar(hidden(text).c_str(), ImGuiDataType_Double, &value, speed, &min, &max, format,
                             flags);
}

bool sliderRow(const char* text, double& value, double min, double max, const char* format,
               bool logarithmic) {
    label(text);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    return ImGui::SliderScalar(hidden(text).c_str(), ImGuiDataType_Double, &value, &min, &max, format, flags);
}

bool intRow(const char* text, int& value, int min, int max, const char* format) {
    label(text);
    return ImGui::SliderInt(hidden(text).c_str(), &value, min, max, format, ImGuiSliderFlags_AlwaysClamp);
}

bool checkRow(const char* text, bool& value) {
    label(text);
    return ImGui::Checkbox(hidden(text).c_str(), &value);
}

bool textRow(const char* text, std::string& value) {
    label(text);
    return ImGui::InputText(hidden(text).c_str(), &value);
}

void heading(const char* text) {
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.15f});
    ImGui::TextDisabled("%s", text);
    ImGui::Separator();
}

void hint(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

bool toggleButton(const char* text, bool on, unsigned color) {
    if (on) {
        ImGui::PushStyleColor(ImGuiCol_Button, color);
        ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(20, 20, 20, 255));
    }
    const bool clicked = ImGui::SmallButton(text);
    if (on) ImGui::PopStyleColor(2);
    return clicked;
}

}  // namespace cutis::app
