// How responsive the viewer was: what `cutis view --stats` writes when it ends.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/viewer/render_worker.h"

namespace cutis::app {

class FrameTimes {
  public:
    // A frame of the interface took that long, all waiting for events left out [s]. `turning`: the view was
    // dragged. `loading`: a scene was being loaded, or the first picture of one was not there yet.
    void addFrame(double seconds, bool turning, bool loading);
    // The document became that version, by a move of the view or by any other edit. `busy`: a picture was under way.
    void addEdit(std::uint64_t version, bool ofView, bool busy);
    void addPicture(const WorkerResult& picture, bool turning);
    // Milliseconds as JSON: of the first frame of the interface, which makes what all others use; of the
    // others (median, 99th percentile, longest), and those while a scene is loaded; between pictures while
    // the view is dragged, and from an edit to its first picture, that alone of edits while another picture was under
    // way, and to its full picture, median and number of each.
    // Throws Error.
    void write(const std::filesystem::path& file) const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Edit {
        std::uint64_t version = 0;
        bool ofView = false, busy = false;
        Clock::time_point at;
        bool shown = false;
    };

    bool first_ = true;
    double firstFrame_ = 0;  // seconds, and so are
    std::vector<double> frames_, loadingFrames_, turningFrames_, turningPictures_, firstPictures_,
        busyFirstPictures_, fullPictures_;
    std::optional<Edit> edit_;  // the last
    std::optional<Clock::time_point> lastPicture_;
};

}  // namespace cutis::app
