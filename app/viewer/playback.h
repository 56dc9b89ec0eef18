// The time line of a scene that moves: which animation, where in it, and how it plays. No window, no threads.
// It is no part of the document: undo takes back changes of lights, not the time that has passed meanwhile.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/pose.h"

namespace cutis::app {

// A pose of a scene, as poseScene takes it.
struct Pose {
    int animation = kAtRest;  // index into Scene::animations
    double seconds = 0;
    bool operator==(const Pose&) const = default;
};

class Playback {
  public:
    struct Clip {
        std::string name;
        double duration = 0;  // seconds
    };
    static constexpr double kSlowest = 0.05, kFastest = 4;  // times as fast as the file has it

    // Another scene: paused in that pose, which is one of its own.
    void open(const Scene& scene, const Pose& pose);
    // Nothing in this scene moves: there is no time line.
    bool empty() const { return clips_.empty(); }
    const std::vector<Clip>& clips() const { return clips_; }

    const Pose& pose() const { return pose_; }
    double duration() const;  // of the chosen animation; 0 at rest
    bool playing() const { return playing_; }

    // From its beginning; kAtRest puts the scene at rest, where nothing plays.
    void choose(int animation);
    // Begins anew from the end. Of a scene at rest, the first animation plays.
    void toggle();
    void pause() { playing_ = false; }
    void seek(double seconds);  // held within the animation
    // To a frame before or after the one that is shown, on frames of kDefaultFps (app/frame_files.h), and
    // pauses.
    void step(int frames);
    int frame() const;  // the last one that has begun
    // So many seconds have passed since the last call, whether it plays or not.
    void advance(double seconds);

    bool loop = true;
    double speed = 1;

  private:
    std::vector<Clip> clips_;
    Pose pose_;
    bool playing_ = false;
};

}  // namespace cutis::app
