#include "app/viewer/panels/widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/viewer/style.h"

namespace cutis::app {
namespace {

std::string hidden(const char* text) {
    std::string id = "##";
    return id.append(text);
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

void shortText(const std::string& text, bool dim) {
    const float room = ImGui::GetContentRegionAvail().x;
    std::string shown = text;
    while (!shown.empty() && ImGui::CalcTextSize(shown.c_str()).x > room) {
        // Without its last character, which may be several bytes, and its ellipsis.
        if (shown.size() >= 3 && shown.ends_with("\xe2\x80\xa6")) shown.resize(shown.size() - 3);
        while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80) shown.pop_back();
        if (!shown.empty()) shown.pop_back();
        if (!shown.empty()) shown += "\xe2\x80\xa6";
    }
    dim ? ImGui::TextDisabled("%s", shown.c_str()) : ImGui::TextUnformatted(shown.c_str());
    if (shown != text) hint(text.c_str());
}

void optionHint(const char* name) {
    if (!ImGui::IsItemHovered()) return;
    for (const Option& option : options()) {
        if (option.longName() != name || !(option.commands & kViewer)) continue;
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
        ImGui::TextUnformatted(option.help.c_str());
        ImGui::TextDisabled("%s", name);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
        return;
    }
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

void placePicture(Session& session, int picture, float x, float y, float width, float height) {
    const ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 low = draw.GetClipRectMin(), high = draw.GetClipRectMax();
    const auto rectangle = [](float left, float top, float right, float bottom) {
        return PixelRect{int(left), int(top), int(right) - int(left), int(bottom) - int(top)};
    };
    const float left = std::max(x, low.x), top = std::max(y, low.y);
    const float right = std::min(x + width, high.x), bottom = std::min(y + height, high.y);
    if (left >= right || top >= bottom) return;
    session.thumbnails.push_back(
        {picture, rectangle(x, y, x + width, y + height), rectangle(left, top, right, bottom)});
}

bool thumbnail(Session& session, const char* id, int picture, float width, float height, bool chosen) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton(id, {width, height});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (session.pictures.count(picture)) {
        placePicture(session, picture, at.x, at.y, width, height);
    } else {
        draw.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    }
    const float line = static_cast<float>(session.uiScale);
    const bool hovered = ImGui::IsItemHovered();
    if (chosen || hovered)
        draw.AddRect(at, {at.x + width, at.y + height}, accentColor(chosen ? 1.0f : 0.6f), 0, 0,
                     (chosen ? 2 : 1) * line);
    return clicked;
}

}  // namespace cutis::app
