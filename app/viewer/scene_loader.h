// Loads scenes on a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "app/options.h"
#include "app/tolerance.h"
#include "app/viewer/document.h"
#include "app/viewer/playback.h"

namespace cutis::app {

// What a scene file and the options make of it.
struct LoadedScene {
    std::string name;                         // as it was asked for: a file, or "default"
    std::shared_ptr<Scene> scene;             // with texels: for the renderer alone
    std::shared_ptr<Scene> geometry;          // the same without texels: for the interface
    std::shared_ptr<Scene> spare;             // another of these, to pose beside it; null where nothing moves
    Pose pose;                                // that they are in
    Document document;                        // the scene as it opens
    KnownFront known{defaultFront(), false};  // of the error of settings for it
    std::string error;                        // not empty: nothing was loaded, for this reason
    bool opens = true;                        // it becomes the document, as start() was told
};

class SceneLoader {
  public:
    // `wake` is called, on the loader's thread, when a scene is there.
    explicit SceneLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

    // Loads operand 0 of the request as loadInputs does. What was under way is thrown away, unless this one
    // cannot be loaded: then it comes after the reason for that. `opens`: see LoadedScene.
    void start(const Request& request, bool opens);
    bool loading() const { return pending_.valid(); }
    const std::string& name() const { return name_; }
    double seconds() const;  // since start

    // What is there now, if anything is.
    std::optional<LoadedScene> take();

  private:
    std::function<void()> wake_;
    struct Wanted {
        Request request;
        bool opens = true;
    };
    std::future<LoadedScene> pending_;
    std::optional<Wanted> next_;
    std::optional<LoadedScene> before_;  // what was under way when next_ came
    std::string name_;
    std::chrono::steady_clock::time_point begun_;
};

}  // namespace cutis::app
