// Questions that must be answered before anything else: a path, or what to do with an unsaved rig.
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <functional>
#include <utility>

#include "app/viewer/actions.h"
#include "app/viewer/comparing.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace {

constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;

void close(Session& session) {
    session.dialog = Dialog::none;
    ImGui::CloseCurrentPopup();
}

void cancel(Session& session) {
    session.afterSaving = nullptr;
    close(session);
}

void drawPathDialog(
    Session& session, const char* what, const char* verb, const char* details,
    void (*act)(Session&, const std::filesystem::path&), const std::function<void()>& drawMore = [] {}) {
    ImGui::TextUnformatted(what);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 34);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    bool done = ImGui::InputText("##path", &session.dialogPath,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::TextDisabled("%s", details);
    drawMore();
    ImGui::Spacing();
    ImGui::BeginDisabled(session.dialogPath.empty());
    done |= ImGui::Button(verb);
    ImGui::EndDisabled();
    ImGui::SameLine();
    const bool cancelled = ImGui::Button("Cancel");
    if (done && !session.dialogPath.empty()) {
        const std::string path = session.dialogPath;
        close(session);
        act(session, path);
    } else if (cancelled) {
        cancel(session);
    }
}

void drawUnsaved(Session& session) {
    const bool rig = session.edits.unsaved(), skin = session.skinUnsaved();
    ImGui::Text("The %s changes that are not saved.", rig && skin ? "rig and the skin have"
                                                      : rig       ? "rig has"
                                                                  : "skin has");
    ImGui::Spacing();
    if (ImGui::Button("Save")) {
        close(session);
        saveNext(session);
    }
    ImGui::SameLine();
    if (ImGui::Button("Go on without saving")) {
        close(session);
        std::exchange(session.afterSaving, nullptr)(session);
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) cancel(session);
}

void saveAs(Session& session, const std::filesystem::path& file) {
    saveRigAs(session, file);
}

void saveSkin(Session& session, const std::filesystem::path& file) {
    saveSkinAs(session, file);
}

}  // namespace

void drawDialogs(Session& session) {
    if (session.dialogOpens) ImGui::OpenPopup("cutis");
    session.dialogOpens = false;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal("cutis", nullptr, kFlags | ImGuiWindowFlags_NoTitleBar)) return;
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE)) cancel(session);
    switch (session.dialog) {
        case Dialog::open:
            drawPathDialog(
                session, "Open a file", "Open",
                ".gltf, .glb: a scene; .rig.json: a rig; .skin.json: skin; .exr, .hdr: an environment",
                openFile);
            break;
        case Dialog::saveRig:
            drawPathDialog(session, "Save the rig as", "Save", "A file that is there is replaced", saveAs);
            break;
        case Dialog::saveSkin:
            drawPathDialog(session, "Save the skin as", "Save",
                           "How all materials scatter, for --skin. A file that is there is replaced",
                           saveSkin);
            break;
        case Dialog::savePicture:
            drawPathDialog(session, "Save the picture as", "Save",
                           ".png: as shown; .exr: scene-linear radiance. A file that is there is replaced",
                           savePicture, [&] {
                               ImGui::Checkbox("With data channels", &session.saveAovs);
                               hint(
                                   "Also FILE.NAME.exr for diffuse, specular, irradiance, thickness, albedo, "
                                   "normal, position, depth and character");
                           });
            break;
        case Dialog::saveComparison:
            drawPathDialog(session, "Save the comparison in the folder", "Save",
                           "Pictures, maps, figures and index.html, as cutis compare writes them", saveComparison);
            break;
        case Dialog::unsaved:
            drawUnsaved(session);
            break;
        case Dialog::none:
            ImGui::CloseCurrentPopup();
            break;
    }
    ImGui::EndPopup();
}

}  // namespace cutis::app
