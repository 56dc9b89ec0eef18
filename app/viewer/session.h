// All that panels read and change: the document behind its edit list, and what is of this moment only.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/viewer/edits.h"
#include "app/viewer/render_worker.h"
#include "app/viewer/window.h"

namespace cutis::app {

// A state that was put aside, with the newest picture of it.
struct StoredState {
    bool stored = false;
    Document document;
    std::uint64_t version = 0;  // of the edit list: a better picture of this version replaces the one here
    bool full = false;          // the picture is the full one
    DisplayPicture display;
    std::shared_ptr<const Picture> linear;
    bool changed = false;  // the window does not have the picture yet
};

enum class CompareMode { off, wipe, sideBySide, blink };

enum class Dialog { none, open, saveRig, savePicture, unsaved };

struct Session {
    Request request;  // options of the command line
    EditList edits;
    double uiScale = 1;

    // The scene without texels, with the document's skin; null until one is loaded. The renderer's own copy
    // has the texels.
    std::shared_ptr<Scene> geometry, scene;
    glm::dvec3 headCentre{0};            // of everyone's heads: what lights turn round
    std::vector<double> headIrradiance;  // per light, luminance at the head that it faces, as if it were on
    std::uint64_t derivedVersion = 0;    // of the edit list, when these were computed

    int selectedLight = 0, selectedMaterial = -1, selectedCharacter = -1;  // -1: none, everyone
    PixelRect view;  // where the picture is, in pixels of the window

    std::optional<WorkerResult> picture;  // newest
    WorkerStatus worker;
    std::string loading;  // name of the scene under way; empty: none
    double loadingSeconds = 0;
    std::string openedScene;                              // what `geometry` is
    std::vector<std::optional<SkinMaterial>> loadedSkin;  // per material, as the file has it

    std::array<StoredState, 2> compared;  // A, B
    CompareMode compareMode = CompareMode::off;
    double wipe = 0.5;  // of the picture's width

    Dialog dialog = Dialog::none;
    bool dialogOpens = false;  // in the next frame
    std::string dialogPath;
    bool showHelp = false, showHandles = true;

    std::string message;  // of the last action
    bool messageIsError = false;
    std::filesystem::path savingPicture;  // waits for the full picture; empty: none
    std::future<std::string> writing;     // the picture on its way to disk; gives what to say
    std::string clipboard;                // what to put there; empty: nothing
    std::optional<Request> opening;       // a scene to load
    bool recoverable = false;             // a rig was left unsaved last time
    bool quit = false;

    const Document& document() const { return edits.document(); }
    bool hasLight() const {
        return selectedLight >= 0 && selectedLight < static_cast<int>(document().rig.lights.size());
    }
    const Light& light() const { return document().rig.lights[static_cast<std::size_t>(selectedLight)]; }
    double aspect() const { return view.height > 0 ? double(view.width) / view.height : 1.0; }

    void say(const std::string& text) { message = text, messageIsError = false; }
    // Also on stderr, for whoever started the program from a terminal.
    void complain(const std::string& text);
};

// The camera that the document's view is, for the picture's aspect. The scene must be there.
Camera currentCamera(const Session& session);
// Changes the selected light, as one edit called "LABEL of NAME".
void editLight(Session& session, const std::string& label, const std::function<void(Light&)>& change);
// Changes the view: a camera of the file becomes one moved by hand first.
void editView(Session& session, const std::string& label, const std::function<void(OrbitCamera&)>& change);
// Brings geometry and headIrradiance up to the document.
void updateDerived(Session& session);

}  // namespace cutis::app
