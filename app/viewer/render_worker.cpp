#include "app/viewer/render_worker.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "app/viewer/document.h"
#include "app/viewer/overlay.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/light_samples.h"

namespace cutis::app {
namespace {

bool sameCamera(const Camera& a, const Camera& b) {
    return a.world == b.world && a.yfov == b.yfov && a.orthographic == b.orthographic && a.xmag == b.xmag &&
           a.ymag == b.ymag && a.aspect == b.aspect;
}

bool sameSettings(const RenderSettings& a, const RenderSettings& b) {
    return a.width == b.width && a.height == b.height && a.irradianceSize == b.irradianceSize &&
           a.gaussians == b.gaussians && a.merge == b.merge && a.chain == b.chain && a.taps == b.taps;
}

// All that lights the scene: what is left is the camera, the exposure and what is shown.
bool sameLight(const RenderState& a, const RenderState& b) {
    Rig rig = a.rig;
    rig.exposure = b.rig.exposure;
    return a.scene == b.scene && a.skin == b.skin && rig == b.rig && sameSettings(a.settings, b.settings);
}

// Turned by so little that samples fall elsewhere within a third of a pixel, which is how far apart they are:
// the points of a Halton sequence in bases 2 and 3.
Camera jittered(Camera camera, int index, int height) {
    const auto radicalInverse = [](int i, int base) {
        double value = 0, digit = 1;
        for (; i > 0; i /= base) value += (digit /= base) * (i % base);
        return value;
    };
    const double pixels = 1.0 / 3;
    const double dx = pixels * (radicalInverse(index, 2) - 0.5),
                 dy = pixels * (radicalInverse(index, 3) - 0.5);
    if (camera.orthographic) {
        const double metres = 2 * camera.ymag / height;
        camera.world = camera.world * glm::translate(glm::dmat4(1), glm::dvec3(dx * metres, dy * metres, 0));
        return camera;
    }
    const double angle = 2 * std::tan(camera.yfov / 2) / height;
    camera.world = glm::rotate(camera.world, dx * angle, glm::dvec3(0, 1, 0));
    camera.world = glm::rotate(camera.world, dy * angle, glm::dvec3(1, 0, 0));
    return camera;
}

// Light maps are most of what a light that moves costs.
constexpr int kDraftLightMap = 256, kDraftSamples = 4;

RenderSettings draftOf(RenderSettings settings) {
    if (settings.lightMapSize == 0) settings.lightMapSize = kDraftLightMap;
    return settings;
}

RenderState draftOf(RenderState state) {
    for (Light& light : state.rig.lights)
        if (sampleCount(light) > kDraftSamples) light.samples = kDraftSamples;
    return state;
}

DisplayPicture displayOf(const RenderState& state, const RenderResult& rendered) {
    const auto found = rendered.aovs.find(state.overlay);
    return found == rendered.aovs.end() ? toDisplay(rendered.picture, state.rig.exposure)
                                        : showAov(state.overlay, found->second, state.rig.exposure);
}

}  // namespace

RenderWorker::RenderWorker(std::function<Renderers()> open, std::function<void()> wake)
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

void RenderWorker::renderAside(AsideJob job) {
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(aside_, [&](const AsideJob& other) { return other.id == job.id; });
        const auto place =
            std::find_if(aside_.begin(), aside_.end(), [&](const AsideJob& o) { return o.id > job.id; });
        aside_.insert(place, std::move(job));
    }
    changed_.notify_all();
}

void RenderWorker::forgetAside(int first, int last) {
    const std::lock_guard lock(mutex_);
    std::erase_if(aside_, [&](const AsideJob& job) { return job.id >= first && job.id < last; });
}

std::optional<WorkerResult> RenderWorker::takeResult() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

std::vector<AsideResult> RenderWorker::takeAside() {
    const std::lock_guard lock(mutex_);
    return std::exchange(asideResults_, {});
}

WorkerStatus RenderWorker::status() const {
    const std::lock_guard lock(mutex_);
    WorkerStatus status = status_;
    status.aside = aside_.size();
    if (status.busy) status.seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    return status;
}

bool RenderWorker::stale() const {
    const std::lock_guard lock(mutex_);
    return ended_ || next_.has_value();
}

void RenderWorker::run() {
    for (;;) {
        std::optional<Job> job;
        std::optional<AsideJob> aside;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ended_ || next_.has_value() || !aside_.empty(); });
            if (ended_) break;
            status_.working = true;
            if (next_) {
                job = std::exchange(next_, std::nullopt);
            } else {
                aside = std::move(aside_.front());
                aside_.pop_front();
            }
        }
        std::string error;
        try {
            if (!renderers_.view) renderers_ = open_();
            job ? refine(*job) : renderNextAside(*aside);
        } catch (const std::bad_alloc&) {
            error = "out of memory: the scene or the picture is too large for this machine";
        } catch (const std::exception& problem) {
            error = problem.what();
            // Nothing more comes from a lost device: the next picture opens one anew.
            if (error.find("device was lost") != std::string::npos) renderers_ = {};
        }
        {
            const std::lock_guard lock(mutex_);
            status_.busy = status_.working = false;
            if (job || !error.empty()) status_.error = error;
            if (aside && !error.empty()) asideResults_.push_back({aside->id, nullptr, {}});
        }
        wake_();
    }
    renderers_ = {};  // its device goes on the thread that it lived on
}

