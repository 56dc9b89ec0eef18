// The environment: which, how bright, which way round.
#include <imgui.h>

#include <cmath>

#include "app/viewer/actions.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/thumbnails.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

int numberOf(const std::string& file) {
    const auto& files = installedEnvironments();
    for (std::size_t i = 0; i < files.size(); ++i)
        if (files[i].filename() == fs::path(file).filename())
            return kEnvironmentPictures + static_cast<int>(i);
    return -1;
}

// The environment as a strip that is dragged sideways to turn it: the middle lies behind the subject (-Z).
void drawStrip(Session& session, const EnvironmentSettings& settings) {
    const float width = ImGui::GetContentRegionAvail().x, height = width / 2;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("strip", {width, height});
    hint("Drag sideways to turn the environment");
    if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0) {
        const double degrees = -360.0 * ImGui::GetIO().MouseDelta.x / width;
        session.edits.apply("Turn the environment", [&](Document& document) {
            double& rotation = document.rig.environment.rotation;
            rotation += degrees;
            rotation -= 360 * std::floor((rotation + 180) / 360);
        });
    }
    const int number = numberOf(settings.file);
    const double turns = -settings.rotation / 360;
    const float shift = std::round(static_cast<float>((turns - std::floor(turns)) * width));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRect(at, {at.x + width, at.y + height}, true);
    if (session.pictures.count(number)) {
        placePicture(session, number, at.x + shift, at.y, width, height);
        placePicture(session, number, at.x + shift - width, at.y, width, height);
    } else {
        draw.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    }
    draw.PopClipRect();
}

void drawLibrary(Session& session) {
    const auto& files = installedEnvironments();
    const std::string current = fs::path(session.document().rig.environment.file).filename().string();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - gap) / 2);
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (i % 2) ImGui::SameLine(0, gap);
        ImGui::BeginGroup();
        const std::string name = files[i].stem().string();
        if (thumbnail(session, name.c_str(), kEnvironmentPictures + static_cast<int>(i), width, width / 2,
                      files[i].filename() == current))
            openEnvironment(session, files[i]);
        hint(name.c_str());
        shortText(name, true, width);
        ImGui::EndGroup();
    }
    if (files.empty()) ImGui::TextDisabled("tools/setup installs environments");
}

}  // namespace

void drawEnvironmentPanel(Session& session) {
    EnvironmentSettings settings = session.document().rig.environment;
    if (settings.file.empty()) {
        ImGui::TextDisabled("No environment");
    } else {
        heading(fs::path(settings.file).stem().string());
        drawStrip(session, settings);
        bool changed = fieldRow(fields::kEnvironmentEnabled, settings.enabled);
        changed |= fieldRow(fields::kEnvironmentIntensity, settings.intensity);
        double turn = settings.rotation - 360 * std::floor((settings.rotation + 180) / 360);
        if (fieldRow(fields::kRotation, turn)) {
            settings.rotation = turn;
            changed = true;
        }
        changed |= fieldRow(fields::kShadowSamples, settings.shadowSamples, "none");
        if (settings.sunRemoved) changed |= fieldRow(fields::kSunRemoved, settings.sunRemoved);
        settings.rotation = changed ? settings.rotation : session.document().rig.environment.rotation;
        settings.file = session.document().rig.environment.file;
        if (changed)
            session.edits.apply("Environment",
                                [&](Document& document) { document.rig.environment = settings; });
        Background background = session.document().background;
        if (enumRow("Background", "--background", background, kBackgroundNames))
            session.edits.apply("Background", [&](Document& document) { document.background = background; });
        if (!settings.sunRemoved) {
            if (ImGui::Button("Take its sun out as a light", {-1, 0})) takeSun(session);
            hint("Adds a directional light that gives what the sun gave; the environment shines without it");
        }
        if (ImGui::Button("Remove", {-1, 0}))
            session.edits.apply("No environment", [](Document& document) { document.rig.environment = {}; });
    }
    heading("Library");
    if (ImGui::Button("Another file ...", {-1, 0})) showDialog(session, Dialog::open);
    drawLibrary(session);
}

}  // namespace cutis::app
