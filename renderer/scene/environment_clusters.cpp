#include "renderer/scene/environment_clusters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "renderer/core/parallel.h"
#include "renderer/scene/environment_cells.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMaxCellColumns = 1024, kMaxCellRows = 512;

// rms angle from the length of a mean of unit vectors: |mean| = E[cos] ≈ 1 - E[angle²]/2.
double spreadOf(double length) {
    return std::sqrt(std::max(2 * (1 - length), 0.0));
}

// A texel's extent in closed form: with θ from +Y over [θ0, θ1] and φ over Δ,
//   ∫ dω = Δ (cosθ0 - cosθ1),   ∫ ω_y dω = Δ (sin²θ1 - sin²θ0)/2,   ∫ ω_xz dω = 2 sin(Δ/2) ∫ sin²θ dθ ·
//   (sinφ, -cosφ).
struct RowGeometry {
    double solidAngle, vertical, horizontal;  // of one texel

    RowGeometry(int row, int width, int height) {
        const double a = kPi * row / height, b = kPi * (row + 1) / height, delta = 2 * kPi / width;
        solidAngle = delta * (std::cos(a) - std::cos(b));
        vertical = delta * (std::sin(b) - std::sin(a)) * (std::sin(b) + std::sin(a)) / 2;
        horizontal = std::sin(delta / 2) * (b - a - std::sin(b - a) * std::cos(a + b));
    }
};

// A rectangle of cells on its way to becoming a cluster.
struct Region {
    int x0, y0, x1, y1;
    FluxSums sums;
    double priority;
    bool operator<(const Region& other) const { return priority < other.priority; }
};

Region makeRegion(const EnvironmentCells& grid, int x0, int y0, int x1, int y1) {
    Region region{x0, y0, x1, y1, {}, 0};
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) region.sums += grid.cells[std::size_t(y) * grid.width + x];
    const bool divisible = x1 - x0 > 1 || y1 - y0 > 1;
    region.priority = divisible ? region.sums.weight() * region.sums.spread() : 0;
    return region;
}

// Halves across the direction in which the rectangle is longer on the sphere.
std::pair<Region, Region> halve(const EnvironmentCells& grid, const Region& r) {
    const double middle = kPi * (r.y0 + r.y1) / 2 / grid.height;
    const double across = 2 * kPi * (r.x1 - r.x0) / grid.width * std::sin(middle);
    const double down = kPi * (r.y1 - r.y0) / grid.height;
    if (r.y1 - r.y0 == 1 || (r.x1 - r.x0 > 1 && across > down)) {
        const int x = (r.x0 + r.x1) / 2;
        return {makeRegion(grid, r.x0, r.y0, x, r.y1), makeRegion(grid, x, r.y0, r.x1, r.y1)};
    }
    const int y = (r.y0 + r.y1) / 2;
    return {makeRegion(grid, r.x0, r.y0, r.x1, y), makeRegion(grid, r.x0, y, r.x1, r.y1)};
}

}  // namespace

double FluxSums::spread() const {
    return weight() > 0 ? spreadOf(glm::length(moment) / weight()) : 0;
}

FluxSums& FluxSums::operator+=(const FluxSums& other) {
    flux += other.flux;
    moment += other.moment;
    solidAngle += other.solidAngle;
    return *this;
}

