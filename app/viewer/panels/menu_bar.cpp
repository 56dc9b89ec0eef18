#include <imgui.h>

#include "app/viewer/actions.h"
#include "app/viewer/autosave.h"
#include "app/viewer/panels/panels.h"

namespace cutis::app {
namespace {

void drawFileMenu(Session& session) {
    if (!ImGui::BeginMenu("File")) return;
    if (ImGui::MenuItem("Open ...", "Ctrl+O")) showDialog(session, Dialog::open);
    if (ImGui::BeginMenu("Open recent", !session.recent.empty())) {
        for (const std::filesystem::path& file : std::vector(session.recent))
            if (ImGui::MenuItem(file.c_str())) openFile(session, file);
        ImGui::EndMenu();
    }
    if (ImGui::MenuItem("Default scene")) openScene(session, "default");
    ImGui::Separator();
    if (ImGui::MenuItem("Save rig", "Ctrl+S")) saveRig(session);
    if (ImGui::MenuItem("Save rig as ...", "Ctrl+Shift+S"))
        showDialog(session, Dialog::saveRig, session.document().rigFile.string());
    if (ImGui::MenuItem("Save skin as ...", nullptr, false, session.geometry != nullptr))
        showDialog(session, Dialog::saveSkin, "untitled.skin.json");
    if (ImGui::MenuItem("Recover unsaved", nullptr, false, session.recoverable)) recoverUnsaved(session);
    ImGui::Separator();
    if (ImGui::MenuItem("Save picture ...", "Ctrl+P"))
        showDialog(session, Dialog::savePicture, "picture.png");
    if (ImGui::MenuItem("Save comparison ...", "Ctrl+E", false, session.compared[0].stored))
        showDialog(session, Dialog::saveComparison, "comparison");
    if (ImGui::MenuItem("Copy command line", "Ctrl+Shift+C")) copyCommandLine(session);
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) quit(session);
    ImGui::EndMenu();
}

void drawEditMenu(Session& session) {
    if (!ImGui::BeginMenu("Edit")) return;
    const std::string undoText = "Undo " + session.edits.undoLabel() + "##undo";
    const std::string redoText = "Redo " + session.edits.redoLabel() + "##redo";
    if (ImGui::MenuItem(undoText.c_str(), "Ctrl+Z", false, session.edits.canUndo())) undo(session);
    if (ImGui::MenuItem(redoText.c_str(), "Ctrl+Shift+Z", false, session.edits.canRedo())) redo(session);
    ImGui::EndMenu();
}

}  // namespace

float drawMenuBar(Session& session) {
    float height = 0;
    if (ImGui::BeginMainMenuBar()) {
        drawFileMenu(session);
        drawEditMenu(session);
        if (ImGui::BeginMenu("View")) {
            ImGui::MenuItem("Panels", "Tab", &session.showPanels);
            ImGui::MenuItem("Light handles", "H", &session.showHandles);
            ImGui::MenuItem("Light mixer", "X", &session.mixer.shown);
            ImGui::MenuItem("Time line", "T", &session.showTimeLine, !session.playback.empty());
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("Help")) {
            ImGui::MenuItem("Hot keys", "F1", &session.showHelp);
            ImGui::EndMenu();
        }
        height = ImGui::GetWindowHeight();
        ImGui::EndMainMenuBar();
    }
    return height;
}

}  // namespace cutis::app
