// Above the picture: what it shows, what dragging in it does.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/viewer/overlay.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/style.h"

namespace cutis::app {
namespace {

constexpr std::pair<const char*, double> kShapes[] = {{"Fill", 0.0},     {"16:9", 16.0 / 9}, {"3:2", 1.5},
                                                      {"4:3", 4.0 / 3},  {"1:1", 1.0},       {"4:5", 0.8},
                                                      {"9:16", 9.0 / 16}};

void drawOverlayChoice(Session& session) {
    const Overlay* shown = &overlays()[0];
    for (const Overlay& overlay : overlays())
        if (session.overlay == overlay.aov) shown = &overlay;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7.5f);
    if (ImGui::BeginCombo("##show", shown->label, ImGuiComboFlags_HeightLarge)) {
        for (const Overlay& overlay : overlays()) {
            if (ImGui::Selectable(overlay.label, &overlay == shown)) session.overlay = overlay.aov;
            if (*overlay.scale) hint(overlay.scale);
        }
        ImGui::EndCombo();
    }
    hint(*shown->scale ? shown->scale : "What is shown: the picture, or what it is made of");
}

void drawPlacing(Session& session) {
    const auto choose = [&](const char* text, PlaceBy by, const char* help) {
        if (toggleButton(text, session.placing == by, accentColor()))
            session.placing = session.placing == by ? std::nullopt : std::optional(by);
        hint(help);
    };
    ImGui::TextDisabled("Place light by");
    ImGui::SameLine();
    choose("highlight", PlaceBy::highlight,
           "Drag on a face: the chosen light moves so that its highlight falls under the mouse (L; or hold "
           "Ctrl)");
    ImGui::SameLine();
    choose("shadow edge", PlaceBy::shadowEdge,
           "Drag on a face: the chosen light moves so that its shadow begins under the mouse (or hold Ctrl "
           "and Shift)");
}

void drawShape(Session& session) {
    const char* shown = "Fill";
    for (const auto& [name, aspect] : kShapes)
        if (std::abs(session.pictureAspect - aspect) < 1e-6) shown = name;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 4.5f);
    if (ImGui::BeginCombo("##shape", shown)) {
        for (const auto& [name, aspect] : kShapes)
            if (ImGui::Selectable(name, name == shown)) session.pictureAspect = aspect;
        ImGui::EndCombo();
    }
    hint("Width to height of the picture");
}

}  // namespace

void drawViewBar(Session& session, const PixelRect& where) {
    ImGui::SetNextWindowPos({float(where.x), float(where.y)});
    ImGui::SetNextWindowSize({float(where.width), float(where.height)});
    const float scale = static_cast<float>(session.uiScale);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 3 * scale});
    ImGui::Begin("##viewbar", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    drawOverlayChoice(session);
    ImGui::SameLine(0, 16 * scale);
    ImGui::AlignTextToFramePadding();
    drawPlacing(session);
    ImGui::SameLine(0, 16 * scale);
    if (toggleButton("Mixer", session.mixer.shown, accentColor())) session.mixer.shown = !session.mixer.shown;
    hint("Every light's own picture with a fader: mixing them renders nothing (X)");
    // At the right edge, or after the rest where that leaves no room.
    const float right = ImGui::GetWindowWidth() - ImGui::GetFontSize() * 4.5f - 8 * scale;
    ImGui::SameLine();
    ImGui::SameLine(std::max(right, ImGui::GetCursorPosX()));
    drawShape(session);
    ImGui::End();
}

}  // namespace cutis::app
