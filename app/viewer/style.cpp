#include "app/viewer/style.h"

#include <imgui.h>

#include <filesystem>

namespace cutis::app {
namespace {

constexpr float kFontSize = 14;  // pixels at a scale of 1

ImVec4 grey(float value, float alpha = 1) {
    return {value, value * 1.01f, value * 1.03f, alpha};
}

void applyColors(ImVec4* colors) {
    const ImVec4 accent = ImGui::ColorConvertU32ToFloat4(accentColor());
    const ImVec4 dim(accent.x * 0.55f, accent.y * 0.55f, accent.z * 0.55f, 1);
    colors[ImGuiCol_Text] = grey(0.86f);
    colors[ImGuiCol_TextDisabled] = grey(0.52f);
    colors[ImGuiCol_WindowBg] = grey(0.115f);
    colors[ImGuiCol_PopupBg] = grey(0.14f);
    colors[ImGuiCol_MenuBarBg] = grey(0.09f);
    colors[ImGuiCol_Border] = grey(0.2f);
    colors[ImGuiCol_FrameBg] = grey(0.18f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.23f);
    colors[ImGuiCol_FrameBgActive] = grey(0.26f);
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = grey(0.09f);
    colors[ImGuiCol_Button] = grey(0.21f);
    colors[ImGuiCol_ButtonHovered] = grey(0.28f);
    colors[ImGuiCol_ButtonActive] = dim;
    colors[ImGuiCol_Header] = grey(0.21f);
    colors[ImGuiCol_HeaderHovered] = grey(0.26f);
    colors[ImGuiCol_HeaderActive] = grey(0.3f);
    colors[ImGuiCol_SliderGrab] = grey(0.36f);  // text lies over it
    colors[ImGuiCol_SliderGrabActive] = accent;
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_Separator] = grey(0.2f);
    colors[ImGuiCol_Tab] = grey(0.12f);
    colors[ImGuiCol_TabHovered] = grey(0.28f);
    colors[ImGuiCol_TabActive] = grey(0.24f);
    colors[ImGuiCol_TabUnfocused] = grey(0.12f);
    colors[ImGuiCol_TabUnfocusedActive] = grey(0.2f);
    colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_TextSelectedBg] = dim;
    colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.5f);
}

}  // namespace

unsigned accentColor(float alpha) {
    return ImGui::ColorConvertFloat4ToU32({0.88f, 0.62f, 0.36f, alpha});
}

unsigned warningColor() {
    return ImGui::ColorConvertFloat4ToU32({0.93f, 0.74f, 0.35f, 1});
}

void applyStyle(double scale) {
    const float factor = static_cast<float>(scale);
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    applyColors(style.Colors);
    style.WindowRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
    style.WindowPadding = {10, 8};
    style.FramePadding = {6, 3};
    style.ItemSpacing = {6, 5};
    style.ScrollbarSize = 11;
    style.IndentSpacing = 12;
    style.ScaleAllSizes(factor);

    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    std::error_code error;
    if (std::filesystem::is_regular_file(CUTIS_UI_FONT, error)) {
        // Names of lights and people, in what most of the world writes; the rest shows as "?".
        static const ImWchar kRanges[] = {0x20,   0x24f,  0x370,  0x3ff,  0x400, 0x52f,
                                          0x2010, 0x2026, 0x2190, 0x2193, 0};
        fonts.AddFontFromFileTTF(CUTIS_UI_FONT, kFontSize * factor, nullptr, kRanges);
    } else {
        ImFontConfig config;
        config.SizePixels = 13 * factor;
        fonts.AddFontDefault(&config);
    }
}

}  // namespace cutis::app
