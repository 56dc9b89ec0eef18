#include "renderer/reference/environment_sampler.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/directions.h"
#include "renderer/scene/environment_clusters.h"

namespace cutis::reference {
namespace {

constexpr int kMaxColumns = 32, kMaxRows = 16;  // of cells
constexpr int kBinsAcross = 24;                 // of normals, in the octahedral square

double luminance(const glm::vec3& radiance) {
    return (double(radiance.r) + radiance.g + radiance.b) / 3;
}

// ∫ dω over a texel of row y.
double texelSolidAngle(const Environment& environment, int y) {
    return 2 * kPi / environment.width *
           (std::cos(kPi * y / environment.height) - std::cos(kPi * (y + 1) / environment.height));
}

// Unit vectors in a square (Cigolle et al. 2014), [0,1]².
glm::dvec2 toSquare(const glm::dvec3& v) {
    const glm::dvec3 n = v / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
    glm::dvec2 e(n.x, n.y);
    if (n.z < 0) e = {(1 - std::abs(n.y)) * (n.x >= 0 ? 1 : -1), (1 - std::abs(n.x)) * (n.y >= 0 ? 1 : -1)};
    return e * 0.5 + 0.5;
}

glm::dvec3 fromSquare(const glm::dvec2& square) {
    const glm::dvec2 e = square * 2.0 - 1.0;
    glm::dvec3 n(e, 1 - std::abs(e.x) - std::abs(e.y));
    const double t = std::max(-n.z, 0.0);
    n.x += n.x >= 0 ? -t : t;
    n.y += n.y >= 0 ? -t : t;
    return glm::normalize(n);
}

// Makes a list of weights cumulative and ending at 1; empty when they sum to nothing.
std::vector<float> cumulated(const std::vector<double>& weights) {
    double total = 0;
    for (double w : weights) total += w;
    std::vector<float> result;
    if (!(total > 0)) return result;
    double sum = 0;
    for (double w : weights) result.push_back(static_cast<float>((sum += w) / total));
    result.back() = 1;
    return result;
}

struct Choice {
    std::size_t index;
    double fraction;  // what is left of u, uniform again
};

// Probabilities are the differences of the stored floats, exactly as probabilityOf gives them.
Choice choose(const std::vector<float>& cumulative, double u) {
    const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u,
                                        [](double value, float entry) { return value < entry; });
    const std::size_t i = std::min<std::size_t>(found - cumulative.begin(), cumulative.size() - 1);
    const double low = i > 0 ? cumulative[i - 1] : 0, high = cumulative[i];
    return {i, high > low ? std::clamp((u - low) / (high - low), 0.0, 1.0) : 0.5};
}

double probabilityOf(const std::vector<float>& cumulative, std::size_t i) {
    return double(cumulative[i]) - (i > 0 ? cumulative[i - 1] : 0.f);
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Environment* environment, const EnvironmentSettings& settings) {
    if (!environment || !settings.enabled || !(settings.intensity > 0)) return;
    environment_ = environment;
    intensity_ = settings.intensity;
    const glm::dvec3 turned = rotateAboutY({0, 0, 1}, settings.rotation);
    cosine_ = turned.z;
    sine_ = turned.x;
    makeCells();
    makeBins();
}

void EnvironmentSampler::makeCells() {
    const Environment& e = *environment_;
    for (int y = 0; y < e.height; ++y) solidAngles_.push_back(texelSolidAngle(e, y));
    columns_ = std::min(kMaxColumns, e.width);
    rows_ = std::min(kMaxRows, e.height);
    for (int r = 0; r < rows_; ++r) {
        for (int c = 0; c < columns_; ++c) {
            Cell cell{c * e.width / columns_,
                      (c + 1) * e.width / columns_,
                      r * e.height / rows_,
                      (r + 1) * e.height / rows_,
                      0,
                      {}};
            std::vector<double> weights;
            for (int y = cell.y0; y < cell.y1; ++y) {
                for (int x = cell.x0; x < cell.x1; ++x) {
                    weights.push_back(luminance(e.radiance[std::size_t(y) * e.width + x]) *
                                      texelSolidAngle(e, y));
                    cell.weight += weights.back();
                }
            }
            cell.cumulative = cumulated(weights);
            cells_.push_back(std::move(cell));
        }
    }
}

void EnvironmentSampler::makeBins() {
    const Environment& e = *environment_;
    // A cell's half diagonal plus a bin's: how far either may be from its centre. Below the horizon by more
    // than that, a cell gives the bin's normals nothing.
    const double reach = kPi / std::min(columns_ / 2.0, double(rows_)) * 0.75 + 2.0 / kBinsAcross;
    bins_.reserve(kBinsAcross * kBinsAcross);
    for (int bin = 0; bin < kBinsAcross * kBinsAcross; ++bin) {
        const glm::dvec3 n =
            fromSquare((glm::dvec2(bin % kBinsAcross, bin / kBinsAcross) + 0.5) / double(kBinsAcross));
        std::vector<double> weights;
        for (const Cell& cell : cells_) {
            const glm::dvec3 centre = environmentDirection(0.5 * (cell.x0 + cell.x1) / e.width,
                                                           0.5 * (cell.y0 + cell.y1) / e.height);
            const double cosine = glm::dot(n, centre);
            weights.push_back(cosine > -reach ? cell.weight * std::max(cosine, 0.3 * reach) : 0);
        }
        bins_.push_back(cumulated(weights));
    }
    const bool black = std::all_of(bins_.begin(), bins_.end(), [](const auto& bin) { return bin.empty(); });
    if (black) bins_.clear();
}

std::size_t EnvironmentSampler::binOf(const glm::dvec3& n) const {
    const glm::dvec2 square = toSquare(toEnvironment(n)) * double(kBinsAcross);
    const int x = std::clamp(static_cast<int>(square.x), 0, kBinsAcross - 1);
    const int y = std::clamp(static_cast<int>(square.y), 0, kBinsAcross - 1);
    return std::size_t(y) * kBinsAcross + x;
}

std::size_t EnvironmentSampler::texelIndex(const glm::dvec3& environmentDirection, int& x, int& y) const {
    const glm::dvec2 uv = environmentCoordinates(environmentDirection);
    x = std::clamp(static_cast<int>(uv.x * environment_->width), 0, environment_->width - 1);
    y = std::clamp(static_cast<int>(uv.y * environment_->height), 0, environment_->height - 1);
    return std::size_t(y) * environment_->width + x;
}

// The inverse of rotateAboutY, and that itself (environment_clusters.h).
glm::dvec3 EnvironmentSampler::toEnvironment(const glm::dvec3& d) const {
    return {cosine_ * d.x - sine_ * d.z, d.y, cosine_ * d.z + sine_ * d.x};
}

glm::dvec3 EnvironmentSampler::toWorld(const glm::dvec3& d) const {
    return {cosine_ * d.x + sine_ * d.z, d.y, cosine_ * d.z - sine_ * d.x};
}

glm::dvec3 EnvironmentSampler::sample(const glm::dvec3& n, const glm::dvec2& choice,
                                      const glm::dvec2& place) const {
    const std::vector<float>& bin = bins_[binOf(n)];
    // A normal that sees no light at all: any direction will do, its radiance is 0.
    if (bin.empty()) return n;
    const Cell& cell = cells_[choose(bin, choice.x).index];
    const std::size_t texel = choose(cell.cumulative, choice.y).index;
    const int width = cell.x1 - cell.x0;
    const double x = cell.x0 + double(texel % width) + place.x;
    const int row = cell.y0 + static_cast<int>(texel / width);
    // Even over the texel's solid angle: cosθ runs evenly between those of its edges.
    const double high = std::cos(kPi * row / environment_->height),
                 low = std::cos(kPi * (row + 1) / environment_->height);
    const double v = std::acos(std::clamp(glm::mix(high, low, place.y), -1.0, 1.0)) / kPi;
    return toWorld(environmentDirection(x / environment_->width, v));
}

EnvironmentSampler::Sky EnvironmentSampler::lookUp(const glm::dvec3& n, const glm::dvec3& direction) const {
    int x, y;
    const std::size_t at = texelIndex(toEnvironment(direction), x, y);
    Sky sky{glm::dvec3(environment_->radiance[at]) * intensity_, 0};
    const std::vector<float>& bin = bins_[binOf(n)];
    // Cells are cut at whole texels, c · width / columns rounded down: the inverse of that.
    const int column = ((x + 1) * columns_ - 1) / environment_->width,
              row = ((y + 1) * rows_ - 1) / environment_->height;
    const std::size_t index = std::size_t(row) * columns_ + column;
    const Cell& cell = cells_[index];
    if (bin.empty() || cell.cumulative.empty()) return sky;
    const std::size_t texel = std::size_t(y - cell.y0) * (cell.x1 - cell.x0) + (x - cell.x0);
    sky.pdf = probabilityOf(bin, index) * probabilityOf(cell.cumulative, texel) / solidAngles_[y];
    return sky;
}

}  // namespace cutis::reference
