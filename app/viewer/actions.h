// What menus, hot keys and dialogs do.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/viewer/session.h"

namespace cutis::app {

// With its dot: ".exr" of "A.EXR".
std::string lowercaseExtension(const std::filesystem::path& file);

// By what the name ends in: a glTF scene, a rig file, or else an environment. What cannot be opened changes
// nothing, and the session says why.
void openFile(Session& session, const std::filesystem::path& file);
void openScene(Session& session, const std::string& scene);
void openRig(Session& session, const std::filesystem::path& file);
void openSkin(Session& session, const std::filesystem::path& file);
void openPreset(Session& session, const std::string& name);
void openEnvironment(Session& session, const std::filesystem::path& file);

// Finds the sun of the environment and makes it a light of the rig, in one edit.
void takeSun(Session& session);
// Ends what opening an environment or finding its sun began in the background, once that is done.
void continueTask(Session& session);

// To the file that it came from; asks for one when there is none. True when it is saved.
bool saveRig(Session& session);
bool saveRigAs(Session& session, const std::filesystem::path& file);
// The skin of all materials as a file that `--skin` takes.
bool saveSkinAs(Session& session, const std::filesystem::path& file);
// Saves what is not saved yet, asking for names, then does what waits for that (Session::afterSaving).
void saveNext(Session& session);
// .png as shown, .exr scene-linear: when the full picture of the current state is there. With
// Session::saveAovs also its data channels, FILE.NAME.exr, as `cutis render --aov` names them.
void savePicture(Session& session, const std::filesystem::path& file);
// Writes a picture that is waited for once it is there; its data channels have come.
void continueSaving(Session& session);
void takeAovs(Session& session, AsideResult result);

// The `cutis render` that makes this picture. Names copies of rig and skin in the cache folder where they are not
// saved. Throws Error.
std::string commandLine(Session& session);
void copyCommandLine(Session& session);

// Does it at once when rig and skin are saved; else what becomes of them is asked first.
void whenSaved(Session& session, std::function<void(Session&)> act);
// When all is saved, a picture on its way to disk too; asked for again, without that picture.
void quit(Session& session);
void continueQuitting(Session& session);
void undo(Session& session);
void redo(Session& session);
void showDialog(Session& session, Dialog dialog, const std::string& path = "");

// Puts a file at the head of the recent ones, here and in the cache folder for the next start.
void rememberFile(Session& session, const std::filesystem::path& file);
std::vector<std::filesystem::path> loadRecentFiles();

}  // namespace cutis::app
