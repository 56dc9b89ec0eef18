#include "renderer/reference/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>

#include "renderer/core/files.h"
#include "renderer/core/parallel.h"
#include "renderer/reference/content_key.h"
#include "renderer/reference/data_channels.h"
#include "renderer/reference/sums.h"

namespace cutis::reference {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kCacheKind = "reference";
constexpr int kLeastPasses = 1;
constexpr double kSaveEvery = 60;      // seconds
constexpr double kShadedWeight = 0.1;  // surfaces with less of a sample than this are shaded by chance

// Purposes of random pairs of a sample of a pixel; each surface behind another has a branch of its own.
enum Purpose : std::uint32_t { kPixelPlace, kRoulette };
constexpr std::uint32_t kDataBranch = 0x10000;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<std::optional<SkinModel>> makeModels(const Scene& scene, const PlacedScene& placed,
                                                 int gaussians) {
    std::vector<std::optional<SkinModel>> models(scene.materials.size());
    for (const PlacedMesh& mesh : placed.meshes) {
        std::optional<SkinModel>& model = models[static_cast<std::size_t>(mesh.primitive->material)];
        if (mesh.skin && !model) model.emplace(*mesh.material->skin, gaussians);
    }
    return models;
}

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Everything that one evaluation holds.
class Evaluation {
  public:
    Evaluation(const Input& input, const Settings& settings, const Hooks& hooks)
        : input_(input),
          settings_(settings),
          hooks_(hooks),
          placed_(placeScene(*input.scene)),
          models_(makeModels(*input.scene, placed_, settings.gaussians)),
          rays_(placed_, wants("thickness")),
          lighting_(rays_, LightSampler(input.rig, placed_.origin),
                    EnvironmentSampler(input.environment, input.rig.environment)),
          diffusion_(rays_, lighting_, *input.scene, models_),
          shading_(rays_, lighting_, diffusion_),
          view_(input.camera, placed_.origin, settings.width, settings.height),
          sums_(settings.width, settings.height),
          wantsIrradiance_(wants("irradiance")) {}

    Result run();

  private:
    bool wants(const std::string& aov) const {
        return std::find(settings_.aovs.begin(), settings_.aovs.end(), aov) != settings_.aovs.end();
    }
    bool wantsData() const;
    bool stopped() const { return hooks_.stop && hooks_.stop->load(); }
    bool outOfTime() const { return settings_.budget > 0 && secondsSince(start_) >= settings_.budget; }
    bool finished() const;
    bool runPass();
    PixelSum evaluatePixel(int x, int y, int pass);
    void addSample(int x, int y, const RandomNumbers& random, SampleSum& sum);
    void report(int passes, double fraction);
    void takeResult(Result& result);

