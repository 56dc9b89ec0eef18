// Below the picture: which animation, and where in it.
#include <imgui.h>

#include <cstdio>

#include "app/frame_files.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/style.h"

namespace cutis::app {
namespace {

std::string nameOf(const Playback& playback, int animation) {
    if (animation == kAtRest) return "at rest";
    const std::string& name = playback.clips()[static_cast<std::size_t>(animation)].name;
    return name.empty() ? "animation " + std::to_string(animation) : name;
}

void drawChoice(Playback& playback) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7.5f);
    const int chosen = playback.pose().animation;
    const bool open = ImGui::BeginCombo("##animation", nameOf(playback, chosen).c_str());
    if (!open) return optionHint("--animation");
    for (int i = kAtRest; i < static_cast<int>(playback.clips().size()); ++i) {
        const std::string name = nameOf(playback, i) + "##" + std::to_string(i);
        if (ImGui::Selectable(name.c_str(), i == chosen) && i != chosen) playback.choose(i);
    }
    ImGui::EndCombo();
}

void drawButtons(Playback& playback) {
    const float width = ImGui::GetFontSize() * 3.2f;
    ImGui::SameLine();
    if (ImGui::Button(playback.playing() ? "Pause" : "Play", {width, 0})) playback.toggle();
    hint("Space");
    ImGui::SameLine();
    if (ImGui::ArrowButton("before", ImGuiDir_Left)) playback.step(-1);
    hint("The frame before (Left)");
    ImGui::SameLine();
    if (ImGui::ArrowButton("after", ImGuiDir_Right)) playback.step(1);
    hint("The next frame (Right)");
    ImGui::SameLine();
    ImGui::Checkbox("Loop", &playback.loop);
    hint("Begin anew at the end");
}

// The place in time takes what room the rest leaves.
void drawTime(Playback& playback) {
    const float speedWidth = ImGui::GetFontSize() * 4.2f, gap = ImGui::GetStyle().ItemSpacing.x;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - speedWidth - gap);
    const double begin = 0, end = playback.duration();
    double seconds = playback.pose().seconds;
    char format[64];
    std::snprintf(format, sizeof format, "%%.2f of %.2f s, frame %d", end, playback.frame());
    ImGui::BeginDisabled(end <= 0);
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &seconds, &begin, &end, format,
                            ImGuiSliderFlags_AlwaysClamp)) {
        playback.pause();
        playback.seek(seconds);
    }
    ImGui::EndDisabled();
    optionHint("--time");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(speedWidth);
    const double slowest = Playback::kSlowest, fastest = Playback::kFastest;
    ImGui::DragScalar("##speed", ImGuiDataType_Double, &playback.speed, 0.01f, &slowest, &fastest,
                      "%.2f\xc3\x97", ImGuiSliderFlags_AlwaysClamp);
    hint("Speed: times as fast as in the file");
}

}  // namespace

void drawTimeLine(Session& session, const PixelRect& where) {
    const float scale = static_cast<float>(session.uiScale);
    ImGui::SetNextWindowPos({float(where.x), float(where.y)});
    ImGui::SetNextWindowSize({float(where.width), float(where.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 4 * scale});
    ImGui::Begin("##timeline", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    drawChoice(session.playback);
    drawButtons(session.playback);
    drawTime(session.playback);
    ImGui::End();
}

}  // namespace cutis::app
