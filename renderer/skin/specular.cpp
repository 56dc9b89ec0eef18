#include "renderer/skin/specular.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/skin/quadrature.h"

namespace cutis::skin {
namespace {

constexpr double kPi = std::numbers::pi;

// ∫_0^φ dφ' / (a + b cosφ') for a > 0, b ≥ 0, with t = tan(φ/2) and a + b cosφ > 0.
double integrateReciprocal(double a, double b, double t) {
    const double u = (a - b) / (a + b) * t * t;
    if (std::abs(u) < 1e-8) return 2 * t / (a + b) * (1 - u / 3);
    if (u > 0) return 2 / std::sqrt((a - b) * (a + b)) * std::atan(std::sqrt(u));
    return 2 / std::sqrt((b - a) * (b + a)) * std::atanh(std::min(std::sqrt(-u), 1 - 1e-15));
}

// The mean over azimuth φ of the half-vector of the estimator below, at tanθ_h = r.
double integrateAzimuth(double mu, double r) {
    static const GaussLegendre<8> rule;
    const double sigma = std::sqrt((1 - mu) * (1 + mu));
    const double q2 = 1 + r * r, q = std::sqrt(q2), b = sigma * r;
    // L is above the surface where (V·H) cosθ_h > μ/2: where cosφ > c.
    const double numerator = mu * (r * r - 1);
    double phi = kPi, reciprocal;
    if (2 * b + numerator <= 0) {
        reciprocal = kPi / std::sqrt((mu - b) * (mu + b));
    } else if (2 * b - numerator <= 0) {
        return 0;
    } else {
        const double t = std::sqrt((2 * b - numerator) / (2 * b + numerator));
        phi = 2 * std::atan(t);
        reciprocal = integrateReciprocal(mu, b, t);
    }
    // F(z) (2 - μq/z) with z = V·H = (μ + b cosφ)/q. F(z)/z = 1/z + a polynomial, because F(0) = 1: the pole
    // is integrated in closed form, and the rest is a polynomial of degree 5 in cosφ.
    const double smooth = rule.integrate(0, phi, [&](double angle) {
        const double z = (mu + b * std::cos(angle)) / q;
        const double quotient = -(1 - kSkinF0) * (5 - z * (10 - z * (10 - z * (5 - z))));  // (F(z) - 1) / z
        return 2 * schlick(z) - mu * q * quotient;
    });
    return (smooth - mu * q2 * reciprocal) / kPi;
}

}  // namespace

double beckmann(double cosTheta, double m) {
    if (!(cosTheta > 0)) return 0;
    const double cos2 = cosTheta * cosTheta, tan2 = std::max(1 - cos2, 0.0) / cos2;
    const double exponent = tan2 / (m * m);
    if (!(exponent < 700)) return 0;  // exp would underflow, and 1/cos⁴ may overflow
    return std::exp(-exponent) / (kPi * m * m * cos2 * cos2);
}

double schlick(double cosTheta, double f0) {
    const double x = std::clamp(1 - cosTheta, 0.0, 1.0), x2 = x * x;
    return f0 + (1 - f0) * x2 * x2 * x;
}

double kelemenSpecular(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l, double m) {
    if (!(glm::dot(n, v) > 0) || !(glm::dot(n, l) > 0)) return 0;
    const glm::dvec3 h = l + v;
    const double hh = glm::dot(h, h), length = std::sqrt(hh);
    if (!(hh > 0)) return 0;
    return beckmann(std::min(glm::dot(n, h) / length, 1.0), std::max(m, kMinRoughness)) *
           schlick(0.5 * length) / hh;  // V·H = |h|/2 for unit V and L
}

// Half-vectors with density D cosθ_h are tanθ_h = m √(-ln u), φ uniform. With dω_L = 4 (V·H) dω_H and h·h = 4
// (V·H)²,
//   ρ = ∫ D F μ_L / (V·H) dω_H = E[ F μ_L / ((V·H) cosθ_h) ],   μ_L = 2 (V·H) cosθ_h - μ,
// so the estimator is F (2 - μ / ((V·H) cosθ_h)) where that is positive: bounded, and a smooth function of r
// = tanθ_h but at r = tan(π/4 ∓ θ_v/2), where L starts to set and has set at every azimuth. Instead of random
// u: with s = r/m, -dlnu = 2s ds and u = exp(-s²), by quadrature over panels that grow geometrically from the
// first of these.
double directionalAlbedo(double mu, double m) {
    static const GaussLegendre<10> rule;
    mu = std::clamp(mu, 1e-9, 1.0);
    m = std::clamp(m, kMinRoughness, 1.0);
    const double sigma = std::sqrt((1 - mu) * (1 + mu));
    const double reach = 6;  // exp(-36)
    const double setting = std::min(mu / (1 + sigma) / m, reach), set = std::min((1 + sigma) / mu / m, reach);
    const auto integrand = [&](double s) { return 2 * s * std::exp(-s * s) * integrateAzimuth(mu, s * m); };
    double albedo = 0;
    for (double a = 0; a < setting;) {
        const double b = std::min(a + 1, setting);
        albedo += rule.integrate(a, b, integrand);
        a = b;
    }
    for (double a = setting; a < set;) {
        const double b = std::min(a + std::min(a, 1.0), set);
        albedo += rule.integrate(a, b, integrand);
        a = b;
    }
    return std::clamp(albedo, 0.0, 1.0);
}

double clampedScale(double s, double albedo) {
    return s * albedo > 1 ? 1 / albedo : s;
}

std::vector<float> directionalAlbedoRow(double m, int count) {
    std::vector<float> row(count);
    for (int i = 0; i < count; ++i) {
        const double t = double(i) / (count - 1);
        row[i] = float(directionalAlbedo(t * t, m));
    }
    return row;
}

std::vector<float> mixedAlbedoRow(double m, double narrower, double weight, int count) {
    std::vector<float> row = directionalAlbedoRow(m, count);
    if (!(weight > 0)) return row;
    const std::vector<float> second = directionalAlbedoRow(narrower, count);
    for (int i = 0; i < count; ++i) row[i] = float(row[i] * (1 - weight) + second[i] * weight);
    return row;
}

double lookUpAlbedo(std::span<const float> row, double mu) {
    const double x = std::sqrt(std::clamp(mu, 0.0, 1.0)) * double(row.size() - 1);
    const std::size_t i = std::min(std::size_t(x), row.size() - 2);
    const double f = x - double(i);
    return row[i] * (1 - f) + row[i + 1] * f;
}

double meanAlbedo(double m, double s) {
    return meanAlbedo(directionalAlbedoRow(m, 4 * kAlbedoRowSize), s);
}

double meanAlbedo(std::span<const float> row, double s) {
    static const GaussLegendre<4> rule;
    const double count = double(row.size() - 1);
    double mean = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i)  // μ = t²: 2 μ dμ = 4 t³ dt
        mean += rule.integrate(double(i) / count, double(i + 1) / count, [&](double t) {
            const double f = t * count - double(i);
            return 4 * t * t * t * std::min(1.0, s * (row[i] * (1 - f) + row[i + 1] * f));
        });
    return std::min(mean, 1.0);
}

}  // namespace cutis::skin