    const Input& input_;
    const Settings& settings_;
    const Hooks& hooks_;
    PlacedScene placed_;
    std::vector<std::optional<SkinModel>> models_;
    RayScene rays_;
    Lighting lighting_;
    Diffusion diffusion_;
    Shading shading_;
    View view_;
    Sums sums_;
    bool wantsIrradiance_;
    std::vector<std::optional<PixelPoint>> points_;  // for data channels; empty unless wanted
    std::atomic<std::uint64_t> nonfinite_{0};
    Clock::time_point start_ = Clock::now();
    int passesThisRun_ = 0;
    double secondsInPasses_ = 0, error_ = 0;
    std::mutex reportMutex_;
    Clock::time_point lastReport_{};
};

bool Evaluation::wantsData() const {
    for (const char* name :
         {"irradiance", "thickness", "albedo", "normal", "position", "depth", "character"}) {
        if (wants(name)) return true;
    }
    return false;
}

bool Evaluation::finished() const {
    const int passes = sums_.passes();
    if (passes < kLeastPasses) return false;
    if (settings_.maxPasses > 0 && passes >= settings_.maxPasses) return true;
    if (settings_.error > 0 && error_ <= settings_.error) return true;
    return outOfTime();
}

void Evaluation::report(int passes, double fraction) {
    if (!hooks_.progress) return;
    const std::unique_lock lock(reportMutex_, std::try_to_lock);
    if (!lock || secondsSince(lastReport_) < 0.2) return;
    lastReport_ = Clock::now();
    Progress progress{passes, fraction, error_, secondsSince(start_), -1};
    double left = INFINITY;
    if (passesThisRun_ > 0) {
        const double perPass = secondsInPasses_ / passesThisRun_, done = passes + fraction;
        // Error falls with the root of the number of passes at least.
        if (settings_.error > 0 && error_ > 0) {
            const double needed =
                std::max<double>(kLeastPasses, passes * std::pow(error_ / settings_.error, 2));
            left = std::min(left, (needed - done) * perPass);
        }
        if (settings_.maxPasses > 0) left = std::min(left, (settings_.maxPasses - done) * perPass);
    }
    if (settings_.budget > 0) left = std::min(left, settings_.budget - progress.seconds);
    if (std::isfinite(left)) progress.secondsLeft = std::max(left, 0.0);
    hooks_.progress(progress);
}

// One sample of the picture: the surfaces along a random ray through the pixel, composited from the nearest.
void Evaluation::addSample(int x, int y, const RandomNumbers& random, SampleSum& sum) {
    thread_local std::vector<Hit> hits;
    const ViewRay ray = view_.rayThrough(glm::dvec2(x, y) + random.pair(kPixelPlace));
    rays_.findVisible(ray.from, ray.direction, ray.tNear, ray.tFar, hits);
    glm::dvec3 transmitted(1);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        // Of what is not blended everything that is there is opaque.
        const bool blended = hits[i].mesh->material->alphaMode == AlphaMode::blend;
        const double alpha = blended ? hits[i].alpha : 1;
        const glm::dvec3 weight = transmitted * alpha;
        const double heaviest = std::max({weight.r, weight.g, weight.b});
        const RandomNumbers own = random.branch(static_cast<std::uint32_t>(i));
        // Glass must be shaded for what it lets through.
        const bool glass = hits[i].mesh->material->layered() && hits[i].mesh->material->transmission > 0;
        const double shaded = glass ? 1.0 : std::min(1.0, heaviest / kShadedWeight);
        Shade shade;
        const bool drawn = shaded >= 1 || own.pair(kRoulette).x < shaded;
        if (drawn) shade = shading_.shade(hits[i], -ray.direction, own.branch(0));
        const glm::dvec3 passed = transmitted * (1.0 - alpha + alpha * shade.through),
                         kept = transmitted - passed;
        sum.coverage += static_cast<float>((kept.r + kept.g + kept.b) / 3);
        transmitted = passed;
        if (!drawn) continue;
        if (!finite(shade.diffuse) || !finite(shade.specular)) {
            ++nonfinite_;
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            const double share = weight[c] / shaded;
            sum.diffuse[c] += static_cast<float>(shade.diffuse[c] * share);
            sum.picture[c] += static_cast<float>((shade.diffuse[c] + shade.specular[c]) * share);
        }
    }
}

PixelSum Evaluation::evaluatePixel(int x, int y, int pass) {
    PixelSum result;
    const std::size_t pixel = std::size_t(y) * settings_.width + x;
    const bool irradiance = wantsIrradiance_ && points_[pixel];
    for (int sequence = 0; sequence < kSequences; ++sequence) {
        const std::uint64_t key = RandomNumbers::mix(
            RandomNumbers::mix((std::uint64_t(settings_.seed) << 8) + static_cast<std::uint32_t>(sequence)) +
            pixel);
        for (int s = 0; s < kSamplesPerSequence; ++s) {
            const RandomNumbers random(key, static_cast<std::uint32_t>(pass * kSamplesPerSequence + s));
            addSample(x, y, random, result.sequence[sequence]);
            if (!irradiance) continue;
            const PixelPoint& point = *points_[pixel];
            const glm::dvec3 e = shading_.irradiance(point.hit, point.view, random.branch(kDataBranch));
            for (int c = 0; c < 3; ++c) result.irradiance[c] += static_cast<float>(e[c]);
        }
    }
    return result;
}

