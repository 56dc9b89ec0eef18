// All that panels read and change: the document behind its edit list, and what is of this moment only.
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/tolerance.h"
#include "app/viewer/edits.h"
#include "app/viewer/mixer.h"
#include "app/viewer/place_by_light.h"
#include "app/viewer/playback.h"
#include "app/viewer/render_worker.h"
#include "app/viewer/window.h"

namespace cutis::app {

// Numbers of pictures in the window, and of what is rendered beside the view: the smaller the sooner.
inline constexpr int kRoomPicture = -1;  // one dark pixel: what is about the view
inline constexpr int kLivePicture = 0, kPictureA = 1, kPictureB = 2, kDifferencePicture = 3, kMixPicture = 4;
inline constexpr int kSavedPicture = 5;  // only its data channels, never shown
inline constexpr int kLightPictures = 100, kPresetPictures = 100000, kEnvironmentPictures = 200000;  // and on

// A state that was put aside, with its full picture once that is rendered.
struct StoredState {
    bool stored = false;
    std::string name;
    Document document;
    std::shared_ptr<const Picture> linear;
};

enum class CompareMode { off, wipe, sideBySide, blink, difference };
enum class DifferenceMap { relative, perceived };

// What the comparison of the two stored states found. As `cutis compare` has it.
struct ComparedFigures {
    const Picture *a = nullptr, *b = nullptr;  // of which pictures; not dereferenced
    double relativeL2 = 0, p99 = 0, flip = 0, lightRatio = 0;
    Picture map, flipMap;
    std::string problem;
};

// The light mixer: pictures of each light alone, and what of the document they were made for.
struct MixerStrip {
    bool shown = false;
    std::vector<Contribution> contributions;
    View view;
    std::vector<std::optional<SkinMaterial>> skin;
    std::shared_ptr<Scene> scene;
    Pose pose;
    int width = 0, height = 0;
    std::uint64_t mixedVersion = 0;  // the session's shownVersion, for which kMixPicture is
    bool complete() const;           // all pictures are there
};

// A picture that is to be saved once it is there.
struct SavedPicture {
    std::filesystem::path file;  // empty: none
    bool aovs = false;           // with data channels, which are rendered first
    std::shared_ptr<const Picture> picture;  // null until the full one is there
    double exposure = 0;
};

// What a file on its way to disk ends with.
struct SaidOfSaving {
    std::string text;
    bool failed = false;
};

enum class Dialog { none, open, saveRig, saveSkin, savePicture, saveComparison, unsaved };

struct Session {
    Request request;  // options of the command line
    EditList edits;
    double uiScale = 1;

    // The scene without texels, with the document's skin; null until one is loaded. The renderer's own copy
    // has the texels.
    std::shared_ptr<Scene> geometry, scene;
    Playback playback;
    Pose posed;                     // that `geometry` is in, and pictures are made of
    std::uint64_t poses = 0;        // how often it has changed
    glm::dvec3 headCentre{0};            // of everyone's heads: what lights turn round
    std::vector<double> headIrradiance;  // per light, luminance at the head that it faces, as if it were on
    std::uint64_t derivedVersion = 0;    // of the edit list, when these were computed
    std::shared_ptr<Scene> derivedGeometry;  // these follow from
    std::vector<std::optional<SkinMaterial>> derivedSkin;
    Rig derivedRig;

    KnownFront known{defaultFront()};  // of the error of settings

    int selectedLight = 0, selectedMaterial = -1, selectedCharacter = -1;  // -1: none, everyone
    PixelRect room;  // between the panels: the view and bars about it
    PixelRect view;  // where the picture is, in pixels of the window

    std::optional<WorkerResult> picture;  // newest
    WorkerStatus worker;
    std::string loading;  // name of the scene under way; empty: none
    double loadingSeconds = 0;
    std::string openedScene;                              // what `geometry` is
    std::vector<std::optional<SkinMaterial>> loadedSkin;  // per material, as the file and --skin have it
    std::vector<std::optional<SkinMaterial>> savedSkin;   // as it was loaded or saved last

    std::array<StoredState, 2> compared;  // A, B
    CompareMode compareMode = CompareMode::off;
    DifferenceMap differenceMap = DifferenceMap::relative;
    std::optional<ComparedFigures> figures;
    std::future<ComparedFigures> comparing;
    DifferenceMap mapShown = DifferenceMap::relative;  // that kDifferencePicture is
    double wipe = 0.5;  // of the picture's width

