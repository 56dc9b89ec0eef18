// Values of animation curves over time.
#include <algorithm>
#include <cmath>

#include "renderer/scene/pose.h"

namespace cutis {
namespace {

glm::dquat quaternionOf(const std::vector<double>& v) {
    return {v[3], v[0], v[1], v[2]};
}

std::vector<double> valuesOf(const glm::dquat& q) {
    const double length = glm::length(q);
    if (!(length > 1e-12)) return {0, 0, 0, 1};
    return {q.x / length, q.y / length, q.z / length, q.w / length};
}

// Row `row` of the keys' values.
std::vector<double> rowOf(const AnimationSampler& curve, std::size_t row) {
    const auto begin = curve.values.begin() + std::ptrdiff_t(row * curve.components);
    return {begin, begin + std::ptrdiff_t(curve.components)};
}

std::vector<double> valueAtKey(const AnimationSampler& curve, std::size_t key) {
    return rowOf(curve, curve.interpolation == Interpolation::cubicSpline ? 3 * key + 1 : key);
}

// glTF 2.0, appendix C.5: Hermite, its slopes in units a second.
std::vector<double> hermite(const AnimationSampler& curve, std::size_t key, double t, double span) {
    const std::vector<double> from = rowOf(curve, 3 * key + 1), slopeOut = rowOf(curve, 3 * key + 2);
    const std::vector<double> slopeIn = rowOf(curve, 3 * key + 3), to = rowOf(curve, 3 * key + 4);
    const double t2 = t * t, t3 = t2 * t;
    std::vector<double> value(curve.components);
    for (std::size_t c = 0; c < value.size(); ++c) {
        value[c] = (2 * t3 - 3 * t2 + 1) * from[c] + span * (t3 - 2 * t2 + t) * slopeOut[c] +
                   (3 * t2 - 2 * t3) * to[c] + span * (t3 - t2) * slopeIn[c];
    }
    return value;
}

std::vector<double> between(const AnimationSampler& curve, bool rotation, std::size_t key, double t,
                            double span) {
    if (curve.interpolation == Interpolation::cubicSpline) return hermite(curve, key, t, span);
    std::vector<double> from = valueAtKey(curve, key);
    if (curve.interpolation == Interpolation::step) return from;
    const std::vector<double> to = valueAtKey(curve, key + 1);
    if (rotation) {
        // The shorter way round, as appendix C.4 has it.
        return valuesOf(glm::slerp(quaternionOf(valuesOf(quaternionOf(from))),
                                   quaternionOf(valuesOf(quaternionOf(to))), t));
    }
    for (std::size_t c = 0; c < from.size(); ++c) from[c] += t * (to[c] - from[c]);
    return from;
}

}  // namespace

std::vector<double> sampleCurve(const AnimationSampler& curve, bool rotation, double seconds) {
    const auto after = std::upper_bound(curve.times.begin(), curve.times.end(), seconds,
                                        [](double at, float time) { return at < double(time); });
    const std::size_t next = std::size_t(after - curve.times.begin());
    std::vector<double> value;
    if (next == 0 || next == curve.times.size()) {
        value = valueAtKey(curve, next == 0 ? 0 : next - 1);
    } else {
        const double from = curve.times[next - 1], span = double(curve.times[next]) - from;
        value = between(curve, rotation, next - 1, (seconds - from) / span, span);
    }
    return rotation ? valuesOf(quaternionOf(value)) : value;
}

}  // namespace cutis
