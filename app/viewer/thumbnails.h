// Small pictures of what can be chosen: presets on the current character, environments.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/viewer/session.h"

namespace cutis::app {

// Pixels of a thumbnail at any scale: it is drawn larger or smaller.
inline constexpr int kThumbnailWidth = 128, kThumbnailHeight = 96;

// Asks for a picture of each preset on the chosen character, beside the view, when the character or its skin
// is not what the pictures show.
void requestPresetThumbnails(Session& session);

// Environments that set-up installed, sorted by name.
const std::vector<std::filesystem::path>& installedEnvironments();

// Loads environments one after another on a thread of its own and makes each small.
class EnvironmentThumbnails {
  public:
    // `wake` is called on that thread whenever one is there.
    explicit EnvironmentThumbnails(std::function<void()> wake) : wake_(std::move(wake)) {}
    ~EnvironmentThumbnails();
    // Begins, the first time it is called.
    void start();
    // Those that are there and were not taken yet, by their place in installedEnvironments.
    std::vector<std::pair<int, DisplayPicture>> take();

  private:
    std::function<void()> wake_;
    std::mutex mutex_;
    std::vector<std::pair<int, DisplayPicture>> made_;
    std::jthread thread_;
};

}  // namespace cutis::app
