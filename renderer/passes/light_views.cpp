#include "renderer/passes/light_views.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cutis {
namespace {

// Texels around what a view serves, so that filters near its edge stay inside.
constexpr double kMarginTexels = 6;

std::array<glm::dvec3, 8> corners(const Bounds& bounds) {
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i) {
        result[i] = {i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                     i & 4 ? bounds.max.z : bounds.min.z};
    }
    return result;
}

struct Frame {
    glm::dvec3 right, up, forward;
    glm::dvec3 toFrame(const glm::dvec3& v) const { return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, forward)}; }
};

Frame frameAlong(const glm::dvec3& forward) {
    const glm::dvec3 aside = std::abs(forward.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, aside));
    return {right, glm::cross(right, forward), forward};
}

// Rows of the matrix that takes p (relative to the origin) to clip space, from rows in double.
glm::mat4 fromRows(const std::array<glm::dvec4, 4>& rows) {
    glm::dmat4 m;
    for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c) m[c][r] = rows[r][c];
    }
    return glm::mat4(m);
}

struct Range {
    double low = INFINITY, high = -INFINITY;
    void extend(double x) { low = std::min(low, x), high = std::max(high, x); }
    double size() const { return high - low; }
    double middle() const { return 0.5 * (low + high); }
};

}  // namespace

shared::LightView directionalView(const glm::dvec3& direction, const Bounds& receivers, const Bounds& casters,
                                  const glm::dvec3& origin, int mapSize) {
    const Frame frame = frameAlong(glm::normalize(direction));
    Range x, y, z;
    for (const glm::dvec3& corner : corners(receivers)) {
        const glm::dvec3 p = frame.toFrame(corner - origin);
        x.extend(p.x), y.extend(p.y), z.extend(p.z);
    }
    Range depth = z;
    for (const glm::dvec3& corner : corners(casters)) depth.extend(frame.toFrame(corner - origin).z);
    const double extent = std::max({x.size(), y.size(), 1e-9});
    const double width = extent * (1 + 2 * kMarginTexels / mapSize);
    const double slack = 1e-3 * std::max(depth.size(), extent);
    const double nearPlane = depth.low - slack, farPlane = z.high + slack;
    const double span = farPlane - nearPlane;

    shared::LightView view{};
    view.worldToClip = fromRows({glm::dvec4(frame.right * (2 / width), -2 * x.middle() / width),
                                 glm::dvec4(frame.up * (2 / width), -2 * y.middle() / width),
                                 glm::dvec4(frame.forward / span, -nearPlane / span), glm::dvec4(0, 0, 0, 1)});
    view.depthToDistance = glm::vec3(0, 0, span);
    view.texelSize = static_cast<float>(width / mapSize);
    return view;
}

shared::LightView perspectiveView(const glm::dvec3& position, const Bounds& receivers, const Bounds& casters,
                                  const glm::dvec3& origin, int mapSize) {
    const glm::dvec3 towards = receivers.centre() - position;
    const double distance = glm::length(towards);
    const Frame frame = frameAlong(distance > 1e-9 ? towards / distance : glm::dvec3(0, 0, -1));
    const double size = std::max(glm::length(receivers.size()), 1e-9);
    constexpr double kWidest = 6.0;  // tangent of half the field of view: 161 degrees
    Range x, y, z, depth;
    for (const glm::dvec3& corner : corners(receivers)) {
        const glm::dvec3 p = frame.toFrame(corner - position);
        const double ahead = std::max(p.z, 1e-3 * size);
        x.extend(std::clamp(p.x / ahead, -kWidest, kWidest));
        y.extend(std::clamp(p.y / ahead, -kWidest, kWidest));
        z.extend(p.z);
    }
    for (const glm::dvec3& corner : corners(casters)) depth.extend(frame.toFrame(corner - position).z);
    const double width = std::max({x.size(), y.size(), 1e-9}) * (1 + 2 * kMarginTexels / mapSize);
    const double farPlane = std::max(z.high * 1.001, 1e-6 * size);
    // Depth in float32 keeps 1e-7 of near·far/z²: a near plane at a thousandth of the way costs nothing visible.
    const double nearPlane = std::clamp(depth.low * 0.999, 1e-3 * farPlane, 0.5 * farPlane);
    const double span = farPlane - nearPlane;

    const glm::dvec3 eye = position - origin;
    const auto row = [&](const glm::dvec3& axis, double scale, double shift) {
        const glm::dvec3 a = axis * scale - frame.forward * shift;
        return glm::dvec4(a, -glm::dot(a, eye));
    };
    shared::LightView view{};
    view.worldToClip =
        fromRows({row(frame.right, 2 / width, 2 * x.middle() / width), row(frame.up, 2 / width, 2 * y.middle() / width),
                  glm::dvec4(frame.forward * (farPlane / span),
                             -glm::dot(frame.forward, eye) * farPlane / span - farPlane * nearPlane / span),
                  glm::dvec4(frame.forward, -glm::dot(frame.forward, eye))});
    // z = far·near / (far - d·(far - near))
    view.depthToDistance = glm::vec3(farPlane * nearPlane, farPlane, -span);
    view.texelSize = static_cast<float>(width / mapSize);
    return view;
}

std::vector<shared::LightView> computeLightViews(std::span<const LightSample> samples, std::span<const Bounds> groups,
                                                 const Bounds& casters, const glm::dvec3& origin, int mapSize) {
    std::vector<shared::LightView> views;
    views.reserve(samples.size() * groups.size());
    for (const LightSample& sample : samples) {
        for (const Bounds& group : groups) {
            views.push_back(sample.directional ? directionalView(sample.direction, group, casters, origin, mapSize)
                                               : perspectiveView(sample.position, group, casters, origin, mapSize));
            views.back().layer = static_cast<std::uint32_t>(views.size() - 1);
        }
    }
    return views;
}

bool reaches(const glm::mat4& worldToClip, const glm::vec3& boxMin, const glm::vec3& boxMax) {
    // A box is out when all its corners are beyond one plane of the frustum. Nothing is before the near plane.
    int outside[5] = {};
    for (int i = 0; i < 8; ++i) {
        const glm::vec4 corner(i & 1 ? boxMax.x : boxMin.x, i & 2 ? boxMax.y : boxMin.y, i & 4 ? boxMax.z : boxMin.z, 1);
        const glm::vec4 clip = worldToClip * corner;
        outside[0] += clip.x < -clip.w;
        outside[1] += clip.x > clip.w;
        outside[2] += clip.y < -clip.w;
        outside[3] += clip.y > clip.w;
        outside[4] += clip.z > clip.w;
    }
    return std::none_of(std::begin(outside), std::end(outside), [](int count) { return count == 8; });
}

}  // namespace cutis
