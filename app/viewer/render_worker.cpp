#include "app/viewer/render_worker.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include "app/viewer/document.h"
#include "renderer/scene/environment.h"

namespace cutis::app {

RenderWorker::RenderWorker(std::function<RenderFunction()> open, std::function<void()> wake)
    : open_(std::move(open)), wake_(std::move(wake)), thread_([this] { run(); }) {}

RenderWorker::~RenderWorker() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void RenderWorker::show(std::uint64_t version, RenderState state) {
    {
        const std::lock_guard lock(mutex_);
        next_ = Job{version, std::move(state)};
    }
    changed_.notify_all();
}

std::optional<WorkerResult> RenderWorker::takeResult() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

WorkerStatus RenderWorker::status() const {
    const std::lock_guard lock(mutex_);
    WorkerStatus status = status_;
    if (status.busy) status.seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    return status;
}

bool RenderWorker::stale() const {
    const std::lock_guard lock(mutex_);
    return ended_ || next_.has_value();
}

void RenderWorker::run() {
    for (;;) {
        Job job;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ended_ || next_.has_value(); });
            if (ended_) break;
            job = std::move(*next_);
            next_.reset();
        }
        std::string error;
        try {
            if (!renderer_) renderer_ = open_();
            refine(job);
        } catch (const std::bad_alloc&) {
            error = "out of memory: the scene or the picture is too large for this machine";
        } catch (const std::exception& problem) {
            error = problem.what();
        }
        {
            const std::lock_guard lock(mutex_);
            status_.busy = false;
            status_.error = error;
        }
        wake_();
    }
    renderer_ = nullptr;  // its device goes on the thread that it lived on
}

void RenderWorker::refine(const Job& job) {
    applySkin(*job.state.scene, job.state.skin);
    std::vector<double> fractions(std::begin(kFractions), std::end(kFractions));
    if (fullSeconds_ >= 0 && fullSeconds_ <= kInstant) fractions.clear();
    fractions.push_back(1);
    for (const double fraction : fractions) {
        WorkerResult result = render(job, fraction);
        if (result.full) fullSeconds_ = result.seconds;
        {
            const std::lock_guard lock(mutex_);
            status_.busy = false;
            status_.error.clear();
            status_.device = result.stats.device;
            result_ = std::move(result);
        }
        wake_();
        if (stale()) return;
    }
}

WorkerResult RenderWorker::render(const Job& job, double fraction) {
    RenderSettings settings = job.state.settings;
    settings.width = std::max(1, static_cast<int>(std::lround(settings.width * fraction)));
    settings.height = std::max(1, static_cast<int>(std::lround(settings.height * fraction)));
    {
        const std::lock_guard lock(mutex_);
        status_.busy = true;
        status_.width = settings.width;
        status_.height = settings.height;
        begun_ = Clock::now();
    }
    wake_();
    const RenderInput input{.scene = job.state.scene.get(),
                            .rig = job.state.rig,
                            .environment = environmentOf(job.state.rig),
                            .camera = job.state.camera};
    RenderResult rendered = renderer_(input, settings);
    WorkerResult result;
    result.version = job.version;
    result.full = fraction == 1;
    result.display = toDisplay(rendered.picture, job.state.rig.exposure);
    result.linear = std::make_shared<const Picture>(std::move(rendered.picture));
    result.stats = std::move(rendered.stats);
    result.seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    return result;
}

const Environment* RenderWorker::environmentOf(const Rig& rig) {
    const EnvironmentSettings& settings = rig.environment;
    if (!settings.enabled || settings.file.empty()) return nullptr;
    if (settings.file != environmentFile_ || !environment_) {
        environment_.reset();
        environment_ = loadEnvironment(settings.file);
        environmentFile_ = settings.file;
    }
    return &*environment_;
}

}  // namespace cutis::app
