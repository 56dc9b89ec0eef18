#include "app/viewer/legend.h"

#include <imgui.h>

#include "app/viewer/comparing.h"

namespace cutis::app {
namespace {

struct Scale {
    const char* black = "";
    const char* white = "";
};

Scale scaleOf(const Session& session) {
    if (session.compareMode == CompareMode::difference && session.compared[0].stored) {
        const bool relative = session.differenceMap == DifferenceMap::relative;
        return session.figures ? Scale{"0", relative ? kWholeDifferenceText : kWholeFlipText} : Scale{};
    }
    const Shown shown = session.picture ? session.picture->overlay : Shown{};
    for (const Overlay& overlay : overlays())
        if (overlay.aov == shown.aov && overlay.inspect == shown.inspect.what)
            return {overlay.black, overlay.white};
    return {};
}

}  // namespace

void drawLegend(const Session& session) {
    const Scale shown = scaleOf(session);
    if (!*shown.white) return;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float scale = static_cast<float>(session.uiScale), pad = 8 * scale, gap = 6 * scale;
    const float line = ImGui::GetTextLineHeight(), length = 120 * scale;
    const float low = ImGui::CalcTextSize(shown.black).x, high = ImGui::CalcTextSize(shown.white).x;
    ImVec2 at(float(session.view.x) + pad, float(session.view.y + session.view.height) - pad - line);
    draw.AddRectFilled({at.x - gap, at.y - gap / 2},
                       {at.x + low + length + high + 3 * gap, at.y + line + gap / 2},
                       IM_COL32(20, 20, 20, 220));
    draw.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), shown.black);
    at.x += low + gap;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
        const glm::vec3 code = heatColor((float(i) + 0.5f) / kSteps);
        draw.AddRectFilled({at.x + length * float(i) / kSteps, at.y + 2 * scale},
                           {at.x + length * float(i + 1) / kSteps, at.y + line - 2 * scale},
                           ImGui::ColorConvertFloat4ToU32({code.x, code.y, code.z, 1}));
    }
    draw.AddText({at.x + length + gap, at.y}, ImGui::GetColorU32(ImGuiCol_Text), shown.white);
}

}  // namespace cutis::app
