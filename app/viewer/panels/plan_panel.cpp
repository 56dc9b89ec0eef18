// What ran for the picture, what did not and why; and how exactly the next one is computed.
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace {

// One of several values of a setting.
template <class Value, std::size_t kCount>
bool choiceRow(const char* text, const char* option, Value& value,
               const std::pair<const char*, Value> (&choices)[kCount]) {
    const char* shown = "as given";
    for (const auto& [name, choice] : choices)
        if (choice == value) shown = name;
    label(text);
    bool changed = false;
    ImGui::PushID(text);
    const bool open = ImGui::BeginCombo("##choice", shown);
    if (!open) optionHint(option);
    for (const auto& [name, choice] : choices) {
        if (!open || !ImGui::Selectable(name, choice == value) || choice == value) continue;
        value = choice;
        changed = true;
    }
    if (open) ImGui::EndCombo();
    ImGui::PopID();
    return changed;
}

void editQuality(Session& session, const char* label, const Quality& quality) {
    session.edits.apply(label, [&](Document& document) { document.quality = quality; });
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
    return text;
}

// What is known of the error of this quality, and a slider that chooses the quality by it.
void drawError(Session& session) {
    heading("Error of the skin's light");
    const MeasuredFront& front = session.known.front;
    Quality quality = session.document().quality;
    const MeasuredSetting* measured = measuredOf(quality, front);
    label("Estimate");
    if (measured) {
        ImGui::Text("%s", percent(measured->error).c_str());
    } else {
        ImGui::TextDisabled("not measured");
    }
    const std::string known = "As cutis measure found it, on " + session.known.where() +
                              ": relative L2 of diffuse light. Measuring this scene makes it exact";
    hint(known.c_str());
    bool chosen = quality.tolerance > 0;
    const double tightest = closest(front) ? closest(front)->error : 0.01;
    if (checkRow("By tolerance", chosen)) {
        quality.tolerance = chosen ? (measured ? measured->error : tightest) : 0;
        editQuality(session, "Tolerance", quality);
    }
    optionHint("--tolerance");
    if (!chosen) return;
    double shown = 100 * quality.tolerance;
    if (sliderRow("Tolerance", shown, 100 * tightest, 10, "%.1f %%", true)) {
        // Not below the closest, for a rounding of the slider's.
        quality.tolerance = std::max(shown / 100, tightest);
        editQuality(session, "Tolerance", quality);
    }
    optionHint("--tolerance");
    if (!measured) return;
    label("Takes");
    shortText(measured->setting.name + ", within " + percent(measured->error));
}

void drawQuality(Session& session) {
    constexpr std::pair<const char*, int> kSizes[] = {{"automatic", 0}, {"512", 512},   {"1024", 1024},
                                                      {"2048", 2048},   {"4096", 4096}, {"8192", 8192}};
    constexpr std::pair<const char*, int> kGaussians[] = {{"all", 0}, {"1", 1}, {"2", 2}, {"3", 3},
                                                          {"4", 4},   {"5", 5}, {"6", 6}};
    constexpr std::pair<const char*, int> kTaps[] = {{"1", 1}, {"3", 3}, {"6", 6}, {"12", 12}, {"24", 24}};
    drawError(session);
    Quality quality = session.document().quality;
    if (quality.tolerance > 0) return;
    heading("Quality");
    bool changed = choiceRow("Atlas", "--irradiance-size", quality.irradianceSize, kSizes);
    changed |= choiceRow("Gaussians", "--gaussians", quality.gaussians, kGaussians);
    changed |= enumRow("Merge", "--merge", quality.merge, kMergeNames);
    changed |= enumRow("Chain", "--chain", quality.chain, kChainNames);
    changed |= choiceRow("Taps", "--taps", quality.taps, kTaps);
    if (changed) editQuality(session, "Quality", quality);
}

void drawFigures(const WorkerResult& picture) {
    const RenderStats& stats = picture.stats;
    heading("Picture");
    const auto row = [](const char* name) { label(name); };
    row("Size");
    ImGui::Text("%d \xc3\x97 %d%s", picture.display.width, picture.display.height,
                picture.full ? "" : " preview");
    row("Time");
    ImGui::Text("%.2f s", picture.seconds);
    row("Lights");
    ImGui::Text("%d in %d samples", stats.lights, stats.lightSamples);
    row("Atlas");
    ImGui::Text("%d\xc2\xb2, %.2f mm a texel", stats.atlasWidth, stats.atlasMmPerTexel);
    row("Gaussians");
    ImGui::Text("%d", stats.gaussians);
    row("Memory");
    ImGui::Text("%.0f MiB", double(stats.bytesGpu) / (1 << 20));
    if (!stats.nonfinite) return;
    row("Not finite");
    ImGui::Text("%llu values", static_cast<unsigned long long>(stats.nonfinite));
}

std::string timeText(double milliseconds) {
    char text[32];
    const bool inSeconds = milliseconds >= 9999.95;
    std::snprintf(text, sizeof text, inSeconds ? "%.2f s" : "%.1f ms",
                  inSeconds ? milliseconds / 1000 : milliseconds);
    return text;
}

void drawPasses(const RenderStats& stats) {
    double total = 0;
    for (const PassStats& pass : stats.passes) total += pass.gpuMs;
    heading("Runs: " + timeText(total) + " on the device");
    if (!ImGui::BeginTable("passes", 2, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("0000.0 ms").x);
    for (const PassStats& pass : stats.passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (pass.runs) {
            ImGui::TextUnformatted(pass.name.c_str());
        } else {
            ImGui::TextDisabled("%s", pass.name.c_str());
        }
        ImGui::PushTextWrapPos();
        ImGui::TextDisabled("%s", pass.reason.c_str());
        ImGui::PopTextWrapPos();
        ImGui::TableNextColumn();
        pass.runs ? ImGui::TextUnformatted(timeText(pass.gpuMs).c_str()) : ImGui::TextDisabled("kept");
    }
    ImGui::EndTable();
}

}  // namespace

void drawPlanPanel(Session& session) {
    drawQuality(session);
    if (!session.picture) {
        ImGui::TextDisabled("No picture yet");
        return;
    }
    drawFigures(*session.picture);
    drawPasses(session.picture->stats);
    heading("Left out");
    ImGui::PushTextWrapPos();
    for (const LeftOut& left : session.picture->stats.leftOut) {
        ImGui::TextUnformatted(left.name.c_str());
        ImGui::TextDisabled("%s", left.reason.c_str());
    }
    if (session.picture->stats.leftOut.empty()) ImGui::TextDisabled("Nothing: this scene needs all passes");
    ImGui::PopTextWrapPos();
}

}  // namespace cutis::app
