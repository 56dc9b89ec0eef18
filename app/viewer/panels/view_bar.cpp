// Above the picture: what it shows, what dragging in it does.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/viewer/overlay.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/style.h"
#include "renderer/scene/light_samples.h"

namespace cutis::app {
namespace {

constexpr std::pair<const char*, double> kShapes[] = {{"Fill", 0.0},     {"16:9", 16.0 / 9}, {"3:2", 1.5},
                                                      {"4:3", 4.0 / 3},  {"1:1", 1.0},       {"4:5", 0.8},
                                                      {"9:16", 9.0 / 16}};

// Widths of the bar in which all of it finds room, in which the shape still does, wide gaps, and a button for
// each way to place a light; in sizes of the font.
constexpr float kRoomForAll = 46, kRoomForShape = 36, kRoomForGaps = 29, kRoomForButtons = 25;

bool isShown(const Session& session, const Overlay& overlay) {
    return session.overlay.aov == overlay.aov && session.overlay.inspect.what == overlay.inspect;
}

void drawNumber(int& index, int count, const char* help) {
    index = std::clamp(index, 0, count - 1);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 4);
    int number = index + 1;
    if (ImGui::SliderInt("##number", &number, 1, count, "%d", ImGuiSliderFlags_AlwaysClamp))
        index = number - 1;
    hint(help);
}

// Which of several is shown: the level of which Gaussian, the map of which sample of a light.
void drawNumbers(Session& session) {
    Inspect& inspect = session.overlay.inspect;
    const int levels = session.picture ? session.picture->stats.gaussians : 0;
    if (inspect.what == Inspect::What::level && levels > 0)
        drawNumber(inspect.index, levels, "Which level, from the narrowest");
    const int samples = session.hasLight() ? sampleCount(session.light()) : 0;
    if (inspect.what == Inspect::What::lightMap && samples > 1)
        drawNumber(inspect.part, samples, "Which sample of the light");
}

void drawOverlayChoice(Session& session, float width) {
    const Overlay* shown = &overlays()[0];
    for (const Overlay& overlay : overlays())
        if (isShown(session, overlay)) shown = &overlay;
    ImGui::SetNextItemWidth(width);
    if (ImGui::BeginCombo("##show", shown->label, ImGuiComboFlags_HeightLargest)) {
        for (const Overlay& overlay : overlays()) {
            if (ImGui::Selectable(overlay.label, &overlay == shown))
                session.overlay = {overlay.aov, {overlay.inspect, 0, 0}};
            if (*overlay.scale) hint(overlay.scale);
        }
        ImGui::EndCombo();
    }
    hint(*shown->scale ? shown->scale : "What is shown: the picture, or what it is made of");
    drawNumbers(session);
}

constexpr const char* kHighlightHelp =
    "Drag on a face: the chosen light moves so that its highlight falls under the mouse (L; or hold Ctrl)";
constexpr const char* kShadowEdgeHelp =
    "Drag on a face: the chosen light moves so that its shadow begins under the mouse (or hold Ctrl and "
    "Shift)";

// The same in the room of one button.
void drawPlacingChoice(Session& session) {
    const char* shown = !session.placing                         ? "Place by"
                        : *session.placing == PlaceBy::highlight ? "highlight"
                                                                 : "shadow edge";
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6.2f);
    if (!ImGui::BeginCombo("##place", shown)) return;
    if (ImGui::Selectable("off", !session.placing)) session.placing.reset();
    if (ImGui::Selectable("highlight", session.placing == PlaceBy::highlight))
        session.placing = PlaceBy::highlight;
    hint(kHighlightHelp);
    if (ImGui::Selectable("shadow edge", session.placing == PlaceBy::shadowEdge))
        session.placing = PlaceBy::shadowEdge;
    hint(kShadowEdgeHelp);
    ImGui::EndCombo();
}

void drawPlacing(Session& session, bool narrow) {
    const auto choose = [&](const char* text, PlaceBy by, const char* help) {
        if (toggleButton(text, session.placing == by, accentColor()))
            session.placing = session.placing == by ? std::nullopt : std::optional(by);
        hint(help);
    };
    if (!narrow) {
        ImGui::TextDisabled("Place light by");
        ImGui::SameLine();
    }
    choose("highlight", PlaceBy::highlight, kHighlightHelp);
    ImGui::SameLine();
    choose("shadow edge", PlaceBy::shadowEdge, kShadowEdgeHelp);
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
    // What matters least goes first where there is no room: the label, the shape, gaps.
    const float font = ImGui::GetFontSize(), room = ImGui::GetWindowWidth() / font;
    const bool tight = room < kRoomForGaps;
    const float gap = (tight ? 6 : 16) * scale;
    drawOverlayChoice(session, font * (room < kRoomForButtons ? 5.2f : tight ? 6.5f : 7.5f));
    ImGui::SameLine(0, gap);
    ImGui::AlignTextToFramePadding();
    if (room < kRoomForButtons) {
        drawPlacingChoice(session);
    } else {
        drawPlacing(session, room < kRoomForAll);
    }
    ImGui::SameLine(0, gap);
    if (toggleButton("Mixer", session.mixer.shown, accentColor())) session.mixer.shown = !session.mixer.shown;
    hint("Every light's own picture with a fader: mixing them renders nothing (X)");
    if (room < kRoomForShape) return ImGui::End();
    // At the right edge, or after the rest where that leaves no room.
    const float right = ImGui::GetWindowWidth() - font * 4.5f - 8 * scale;
    ImGui::SameLine();
    ImGui::SameLine(std::max(right, ImGui::GetCursorPosX()));
    drawShape(session);
    ImGui::End();
}

}  // namespace cutis::app
