#include "app/viewer/viewer.h"

#include <imgui.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

#include "app/viewer/actions.h"
#include "app/viewer/autosave.h"
#include "app/viewer/comparing.h"
#include "app/viewer/frame_times.h"
#include "app/viewer/hot_keys.h"
#include "app/viewer/interface.h"
#include "app/viewer/mixing.h"
#include "app/viewer/scene_loader.h"
#include "app/viewer/scene_poser.h"
#include "app/viewer/shader_reload.h"
#include "app/viewer/thumbnails.h"
#include "app/viewer/window.h"
#include "renderer/core/error.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace {

using Clock = std::chrono::steady_clock;

// Sleep between frames, in seconds: while something moves, while a clock is shown, and with nothing to do.
constexpr double kActive = 0.016, kWorking = 0.1, kIdle = 0.5;
constexpr double kAutosavePeriod = 5;  // seconds
constexpr double kMixPause = 0.8;      // seconds without an edit before what was mixed is rendered

Renderers openRenderers(const std::string& select) {
    gpu::DeviceOptions options;
    options.select = select;
    const auto device = std::make_shared<gpu::Device>(options);
    const auto open = [](std::shared_ptr<gpu::Device> on) -> RenderFunction {
        // The renderer goes before its device.
        struct Opened {
            std::shared_ptr<gpu::Device> device;
            Renderer renderer{*device};
        };
        return [opened = std::make_shared<Opened>(std::move(on))](const RenderInput& input,
                                                                  const RenderSettings& settings) {
            return opened->renderer.render(input, settings);
        };
    };
    return {open(device), open(device), [=] { return open(std::make_shared<gpu::Device>(options)); }};
}

class Viewer {
  public:
    explicit Viewer(const Request& request)
        : window_({titleOf(request.operands[0]), request.settings.width, request.settings.height,
                   request.uiScale, request.device}),
          loader_(Window::wake),
          environmentThumbnails_(Window::wake),
          shaders_(CUTIS_SHADER_FOLDER, Window::wake),
          worker_([device = request.device] { return openRenderers(device); }, Window::wake) {
        session_.request = request;
        session_.uiScale = window_.uiScale();
        session_.uploads.emplace_back(kRoomPicture, DisplayPicture{1, 1, {9, 9, 10, 255}});
        session_.recent = loadRecentFiles();
        offerRecovery(keepAutosave());
        startLoading(request);
    }

    void run() {
        try {
            runUntilQuit();
        } catch (...) {  // the window's device was lost: the rig must not be
            autosave(session_);
            throw;
        }
        discardAutosave();
        window_.hide();
        if (!session_.request.stats.empty()) times_.write(session_.request.stats);
        if (session_.writing.valid()) session_.writing.wait();
    }

    // No picture is begun any more. One is under way, or a scene: only its end can be waited for.
    bool endsWork() {
        worker_.end();
        return worker_.status().working || loader_.loading();
    }

  private:
    void runUntilQuit() {
        while (!session_.quit) {
            window_.waitEvents(pause());
            const Clock::time_point begun = Clock::now();
            takeNews();
            takeInput();
            movePose();
            if (window_.beginFrame()) drawFrame();
            showNewest();
            saveNowAndThen();
            times_.addFrame(std::chrono::duration<double>(Clock::now() - begun).count(), turning(),
                            loader_.loading() || !session_.picture);
        }
    }

