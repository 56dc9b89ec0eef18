#include "app/viewer/viewer.h"

#include <imgui.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/viewer/actions.h"
#include "app/viewer/hot_keys.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/scene_loader.h"
#include "app/viewer/view_input.h"
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
constexpr double kBlinkPeriod = 0.7;   // seconds that each of two pictures is shown
constexpr float kPanelWidth = 300;     // at a scale of 1

std::string titleOf(const std::string& scene) {
    return "cutis - " + std::filesystem::path(scene).filename().string();
}

RenderFunction openRenderer(const std::string& select) {
    gpu::DeviceOptions options;
    options.select = select;
    auto device = std::make_shared<gpu::Device>(options);
    return [device](const RenderInput& input, const RenderSettings& settings) {
        return renderPicture(*device, input, settings);
    };
}

class Viewer {
  public:
    explicit Viewer(const Request& request)
        : window_({titleOf(request.operands[0]), request.settings.width, request.settings.height,
                   request.uiScale, request.device}),
          loader_(Window::wake),
          worker_([device = request.device] { return openRenderer(device); }, Window::wake) {
        session_.request = request;
        session_.uiScale = window_.uiScale();
        session_.recoverable = keepAutosave();
        if (session_.recoverable)
            session_.say("A rig that was not saved is kept: File, Recover rig brings it back");
        startLoading(request);
    }

    void run() {
        while (!session_.quit) {
            window_.waitEvents(pause());
            takeNews();
            takeInput();
            if (window_.beginFrame()) drawFrame();
            showNewest();
            saveNowAndThen();
        }
        discardAutosave();
        window_.hide();  // the picture under way may take a while to end
    }

  private:
    double pause() const {
        if (ImGui::IsAnyItemActive() || ImGui::IsAnyMouseDown() || frames_ > 0) return kActive;
        const bool working = loader_.loading() || session_.worker.busy || session_.writing.valid() ||
                             session_.compareMode == CompareMode::blink;
        return working ? kWorking : kIdle;
    }

    void startLoading(const Request& request) {
        opens_ = true;
        loader_.start(request);
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
        request.lights.clear();
        request.environment.reset();
        request.environmentIntensity.reset();
        request.environmentRotation.reset();
        request.camera.clear();
        opens_ = false;
        loader_.start(request);
    }

    void takeNews() {
        if (std::optional<LoadedScene> loaded = loader_.take()) takeScene(std::move(*loaded));
        session_.loading = loader_.loading() ? loader_.name() : "";
        session_.loadingSeconds = loader_.loading() ? loader_.seconds() : 0;
        session_.worker = worker_.status();
        if (std::optional<WorkerResult> result = worker_.takeResult()) {
            window_.setPicture(PictureSlot::live, result->display);
            session_.picture = std::move(*result);
            refreshStored();
        }
        for (std::size_t slot = 0; slot < session_.compared.size(); ++slot) {
            StoredState& state = session_.compared[slot];
            if (!state.changed) continue;
            window_.setPicture(slot == 0 ? PictureSlot::a : PictureSlot::b, state.display);
            state.changed = false;
        }
        continueSaving(session_);
    }

    void takeScene(LoadedScene loaded) {
        if (!loaded.error.empty()) {
            session_.complain(loaded.error);
            unavailable_ = loaded.name;
            return;
        }
        unavailable_.clear();
        session_.geometry = loaded.geometry;
        session_.scene = loaded.scene;
        session_.openedScene = loaded.name;
        session_.loadedSkin = loaded.document.skin;
        session_.derivedVersion = 0;
        session_.selectedMaterial = session_.selectedCharacter = -1;
        shownKey_ = {};
        if (opens_ && session_.document().scene.empty()) {
            session_.edits.reset(loaded.document);
        } else if (opens_) {
            session_.edits.endGesture();
            session_.edits.apply("Open " + loaded.name,
                                 [&](Document& document) { document = loaded.document; });
            session_.edits.endGesture();
            session_.edits.markSaved();
        }
        window_.setTitle(titleOf(loaded.name));
    }

