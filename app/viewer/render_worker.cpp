#include "app/viewer/render_worker.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "app/viewer/document.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/environment_sun.h"

namespace cutis::app {

RenderWorker::RenderWorker(std::function<Renderers()> open, std::function<void()> wake)
    : open_(std::move(open)),
      wake_(std::move(wake)),
      shadows_([this] {
          { const std::lock_guard lock(mutex_); }  // whoever is about to wait must not miss this
          changed_.notify_all();
      }),
      thread_([this] { run(); }) {}

void RenderWorker::end() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    shadows_.stop();
    changed_.notify_all();
}

RenderWorker::~RenderWorker() {
    end();
    thread_.join();
    shadows_.wait();
}

void RenderWorker::show(std::uint64_t version, RenderState state) {
    {
        const std::lock_guard lock(mutex_);
        next_ = Job{version, std::move(state)};
    }
    shadows_.stop();  // they are of the state before, and take their share of the machine
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

// Unless a newer one has taken its place.
void RenderWorker::askAgain(AsideJob job) {
    {
        const std::lock_guard lock(mutex_);
        if (std::any_of(aside_.begin(), aside_.end(),
                        [&](const AsideJob& other) { return other.id == job.id; }))
            return;
    }
    renderAside(std::move(job));
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

void RenderWorker::restart() {
    {
        const std::lock_guard lock(mutex_);
        restarts_ = true;
        result_.reset();
        status_.error.clear();
    }
    changed_.notify_all();
}

bool RenderWorker::stale() const {
    const std::lock_guard lock(mutex_);
    return ended_ || next_.has_value();
}

// For a picture that takes about so long; negative: unknown. One that is there at once is not worth
// interrupting.
StopAsked RenderWorker::whenStale(double seconds) const {
    if (seconds >= 0 && seconds <= kInstant) return {};
    return [this] { return stale(); };
}

void RenderWorker::run() {
    for (;;) {
        std::optional<Job> job;
        std::optional<AsideJob> aside;
        bool restarts = false;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock,
                          [this] { return ended_ || next_.has_value() || !aside_.empty() || canRefine(); });
            if (ended_) break;
            status_.working = true;
            restarts = std::exchange(restarts_, false);
            if (next_) {
                job = std::exchange(next_, std::nullopt);
            } else if (!aside_.empty()) {
                aside = std::move(aside_.front());
                aside_.pop_front();
            }
        }
        std::string error;
        try {
            if (restarts) closeRenderers();
            if (!renderers_.view) renderers_ = open_();
            if (job) {
                show(*job);
            } else if (aside) {
                renderNextAside(*aside);
            } else if (canRefine()) {  // unless a restart has ended it
                refineOnce();
            }
        } catch (const Interrupted&) {
            // What it was for comes again when it is still wanted: pictures beside the view, once that rests.
            if (aside) askAgain(std::move(*aside));
            aside.reset();
        } catch (const std::bad_alloc&) {
            refinement_.reset();
            error = "out of memory: the scene or the picture is too large for this machine";
        } catch (const std::exception& problem) {
            error = problem.what();
            refinement_.reset();
            if (error.find("device was lost") != std::string::npos) recoverDevice(std::move(job));
        }
        {
            const std::lock_guard lock(mutex_);
            status_.busy = status_.working = false;
            if (aside) status_.asideError = error;
            if (job || (!aside && !error.empty())) status_.error = error;
            if (shadows_.busy()) status_.working = true;
            if (aside && !error.empty()) asideResults_.push_back({aside->id, nullptr, {}, {}});
        }
        wake_();
    }
    closeRenderers();  // a device goes on the thread that it lived on
}

// Nothing more comes from a lost device: the next picture opens one anew. The picture that lost it is tried
// once more.
void RenderWorker::recoverDevice(std::optional<Job> job) {
    closeRenderers();
    const std::lock_guard lock(mutex_);
    ++status_.devicesLost;
    if (job && !next_ && !std::exchange(triesAgain_, true)) next_ = std::move(job);
}