EnvironmentCells sumEnvironment(const Environment& environment,
                                const std::function<glm::dvec3(std::size_t)>& radianceAt) {
    const int width = environment.width, height = environment.height;
    EnvironmentCells grid{std::min(width, kMaxCellColumns), std::min(height, kMaxCellRows), {}};
    grid.cells.resize(std::size_t(grid.width) * grid.height);
    std::vector<glm::dvec2> heading(width);  // (sinφ, -cosφ) of each column's centre
    for (int x = 0; x < width; ++x) {
        const double phi = 2 * kPi * ((x + 0.5) / width - 0.5);
        heading[x] = {std::sin(phi), -std::cos(phi)};
    }
    parallelFor(std::size_t(grid.height), [&](std::size_t cellRow) {
        // Rows and columns of texels go to cells in whole numbers, as evenly as they can.
        const int first = int(cellRow * height / grid.height),
                  last = int((cellRow + 1) * height / grid.height);
        for (int y = first; y < last; ++y) {
            const RowGeometry row(y, width, height);
            for (int x = 0; x < width; ++x) {
                const std::size_t texel = std::size_t(y) * width + x;
                const glm::dvec3 radiance = radianceAt(texel);
                const double weight = radiance.x + radiance.y + radiance.z;
                const std::size_t column = (std::size_t(x + 1) * grid.width - 1) / width;
                FluxSums& cell = grid.cells[cellRow * grid.width + column];
                cell.flux += radiance * row.solidAngle;
                cell.moment += weight * glm::dvec3(row.horizontal * heading[x].x, row.vertical,
                                                   row.horizontal * heading[x].y);
                cell.solidAngle += row.solidAngle;
            }
        }
    });
    return grid;
}

std::vector<FluxSums> clusterCells(const EnvironmentCells& grid, std::size_t maxClusters) {
    std::priority_queue<Region> open;
    open.push(makeRegion(grid, 0, 0, grid.width, grid.height));
    while (open.size() < maxClusters && open.top().priority > 0) {
        const auto [a, b] = halve(grid, open.top());
        open.pop();
        open.push(a);
        open.push(b);
    }
    std::vector<FluxSums> clusters;
    for (; !open.empty(); open.pop())
        if (open.top().sums.weight() > 0) clusters.push_back(open.top().sums);
    return clusters;
}

double EnvironmentCluster::spread() const {
    return spreadOf(glm::length(centroid));
}

std::vector<EnvironmentCluster> clusterEnvironment(const Environment& environment, std::size_t maxClusters) {
    const EnvironmentCells grid = sumEnvironment(
        environment, [&](std::size_t texel) { return glm::dvec3(environment.radiance[texel]); });
    std::vector<EnvironmentCluster> clusters;
    for (const FluxSums& sums : clusterCells(grid, maxClusters))
        clusters.push_back({sums.flux, sums.moment / sums.weight(), sums.solidAngle});
    return clusters;
}

glm::dvec3 irradianceFrom(std::span<const EnvironmentCluster> clusters, const glm::dvec3& n) {
    glm::dvec3 sum(0);
    for (const EnvironmentCluster& c : clusters) sum += c.flux * std::max(glm::dot(n, c.centroid), 0.0);
    return sum;
}

glm::dvec3 environmentDirection(double u, double v) {
    const double phi = 2 * kPi * (u - 0.5), theta = kPi * v;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

glm::dvec2 environmentCoordinates(const glm::dvec3& direction) {
    return {0.5 + std::atan2(direction.x, -direction.z) / (2 * kPi),
            std::atan2(std::hypot(direction.x, direction.z), direction.y) / kPi};
}

glm::dvec3 rotateAboutY(const glm::dvec3& direction, double degrees) {
    const double a = degrees * kPi / 180, c = std::cos(a), s = std::sin(a);
    return {c * direction.x + s * direction.z, direction.y, c * direction.z - s * direction.x};
}

std::vector<glm::dvec3> visibilityDirections(int n) {
    std::vector<glm::dvec3> directions;
    const double turn = 2 * kPi * (2 - std::numbers::phi);  // the golden angle
    for (int i = 0; i < n; ++i) {
        const double y = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - y * y);
        directions.emplace_back(r * std::cos(turn * i), y, r * std::sin(turn * i));
    }
    return directions;
}