    // A picture that was stored as a preview becomes the full one when that is there.
    void refreshStored() {
        for (StoredState& state : session_.compared) {
            if (!state.stored || state.full || state.version != session_.picture->version) continue;
            state.display = session_.picture->display;
            state.linear = session_.picture->linear;
            state.full = session_.picture->full;
            state.changed = true;
        }
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

    void drawFrame() {
        if (frames_ > 0) --frames_;
        updateDerived(session_);
        const float scale = static_cast<float>(session_.uiScale);
        const float top = drawMenuBar(session_);
        const float bottom = ImGui::GetFrameHeight() + 4 * scale;
        layOut(top, bottom);
        if (session_.geometry) {
            drawSide("##rig", 0, top, bottom, [this] {
                drawRigPanel(session_);
                drawLightPanel(session_);
            });
            drawSide("##look", ImGui::GetIO().DisplaySize.x - panelWidth(), top, bottom,
                     [this] { drawTabs(); });
        }
        drawStatusBar(session_, bottom);
        drawHelp(session_);
        drawDialogs(session_);
        handleView(session_);
        drawLoading();
        const std::vector<PicturePart> parts = pictureParts();
        window_.endFrame(parts);
        const ImGuiIO& io = ImGui::GetIO();
        if (!ImGui::IsAnyItemActive() && !ImGui::IsAnyMouseDown() && io.MouseWheel == 0)
            session_.edits.endGesture();
    }

    float panelWidth() const { return kPanelWidth * static_cast<float>(session_.uiScale); }

    void layOut(float top, float bottom) {
        const ImVec2 display = ImGui::GetIO().DisplaySize;
        const float side = panelWidth();
        session_.view = {static_cast<int>(side), static_cast<int>(top),
                         static_cast<int>(display.x - 2 * side), static_cast<int>(display.y - top - bottom)};
    }

    template <class Draw>
    void drawSide(const char* name, float x, float top, float bottom, const Draw& draw) {
        ImGui::SetNextWindowPos({x, top});
        ImGui::SetNextWindowSize({panelWidth(), ImGui::GetIO().DisplaySize.y - top - bottom});
        ImGui::Begin(name, nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoBringToFrontOnFocus);
        draw();
        ImGui::End();
    }

    void drawTabs() {
        if (!ImGui::BeginTabBar("look")) return;
        const auto tab = [this](const char* name, const auto& draw) {
            if (!ImGui::BeginTabItem(name)) return;
            draw();
            ImGui::EndTabItem();
        };
        tab("View", [this] {
            drawCameraPanel(session_);
            drawEnvironmentPanel(session_);
        });
        tab("Skin", [this] { drawSkinPanel(session_); });
        tab("Compare", [this] { drawComparePanel(session_); });
        tab("Plan", [this] { drawPlanPanel(session_); });
        ImGui::EndTabBar();
    }

    void drawLoading() {
        if (!loader_.loading()) return;
        const ImVec2 display = ImGui::GetIO().DisplaySize;
        const float scale = static_cast<float>(session_.uiScale);
        ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
        ImGui::SetNextWindowSize({320 * scale, 0});
        ImGui::Begin("##loading", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
        ImGui::Text("Loading %s", titleOf(loader_.name()).substr(8).c_str());
        // Nobody knows how long a scene takes: the bar nears its end and never gets there.
        const double seconds = loader_.seconds();
        ImGui::ProgressBar(static_cast<float>(seconds / (seconds + 2)), {-1, 6 * scale}, "");
        ImGui::End();
    }

    // Which pictures lie where behind the interface.
    std::vector<PicturePart> pictureParts() const {
        const PixelRect& view = session_.view;
        const bool comparing = session_.compareMode != CompareMode::off && session_.compared[0].stored;
        if (!comparing) return {{PictureSlot::live, view, view}};
        const PictureSlot other = session_.compared[1].stored ? PictureSlot::b : PictureSlot::live;
        PixelRect left = view, right = view;
        if (session_.compareMode == CompareMode::blink) {
            const double time = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
            const bool first = std::fmod(time, 2 * kBlinkPeriod) < kBlinkPeriod;
            return {{first ? PictureSlot::a : other, view, view}};
        }
        if (session_.compareMode == CompareMode::sideBySide) {
            // Both whole, at half the size.
            left.width = right.width = view.width / 2;
            left.height = right.height = view.height / 2;
            left.y = right.y = view.y + view.height / 4;
            right.x += left.width;
            return {{PictureSlot::a, left, left}, {other, right, right}};
        }
        left.width = static_cast<int>(session_.wipe * view.width);
        right.x += left.width;
        right.width -= left.width;
        return {{PictureSlot::a, view, left}, {other, view, right}};
    }

    // Hands the newest state to the worker when it is not what was handed over last.
    void showNewest() {
        if (!session_.scene || session_.view.width <= 0 || session_.view.height <= 0 ||
            session_.document().scene != session_.openedScene)
            return;
        const Key key{session_.edits.version(), session_.view.width, session_.view.height, true};
        if (key == shownKey_) return;
        shownKey_ = key;
        updateDerived(session_);
        RenderState state;
        state.scene = session_.scene;
        state.skin = session_.document().skin;
        state.rig = effectiveRig(session_.document());
        state.settings = session_.request.settings;
        state.settings.width = session_.view.width;
        state.settings.height = session_.view.height;
        try {
            state.camera = currentCamera(session_);
            resolvePlacements(state.rig, *session_.geometry);
        } catch (const Error& error) {
            session_.complain(error.what());
            return;
        }
        worker_.show(key.version, std::move(state));
    }

    void saveNowAndThen() {
        if (Clock::now() - autosaved_ < std::chrono::duration<double>(kAutosavePeriod)) return;
        autosaved_ = Clock::now();
        if (session_.edits.version() == autosavedVersion_) return;
        autosavedVersion_ = session_.edits.version();
        autosave(session_);
    }

    struct Key {
        std::uint64_t version = 0;
        int width = 0, height = 0;
        bool set = false;
        bool operator==(const Key&) const = default;
    };

    Session session_;
    Window window_;
    SceneLoader loader_;
    bool opens_ = true;        // what is loading becomes the document
    std::string unavailable_;  // a scene that could not be loaded: not tried again by itself
    Key shownKey_;
    int frames_ = 0;  // to draw without a pause: ImGui answers a key in the frame after
    Clock::time_point autosaved_ = Clock::now();
    std::uint64_t autosavedVersion_ = 0;
    RenderWorker worker_;  // last: it ends first
};

}  // namespace

void runViewer(const Request& request) {
    Viewer(request).run();
}

}  // namespace cutis::app
