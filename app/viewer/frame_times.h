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
    // dragged.
    void addFrame(double seconds, bool turning);
    // The document became that version, by a move of the view or by any other edit.
    void addEdit(std::uint64_t version, bool ofView);
    void addPicture(const WorkerResult& picture, bool turning);
    // Milliseconds as JSON: of frames of the interface (median, 99th percentile, longest), between pictures
    // while the view is dragged, and from an edit to its first and to its full picture, median and number of
    // each. Throws Error.
    void write(const std::filesystem::path& file) const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Edit {
        std::uint64_t version = 0;
        bool ofView = false;
        Clock::time_point at;
        bool shown = false;
    };

    std::vector<double> frames_, turningFrames_, turningPictures_, firstPictures_, fullPictures_;  // seconds
    std::optional<Edit> edit_;                                                                     // the last
    std::optional<Clock::time_point> lastPicture_;
};

}  // namespace cutis::app
