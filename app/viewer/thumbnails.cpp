#include "app/viewer/thumbnails.h"

#include <algorithm>
#include <cmath>

#include "app/inputs.h"
#include "renderer/core/error.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/presets.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

constexpr double kMiddleGrey = 0.35;  // that an environment's mean luminance is shown as

// Box averages of a lat-long picture, exposed to its mean.
DisplayPicture shrink(const Environment& environment) {
    const int width = kThumbnailWidth, height = kThumbnailWidth / 2;
    Picture small{width, height, 4, std::vector<float>(std::size_t(width) * height * 4, 1.0f)};
    double mean = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int x0 = x * environment.width / width,
                      x1 = std::max((x + 1) * environment.width / width, x0 + 1);
            const int y0 = y * environment.height / height,
                      y1 = std::max((y + 1) * environment.height / height, y0 + 1);
            glm::dvec3 sum(0);
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u)
                    sum += glm::min(environment.radiance[std::size_t(v) * environment.width + u],
                                    glm::vec3(1e4f));
            sum /= double(x1 - x0) * (y1 - y0);
            for (int c = 0; c < 3; ++c) small.values[(std::size_t(y) * width + x) * 4 + c] = float(sum[c]);
            // A sun would leave all else black: what is bright counts by its logarithm.
            mean += std::log(glm::dot(sum, glm::dvec3(0.2126, 0.7152, 0.0722)) + 1e-6);
        }
    }
    mean = std::exp(mean / (double(width) * height));
    return toDisplay(small, std::log2(kMiddleGrey / std::max(mean, 1e-6)));
}

}  // namespace

void requestPresetThumbnails(Session& session) {
    static std::tuple<std::shared_ptr<Scene>, int, std::vector<std::optional<SkinMaterial>>> made;
    if (!session.scene || session.document().scene != session.openedScene) return;
    const auto wanted = std::make_tuple(session.scene, session.selectedCharacter, session.document().skin);
    if (made == wanted) return;
    made = wanted;
    OrbitCamera camera;
    camera.azimuth = 12;
    camera.yfov = 0.35;
    // Of everyone together the heads would be too small.
    const int character = session.geometry->characters.empty() ? -1 : std::max(session.selectedCharacter, 0);
    const double aspect = double(kThumbnailWidth) / kThumbnailHeight;
    frameSubject(camera, *session.geometry, character, Framing::face, aspect);
    camera.distance *= 0.75;  // nearer than for a portrait: the face alone tells the lighting
    for (std::size_t i = 0; i < presets().size(); ++i) {
        Document document = session.document();
        document.rig = presetRig(presets()[i].name);
        for (Light& light : document.rig.lights)
            if (light.place && character >= 0)
                light.place->subject = session.geometry->characters[std::size_t(character)].name;
        document.solo.assign(document.rig.lights.size(), false);
        document.view = {"", camera};
        try {
            AsideJob job{kPresetPictures + static_cast<int>(i), stateFor(session, document)};
            job.state.camera = toCamera(camera, aspect);
            job.state.background = Background::none;
            job.state.settings.width = kThumbnailWidth;
            job.state.settings.height = kThumbnailHeight;
            job.state.settings.lightMapSize = 512;  // texels: the face is 60 pixels high
            session.asideJobs.push_back(std::move(job));
        } catch (const Error&) {  // a scene that is empty: no thumbnail
        }
    }
}

const std::vector<fs::path>& installedEnvironments() {
    static const std::vector<fs::path> found = [] {
        std::vector<fs::path> files;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(dataFolder() / "hdri", error))
            if (entry.path().extension() == ".exr" || entry.path().extension() == ".hdr")
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }();
    return found;
}

EnvironmentThumbnails::~EnvironmentThumbnails() = default;  // asks the thread to stop, and waits

void EnvironmentThumbnails::start() {
    if (thread_.joinable()) return;
    thread_ = std::jthread([this](const std::stop_token& stop) {
        const std::vector<fs::path>& files = installedEnvironments();
        for (std::size_t i = 0; i < files.size() && !stop.stop_requested(); ++i) {
            try {
                DisplayPicture small = shrink(loadEnvironment(files[i], false));
                const std::lock_guard lock(mutex_);
                made_.emplace_back(static_cast<int>(i), std::move(small));
            } catch (const std::exception&) {  // choosing it will say what is wrong
            }
            wake_();
        }
    });
}

std::vector<std::pair<int, DisplayPicture>> EnvironmentThumbnails::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(made_, {});
}

}  // namespace cutis::app
