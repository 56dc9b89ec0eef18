#include "renderer/frame/camera.h"

#include <algorithm>
#include <cmath>

namespace cutis {
glm::dvec2 halfExtents(const Camera& camera, const glm::ivec2& pixels) {
    const double aspect = static_cast<double>(pixels.x) / pixels.y;
    if (camera.orthographic) {
        const double y = std::max(camera.ymag, camera.xmag / aspect);
        return {y * aspect, y};
    }
    const double y = std::tan(0.5 * camera.yfov);
    return {y * aspect, y};
}

shared::ViewCamera viewCamera(const Camera& camera, const glm::dvec3& origin, const Bounds& bounds,
                              const glm::ivec2& pixels) {
    const glm::dvec3 right = glm::normalize(glm::dvec3(camera.world[0]));
    const glm::dvec3 up = glm::normalize(glm::dvec3(camera.world[1]));
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(camera.world[2]));
    const glm::dvec3 eye = glm::dvec3(camera.world[3]) - origin;
    const glm::dvec2 half = halfExtents(camera, pixels);

    // Planes as tight as the scene allows: depth precision goes where things are.
    double nearest = INFINITY, farthest = -INFINITY;
    for (int i = 0; i < 8 && !bounds.empty(); ++i) {
        const glm::dvec3 corner(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                                i & 4 ? bounds.max.z : bounds.min.z);
        const double z = glm::dot(corner - origin - eye, forward);
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    if (bounds.empty()) nearest = 0, farthest = 1;
    const double slack = 1e-3 * std::max(farthest - nearest, 1e-9);
    double zfar = farthest + slack;
    if (camera.zfar > 0) zfar = std::min(zfar, camera.zfar);
    double znear = std::max(camera.znear, nearest - slack);
    if (!camera.orthographic) znear = std::max(znear, 1e-6 * std::max(zfar, 1e-9));
    if (!(zfar > znear)) zfar = znear + std::max(1e-6, 1e-3 * std::abs(znear));
    const double span = zfar - znear;

    const auto row = [&](const glm::dvec3& axis, double scale, double offset) {
        return glm::dvec4(axis * scale, -glm::dot(axis, eye) * scale + offset);
    };
    glm::dvec4 rows[4];
    rows[0] = row(right, 1 / half.x, 0);
    rows[1] = row(up, -1 / half.y, 0);  // Vulkan's clip space has +Y at the bottom
    if (camera.orthographic) {
        rows[2] = row(forward, 1 / span, -znear / span);
        rows[3] = glm::dvec4(0, 0, 0, 1);
    } else {
        rows[2] = row(forward, zfar / span, -zfar * znear / span);
        rows[3] = row(forward, 1, 0);
    }
    shared::ViewCamera view{};
    for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c) view.worldToClip[c][r] = static_cast<float>(rows[r][c]);
    }
    view.origin = glm::vec3(eye);
    view.orthographic = camera.orthographic ? 1 : 0;
    view.right = glm::vec3(right * half.x);
    view.up = glm::vec3(up * half.y);
    view.forward = glm::vec3(forward);
    view.znear = static_cast<float>(znear);
    view.exposure = 1;
    return view;
}

double ViewCameraMetrics::metresPerPixel(const glm::dvec3& point) const {
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(camera_.world[2]));
    return widthOfPixel(glm::dot(point - glm::dvec3(camera_.world[3]), forward));
}

double ViewCameraMetrics::metresPerPixelAtDistance(const glm::dvec3& point) const {
    return widthOfPixel(glm::length(point - glm::dvec3(camera_.world[3])));
}

double ViewCameraMetrics::widthOfPixel(double depth) const {
    const double width = 2 * halfExtents(camera_, pixels_).y / pixels_.y;
    return camera_.orthographic ? width : width * std::max(depth, camera_.znear);
}

}  // namespace cutis