void RenderWorker::closeRenderers() {
    shadows_.close();
    refinement_.reset();
    shown_.reset();
    renderers_ = {};
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

void RenderWorker::show(const Job& job) {
    refinement_.reset();
    if (showAgain(job)) return;
    putSkin(job.state);
    putPose(job.state);
    const bool onlyMoved = moved(job);
    const double first = firstFraction(job);
    const StopAsked stopAsked = whenStale(onlyMoved ? moveSeconds_ : changeSeconds_);
    if (first < 1) {
        publish(render(job, first, !onlyMoved, {}));
        if (stale()) return;
    }
    if (first < 0.25) {
        publish(render(job, 2 * first, !onlyMoved, stopAsked));
        if (stale()) return;
    }
    WorkerResult result = render(job, 1, false, first < 1 ? stopAsked : StopAsked());
    (onlyMoved ? moveSeconds_ : changeSeconds_) = result.seconds;
    shown_ = job;
    showFull(std::move(result));
}

// Another exposure of the picture that is there, or another background, needs no rendering.
bool RenderWorker::showAgain(const Job& job) {
    if (!moved(job) || !job.state.overlay.aov.empty() || !shown_->state.overlay.aov.empty() ||
        !sameCamera(shown_->state.camera, job.state.camera))
        return false;
    shown_ = job;
    WorkerResult result = full_;
    result.version = job.version;
    result.composed = overBackground(job.state, result.linear);
    result.display = toDisplay(*result.composed, job.state.rig.exposure);
    showFull(std::move(result));
    return true;
}

// The full picture of shown_. It is refined from then on, one picture at a time, whenever nothing else is
// asked for.
void RenderWorker::showFull(WorkerResult result) {
    const bool refines = shown_->state.overlay.aov.empty();
    result.refined = 1;
    result.shadowSets = 1;
    full_ = result;
    full_.display = {};
    if (refines)
        refinement_.emplace(result.composed, hasSoftShadows(shown_->state) && renderers_.openShadows);
    publish(std::move(result));
}

bool RenderWorker::canRefine() const {
    return refinement_ && refinement_->next() != Refinement::Step::none && !shadows_.busy();
}

void RenderWorker::refineOnce() {
    Job job = *shown_;
    putSkin(job.state);  // pictures beside the view may have had another
    putPose(job.state);
    if (refinement_->next() == Refinement::Step::pixels) {
        job.state.camera =
            jittered(job.state.camera, refinement_->pixelPictures(), job.state.settings.height);
        refinement_->add(*render(job, 1, false, whenStale(moveSeconds_)).composed);
    } else if (std::optional<ShadowPicture> more = shadows_.take()) {
        if (more->version != job.version) return;  // of a state that is no more
        const auto linear = std::make_shared<const Picture>(std::move(more->picture));
        refinement_->add(*overBackground(job.state, linear));
    } else {
        job.state.settings.seed = static_cast<std::uint32_t>(refinement_->shadowPictures());
        shadows_.start(job.version, inputOf(job.state), job.state.settings, job.state.scene,
                       renderers_.openShadows);
        if (stale()) shadows_.stop();  // it may have been told to before it began
        return;
    }
    WorkerResult result = full_;
    result.refined = refinement_->pixelPictures();
    result.shadowSets = refinement_->shadowPictures();
    result.converged = refinement_->next() == Refinement::Step::none;
    result.display = toDisplay(refinement_->mean(), job.state.rig.exposure);
    publish(std::move(result));
}

// What renders shadows on its own thread reads the scene: it is not changed before that is done.
void RenderWorker::putSkin(const RenderState& state) {
    if (skinOf(*state.scene) == state.skin) return;
    shadows_.wait();
    applySkin(*state.scene, state.skin);
}

// Scenes at rest come as they are.
void RenderWorker::putPose(const RenderState& state) {
    if (state.scene->animations.empty() || (posedScene_.lock() == state.scene && pose_ == state.pose)) return;
    shadows_.wait();
    posedScene_.reset();  // unknown, should this throw
    poseScene(*state.scene, state.pose.animation, state.pose.seconds);
    ++poseRevision_;
    posedScene_ = state.scene;
    pose_ = state.pose;
}

void RenderWorker::publish(WorkerResult result) {
    {
        const std::lock_guard lock(mutex_);
        status_.busy = false;
        if (restarts_) return;  // made with shaders that are no more: says nothing of the new ones
        status_.error.clear();
        triesAgain_ = false;
        status_.device = result.stats.device;
        result_ = std::move(result);
    }
    wake_();
}

WorkerResult RenderWorker::render(const Job& job, double fraction, bool draft, StopAsked stopAsked) {
    RenderSettings settings = job.state.settings;
    settings.stopAsked = std::move(stopAsked);
    settings.width = std::max(1, static_cast<int>(std::lround(settings.width * fraction)));
    settings.height = std::max(1, static_cast<int>(std::lround(settings.height * fraction)));
    settings.inspect = job.state.overlay.inspect;
    if (const std::string& aov = job.state.overlay.aov; !aov.empty() && aov != kInspectedName)
        settings.aovs = {aov};
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
    result.overlay = job.state.overlay;
    result.linear = std::make_shared<const Picture>(std::move(rendered.picture));
    result.composed = overBackground(job.state, result.linear);
    const auto overlay = rendered.aovs.find(job.state.overlay.aov);
    result.display = overlay == rendered.aovs.end()
                         ? toDisplay(*result.composed, job.state.rig.exposure)
                         : showAov(job.state.overlay, overlay->second, job.state.rig.exposure);
    result.stats = std::move(rendered.stats);
    result.seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    return result;
}

void RenderWorker::renderNextAside(const AsideJob& job) {
    putSkin(job.state);
    putPose(job.state);
    RenderSettings settings = job.state.settings;
    settings.stopAsked = whenStale(changeSeconds_);
    RenderResult rendered = draw(renderers_.draft, job.state, settings);
    AsideResult result{
        job.id, std::make_shared<const Picture>(std::move(rendered.picture)), {}, std::move(rendered.aovs)};
    result.display = toDisplay(*overBackground(job.state, result.linear), job.state.rig.exposure);
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
    return renderer(inputOf(state), settings);
}

RenderInput RenderWorker::inputOf(const RenderState& state) {
    return {.scene = state.scene.get(),
            .poseRevision = poseRevision_,
            .rig = state.rig,
            .environment = environmentOf(state.rig),
            .environmentRevision = environmentRevision_,
            .camera = state.camera};
}

const Environment* RenderWorker::environmentOf(const Rig& rig) {
    const EnvironmentSettings& settings = rig.environment;
    if (!settings.enabled || settings.file.empty()) return nullptr;
    const bool known =
        environment_ && settings.file == environmentFile_ && settings.sunRemoved == sunRemoved_;
    if (known) return &*environment_;
    shadows_.wait();
    environment_.reset();
    background_.reset();
    Environment loaded = loadEnvironment(settings.file);
    if (settings.sunRemoved) removeSun(loaded);
    environment_ = std::move(loaded);
    environmentFile_ = settings.file;
    sunRemoved_ = settings.sunRemoved;
    ++environmentRevision_;
    return &*environment_;
}

std::shared_ptr<const Picture> RenderWorker::overBackground(const RenderState& state,
                                                            const std::shared_ptr<const Picture>& picture) {
    const Environment* environment = environmentOf(state.rig);
    if (!environment || state.background == Background::none) return picture;
    if (!background_ || backgroundKind_ != state.background) {
        background_.emplace(*environment, state.background);
        backgroundKind_ = state.background;
    }
    Picture composed = *picture;
    background_->paint(composed, state.camera, state.rig.environment);
    return std::make_shared<const Picture>(std::move(composed));
}

}  // namespace cutis::app
