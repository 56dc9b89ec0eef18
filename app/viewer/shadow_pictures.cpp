#include "app/viewer/shadow_pictures.h"

#include <chrono>
#include <utility>

namespace cutis::app {

void ShadowPictures::start(std::uint64_t version, const RenderInput& input, RenderSettings settings,
                           std::shared_ptr<const Scene> scene, const std::function<RenderFunction()>& open) {
    std::promise<ShadowPicture> promise;
    pending_ = promise.get_future();
    stopped_ = false;
    settings.stopAsked = [this] { return stopped_.load(); };
    thread_ = std::jthread([this, version, input, settings, scene = std::move(scene), open,
                            promise = std::move(promise)]() mutable {
        try {
            if (!renderer_) renderer_ = open();
            promise.set_value({version, renderer_(input, settings).picture});
        } catch (const Interrupted&) {
            promise.set_value({});
        } catch (...) {
            renderer_ = {};
            promise.set_exception(std::current_exception());
        }
        done_();
    });
}

bool ShadowPictures::busy() const {
    return pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

std::optional<ShadowPicture> ShadowPictures::take() {
    if (!pending_.valid() || busy()) return std::nullopt;
    return pending_.get();
}

void ShadowPictures::wait() {
    if (thread_.joinable()) thread_.join();
}

void ShadowPictures::close() {
    wait();
    pending_ = {};
    renderer_ = {};
}

}  // namespace cutis::app
