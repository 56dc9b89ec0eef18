#include "app/viewer/render_state.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "app/viewer/document.h"
#include "renderer/scene/light_samples.h"

namespace cutis::app {
namespace {

constexpr int kDraftLightMap = 256, kDraftSamples = 4;  // texels; of a light

bool sameSettings(const RenderSettings& a, const RenderSettings& b) {
    return a.width == b.width && a.height == b.height && a.irradianceSize == b.irradianceSize &&
           a.gaussians == b.gaussians && a.lightMapSize == b.lightMapSize && a.merge == b.merge &&
           a.chain == b.chain && a.taps == b.taps;
}

}  // namespace

bool sameCamera(const Camera& a, const Camera& b) {
    return a.world == b.world && a.yfov == b.yfov && a.orthographic == b.orthographic && a.xmag == b.xmag &&
           a.ymag == b.ymag && a.aspect == b.aspect;
}

bool sameLight(const RenderState& a, const RenderState& b) {
    Rig rig = a.rig;
    rig.exposure = b.rig.exposure;
    return a.scene == b.scene && a.skin == b.skin && a.pose == b.pose && rig == b.rig &&
           sameSettings(a.settings, b.settings);
}

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

RenderSettings draftOf(RenderSettings settings) {
    if (settings.lightMapSize == 0) settings.lightMapSize = kDraftLightMap;
    return settings;
}

RenderState draftOf(RenderState state) {
    for (Light& light : state.rig.lights)
        if (sampleCount(light) > kDraftSamples) light.samples = kDraftSamples;
    return state;
}

bool hasSoftShadows(const RenderState& state) {
    const EnvironmentSettings& environment = state.rig.environment;
    return (environment.enabled && !environment.file.empty()) ||
           std::any_of(state.rig.lights.begin(), state.rig.lights.end(),
                       [](const Light& light) { return light.enabled && sampleCount(light) > 1; });
}

}  // namespace cutis::app
