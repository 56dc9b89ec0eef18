// Renders the newest state of the document on a thread of its own, so that the interface never waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/viewer/display_picture.h"
#include "renderer/frame/renderer.h"

namespace cutis::app {

// All that a picture depends on.
struct RenderState {
    std::shared_ptr<Scene> scene;  // with texels; the worker alone touches it once it has been handed over
    std::vector<std::optional<SkinMaterial>> skin;  // per material, put into the scene before rendering
    Rig rig;                                        // placements resolved, solo and mute applied
    Camera camera;
    RenderSettings settings;  // width and height of the full picture
};

// A picture on its way to the screen.
struct WorkerResult {
    std::uint64_t version = 0;  // of the state that it shows
    bool full = false;          // at full resolution: nothing follows
    DisplayPicture display;
    std::shared_ptr<const Picture> linear;
    RenderStats stats;
    double seconds = 0;  // wall time of this picture
};

struct WorkerStatus {
    bool busy = false;
    int width = 0, height = 0;  // of the picture under way
    double seconds = 0;         // since it was begun
    std::string device;         // empty until the first picture
    std::string error;          // why the last state could not be rendered; empty: it could
};

// How a picture is made of a state; the environment is the state's, loaded.
using RenderFunction = std::function<RenderResult(const RenderInput&, const RenderSettings&)>;

class RenderWorker {
  public:
    // `open` runs on the worker's thread, once, and gives what renders (it owns the device). `wake` is
    // called, on the worker's thread, whenever there is news.
    RenderWorker(std::function<RenderFunction()> open, std::function<void()> wake);
    // Waits for the picture under way.
    ~RenderWorker();
    RenderWorker(const RenderWorker&) = delete;
    RenderWorker& operator=(const RenderWorker&) = delete;

    // Replaces whatever was asked for before. First comes a picture of a fraction of the size, then larger
    // ones as long as no newer state arrives. Where the last full picture took no longer than kInstant, it
    // comes at once.
    void show(std::uint64_t version, RenderState state);

    // The newest picture that has not been taken yet.
    std::optional<WorkerResult> takeResult();
    WorkerStatus status() const;

    static constexpr double kInstant = 0.1;              // seconds
    static constexpr double kFractions[] = {0.25, 0.5};  // of width and height, before the full picture

  private:
    using Clock = std::chrono::steady_clock;
    struct Job {
        std::uint64_t version = 0;
        RenderState state;
    };

    void run();
    void refine(const Job& job);
    bool stale() const;
    WorkerResult render(const Job& job, double fraction);
    const Environment* environmentOf(const Rig& rig);

    std::function<RenderFunction()> open_;
    std::function<void()> wake_;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> next_;
    std::optional<WorkerResult> result_;
    WorkerStatus status_;
    Clock::time_point begun_;
    bool ended_ = false;

    // The worker's own.
    RenderFunction renderer_;
    double fullSeconds_ = -1;  // of the last full picture; negative: none yet
    std::string environmentFile_;
    std::optional<Environment> environment_;
    std::thread thread_;  // last: starts when all else is there
};

}  // namespace cutis::app
