// Renders the newest state of the document on a thread of its own, so that the interface never waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/viewer/display_picture.h"
#include "app/viewer/refinement.h"
#include "app/viewer/render_state.h"
#include "app/viewer/shadow_pictures.h"
#include "renderer/frame/background.h"
#include "renderer/frame/renderer.h"

namespace cutis::app {

// A picture on its way to the screen.
struct WorkerResult {
    std::uint64_t version = 0;  // of the state that it shows
    bool full = false;          // at full resolution
    Shown overlay;              // what `display` shows
    // Of a full picture: how many pictures, each seen from elsewhere within the pixels, and how many sets of
    // samples of lights and sky it is the mean of.
    int refined = 0, shadowSets = 0;
    bool converged = false;
    DisplayPicture display;
    std::shared_ptr<const Picture>
        linear;  // what `cutis render` gives: of a full picture not the mean but the first
    std::shared_ptr<const Picture> composed;  // the same over the background: what is shown and saved
    RenderStats stats;
    double seconds = 0;  // wall time of this picture
};

// A picture beside the view: a thumbnail, the share of one light. Rendered when the view is up to date.
struct AsideJob {
    int id = 0;  // a newer job of the same id replaces an older one; smaller ones come first
    RenderState state;
};
struct AsideResult {
    int id = 0;
    std::shared_ptr<const Picture> linear;  // null when it could not be rendered
    DisplayPicture display;
    std::map<std::string, Picture> aovs;  // that its settings ask for
};

struct WorkerStatus {
    bool working = false;       // not at rest: a picture is under way, or the next one is about to be
    bool busy = false;          // a picture is under way
    int width = 0, height = 0;  // of the picture under way
    double seconds = 0;         // since it was begun
    std::size_t aside = 0;      // pictures beside the view that are still to come
    std::string device;         // empty until the first picture
    std::string error;          // why the last state could not be rendered; empty: it could
    std::string asideError;     // the same of the last picture beside the view
    int devicesLost = 0;        // and opened anew, since the start
};

// What renders the view, and what renders drafts of it and pictures beside it: apart, so that each keeps what
// its next picture can use.
struct Renderers {
    RenderFunction view, draft;
    // Opens one for shadows from more samples, on a device of its own. Empty: shadows are not refined.
    std::function<RenderFunction()> openShadows = {};
};

class RenderWorker {
  public:
    // `open` runs on the worker's thread, once, and gives what renders (it owns the device). `wake` is
    // called, on the worker's thread, whenever there is news.
    RenderWorker(std::function<Renderers()> open, std::function<void()> wake);
    // Waits for the picture under way.
    ~RenderWorker();
    RenderWorker(const RenderWorker&) = delete;
    RenderWorker& operator=(const RenderWorker&) = delete;

    // Replaces whatever was asked for before. Where full pictures have taken longer than kInstant, a smaller
    // one comes first: after a move of the camera so small that it takes about kPreview, lit as the full one;
    // after any other change a draft, coarsely lit. When nothing newer arrives, more full ones are averaged.
    // The first picture is finished whatever comes, so that a slider that is dragged shows something; all
    // others are interrupted.
    void show(std::uint64_t version, RenderState state);
    void renderAside(AsideJob job);
    // Forgets jobs with an id in [first, last) that have not begun.
    void forgetAside(int first, int last);

    // The newest picture that has not been taken yet.
    std::optional<WorkerResult> takeResult();
    std::vector<AsideResult> takeAside();
    WorkerStatus status() const;
    // Begins nothing more. What is under way ends in the background; `working` says whether anything is.
    void end();
    // Opens all that renders anew before the next picture, which is made from nothing: shaders have changed.
    void restart();

    static constexpr double kInstant = 0.1, kPreview = 0.25;  // seconds
    static constexpr double kDraft = 0.25;                    // of width and height

  private:
    using Clock = std::chrono::steady_clock;
    struct Job {
        std::uint64_t version = 0;
        RenderState state;
    };

    void run();
    void show(const Job& job);
    bool showAgain(const Job& job);
    void showFull(WorkerResult result);
    bool canRefine() const;
    void recoverDevice(std::optional<Job> job);
    void closeRenderers();
    void refineOnce();
    void putSkin(const RenderState& state);
    void putPose(const RenderState& state);
    void renderNextAside(const AsideJob& job);
    void askAgain(AsideJob job);
    void publish(WorkerResult result);
    bool stale() const;
    StopAsked whenStale(double seconds) const;
    bool moved(const Job& job) const;
    double firstFraction(const Job& job) const;
    WorkerResult render(const Job& job, double fraction, bool draft, StopAsked stopAsked);
    RenderResult draw(const RenderFunction& renderer, const RenderState& state,
                      const RenderSettings& settings);
    RenderInput inputOf(const RenderState& state);
    const Environment* environmentOf(const Rig& rig);
    std::shared_ptr<const Picture> overBackground(const RenderState& state,
                                                  const std::shared_ptr<const Picture>& picture);

    std::function<Renderers()> open_;
    std::function<void()> wake_;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> next_;
    std::deque<AsideJob> aside_;
    std::optional<WorkerResult> result_;
    std::vector<AsideResult> asideResults_;
    WorkerStatus status_;
    Clock::time_point begun_;
    bool ended_ = false, restarts_ = false;
    bool triesAgain_ = false;  // after a device was lost

    // The worker's own.
    Renderers renderers_;
    std::optional<Job> shown_;                      // the last job whose full picture is there
    WorkerResult full_;                             // and that picture, without its bytes for the screen
    double moveSeconds_ = -1, changeSeconds_ = -1;  // of the last full picture after a camera's move, and
                                                    // after any other change; negative: none yet
    std::weak_ptr<Scene> posedScene_;               // stands in `pose_`
    Pose pose_;
    std::uint64_t poseRevision_ = 0;
    std::string environmentFile_;
    bool sunRemoved_ = false;
    std::uint64_t environmentRevision_ = 0;
    std::optional<Environment> environment_;
    Background backgroundKind_ = Background::none;
    std::optional<BackgroundPainter> background_;  // of environment_
    std::optional<Refinement> refinement_;         // of shown_
    ShadowPictures shadows_;
    std::thread thread_;  // last: starts when all else is there
};

}  // namespace cutis::app