// False when it was given up half-way. Rows that are done then stay so.
bool Evaluation::runPass() {
    const Clock::time_point passStart = Clock::now();
    const int pass = sums_.passes();
    std::atomic<int> rowsDone{0};
    std::atomic<bool> givenUp{false};
    parallelFor(std::size_t(settings_.height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        if (givenUp || stopped() || (pass >= kLeastPasses && outOfTime())) {
            givenUp = true;
            return;
        }
        if (sums_.passesOf(y) == pass) {
            std::vector<PixelSum> found(settings_.width);
            for (int x = 0; x < settings_.width; ++x) found[x] = evaluatePixel(x, y, pass);
            sums_.addRow(y, found);
        }
        report(pass, double(++rowsDone) / settings_.height);
    });
    if (givenUp) return false;
    ++passesThisRun_;
    secondsInPasses_ += secondsSince(passStart);
    error_ = std::max(sums_.pictureError(), sums_.diffuseError());
    return true;
}

void Evaluation::takeResult(Result& result) {
    result.passes = sums_.passes();
    result.nonfinite = nonfinite_;
    result.pictureError = sums_.pictureError();
    result.diffuseError = sums_.diffuseError();
    result.picture = sums_.picture();
    result.standardError = sums_.standardError();
    result.diffuseStandardError = sums_.diffuseStandardError();
    for (int half = 0; half < 2; ++half) {
        result.halves[half] = sums_.picture(half);
        result.diffuseHalves[half] = sums_.diffuse(half);
    }
    for (const std::string& name : settings_.aovs) {
        if (name == "diffuse") {
            result.aovs[name] = sums_.diffuse();
        } else if (name == "specular") {
            result.aovs[name] = sums_.specular();
        } else if (name == "irradiance") {
            result.aovs[name] = sums_.irradiance();
        } else if (name == "stderr") {
            result.aovs[name] = result.standardError;
        } else {
            result.aovs[name] = makeDataChannel(name, points_, settings_.width, settings_.height, rays_,
                                                placed_, view_, input_.rig);
        }
    }
}

Result Evaluation::run() {
    Result result;
    const std::uint64_t key = settings_.resume ? contentKey(input_, settings_, placed_) : 0;
    if (settings_.resume && sums_.fromBytes(readCache(kCacheKind, key))) {
        error_ = std::max(sums_.pictureError(), sums_.diffuseError());
    }
    if (wantsData()) {
        points_.resize(std::size_t(settings_.width) * settings_.height);
        parallelFor(std::size_t(settings_.height), [&](std::size_t y) {
            for (int x = 0; x < settings_.width; ++x) {
                points_[y * settings_.width + x] = findPixelPoint(rays_, view_, x, static_cast<int>(y));
            }
        });
    }
    Clock::time_point saved = Clock::now();
    bool worked = false;
    while (!finished()) {
        worked = true;
        if (!runPass()) {
            result.interrupted = stopped();
            break;
        }
        if (settings_.resume && secondsSince(saved) > kSaveEvery) {
            writeCache(kCacheKind, key, sums_.toBytes());
            saved = Clock::now();
        }
    }
    if (settings_.resume && worked) writeCache(kCacheKind, key, sums_.toBytes());
    if (!result.interrupted) takeResult(result);
    result.passes = sums_.passes();
    result.seconds = secondsSince(start_);
    return result;
}

}  // namespace

Result evaluate(const Input& input, const Settings& settings, const Hooks& hooks) {
    return Evaluation(input, settings, hooks).run();
}

}  // namespace cutis::reference
