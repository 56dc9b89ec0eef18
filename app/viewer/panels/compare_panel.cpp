// Two states beside each other.
#include <imgui.h>

#include "app/viewer/actions.h"
#include "app/viewer/comparing.h"
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
    if (ImGui::Button("Store", {width, 0})) storeCurrent(session, slot);
    hint("Keeps the lights, the skin and the view as they are now, and their picture");
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!state.stored);
    if (ImGui::Button("Recall", {width, 0})) recallState(session, slot);
    ImGui::EndDisabled();
    hint("Makes this state the current one; undo brings the other back");
    if (state.stored) {
        label("");
        shortText((state.linear ? "" : "(to come) ") + state.name);
    }
    ImGui::PopID();
}

void drawFigures(Session& session) {
    heading("B against A");
    const bool relative = session.differenceMap == DifferenceMap::relative;
    if (ImGui::RadioButton("Relative", relative)) session.differenceMap = DifferenceMap::relative;
    hint("White: a difference as large as the mean light");
    ImGui::SameLine();
    if (ImGui::RadioButton("Perceived", !relative)) session.differenceMap = DifferenceMap::perceived;
    hint("FLIP, as shown on a screen. White: 0.5 and more");
    if (!figuresAreOfNow(session)) {
        ImGui::TextDisabled("Comparing ...");
        return;
    }
    const ComparedFigures& figures = *session.figures;
    if (!figures.problem.empty()) {
        ImGui::TextWrapped("%s", figures.problem.c_str());
        return;
    }
    const auto row = [](const char* name, const char* format, double value, const char* help) {
        label(name);
        ImGui::Text(format, value);
        hint(help);
    };
    row("Relative L2", "%.2f %%", 100 * figures.relativeL2,
        "Root of the squared differences over that of A's light");
    row("99th percent", "%.2f %%", 100 * figures.p99,
        "99 of 100 values differ by less, in shares of A's mean light");
    row("Perceived", "%.4f FLIP", figures.flip, "Mean over the picture; 0 is no difference, 1 the largest");
    row("Light", "%.1f %%", 100 * figures.lightRatio, "All of B's light over all of A's");
}

}  // namespace

void drawComparePanel(Session& session) {
    heading("States");
    drawSlot(session, 0);
    drawSlot(session, 1);
    const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::BeginDisabled(!session.hasLight());
    if (ImGui::Button("Light against all", {width, 0})) compareChosenLight(session);
    ImGui::EndDisabled();
    hint("Stores all lights as A, the chosen one alone as B");
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!session.compared[0].stored);
    if (ImGui::Button("From this view", {width, 0})) renewStates(session);
    ImGui::EndDisabled();
    hint("Renders A and B from where the view is now");
    heading("Show");
    const std::pair<const char*, CompareMode> modes[] = {{"The current state", CompareMode::off},
                                                         {"Wipe", CompareMode::wipe},
                                                         {"Side by side", CompareMode::sideBySide},
                                                         {"Blink", CompareMode::blink},
                                                         {"Difference", CompareMode::difference}};
    for (const auto& [text, mode] : modes)
        if (ImGui::RadioButton(text, session.compareMode == mode)) session.compareMode = mode;
    if (session.compareMode == CompareMode::wipe) sliderRow("Wipe at", session.wipe, 0, 1, "%.2f");
    ImGui::BeginDisabled(!session.compared[0].stored);
    if (ImGui::Button("Save the comparison ...", {-1, 0}))
        showDialog(session, Dialog::saveComparison, "comparison");
    ImGui::EndDisabled();
    hint(
        "Pictures, difference maps, figures and a page that shows them, as cutis compare writes them "
        "(Ctrl+E)");
    if (session.compareMode == CompareMode::off) return;
    if (!session.compared[0].stored) {
        ImGui::TextDisabled("Store a state as A first.");
    } else if (session.compareMode == CompareMode::difference) {
        drawFigures(session);
    } else {
        ImGui::TextDisabled("A against %s.", session.compared[1].stored ? "B" : "the current state");
    }
}

}  // namespace cutis::app
