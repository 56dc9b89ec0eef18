#include "renderer/frame/background.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/parallel.h"
#include "renderer/frame/camera.h"
#include "renderer/scene/environment_clusters.h"

namespace cutis {
namespace {

constexpr int kBlurredWidth = 96, kBlurredHeight = 48;  // 3.75 degrees a texel, half of the blur
constexpr double kBlur = 8 * std::numbers::pi / 180;    // standard deviation along the sphere

// Convolved with a von Mises-Fisher lobe of that deviation, exp((cos - 1) / kBlur²): the Gaussian of a
// sphere.
Environment blur(const Environment& environment) {
    const std::vector<EnvironmentCluster> clusters = clusterEnvironment(environment, 2048);
    Environment blurred{environment.name, kBlurredWidth, kBlurredHeight, {}};
    blurred.radiance.resize(std::size_t(kBlurredWidth) * kBlurredHeight);
    const double sharpness = 1 / (kBlur * kBlur);
    const double whole =
        2 * std::numbers::pi / sharpness * -std::expm1(-2 * sharpness);  // integral of the lobe
    parallelFor(kBlurredHeight, [&](std::size_t y) {
        for (int x = 0; x < kBlurredWidth; ++x) {
            const glm::dvec3 towards =
                environmentDirection((x + 0.5) / kBlurredWidth, (double(y) + 0.5) / kBlurredHeight);
            glm::dvec3 sum(0);
            for (const EnvironmentCluster& cluster : clusters) {
                const double cosine = glm::dot(towards, glm::normalize(cluster.centroid));
                sum += cluster.flux * std::exp(sharpness * (cosine - 1));
            }
            blurred.radiance[y * kBlurredWidth + std::size_t(x)] = glm::vec3(sum / whole);
        }
    });
    return blurred;
}

// Between the texels round it; wraps sideways.
glm::vec3 lookUp(const Environment& environment, const glm::dvec3& towards) {
    const glm::dvec2 uv = environmentCoordinates(towards);
    const double u = uv.x * environment.width - 0.5, v = uv.y * environment.height - 0.5;
    const double column = std::floor(u), row = std::floor(v);
    const auto texel = [&](double x, double y) -> const glm::vec3& {
        const int wrapped = (static_cast<int>(x) + environment.width) % environment.width;
        const int clamped = std::clamp(static_cast<int>(y), 0, environment.height - 1);
        return environment.radiance[std::size_t(clamped) * environment.width + wrapped];
    };
    const float a = static_cast<float>(u - column), b = static_cast<float>(v - row);
    return glm::mix(glm::mix(texel(column, row), texel(column + 1, row), a),
                    glm::mix(texel(column, row + 1), texel(column + 1, row + 1), a), b);
}

}  // namespace

BackgroundPainter::BackgroundPainter(const Environment& environment, Background background) {
    if (background == Background::none || environment.radiance.empty()) return;
    if (background == Background::blurred) {
        blurred_ = blur(environment);
    } else {
        sharp_ = &environment;
    }
}

void BackgroundPainter::paint(Picture& picture, const Camera& camera,
                              const EnvironmentSettings& settings) const {
    const Environment* shown = sharp_ ? sharp_ : blurred_.radiance.empty() ? nullptr : &blurred_;
    if (!shown || !settings.enabled || picture.channels != 4) return;
    const glm::dvec2 half = halfExtents(camera, {picture.width, picture.height});
    const glm::dvec3 right = glm::normalize(glm::dvec3(camera.world[0])) * half.x;
    const glm::dvec3 up = glm::normalize(glm::dvec3(camera.world[1])) * half.y;
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(camera.world[2]));
    const float intensity = static_cast<float>(settings.intensity);
    parallelFor(static_cast<std::size_t>(picture.height), [&](std::size_t y) {
        for (int x = 0; x < picture.width; ++x) {
            float* pixel = &picture.values[(y * picture.width + std::size_t(x)) * 4];
            const float open = 1 - pixel[3];
            if (!(open > 0)) continue;
            const double sx = 2 * (x + 0.5) / picture.width - 1,
                         sy = 1 - 2 * (double(y) + 0.5) / picture.height;
            const glm::dvec3 ray =
                camera.orthographic ? forward : glm::normalize(forward + sx * right + sy * up);
            const glm::vec3 radiance = lookUp(*shown, rotateAboutY(ray, -settings.rotation));
            for (int c = 0; c < 3; ++c) pixel[c] += open * intensity * radiance[c];
        }
    });
}

}  // namespace cutis
