#include "renderer/scene/light_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <numeric>
#include <string>

#include "renderer/core/error.h"
#include "renderer/scene/spherical_rectangle.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGolden = std::numbers::phi - 1;    // best one-dimensional Kronecker step
constexpr double kPlastic = 0.56984029099805326591;  // 1/ρ², ρ the plastic number: independent of kGolden
constexpr int kDefaultRadiusSamples = 6, kDefaultRectSamples = 9;
constexpr double kMaxCellAspect = 1.5;  // of a grid's cells; beyond it a lattice spreads samples better

double fraction(double x) {
    return x - std::floor(x);
}

// Step g of the rank-1 lattice {(i, g·i mod n)} whose nearest two points, on the torus that is `aspect` as
// wide as high, are farthest apart.
int latticeStep(int n, double aspect) {
    int bestStep = 1;
    double best = -1;
    for (int g = 1; g < n; ++g) {
        if (std::gcd(g, n) != 1) continue;
        double nearest = aspect * aspect + 1;
        for (int i = 1; i < n; ++i) {
            const int j = static_cast<int>(static_cast<long long>(g) * i % n);
            const double dx = aspect * std::min(i, n - i) / n, dy = double(std::min(j, n - j)) / n;
            nearest = std::min(nearest, dx * dx + dy * dy);
            if (nearest <= best) break;
        }
        if (nearest > best) best = nearest, bestStep = g;
    }
    return bestStep;
}

