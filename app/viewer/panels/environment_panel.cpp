// The environment: which, how bright, which way round.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/inputs.h"
#include "app/viewer/actions.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

// Environments that set-up installed; read from the folder once.
const std::vector<fs::path>& installedEnvironments() {
    static const std::vector<fs::path> found = [] {
        std::vector<fs::path> files;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(dataFolder() / "hdri", error))
            if (entry.path().extension() == ".exr" || entry.path().extension() == ".hdr")
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }();
    return found;
}

void drawChoice(Session& session) {
    const std::string current = session.document().rig.environment.file;
    label("File");
    const std::string shown = current.empty() ? "none" : fs::path(current).stem().string();
    if (!ImGui::BeginCombo("##file", shown.c_str(), ImGuiComboFlags_HeightLarge)) return;
    if (ImGui::Selectable("none", current.empty()))
        session.edits.apply("No environment",
                            [](Document& document) { document.rig.environment.file.clear(); });
    for (const fs::path& file : installedEnvironments()) {
        const bool chosen = fs::path(current).filename() == file.filename();
        if (ImGui::Selectable(file.stem().c_str(), chosen)) openEnvironment(session, file);
    }
    ImGui::Separator();
    if (ImGui::Selectable("Another file ...")) showDialog(session, Dialog::open);
    ImGui::EndCombo();
}

}  // namespace

void drawEnvironmentPanel(Session& session) {
    heading("Environment");
    drawChoice(session);
    EnvironmentSettings settings = session.document().rig.environment;
    if (settings.file.empty()) return;
    bool changed = checkRow("On", settings.enabled);
    changed |= dragRow("Intensity", settings.intensity, 0.005f, 0, 1000, "%.3g", true);
    double turn = settings.rotation - 360 * std::floor((settings.rotation + 180) / 360);
    if (sliderRow("Rotation", turn, -180, 180, "%.0f\xc2\xb0")) {
        settings.rotation = turn;
        changed = true;
    }
    changed |=
        intRow("Shadows", settings.shadowSamples, 0, 64, settings.shadowSamples ? "%d samples" : "soft only");
    hint("Directions of the environment that cast shadows as lights do");
    if (changed)
        session.edits.apply("Environment", [&](Document& document) { document.rig.environment = settings; });
}

}  // namespace cutis::app
