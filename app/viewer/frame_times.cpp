#include "app/viewer/frame_times.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "renderer/core/files.h"

namespace cutis::app {
namespace {

// The value below which that share of them lies; 0 of none.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto place = static_cast<std::ptrdiff_t>(share * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

nlohmann::ordered_json summary(const std::vector<double>& seconds) {
    const auto milliseconds = [&](double share) { return std::round(1e4 * quantile(seconds, share)) / 10; };
    return {{"count", seconds.size()},
            {"median_ms", milliseconds(0.5)},
            {"p99_ms", milliseconds(0.99)},
            {"max_ms", milliseconds(1)}};
}

}  // namespace

void FrameTimes::addFrame(double seconds, bool turning, bool loading) {
    if (std::exchange(first_, false)) {
        firstFrame_ = seconds;
        return;
    }
    frames_.push_back(seconds);
    if (loading) loadingFrames_.push_back(seconds);
    if (turning) turningFrames_.push_back(seconds);
}

void FrameTimes::addEdit(std::uint64_t version, bool ofView, bool busy) {
    edit_ = Edit{version, ofView, busy, Clock::now(), false};
}

void FrameTimes::addPicture(const WorkerResult& picture, bool turning) {
    const Clock::time_point now = Clock::now();
    if (turning && lastPicture_)
        turningPictures_.push_back(std::chrono::duration<double>(now - *lastPicture_).count());
    lastPicture_ = turning ? std::optional(now) : std::nullopt;
    if (!edit_ || edit_->ofView || picture.version != edit_->version) return;
    const double since = std::chrono::duration<double>(now - edit_->at).count();
    if (!edit_->shown) {
        firstPictures_.push_back(since);
        if (edit_->busy) busyFirstPictures_.push_back(since);
    }
    edit_->shown = true;
    if (!picture.full) return;
    fullPictures_.push_back(since);
    edit_.reset();
}

void FrameTimes::write(const std::filesystem::path& file) const {
    const nlohmann::ordered_json json{{"first_frame_ms", std::round(1e4 * firstFrame_) / 10},
                                      {"frame", summary(frames_)},
                                      {"frame_while_loading", summary(loadingFrames_)},
                                      {"frame_while_orbiting", summary(turningFrames_)},
                                      {"between_pictures_while_orbiting", summary(turningPictures_)},
                                      {"edit_to_first_picture", summary(firstPictures_)},
                                      {"edit_while_rendering_to_first_picture", summary(busyFirstPictures_)},
                                      {"edit_to_full_picture", summary(fullPictures_)}};
    writeFileAtomically(file, json.dump(2) + '\n');
}

}  // namespace cutis::app