// n points of the unit square, centred on 0 and symmetric about it, so that all odd moments vanish. `aspect`
// is the width over the height of what the square stands for.
std::vector<glm::dvec2> squarePoints(int n, double aspect) {
    int columns = 0;
    double best = kMaxCellAspect;
    for (int a = 1; a <= n; ++a) {
        if (n % a) continue;
        const double cell = aspect / a * (n / a);  // width over height of one cell
        const double elongation = std::max(cell, 1 / cell);
        if (elongation <= best) best = elongation, columns = a;
    }
    std::vector<glm::dvec2> points(n);
    if (columns) {
        const int rows = n / columns;
        for (int i = 0; i < n; ++i)
            points[i] = {(i % columns + 0.5) / columns - 0.5, (i / columns + 0.5) / rows - 0.5};
        return points;
    }
    // A lattice with one point in each of n rows and n columns. Its shift 2c ≡ g-1 (mod n) makes i and n-1-i
    // mirror images; it exists because g is odd wherever n is even.
    const int g = latticeStep(n, aspect), shift = (g % 2 ? g - 1 : g - 1 + n) / 2;
    for (int i = 0; i < n; ++i) {
        const long long j = (static_cast<long long>(g) * i + shift) % n;
        points[i] = {(i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5};
    }
    return points;
}

// Square of side 1 to disc of radius 1, areas kept in proportion (Shirley & Chiu, "A Low Distortion Map
// Between Disk and Square", JGT 2(3), 1997).
glm::dvec2 discFromSquare(const glm::dvec2& p) {
    const glm::dvec2 q = 2.0 * p;
    if (q.x == 0 && q.y == 0) return {0, 0};
    if (std::abs(q.x) > std::abs(q.y)) {
        const double angle = kPi / 4 * (q.y / q.x);
        return q.x * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    const double angle = kPi / 2 - kPi / 4 * (q.x / q.y);
    return q.y * glm::dvec2(std::cos(angle), std::sin(angle));
}

// Radius within which a fraction u lies of the density 1 / (π² √(1-r²)) in the unit ball: the one whose
// projection along any axis is an even disc (its Abel transform is constant). CDF(r) = 2/π · (asin r - r
// √(1-r²)).
double ballRadius(double u) {
    double low = 0, high = kPi / 2;  // of t = asin r: CDF = (2t - sin 2t) / π
    for (int step = 0; step < 50; ++step) {
        const double t = 0.5 * (low + high);
        ((2 * t - std::sin(2 * t)) / kPi < u ? low : high) = t;
    }
    return std::sin(0.5 * (low + high));
}

// n points of that density: pairs of opposite points, and the centre when n is odd, so that the mean is the
// centre.
std::vector<glm::dvec3> ballPoints(int n) {
    std::vector<glm::dvec3> points;
    points.reserve(n);
    if (n % 2) points.emplace_back(0);
    const int pairs = n / 2;
    for (int i = 0; i < pairs; ++i) {
        const double z = (i + 0.5) / pairs, angle = 2 * kPi * fraction(i * kGolden);
        const double r = ballRadius(pairs == 1 ? 0.5 : fraction(0.5 + (i - 0.5 * (pairs - 1)) * kPlastic));
        const double across = std::sqrt(1 - z * z);
        const glm::dvec3 p = r * glm::dvec3(across * std::cos(angle), across * std::sin(angle), z);
        points.push_back(p);
        points.push_back(-p);
    }
    return points;
}

LightSample wholeLight(const Light& light, int index) {
    LightSample sample;
    sample.light = index;
    sample.directional = light.type == LightType::directional;
    sample.position = light.position;
    sample.direction = light.direction;
    sample.intensity = lightIntensity(light);
    sample.range = light.range;
    sample.shadow = light.shadow;
    if (light.type == LightType::spot) {
        sample.cosInner = std::cos(light.innerConeAngle);
        sample.cosOuter = std::cos(light.outerConeAngle);
    }
    return sample;
}

// The R2 sequence (Roberts 2018), 0 for seed 0.
glm::dvec2 shiftOf(std::uint32_t seed) {
    return {fraction(seed * std::sqrt(kPlastic)), fraction(seed * kPlastic)};
}

// Shifted as on a torus (Cranley & Patterson 1976); within [-1/2, 1/2]².
std::vector<glm::dvec2> shiftedSquarePoints(int n, double aspect, std::uint32_t seed) {
    std::vector<glm::dvec2> points = squarePoints(n, aspect);
    if (seed == 0) return points;
    const glm::dvec2 shift = shiftOf(seed) + 0.5;
    for (glm::dvec2& p : points) p = {fraction(p.x + shift.x) - 0.5, fraction(p.y + shift.y) - 0.5};
    return points;
}

// Turned to a direction of its own for each seed.
std::vector<glm::dvec3> turnedBallPoints(int n, std::uint32_t seed) {
    std::vector<glm::dvec3> points = ballPoints(n);
    if (seed == 0) return points;
    const glm::dvec2 shift = shiftOf(seed);
    const glm::dquat turn = glm::angleAxis(2 * kPi * shift.x, glm::dvec3(0, 0, 1)) *
                            glm::angleAxis(std::acos(1 - 2 * shift.y), glm::dvec3(1, 0, 0));
    for (glm::dvec3& p : points) p = turn * p;
    return points;
}

// Steradians from which on a rect light is divided by solid angle: a square 2.4 times as wide as its
// distance.
constexpr double kLargeSolidAngle = 2;

// True when the light is large as the subject sees it and these are its samples.
bool appendBySolidAngle(const Light& light, const LightSample& whole, const SamplingOptions& options,
                        std::vector<LightSample>& samples) {
    if (!options.subject || !(glm::dot(*options.subject - light.position, light.direction) > 0)) return false;
    const RectAxes axes = rectAxes(light.direction);
    const SphericalRectangle seen(light.position, axes.x, axes.y, light.size, *options.subject);
    if (!(seen.solidAngle() > kLargeSolidAngle)) return false;
    const int n = sampleCount(light);
    const double share = seen.solidAngle() / n;
    for (const glm::dvec2& p : shiftedSquarePoints(n, 1, options.seed)) {
        LightSample sample = whole;
        const glm::dvec2 place = seen.placeOf(p + 0.5);
        sample.position += axes.x * place.x + axes.y * place.y;
        const glm::dvec3 away = *options.subject - sample.position;
        const double squared = glm::dot(away, away);
        const double cosine = glm::dot(away, light.direction) / std::sqrt(squared);
        const double area = share * squared / cosine;
        sample.radius = 0.5 * std::sqrt(area);
        // So that irradianceFrom gives L · share where the subject stands.
        const double wider = area / (kPi * squared) * std::max(3 * cosine * cosine - 2, 0.0);
        sample.intensity = lightIntensity(light) * (area * (1 + wider));
        samples.push_back(sample);
    }
    return true;
}

void appendArea(const Light& light, const LightSample& whole, std::uint32_t seed,
                std::vector<LightSample>& samples) {
    const int n = sampleCount(light);
    const RectAxes axes = rectAxes(light.direction);
    const auto append = [&](const glm::dvec3& offset, double area) {
        LightSample sample = whole;
        sample.position += offset;
        sample.intensity /= n;
        sample.radius = 0.5 * std::sqrt(area / n);
        samples.push_back(sample);
    };
    if (light.type == LightType::rect) {
        const double area = light.size.x * light.size.y;
        for (const glm::dvec2& p : shiftedSquarePoints(n, light.size.x / light.size.y, seed))
            append(axes.x * (p.x * light.size.x) + axes.y * (p.y * light.size.y), area);
        return;
    }
    const double area = kPi * light.radius * light.radius;
    if (light.type == LightType::spot) {
        for (const glm::dvec2& p : shiftedSquarePoints(n, 1, seed)) {
            const glm::dvec2 q = light.radius * discFromSquare(p);
            append(axes.x * q.x + axes.y * q.y, area);
        }
        return;
    }
    for (const glm::dvec3& p : turnedBallPoints(n, seed)) append(light.radius * p, area);
}

bool hasArea(const Light& light) {
    switch (light.type) {
        case LightType::directional:
            return false;
        case LightType::point:
        case LightType::spot:
            return light.radius > 0;
        case LightType::rect:
            return true;
    }
    return false;
}

}  // namespace

int sampleCount(const Light& light) {
    if (!hasArea(light)) return 1;
    if (light.samples > 0) return light.samples;
    return light.type == LightType::rect ? kDefaultRectSamples : kDefaultRadiusSamples;
}

std::vector<LightSample> sampleLights(const Rig& rig, const SamplingOptions& options) {
    std::size_t total = 0;
    for (const Light& light : rig.lights)
        if (light.enabled) total += sampleCount(light);
    if (total > options.limit) {
        throw Error("too many light samples",
                    "the enabled lights have " + std::to_string(total) + ", the limit is " +
                        std::to_string(options.limit),
                    rig.name);
    }
    std::vector<LightSample> samples;
    samples.reserve(total);
    for (std::size_t i = 0; i < rig.lights.size(); ++i) {
        const Light& light = rig.lights[i];
        if (!light.enabled) continue;
        LightSample whole = wholeLight(light, static_cast<int>(i));
        if (light.type == LightType::rect) {
            // Radiance L over area A shines L·A candela along the normal, and falls with the cosine off it.
            whole.intensity *= light.size.x * light.size.y;
            whole.cosineEmission = true;
        }
        if (light.type == LightType::rect && appendBySolidAngle(light, whole, options, samples)) continue;
        if (hasArea(light)) {
            appendArea(light, whole, options.seed, samples);
        } else {
            samples.push_back(whole);
        }
    }
    return samples;
}

glm::dvec3 irradianceFrom(const LightSample& sample, const glm::dvec3& p, const glm::dvec3& n) {
    if (sample.directional) return sample.intensity * std::max(0.0, -glm::dot(sample.direction, n));
    const glm::dvec3 toLight = sample.position - p;
    const double squared = glm::dot(toLight, toLight);
    if (!(squared > 0)) return glm::dvec3(0);
    const double distance = std::sqrt(squared);
    const glm::dvec3 l = toLight / distance;
    const double cosEmitted = -glm::dot(sample.direction, l);
    double factor = std::max(0.0, glm::dot(n, l)) / squared;
    if (sample.cosineEmission) {
        const double across = sample.radius / distance;
        const double wider = 4 / kPi * across * across * std::max(3 * cosEmitted * cosEmitted - 2, 0.0);
        factor *= std::max(0.0, cosEmitted) / (1 + wider);
    }
    if (sample.cosOuter > -1) {
        // Not KHR_lights_punctual's 0.001: it would dim cones of up to 2.5 degrees.
        const double width = std::max(1e-6, sample.cosInner - sample.cosOuter);
        const double cone = std::clamp((cosEmitted - sample.cosOuter) / width, 0.0, 1.0);
        factor *= cone * cone;
    }
    if (sample.range > 0) factor *= std::clamp(1 - std::pow(distance / sample.range, 4), 0.0, 1.0);
    return sample.intensity * factor;
}

RectAxes rectAxes(const glm::dvec3& direction) {
    const glm::dvec3 horizontal = glm::cross(glm::dvec3(0, 1, 0), direction);
    const double length = glm::length(horizontal);
    const glm::dvec3 x = length > 1e-9 ? horizontal / length : glm::dvec3(1, 0, 0);
    return {x, glm::normalize(glm::cross(direction, x))};
}

glm::dvec3 colorFromTemperature(double kelvin) {
    const double temperature = std::clamp(kelvin, kMinTemperature, kMaxTemperature);
    constexpr double kSecondRadiation = 1.438776877e7;  // hc/k, nm·K
    // Wyman et al., equation 4: sums of Gaussians whose width differs left and right of the peak.
    const auto lobe = [](double x, double height, double peak, double left, double right) {
        const double t = (x - peak) * (x < peak ? left : right);
        return height * std::exp(-0.5 * t * t);
    };
    glm::dvec3 xyz(0);
    for (double nm = 360; nm <= 830; nm += 1) {
        // Planck's law up to a factor; nm/560 keeps the powers near 1.
        const double power = std::pow(nm / 560, -5) / std::expm1(kSecondRadiation / (nm * temperature));
        xyz += power *
               glm::dvec3(lobe(nm, 0.362, 442.0, 0.0624, 0.0374) + lobe(nm, 1.056, 599.8, 0.0264, 0.0323) +
                              lobe(nm, -0.065, 501.1, 0.0490, 0.0382),
                          lobe(nm, 0.821, 568.8, 0.0213, 0.0247) + lobe(nm, 0.286, 530.9, 0.0613, 0.0322),
                          lobe(nm, 1.217, 437.0, 0.0845, 0.0278) + lobe(nm, 0.681, 459.0, 0.0385, 0.0725));
    }
    // XYZ to linear Rec.709 with white D65 (IEC 61966-2-1).
    const glm::dvec3 rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                         -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                         0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
    const glm::dvec3 inGamut = glm::max(rgb, glm::dvec3(0));
    return inGamut / glm::dot(inGamut, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 lightIntensity(const Light& light) {
    const glm::dvec3 tint = light.temperature ? colorFromTemperature(*light.temperature) : glm::dvec3(1);
    return light.intensity * light.color * tint;
}

}  // namespace cutis