    MixerStrip mixer;
    Shown overlay;                              // no AOV: the picture
    std::optional<PlaceBy> placing;             // dragging in the picture places the chosen light
    double pictureAspect = 0;                   // width over height; 0: fills the view
    std::vector<std::filesystem::path> recent;  // opened last, newest first

    // Passed on by the viewer in each frame.
    std::vector<std::pair<int, DisplayPicture>> uploads;  // to the window
    std::vector<PicturePart> thumbnails;                  // in panels, of this frame
    std::vector<AsideJob> asideJobs;
    std::set<int> pictures;  // numbers that the window has

    Dialog dialog = Dialog::none;
    bool dialogOpens = false;  // in the next frame
    std::string dialogPath;
    std::function<void(Session&)> afterSaving;  // what waits for the rig to be saved, or given up; empty: nothing
    bool showHelp = false, showHandles = true, showPanels = true, showTimeLine = true;

    std::string message;  // at the bottom of the window; see say()
    bool messageIsError = false;
    std::optional<std::chrono::steady_clock::time_point> messageEnds;  // none: when something else is said
    SavedPicture saving;
    std::filesystem::path savingComparison;  // a folder, until both pictures are there; empty: none
    bool saveAovs = false;  // pictures are saved with their data channels
    // Something that takes longer than a frame: what it gives is run on the session once it is there. Others
    // come after it, one at a time.
    std::future<std::function<void(Session&)>> task;
    std::deque<std::function<std::function<void(Session&)>()>> nextTasks;
    std::future<SaidOfSaving> writing;    // a picture or a comparison on its way to disk
    std::string clipboard;                // what to put there; empty: nothing
    std::optional<Request> opening;       // a scene to load
    bool recoverable = false;             // something was left unsaved last time
    bool reloadShaders = false;           // in the next frame
    // Set to the edits' version: quits once nothing is on its way to disk, unless something is edited meanwhile.
    std::optional<std::uint64_t> quitsWhenSaved;
    bool quit = false;

    const Document& document() const { return edits.document(); }
    // The scene's skin is not what was loaded or saved last.
    bool skinUnsaved() const {
        return geometry && document().scene == openedScene && document().skin != savedSkin;
    }
    bool hasLight() const {
        return selectedLight >= 0 && selectedLight < static_cast<int>(document().rig.lights.size());
    }
    // Grows with whatever changes the picture of a view of this size, edits and poses.
    std::uint64_t shownVersion() const { return edits.version() + poses; }
    // The full picture of the document, pose and size of the view as they are is there.
    bool complete() const {
        return picture && picture->full && picture->version == shownVersion() &&
               picture->linear->width == view.width && picture->linear->height == view.height;
    }
    // A picture or a comparison is on its way to disk, or waits for being rendered.
    bool saves() const {
        return !saving.file.empty() || saving.picture || !savingComparison.empty() || writing.valid();
    }
    const Light& light() const { return document().rig.lights[static_cast<std::size_t>(selectedLight)]; }
    double aspect() const { return view.height > 0 ? double(view.width) / view.height : 1.0; }

    // At the bottom of the window: what was done, for a while; what is under way, until something else is
    // said; what went wrong, for longer, and on stderr for whoever started the program from a terminal.
    void say(const std::string& text);
    void announce(const std::string& text);
    void complain(const std::string& text);
    // That is not so any more.
    void takeBack(const std::string& text);
    // Ends a message whose time is over.
    void endMessage(std::chrono::steady_clock::time_point now);
};

// The camera that the document's view is, for the picture's aspect. The scene must be there.
Camera currentCamera(const Session& session);
// Changes the selected light, as one edit called "LABEL of NAME".
void editLight(Session& session, const std::string& label, const std::function<void(Light&)>& change);
// Changes the view: a camera of the file becomes one moved by hand first.
void editView(Session& session, const std::string& label, const std::function<void(OrbitCamera&)>& change);
// What the worker needs for a picture of that document in the current scene. Throws Error: no such camera, no
// such subject of a light.
RenderState stateFor(const Session& session, const Document& document);
// Brings geometry and headIrradiance up to the document.
void updateDerived(Session& session);

}  // namespace cutis::app
