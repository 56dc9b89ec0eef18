// Poses the interface's copy of a scene on a thread of its own, so that no frame waits for it.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "app/viewer/playback.h"

namespace cutis::app {

class ScenePoser {
  public:
    struct Posed {
        std::shared_ptr<Scene> scene;
        Pose pose;
    };

    // Another scene: a second copy of it, which nobody else touches. Null where nothing moves. Waits for what
    // is under way.
    void open(std::shared_ptr<Scene> spare);
    bool busy() const { return pending_.valid(); }
    // Not while it is busy, nor without a scene.
    void start(const Pose& pose);
    // The copy in its new pose, once it is there: `shown` becomes the spare one. Throws Error where the scene
    // cannot be posed so.
    std::optional<Posed> take(std::shared_ptr<Scene> shown);

  private:
    std::shared_ptr<Scene> spare_;
    Pose pose_;                  // under way
    std::future<void> pending_;  // last: waits for its end
};

}  // namespace cutis::app
