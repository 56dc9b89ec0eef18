#include "app/viewer/orbit_camera.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"

namespace cutis::app {
namespace {

constexpr double kMinDistance = 0.01, kMaxDistance = 1e5;  // metres
constexpr double kFullFrameHeight = 24;                    // mm

glm::dmat3 axesOf(const OrbitCamera& orbit) {
    return glm::dmat3(toCamera(orbit, 1).world);
}

double wrapped(double degrees) {
    return degrees - 360 * std::floor((degrees + 180) / 360);
}

// What a framing shows, in heights of the head as portrait painters count.
Bounds subjectOf(const Scene& scene, int character, Framing framing) {
    const bool one = character >= 0 && character < static_cast<int>(scene.characters.size());
    if (framing == Framing::full)
        return one ? scene.characters[static_cast<std::size_t>(character)].bounds : scene.bounds;
    Bounds bounds = headBounds(scene, one && framing != Framing::group
                                          ? scene.characters[static_cast<std::size_t>(character)].name
                                          : std::string("*"));
    if (bounds.empty() || framing == Framing::face) return bounds;
    const double height = bounds.size().y;
    bounds.min -= height * glm::dvec3(0.4, framing == Framing::bust ? 1.0 : 0.5, 0);
    bounds.max += height * glm::dvec3(0.4, 0.15, 0);
    return bounds;
}

std::string plain(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

Camera toCamera(const OrbitCamera& orbit, double aspect) {
    return orbitCamera(orbit.target, orbit.azimuth, orbit.elevation, orbit.distance, orbit.yfov, aspect);
}

std::string toSelector(const OrbitCamera& orbit) {
    std::string text = "orbit:";
    for (const double value : {orbit.target.x, orbit.target.y, orbit.target.z, orbit.azimuth, orbit.elevation,
                               orbit.distance, glm::degrees(orbit.yfov)}) {
        if (!text.ends_with(':')) text += ',';
        text += plain(std::round(value * 1e5) / 1e5);
    }
    return text;
}

OrbitCamera fromCamera(const Camera& camera, const glm::dvec3& pivot) {
    const glm::dvec3 eye(camera.world[3]), back = glm::normalize(glm::dvec3(camera.world[2]));
    OrbitCamera orbit;
    orbit.distance = std::clamp(glm::dot(eye - pivot, back), 0.05, kMaxDistance);
    orbit.target = eye - orbit.distance * back;
    orbit.azimuth = glm::degrees(std::atan2(back.x, back.z));
    orbit.elevation =
        std::clamp(glm::degrees(std::asin(std::clamp(back.y, -1.0, 1.0))), -kMaxElevation, kMaxElevation);
    orbit.yfov = camera.orthographic ? 2 * std::atan(camera.ymag / orbit.distance) : camera.yfov;
    orbit.yfov = std::clamp(orbit.yfov, kMinFieldOfView, kMaxFieldOfView);
    return orbit;
}

void orbitBy(OrbitCamera& camera, double dx, double dy, double height) {
    const double degreesPerPixel = 180 / std::max(height, 1.0);
    camera.azimuth = wrapped(camera.azimuth - dx * degreesPerPixel);
    camera.elevation = std::clamp(camera.elevation + dy * degreesPerPixel, -kMaxElevation, kMaxElevation);
}

void panBy(OrbitCamera& camera, double dx, double dy, double height) {
    const double metresPerPixel = 2 * camera.distance * std::tan(camera.yfov / 2) / std::max(height, 1.0);
    const glm::dmat3 axes = axesOf(camera);
    camera.target += metresPerPixel * (dy * axes[1] - dx * axes[0]);
}

void dollyBy(OrbitCamera& camera, double steps) {
    camera.distance = std::clamp(camera.distance * std::pow(0.9, steps), kMinDistance, kMaxDistance);
}

const char* framingName(Framing framing) {
    constexpr const char* kNames[] = {"Face", "Bust", "Full", "Group"};
    return kNames[static_cast<int>(framing)];
}

void frameSubject(OrbitCamera& camera, const Scene& scene, int character, Framing framing, double aspect) {
    const Bounds bounds = subjectOf(scene, character, framing);
    if (bounds.empty()) return;
    // A point p, seen from the target along the camera's axes, is inside when |p.y| ≤ (distance - p.z) tan.
    constexpr double kMargin = 1.08;
    const double tanY = std::tan(camera.yfov / 2), tanX = tanY * aspect;
    const glm::dmat3 toCameraAxes = glm::transpose(axesOf(camera));
    camera.target = bounds.centre();
    camera.distance = kMinDistance;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 half =
            0.5 * bounds.size() * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 p = toCameraAxes * half;
        camera.distance = std::max(
            {camera.distance, p.z + kMargin * std::abs(p.x) / tanX, p.z + kMargin * std::abs(p.y) / tanY});
    }
}

double focalLength(double yfov) {
    return kFullFrameHeight / (2 * std::tan(yfov / 2));
}

double fieldOfView(double focalLengthMm) {
    return 2 * std::atan(kFullFrameHeight / (2 * focalLengthMm));
}

glm::dvec3 project(const Camera& camera, double aspect, const glm::dvec3& point) {
    const glm::dvec3 p(glm::inverse(camera.world) * glm::dvec4(point, 1));
    const double depth = -p.z;
    const double halfY = camera.orthographic ? camera.ymag : std::tan(camera.yfov / 2) * std::abs(depth);
    const double halfX = halfY * aspect;
    return {0.5 + 0.5 * p.x / std::max(halfX, 1e-12), 0.5 - 0.5 * p.y / std::max(halfY, 1e-12), depth};
}

}  // namespace cutis::app
