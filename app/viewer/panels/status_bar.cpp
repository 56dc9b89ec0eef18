// One line: what is being done, what the last action said.
#include <imgui.h>

#include <cstdio>
#include <cstring>

#include "app/viewer/panels/panels.h"
#include "app/viewer/style.h"

namespace cutis::app {
namespace {

std::string workText(const Session& session) {
    char text[256] = "";
    const WorkerStatus& worker = session.worker;
    if (!session.loading.empty()) {
        std::snprintf(text, sizeof text, "Loading %s, %.0f s", session.loading.c_str(),
                      session.loadingSeconds);
    } else if (session.complete() && session.picture->overlay == session.overlay) {
        const WorkerResult& picture = *session.picture;
        const bool refines = picture.overlay.aov.empty();
        char state[64] = "Complete";
        if (picture.converged) {
            std::snprintf(state, sizeof state, "Converged");
        } else if (refines && picture.refined < Refinement::kPixelPictures) {
            std::snprintf(state, sizeof state, "Refining edges, %d of %d", picture.refined,
                          Refinement::kPixelPictures);
        } else if (refines) {
            std::snprintf(state, sizeof state, "Refining shadows, %d of at most %d", picture.shadowSets,
                          Refinement::kMostShadowPictures);
        }
        std::snprintf(text, sizeof text, "%s; %d \xc3\x97 %d in %.1f s", state, picture.display.width,
                      picture.display.height, picture.seconds);
        if (worker.aside > 0)
            std::snprintf(text + std::strlen(text), sizeof text - std::strlen(text), "; %zu more to come",
                          worker.aside);
    } else if (worker.busy) {
        std::snprintf(text, sizeof text, "Rendering %d \xc3\x97 %d, %.0f s", worker.width, worker.height,
                      worker.seconds);
    }
    return text;
}

}  // namespace

void drawStatusBar(Session& session, float height) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, display.y - height});
    ImGui::SetNextWindowSize({display.x, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        {10 * float(session.uiScale), 4 * float(session.uiScale)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
    ImGui::Begin("##status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    const std::string work = workText(session), device = session.worker.device;
    const bool failed = !session.worker.error.empty();
    ImGui::TextUnformatted(work.c_str());
    if (!work.empty()) ImGui::SameLine(0, 20 * float(session.uiScale));
    const std::string& said = failed ? session.worker.error : session.message;
    const float right = display.x - ImGui::CalcTextSize(device.c_str()).x - 20 * float(session.uiScale);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    // What is too long for its place ends where the device's name begins, and is whole in the tooltip.
    ImGui::PushClipRect(at, {right - 10, at.y + height}, true);
    if (failed || session.messageIsError) ImGui::PushStyleColor(ImGuiCol_Text, warningColor());
    ImGui::TextUnformatted(said.c_str());
    if (failed || session.messageIsError) ImGui::PopStyleColor();
    ImGui::PopClipRect();
    if (!said.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", said.c_str());
    if (at.x < right) {  // what is being done matters more
        ImGui::SameLine(right);
        ImGui::TextDisabled("%s", device.c_str());
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

}  // namespace cutis::app
