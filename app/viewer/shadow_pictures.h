// Pictures with other samples of area lights and sky, rendered beside the view: they relight the whole scene,
// and a camera that begins to move must not wait for that.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <thread>

#include "renderer/frame/renderer.h"

namespace cutis::app {

// How a picture is made of a state; the environment is the state's, loaded.
using RenderFunction = std::function<RenderResult(const RenderInput&, const RenderSettings&)>;

struct ShadowPicture {
    std::uint64_t version = 0;  // as it was asked for
    Picture picture;            // empty when it was stopped
};

// One at a time, on a thread of its own. Called from one thread.
class ShadowPictures {
  public:
    // `done` is called on that thread.
    explicit ShadowPictures(std::function<void()> done) : done_(std::move(done)) {}

    // Not while one is under way. What the input refers to must stay as it is until then; `scene` is kept
    // alive. `open` gives what renders, the first time.
    void start(std::uint64_t version, const RenderInput& input, RenderSettings settings,
               std::shared_ptr<const Scene> scene, const std::function<RenderFunction()>& open);
    bool busy() const;
    // Nobody wants the one that is under way any more: it ends soon, and does not come. From any thread.
    void stop() { stopped_ = true; }
    // The one that was started last, once it is there. Throws what rendering it threw.
    std::optional<ShadowPicture> take();
    // Until nothing is under way.
    void wait();
    // And gives back what renders.
    void close();

  private:
    std::function<void()> done_;
    RenderFunction renderer_;
    std::atomic<bool> stopped_ = false;
    std::future<ShadowPicture> pending_;
    std::jthread thread_;  // last: it ends first
};

}  // namespace cutis::app
