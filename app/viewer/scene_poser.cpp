#include "app/viewer/scene_poser.h"

#include <chrono>
#include <utility>

namespace cutis::app {

void ScenePoser::open(std::shared_ptr<Scene> spare) {
    if (pending_.valid()) pending_.wait();
    pending_ = {};
    spare_ = std::move(spare);
}

void ScenePoser::start(const Pose& pose) {
    pose_ = pose;
    pending_ = std::async(std::launch::async,
                          [scene = spare_, pose] { poseScene(*scene, pose.animation, pose.seconds); });
}

std::optional<ScenePoser::Posed> ScenePoser::take(std::shared_ptr<Scene> shown) {
    using namespace std::chrono_literals;
    if (!pending_.valid() || pending_.wait_for(0s) != std::future_status::ready) return std::nullopt;
    pending_.get();
    return Posed{std::exchange(spare_, std::move(shown)), pose_};
}

}  // namespace cutis::app
