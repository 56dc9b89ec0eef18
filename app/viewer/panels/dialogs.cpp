// Questions that must be answered before anything else: a path, or what to do with an unsaved rig.
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/viewer/actions.h"
#include "app/viewer/panels/panels.h"

namespace cutis::app {
namespace {

constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;

void close(Session& session) {
    session.dialog = Dialog::none;
    ImGui::CloseCurrentPopup();
}

void drawPathDialog(Session& session, const char* what, const char* verb, const char* details,
                    void (*act)(Session&, const std::filesystem::path&)) {
    ImGui::TextUnformatted(what);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 34);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    bool done = ImGui::InputText("##path", &session.dialogPath, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::TextDisabled("%s", details);
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
        close(session);
    }
}

void drawUnsaved(Session& session) {
    ImGui::TextUnformatted("The rig has changes that are not saved.");
    ImGui::Spacing();
    if (ImGui::Button("Save and quit")) {
        close(session);
        if (saveRig(session)) session.quit = true;
    }
    ImGui::SameLine();
    if (ImGui::Button("Quit without saving")) {
        session.quit = true;
        close(session);
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) close(session);
}

void saveAs(Session& session, const std::filesystem::path& file) {
    saveRigAs(session, file);
}

}  // namespace

void drawDialogs(Session& session) {
    if (session.dialogOpens) ImGui::OpenPopup("cutis");
    session.dialogOpens = false;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal("cutis", nullptr, kFlags | ImGuiWindowFlags_NoTitleBar)) return;
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE)) close(session);
    switch (session.dialog) {
        case Dialog::open:
            drawPathDialog(session, "Open a file", "Open",
                           ".gltf or .glb: a scene; .rig.json: a rig; .exr or .hdr: an environment",
                           openFile);
            break;
        case Dialog::saveRig:
            drawPathDialog(session, "Save the rig as", "Save", "A file that is there is replaced", saveAs);
            break;
        case Dialog::savePicture:
            drawPathDialog(session, "Save the picture as", "Save",
                           ".png: as shown; .exr: scene-linear radiance. A file that is there is replaced",
                           savePicture);
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
