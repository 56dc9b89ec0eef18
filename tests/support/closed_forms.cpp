#include "tests/support/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cutis::test {

namespace {

constexpr double kPi = std::numbers::pi;

// λ_l / λ_{l-1} = i_l(κ) / i_{l-1}(κ), ratios of modified spherical Bessel functions. The recurrence
// i_{l-1} = (2l+1)/κ · i_l + i_{l+1} is stable downwards only, whatever its start.
std::vector<double> besselRatios(double kappa, int count) {
    std::vector<double> ratios(count + 1, 0.0);
    double above = 0;
    for (int l = count + 60; l >= 1; --l) {
        above = 1 / ((2 * l + 1) / kappa + above);
        if (l <= count) ratios[l] = above;
    }
    return ratios;
}

std::vector<glm::dvec3> clipToHorizon(const std::vector<glm::dvec3>& corners, const glm::dvec3& point,
                                      const glm::dvec3& normal) {
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
        const double heightA = dot(a - point, normal), heightB = dot(b - point, normal);
        if (heightA >= 0) kept.push_back(a);
        if ((heightA >= 0) != (heightB >= 0)) kept.push_back(a + (b - a) * (heightA / (heightA - heightB)));
    }
    return kept;
}

}  // namespace

double edgeResponse(const skin::Profile& profile, int channel, double x) {
    double sum = 0;
    for (const skin::Gaussian& g : profile.gaussians)
        sum += g.weight[channel] * 0.5 * (1 + std::erf(x / std::sqrt(2 * g.variance)));
    return sum;
}

double slabTransmission(const skin::Profile& profile, int channel, double thickness) {
    double sum = 0;
    for (const skin::Gaussian& g : profile.gaussians)
        sum += g.weight[channel] * std::exp(-thickness * thickness / (2 * g.variance));
    return sum;
}

SphereDiffusion::SphereDiffusion(const skin::Profile& profile, double radius) {
    double widestKappa = 1;
    for (const skin::Gaussian& g : profile.gaussians)
        widestKappa = std::max(widestKappa, radius * radius / g.variance);
    // λ_l falls as exp(-l²/2κ): eight standard deviations.
    const int count = 32 + static_cast<int>(8 * std::sqrt(widestKappa));
    coefficients_.assign(count + 1, glm::dvec3(0));
    for (const skin::Gaussian& g : profile.gaussians) {
        const double kappa = radius * radius / g.variance;
        const std::vector<double> ratios = besselRatios(kappa, count);
        double lambda = 1 - std::exp(-2 * kappa);
        double evenMoment = 0.5;  // ∫_0^1 t P_l(t) dt for even l: 1/2, 1/8, -1/48, …
        for (int l = 0; l <= count; ++l) {
            if (l > 0) lambda *= ratios[l];
            double cosineCoefficient = 0;
            if (l == 1) cosineCoefficient = 0.5;
            if (l % 2 == 0) {
                cosineCoefficient = (2 * l + 1) / 2.0 * evenMoment;
                evenMoment *= -(l - 1.0) / (l + 4.0);
            }
            coefficients_[l] += g.weight * (lambda * cosineCoefficient);
        }
    }
}

double SphereDiffusion::operator()(double cosTheta, int channel) const {
    double previous = 1, current = cosTheta;  // P_0, P_1
    double sum = coefficients_[0][channel] + coefficients_[1][channel] * cosTheta;
    for (std::size_t l = 2; l < coefficients_.size(); ++l) {
        const double next = ((2.0 * l - 1) * cosTheta * current - (l - 1.0) * previous) / l;
        previous = current, current = next;
        sum += coefficients_[l][channel] * current;
    }
    return sum;
}

double integrateSphereDiffusion(const skin::Profile& profile, double radius, double cosTheta, int channel,
                                int steps) {
    const double sinTheta = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
    const glm::dvec3 light(sinTheta, 0, cosTheta);  // seen from x, which is the pole
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        // Midpoints in 1 - cosγ = 2q³: dense at the pole, where narrow Gaussians live.
        const double q = (i + 0.5) / steps;
        const double drop = 2 * q * q * q, weight = 6 * q * q / steps;
        const double cosGamma = 1 - drop, sinGamma = std::sqrt(drop * (2 - drop));
        double kernel = 0;
        for (const skin::Gaussian& g : profile.gaussians)
            kernel +=
                g.weight[channel] * std::exp(-radius * radius * drop / g.variance) / (2 * kPi * g.variance);
        double ring = 0;
        for (int j = 0; j < 2 * steps; ++j) {
            const double phi = (j + 0.5) * kPi / steps;
            ring += std::max(0.0, dot(light, {sinGamma * std::cos(phi), sinGamma * std::sin(phi), cosGamma}));
        }
        sum += kernel * weight * ring * kPi / steps;
    }
    return sum * radius * radius;
}

double polygonIrradiance(const glm::dvec3& point, const glm::dvec3& normal, std::vector<glm::dvec3> corners,
                         double radiance) {
    corners = clipToHorizon(corners, point, normal);
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = normalize(corners[i] - point);
        const glm::dvec3 b = normalize(corners[(i + 1) % corners.size()] - point);
        const glm::dvec3 axis = cross(a, b);
        if (length(axis) < 1e-14) continue;
        sum += std::atan2(length(axis), dot(a, b)) * dot(normalize(axis), normal);
    }
    return radiance * 0.5 * std::abs(sum);
}

std::array<glm::dvec3, 4> rectCorners(const glm::dvec3& centre, const glm::dvec3& direction, double width,
                                      double height) {
    const glm::dvec3 right = normalize(cross(direction, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = normalize(cross(right, direction));
    const glm::dvec3 w = right * (width / 2), h = up * (height / 2);
    return {centre - w - h, centre + w - h, centre + w + h, centre - w + h};
}

glm::dvec3 integrateIrradiance(const glm::dvec3& normal,
                               const std::function<glm::dvec3(const glm::dvec3&)>& radiance, int steps) {
    const glm::dvec3 helper = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 tangent = normalize(cross(helper, normal)), bitangent = cross(normal, tangent);
    glm::dvec3 sum(0);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 4 * steps; ++j) {
            const double r = std::sqrt((i + 0.5) / steps), phi = (j + 0.5) * kPi / (2 * steps);
            sum += radiance(tangent * (r * std::cos(phi)) + bitangent * (r * std::sin(phi)) +
                            normal * std::sqrt(1 - r * r));
        }
    return sum * (kPi / (4.0 * steps * steps));
}

}  // namespace cutis::test
