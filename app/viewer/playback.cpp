#include "app/viewer/playback.h"

#include <algorithm>
#include <cmath>

#include "app/frame_files.h"

namespace cutis::app {
namespace {

constexpr double kRounding = 1e-6;  // frames: a time that was computed from a frame is that frame

}  // namespace

void Playback::open(const Scene& scene, const Pose& pose) {
    clips_.clear();
    for (const Animation& animation : scene.animations)
        clips_.push_back({animation.name, animation.duration});
    pose_ = pose;
    playing_ = false;
}

double Playback::duration() const {
    return pose_.animation == kAtRest ? 0 : clips_[static_cast<std::size_t>(pose_.animation)].duration;
}

void Playback::choose(int animation) {
    pose_ = {animation, 0};
    if (animation == kAtRest) playing_ = false;
}

void Playback::toggle() {
    if (empty()) return;
    if (pose_.animation == kAtRest) choose(0);
    playing_ = !playing_;
    if (playing_ && pose_.seconds >= duration()) pose_.seconds = 0;
}

void Playback::seek(double seconds) {
    if (pose_.animation != kAtRest) pose_.seconds = std::clamp(seconds, 0.0, duration());
}

void Playback::step(int frames) {
    if (empty()) return;
    if (pose_.animation == kAtRest) return choose(0);
    playing_ = false;
    const double place = pose_.seconds * kDefaultFps;
    // From between two frames a step goes to the next one on its side.
    const double from = frames > 0 ? std::floor(place + kRounding) : std::ceil(place - kRounding);
    seek((from + frames) / kDefaultFps);
}

int Playback::frame() const {
    return static_cast<int>(std::floor(pose_.seconds * kDefaultFps + kRounding));
}

void Playback::advance(double seconds) {
    if (!playing_) return;
    double time = pose_.seconds + seconds * speed;
    if (time >= duration()) {
        playing_ = loop && duration() > 0;
        time = playing_ ? std::fmod(time, duration()) : duration();
    }
    pose_.seconds = time;
}

}  // namespace cutis::app