namespace {

// The place of `target` in a list of weights laid end to end: an index and how far into it.
std::pair<std::size_t, double> locate(std::span<const double> weights, double target) {
    std::size_t i = 0;
    while (i + 1 < weights.size() && target >= weights[i]) target -= weights[i++];
    return {i, weights[i] > 0 ? std::clamp(target / weights[i], 0.0, 1.0) : 0.5};
}

// The Fibonacci lattice of visibilityDirections(n), its square warped so that equal areas hold equal sums of
// `grid`.
std::vector<glm::dvec3> warpedLattice(const EnvironmentCells& grid, int n, std::uint32_t seed) {
    // The R2 sequence (Roberts 2018) shifts the lattice as on a torus; not at all for seed 0.
    const double down0 = 0.7548776662466927 * seed, turn0 = 0.5698402909980532 * seed;
    const double shift = down0 + 0.5 - std::floor(down0 + 0.5);
    std::vector<double> rows(grid.height, 0), columns(grid.width);
    double total = 0;
    for (std::size_t i = 0; i < grid.cells.size(); ++i) rows[i / grid.width] += grid.cells[i].weight();
    for (double row : rows) total += row;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < n; ++i) {
        const auto [row, down] = locate(rows, (i + shift) / n * total);
        for (int x = 0; x < grid.width; ++x) columns[x] = grid.cells[row * grid.width + x].weight();
        const double turn = i * (2 - std::numbers::phi) + 0.75 + turn0;  // from +X, as there
        const auto [column, across] = locate(columns, (turn - std::floor(turn)) * rows[row]);
        // Within a cell by solid angle, which is even in the cosine.
        const double top = std::cos(kPi * double(row) / grid.height),
                     bottom = std::cos(kPi * double(row + 1) / grid.height);
        const double v = std::acos(std::clamp(top + down * (bottom - top), -1.0, 1.0)) / kPi;
        directions.push_back(environmentDirection((double(column) + across) / grid.width, v));
    }
    return directions;
}

}  // namespace

std::vector<VisibilityDirection> visibilityDirections(const Environment& environment, int n,
                                                      std::uint32_t seed) {
    constexpr double kEvenShare = 1.0 / 3;
    const auto luminance = [&](std::size_t texel) {
        const glm::vec3& radiance = environment.radiance[texel];
        return (double(radiance.x) + radiance.y + radiance.z) / 3;
    };
    const auto grey = [&](std::size_t texel) { return glm::dvec3(luminance(texel)); };
    double total = 0;
    for (const FluxSums& cell : sumEnvironment(environment, grey).cells) total += cell.flux.x;
    const double mean = total / (4 * kPi);
    const EnvironmentCells mixed = sumEnvironment(environment, [&](std::size_t texel) {
        return glm::dvec3(mean > 0 ? (1 - kEvenShare) * luminance(texel) / mean + kEvenShare : 1);
    });
    std::vector<VisibilityDirection> directions;
    for (const glm::dvec3& direction : warpedLattice(mixed, n, seed)) directions.push_back({direction, 0});
    const std::vector<glm::dvec3> sphere = visibilityDirections(128 * n);
    for (const glm::dvec3& point : sphere) {
        std::max_element(directions.begin(), directions.end(), [&](const auto& a, const auto& b) {
            return glm::dot(a.direction, point) < glm::dot(b.direction, point);
        })->solidAngle += 4 * kPi / double(sphere.size());
    }
    return directions;
}

std::vector<DirectionalFlux> fluxPerDirection(std::span<const EnvironmentCluster> clusters,
                                              std::span<const glm::dvec3> directions, double rotationDegrees,
                                              double intensity) {
    std::vector<DirectionalFlux> shares(directions.size());
    std::vector<glm::dvec3> moments(directions.size(), glm::dvec3(0));
    if (directions.empty()) return shares;
    for (const EnvironmentCluster& cluster : clusters) {
        const glm::dvec3 centroid = rotateAboutY(cluster.centroid, rotationDegrees);
        const auto nearest = std::max_element(directions.begin(), directions.end(), [&](auto& a, auto& b) {
            return glm::dot(a, centroid) < glm::dot(b, centroid);
        });
        const std::size_t i = std::size_t(nearest - directions.begin());
        shares[i].flux += cluster.flux * intensity;
        moments[i] += centroid * (cluster.flux.x + cluster.flux.y + cluster.flux.z);
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double length = glm::length(moments[i]);
        shares[i].direction = length > 0 ? moments[i] / length : directions[i];
    }
    return shares;
}

}  // namespace cutis
