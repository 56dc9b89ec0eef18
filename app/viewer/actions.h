// What menus, hot keys and dialogs do.
#pragma once

#include <filesystem>
#include <string>

#include "app/viewer/session.h"

namespace cutis::app {

// By what the name ends in: a glTF scene, a rig file, or else an environment. What cannot be opened changes
// nothing, and the session says why.
void openFile(Session& session, const std::filesystem::path& file);
void openScene(Session& session, const std::string& scene);
void openRig(Session& session, const std::filesystem::path& file);
void openPreset(Session& session, const std::string& name);
void openEnvironment(Session& session, const std::filesystem::path& file);

// Finds the sun of the environment and makes it a light of the rig, in one edit.
void takeSun(Session& session);
// Ends what opening an environment or finding its sun began in the background, once that is done.
void continueTask(Session& session);

// To the file that it came from; asks for one when there is none. True when it is saved.
bool saveRig(Session& session);
bool saveRigAs(Session& session, const std::filesystem::path& file);
// .png as shown, .exr scene-linear: when the full picture of the current state is there.
void savePicture(Session& session, const std::filesystem::path& file);
// Writes a picture that is waited for once it is there.
void continueSaving(Session& session);

// The `cutis render` that makes this picture. Names a copy of the rig in the cache folder when the rig is not
// saved, and says what no option can express.
std::string commandLine(Session& session);
void copyCommandLine(Session& session);

// At once when the rig is saved, else asks.
void quit(Session& session);
void undo(Session& session);
void redo(Session& session);
void showDialog(Session& session, Dialog dialog, const std::string& path = "");

// Puts a file at the head of the recent ones, here and in the cache folder for the next start.
void rememberFile(Session& session, const std::filesystem::path& file);
std::vector<std::filesystem::path> loadRecentFiles();

// The rig that is not saved, kept in the cache folder in case this program ends badly.
std::filesystem::path autosaveFile();
void autosave(Session& session);
void discardAutosave();
// At the start: puts aside what the last run left, so that this one does not write over it. True when there
// is something to recover.
bool keepAutosave();
void recoverRig(Session& session);

}  // namespace cutis::app