    // The view is being dragged.
    bool turning() const {
        const ImGuiIO& io = ImGui::GetIO();
        return !io.WantCaptureMouse && (io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2]);
    }

    double pause() const {
        if (ImGui::IsAnyItemActive() || ImGui::IsAnyMouseDown() || frames_ > 0 || poser_.busy() ||
            session_.playback.playing())
            return kActive;
        const bool working = loader_.loading() || session_.worker.busy || session_.writing.valid() ||
                             session_.task.valid() || shaders_.compiling() ||
                             session_.compareMode == CompareMode::blink || session_.comparing.valid() ||
                             waits_;
        return working ? kWorking : kIdle;
    }

    void startLoading(const Request& request) {
        askedRig_ = session_.document().rig;
        askedSkin_ = session_.document().skin;
        loader_.start(request, true);
    }

    // Undo past the opening of a scene needs that scene back, with the document as it is.
    void reloadIfNeeded() {
        const Document& document = session_.document();
        if (loader_.loading() || document.scene.empty() || document.scene == session_.openedScene ||
            document.scene == unavailable_)
            return;
        Request request = session_.request;
        request.operands = {document.scene};
        request.rig = "none";
        if (document.scene != session_.request.operands[0]) request.skin.reset();
        request.lights.clear();
        request.environment.reset();
        request.environmentIntensity.reset();
        request.environmentRotation.reset();
        request.camera.clear();
        request.animation.reset();
        request.time.reset();
        loader_.start(request, false);
    }

    void takeNews() {
        while (std::optional<LoadedScene> loaded = loader_.take()) takeScene(std::move(*loaded));
        askAboutEdits();
        session_.loading = loader_.loading() ? loader_.name() : "";
        session_.loadingSeconds = loader_.loading() ? loader_.seconds() : 0;
        takeWorkerStatus();
        if (std::optional<WorkerResult> result = worker_.takeResult()) {
            times_.addPicture(*result, turning());
            session_.uploads.emplace_back(kLivePicture, std::move(result->display));
            session_.picture = std::move(*result);
        }
        for (AsideResult& result : worker_.takeAside()) takeAside(std::move(result));
        takeShaders();
        for (auto& [place, picture] : environmentThumbnails_.take())
            session_.uploads.emplace_back(kEnvironmentPictures + place, std::move(picture));
        updateMixer(session_);
        updateDifference(session_);
        continueTask(session_);
        continueSaving(session_);
        continueComparison(session_);
        continueQuitting(session_);
        for (const auto& [number, picture] : std::exchange(session_.uploads, {})) {
            window_.setPicture(number, picture);
            session_.pictures.insert(number);
        }
        for (AsideJob& job : std::exchange(session_.asideJobs, {})) worker_.renderAside(std::move(job));
    }

    void takeWorkerStatus() {
        const WorkerStatus before = std::exchange(session_.worker, worker_.status());
        const WorkerStatus& now = session_.worker;
        if (!now.error.empty() && now.error != before.error) session_.complain(now.error);
        if (now.error.empty()) session_.takeBack(before.error);
        if (!now.asideError.empty() && now.asideError != before.asideError) session_.complain(now.asideError);
        if (now.devicesLost > before.devicesLost && now.error.empty())
            session_.complain("The device was lost, and is opened anew");
    }

    void takeShaders() {
        shaders_.update(std::exchange(session_.reloadShaders, false));
        if (const std::optional<ShaderReload::News> news = shaders_.take()) {
            news->replaced ? session_.say(news->text) : session_.complain(news->text);
            if (news->replaced) restartRenderers(true);
        }
        // Shaders that compile may still not fit the program: those of the build always do.
        if (!shadersReplaced_) return;
        if (!session_.worker.error.empty()) {
            session_.complain("Shaders of the build are back: " + session_.worker.error);
            gpu::replaceShaders({});
            restartRenderers(false);
        } else if (session_.picture && session_.picture->full && !session_.worker.busy) {
            shadersReplaced_ = false;
        }
    }

    void restartRenderers(bool replaced) {
        shadersReplaced_ = replaced;
        session_.picture.reset();
        worker_.restart();
        shownKey_.reset();
    }

    void takeAside(AsideResult result) {
        if (result.id == kPictureA || result.id == kPictureB)
            return takeStatePicture(session_, std::move(result));
        if (result.id == kSavedPicture) return takeAovs(session_, std::move(result));
        if (result.id >= kLightPictures && result.id < kPresetPictures)
            return takeLightPicture(session_, std::move(result));
        if (result.linear) session_.uploads.emplace_back(result.id, std::move(result.display));
    }

    void takeScene(LoadedScene loaded) {
        const Document& document = session_.document();
        if (!loaded.error.empty()) {
            session_.complain(loaded.error);
            unavailable_ = loaded.name;
        } else if (loaded.opens && !document.scene.empty() &&
                   (document.rig != askedRig_ || document.skin != askedSkin_)) {
            asked_ = std::make_shared<LoadedScene>(std::move(loaded));
        } else {
            showScene(std::move(loaded));
        }
    }

    // What was edited while the scene was loading goes by it: that is asked first.
    void askAboutEdits() {
        if (asked_ && session_.dialog == Dialog::none)
            whenSaved(session_, [this, loaded = std::exchange(asked_, nullptr)](Session&) {
                showScene(std::move(*loaded));
            });
    }

    void showScene(LoadedScene loaded) {
        unavailable_.clear();
        session_.geometry = loaded.geometry;
        session_.scene = loaded.scene;
        poser_.open(loaded.spare);
        session_.playback.open(*loaded.geometry, loaded.pose);
        session_.posed = loaded.pose;
        session_.openedScene = loaded.name;
        session_.loadedSkin = session_.savedSkin = loaded.document.skin;
        session_.known = loaded.known;
        session_.derivedVersion = 0;
        session_.selectedMaterial = session_.selectedCharacter = -1;
        shownKey_.reset();
        worker_.forgetAside(0, std::numeric_limits<int>::max());
        session_.compared = {};
        session_.mixer.contributions.clear();
        // Cameras of a file are made for the usual picture; a view that is framed here fills what room there
        // is.
        if (loaded.opens) session_.pictureAspect = loaded.geometry->cameras.empty() ? 0 : 16.0 / 9;
        if (loaded.opens && loaded.name != "default") rememberFile(session_, loaded.name);
        if (loaded.opens && session_.document().scene.empty()) {
            openFirst(loaded.document);
        } else if (loaded.opens) {
            session_.edits.endGesture();
            session_.edits.apply("Open " + loaded.name,
                                 [&](Document& document) { document = loaded.document; });
            session_.edits.endGesture();
            session_.edits.markSaved();
            session_.say("Opened " + loaded.name);
        }
        window_.setTitle(titleOf(loaded.name));
    }

    // A rig that was opened while the first scene was loading stays.
    void openFirst(const Document& opened) {
        const Document before = session_.document();
        const bool changed = session_.edits.canUndo(), unsaved = session_.edits.unsaved();
        session_.edits.reset(opened);
        if (!changed) return;
        session_.edits.apply("Open rig",
                             [&](Document& document) { replaceRig(document, before.rig, before.rigFile); });
        session_.edits.endGesture();
        if (!unsaved) session_.edits.markSaved();
    }

    void takeInput() {
        const bool typing = ImGui::GetIO().WantTextInput;
        for (const KeyPress& press : window_.takeKeys()) {
            frames_ = 3;
            if (session_.dialog == Dialog::none) runHotKey(session_, press, typing);
        }
        for (const std::filesystem::path& file : window_.takeDrops()) openFile(session_, file);
        if (window_.takeCloseRequest()) quit(session_);
        if (!session_.clipboard.empty()) window_.setClipboard(std::exchange(session_.clipboard, {}));
        if (session_.opening) startLoading(*std::exchange(session_.opening, std::nullopt));
        reloadIfNeeded();
    }

    // The interface's scene and the pictures follow the time line as fast as they can: poses that come while
    // one is computed are left out.
    void movePose() {
        const Clock::time_point now = Clock::now();
        session_.playback.advance(std::chrono::duration<double>(now - std::exchange(played_, now)).count());
        try {
            if (std::optional<ScenePoser::Posed> posed = poser_.take(session_.geometry)) {
                session_.geometry = std::move(posed->scene);
                session_.posed = posed->pose;
                ++session_.poses;
                session_.derivedGeometry.reset();  // which may be this scene, in the pose before the last
            }
        } catch (const Error& error) {
            session_.playback.pause();
            refused_ = session_.playback.pose();
            session_.complain(error.what());
        }
        const Pose& wanted = session_.playback.pose();
        if (session_.playback.empty() || poser_.busy() || wanted == session_.posed || wanted == refused_)
            return;
        refused_.reset();
        poser_.start(wanted);
    }

    void drawFrame() {
        if (frames_ > 0) --frames_;
        updateDerived(session_);
        session_.endMessage(Clock::now());
        window_.endFrame(drawInterface(session_, environmentThumbnails_));
        if (!ImGui::IsAnyItemActive() && !ImGui::IsAnyMouseDown() && ImGui::GetIO().MouseWheel == 0)
            session_.edits.endGesture();
    }

    // Hands the newest state to the worker when it is not what was handed over last.
    void showNewest() {
        if (!session_.scene || session_.view.width <= 0 || session_.view.height <= 0 ||
            session_.document().scene != session_.openedScene)
            return;
        // Another light's shadow or map is shown when another light is chosen.
        const Inspect::What what = session_.overlay.inspect.what;
        if (what == Inspect::What::shadow || what == Inspect::What::lightMap)
            session_.overlay.inspect.index = std::max(session_.selectedLight, 0);
        const Key key{session_.shownVersion(), session_.view.width, session_.view.height, session_.overlay};
        waits_ = false;
        if (key == shownKey_) return;
        if (key.version != seenVersion_) {
            changed_ = Clock::now();
            const bool lit = session_.edits.version() != editVersion_ && !turning();
            times_.addEdit(key.version, !lit, session_.worker.busy);
            editVersion_ = session_.edits.version();
        }
        seenVersion_ = key.version;
        // While the mixer shows what is edited, nothing needs to be rendered until the faders rest.
        waits_ = mixShows(session_) && Clock::now() - changed_ < std::chrono::duration<double>(kMixPause);
        if (waits_) return;
        shownKey_ = key;
        updateDerived(session_);
        RenderState state;
        try {
            state = stateFor(session_, session_.document());
        } catch (const Error& error) {
            session_.complain(error.what());
            return;
        }
        state.overlay = session_.overlay;
        worker_.show(key.version, std::move(state));
    }

    void offerRecovery(bool possible) {
        if (possible && !session_.recoverable)
            session_.announce("What was not saved is kept: File, Recover unsaved brings it back");
        session_.recoverable = possible;
    }

    void saveNowAndThen() {
        if (Clock::now() - autosaved_ < std::chrono::duration<double>(kAutosavePeriod)) return;
        autosaved_ = Clock::now();
        offerRecovery(findLeftBehind());
        if (session_.edits.version() == autosavedVersion_) return;
        autosavedVersion_ = session_.edits.version();
        autosave(session_);
    }

    struct Key {
        std::uint64_t version = 0;
        int width = 0, height = 0;
        Shown overlay;
        bool operator==(const Key&) const = default;
    };

    Session session_;
    Window window_;
    SceneLoader loader_;
    ScenePoser poser_;
    Clock::time_point played_ = Clock::now();  // up to when the time line has gone on
    std::optional<Pose> refused_;              // a pose that the scene cannot take
    std::string unavailable_;                  // a scene that could not be loaded: not tried again by itself
    Rig askedRig_;                             // as it was when the scene that is being loaded was asked for
    std::vector<std::optional<SkinMaterial>> askedSkin_;
    std::shared_ptr<LoadedScene> asked_;  // it is there, and waits for what becomes of edits made meanwhile
    std::optional<Key> shownKey_;
    int frames_ = 0;  // to draw without a pause: ImGui answers a key in the frame after
    Clock::time_point autosaved_ = Clock::now();
    std::uint64_t autosavedVersion_ = 0;
    Clock::time_point changed_;  // the document, last
    std::uint64_t seenVersion_ = 0, editVersion_ = 0;
    bool waits_ = false;  // the mixer shows a change that is not rendered yet
    EnvironmentThumbnails environmentThumbnails_;
    ShaderReload shaders_;
    bool shadersReplaced_ = false;  // and no picture was made with them yet
    FrameTimes times_;
    RenderWorker worker_;  // last: it ends first
};

}  // namespace

void runViewer(const Request& request) {
    Viewer viewer(request);
    viewer.run();
    if (!viewer.endsWork()) return;
    // Nobody waits for a picture or a scene that nobody will see. All files are written; the system takes
    // back the rest.
    std::fflush(nullptr);
    std::quick_exit(gpu::validationMessages() ? 1 : 0);
}

}  // namespace cutis::app
