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

// Widths of the line in which the speed finds room beside the time, and the loop; in sizes of the font.
constexpr float kRoomForSpeed = 41, kRoomForLoop = 36, kRoomForNames = 26;

void drawChoice(Playback& playback, float room) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * (room < kRoomForNames ? 5.0f : 7.5f));
    const int chosen = playback.pose().animation;
    const bool open = ImGui::BeginCombo("##animation", nameOf(playback, chosen).c_str());
    if (!open) return optionHint("--animation");
    for (int i = kAtRest; i < static_cast<int>(playback.clips().size()); ++i) {
        const std::string name = nameOf(playback, i) + "##" + std::to_string(i);
        if (ImGui::Selectable(name.c_str(), i == chosen) && i != chosen) playback.choose(i);
    }
    ImGui::EndCombo();
}

void drawButtons(Playback& playback, float room) {
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
    if (room < kRoomForLoop) return;
    ImGui::SameLine();
    ImGui::Checkbox("Loop", &playback.loop);
    hint("Begin anew at the end");
}

// How the time is written: as much as finds room.
std::string timeFormat(const Playback& playback, float width) {
    char of[32], frame[32], shown[96];
    std::snprintf(of, sizeof of, " of %.2f", playback.duration());
    std::snprintf(frame, sizeof frame, ", frame %d", playback.frame());
    const std::string formats[] = {std::string("%.2f") + of + " s" + frame, std::string("%.2f") + of + " s",
                                   "%.2f s"};
    for (const std::string& format : formats) {
        std::snprintf(shown, sizeof shown, format.c_str(), playback.duration());
        if (ImGui::CalcTextSize(shown).x + 2 * ImGui::GetStyle().FramePadding.x <= width) return format;
    }
    return "%.1f";
}

// The place in time takes what room the rest leaves.
void drawTime(Playback& playback, float room) {
    const float speedWidth = ImGui::GetFontSize() * 4.2f, gap = ImGui::GetStyle().ItemSpacing.x;
    ImGui::SameLine();
    const bool speed = room >= kRoomForSpeed;
    const float width = ImGui::GetContentRegionAvail().x - (speed ? speedWidth + gap : 0);
    ImGui::SetNextItemWidth(width);
    const double begin = 0, end = playback.duration();
    double seconds = playback.pose().seconds;
    const std::string format = timeFormat(playback, width);
    ImGui::BeginDisabled(end <= 0);
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &seconds, &begin, &end, format.c_str(),
                            ImGuiSliderFlags_AlwaysClamp)) {
        playback.pause();
        playback.seek(seconds);
    }
    ImGui::EndDisabled();
    optionHint("--time");
    if (!speed) return;
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
    // What matters least goes first where there is no room: the speed, the loop.
    const float room = ImGui::GetWindowWidth() / ImGui::GetFontSize();
    drawChoice(session.playback, room);
    drawButtons(session.playback, room);
    drawTime(session.playback, room);
    ImGui::End();
}

}  // namespace cutis::app
