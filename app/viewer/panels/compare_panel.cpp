// Two states beside each other.
#include <imgui.h>

#include "app/viewer/actions.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace {

void drawSlot(Session& session, std::size_t slot) {
    const StoredState& state = session.compared[slot];
    ImGui::PushID(static_cast<int>(slot));
    label(slot == 0 ? "State A" : "State B");
    const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::BeginDisabled(!session.picture);
    if (ImGui::Button("Store", {width, 0})) storeState(session, slot);
    ImGui::EndDisabled();
    hint("Keeps the lights, the skin and the view as they are now, and their picture");
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!state.stored);
    if (ImGui::Button("Recall", {width, 0})) recallState(session, slot);
    ImGui::EndDisabled();
    hint("Makes this state the current one; undo brings the other back");
    if (state.stored) {
        const Rig rig = effectiveRig(state.document);
        int on = 0;
        for (const Light& light : rig.lights) on += light.enabled;
        label("");
        ImGui::TextDisabled("%d of %zu lights%s", on, rig.lights.size(), state.full ? "" : ", preview");
    }
    ImGui::PopID();
}

}  // namespace

void drawComparePanel(Session& session) {
    heading("States");
    drawSlot(session, 0);
    drawSlot(session, 1);
    heading("Show");
    const std::pair<const char*, CompareMode> modes[] = {{"The current state", CompareMode::off},
                                                         {"Wipe", CompareMode::wipe},
                                                         {"Side by side", CompareMode::sideBySide},
                                                         {"Blink", CompareMode::blink}};
    for (const auto& [text, mode] : modes)
        if (ImGui::RadioButton(text, session.compareMode == mode)) session.compareMode = mode;
    if (session.compareMode == CompareMode::wipe) sliderRow("Wipe at", session.wipe, 0, 1, "%.2f");
    if (session.compareMode == CompareMode::off) return;
    ImGui::PushTextWrapPos();
    if (!session.compared[0].stored) {
        ImGui::TextDisabled("Store a state as A first.");
    } else {
        ImGui::TextDisabled("A against %s.", session.compared[1].stored ? "B" : "the current state");
    }
    ImGui::PopTextWrapPos();
}

}  // namespace cutis::app