bool RenderWorker::moved(const Job& job) const {
    return shown_ && sameLight(shown_->state, job.state);
}

// A picture costs about as much as it has pixels.
double RenderWorker::firstFraction(const Job& job) const {
    const double seconds = moved(job) ? moveSeconds_ : changeSeconds_;
    if (seconds >= 0 && seconds <= kInstant) return 1;
    if (!moved(job) || seconds < 0) return kDraft;
    return seconds / 4 <= kPreview ? 0.5 : seconds / 16 <= kPreview ? 0.25 : 0.125;
}

void RenderWorker::refine(const Job& job) {
    if (showAgain(job)) return;
    applySkin(*job.state.scene, job.state.skin);
    const bool onlyMoved = moved(job);
    const double first = firstFraction(job);
    if (first < 1) {
        publish(render(job, first, !onlyMoved));
        if (stale()) return;
    }
    if (first < 0.25) {
        publish(render(job, 2 * first, !onlyMoved));
        if (stale()) return;
    }
    WorkerResult result = render(job, 1, false);
    (onlyMoved ? moveSeconds_ : changeSeconds_) = result.seconds;
    shown_ = job;
    full_ = result;
    full_.display = {};
    accumulate(job, std::move(result));
}

// Another exposure of the picture that is there needs no rendering.
bool RenderWorker::showAgain(const Job& job) {
    if (!moved(job) || !job.state.overlay.empty() || !shown_->state.overlay.empty() ||
        !sameCamera(shown_->state.camera, job.state.camera))
        return false;
    shown_ = job;
    full_.version = job.version;
    WorkerResult result = full_;
    result.display = toDisplay(*result.linear, job.state.rig.exposure);
    accumulate(job, std::move(result));
    return true;
}

// Shows the picture, then the mean of ever more like it, until something else is asked for.
void RenderWorker::accumulate(const Job& job, WorkerResult first) {
    const std::shared_ptr<const Picture> picture = first.linear;
    WorkerResult result = std::move(first);
    result.refined = 1;
    publish(result);
    if (!job.state.overlay.empty()) return;
    Picture sum = *picture;
    for (int index = 1; index < kRefinements; ++index) {
        {
            const std::lock_guard lock(mutex_);
            if (ended_ || next_ || !aside_.empty()) return;
        }
        Job turned = job;
        turned.state.camera = jittered(job.state.camera, index, job.state.settings.height);
        const WorkerResult more = render(turned, 1, false);
        if (more.linear->values.size() != sum.values.size()) return;
        for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += more.linear->values[i];
        result.refined = index + 1;
        result.display = toDisplay(sum, job.state.rig.exposure - std::log2(result.refined));
        publish(result);
    }
}

void RenderWorker::publish(WorkerResult result) {
    {
        const std::lock_guard lock(mutex_);
        status_.busy = false;
        status_.error.clear();
        status_.device = result.stats.device;
        result_ = std::move(result);
    }
    wake_();
}

WorkerResult RenderWorker::render(const Job& job, double fraction, bool draft) {
    RenderSettings settings = job.state.settings;
    settings.width = std::max(1, static_cast<int>(std::lround(settings.width * fraction)));
    settings.height = std::max(1, static_cast<int>(std::lround(settings.height * fraction)));
    if (!job.state.overlay.empty()) settings.aovs = {job.state.overlay};
    RenderResult rendered;
    if (draft) {
        rendered = draw(renderers_.draft, draftOf(job.state), draftOf(settings));
    } else {
        settings.detail /= fraction;  // what lights the full picture lights the smaller ones too, and is kept
        rendered = draw(renderers_.view, job.state, settings);
    }
    WorkerResult result;
    result.version = job.version;
    result.full = fraction == 1;
    result.display = displayOf(job.state, rendered);
    result.linear = std::make_shared<const Picture>(std::move(rendered.picture));
    result.stats = std::move(rendered.stats);
    result.seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    return result;
}

void RenderWorker::renderNextAside(const AsideJob& job) {
    applySkin(*job.state.scene, job.state.skin);
    RenderResult rendered = draw(renderers_.draft, job.state, job.state.settings);
    AsideResult result{job.id, nullptr, toDisplay(rendered.picture, job.state.rig.exposure)};
    result.linear = std::make_shared<const Picture>(std::move(rendered.picture));
    const std::lock_guard lock(mutex_);
    asideResults_.push_back(std::move(result));
}

RenderResult RenderWorker::draw(const RenderFunction& renderer, const RenderState& state,
                                const RenderSettings& settings) {
    {
        const std::lock_guard lock(mutex_);
        status_.busy = true;
        status_.width = settings.width;
        status_.height = settings.height;
        begun_ = Clock::now();
    }
    wake_();
    const RenderInput input{.scene = state.scene.get(),
                            .rig = state.rig,
                            .environment = environmentOf(state.rig),
                            .camera = state.camera};
    return renderer(input, settings);
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
