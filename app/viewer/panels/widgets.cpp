#include "app/viewer/panels/widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

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

namespace {

std::string formatOf(const Field& field, const char* unit) {
    const bool degrees = field.shownPerUnit == fields::kDegrees;
    const std::string shown = unit ? unit : degrees ? "\xc2\xb0" : field.unit;
    std::string format = field.format;
    if (!shown.empty() && shown != "\xc2\xb0") format += ' ';
    return format + shown;
}

// What a pixel of dragging adds. ImGui's own logarithmic drags divide that by the whole range, in which a
// range of six decades does not move at all.
float dragSpeed(double value, float step, bool logarithmic) {
    constexpr double kLeast = 1e-3;  // from 0, too, a drag gets away
    return logarithmic ? step * static_cast<float>(std::max(std::abs(value), kLeast)) : step;
}

void fieldHint(const Field& field) {
    if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
    const std::string allowed = field.allowed();
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
    ImGui::TextUnformatted(field.help);
    if (*field.key) ImGui::TextDisabled("%s: %s", field.key, allowed.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

bool fieldPartRow(const Field& field, const char* text, double& value) {
    double shown = value * field.shownPerUnit;
    const std::string format = formatOf(field, nullptr);
    const bool changed =
        field.step > 0 ? dragRow(text, shown, static_cast<float>(field.step), field.low, field.high,
                                 format.c_str(), field.logarithmic)
                       : sliderRow(text, shown, field.low, field.high, format.c_str(), field.logarithmic);
    fieldHint(field);
    if (changed) value = shown / field.shownPerUnit;
    return changed;
}

bool fieldCell(const Field& field, double& value) {
    const float speed = dragSpeed(value, static_cast<float>(field.step), field.logarithmic);
    const bool changed = ImGui::DragScalar("##cell", ImGuiDataType_Double, &value, speed, &field.low,
                                           &field.high, field.format, ImGuiSliderFlags_AlwaysClamp);
    fieldHint(field);
    return changed;
}

bool fieldRow(const Field& field, double& value, const char* unit) {
    Field shown = field;
    if (unit) shown.unit = unit;
    return fieldPartRow(shown, field.label, value);
}

bool fieldRow(const Field& field, int& value, const char* zero) {
    const bool changed = intRow(field.label, value, static_cast<int>(field.low), static_cast<int>(field.high),
                                value == 0 ? zero : "%d");
    fieldHint(field);
    return changed;
}

bool fieldRow(const Field& field, bool& value) {
    const bool changed = checkRow(field.label, value);
    fieldHint(field);
    return changed;
}

bool fieldRow(const Field& field, std::string& value) {
    const bool changed = textRow(field.label, value);
    fieldHint(field);
    return changed;
}

bool choiceOf(const char* text, const char* option, int& index, std::span<const char* const> names) {
    label(text);
    ImGui::PushID(text);
    const bool open = ImGui::BeginCombo("##choice", names[static_cast<std::size_t>(index)]);
    if (!open) optionHint(option);
    bool changed = false;
    for (std::size_t i = 0; open && i < names.size(); ++i) {
        const bool chosen = static_cast<int>(i) == index;
        if (!ImGui::Selectable(names[i], chosen) || chosen) continue;
        index = static_cast<int>(i);
        changed = true;
    }
    if (open) ImGui::EndCombo();
    ImGui::PopID();
    return changed;
}

bool dragRow(const char* text, double& value, float speed, double min, double max, const char* format,
             bool logarithmic) {
    label(text);
    return ImGui::DragScalar(hidden(text).c_str(), ImGuiDataType_Double, &value,
                             dragSpeed(value, speed, logarithmic), &min, &max, format,
                             ImGuiSliderFlags_AlwaysClamp);
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

void heading(const std::string& text, const char* help) {
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.15f});
    shortText(text);
    if (help) hint(help);
    ImGui::Separator();
}

void hint(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

void shortText(const std::string& text, bool dim, float width) {
    const float room = width > 0 ? width : ImGui::GetContentRegionAvail().x;
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
        for (const ImGuiCol part : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
            ImGui::PushStyleColor(part, color);
        ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(20, 20, 20, 255));
    }
    const bool clicked = ImGui::SmallButton(text);
    if (on) ImGui::PopStyleColor(4);
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
