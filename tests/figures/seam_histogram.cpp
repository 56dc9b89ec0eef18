// seam_histogram SCENE RENDER.exr REFERENCE.exr [NEAR_MM]: errors of skin's diffuse light near seams of the
// layout and elsewhere, from what `cutis render --aov diffuse,position` and `cutis reference --halves` wrote
// of one view. The command is in docs/model.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/frame/skin_mesh.h"
#include "renderer/scene/gltf.h"
#include "tests/support/pictures.h"

namespace cutis::test {
namespace {

constexpr double kCellMm = 4;    // of the grid that finds seams near a place
constexpr double kStepMm = 0.5;  // between the points that stand for a seam

// Points along the edges at which islands end and the surface goes on.
class Seams {
  public:
    Seams(const Geometry& geometry, const SkinMesh& mesh, double mmPerUnit) : mmPerUnit_(mmPerUnit) {
        for (const HalfEdge h : mesh.borders) {
            if (!mesh.continues(h)) continue;
            const glm::dvec3 a = place(geometry, h), b = place(geometry, h % 3 == 2 ? h - 2 : h + 1);
            const int steps = 1 + static_cast<int>(glm::length(b - a) / kStepMm);
            for (int i = 0; i <= steps; ++i) {
                const glm::dvec3 p = glm::mix(a, b, double(i) / steps);
                points_[cellOf(p)].push_back(p);
            }
        }
    }

    // mm, kCellMm where there is none nearer than that.
    double distance(const glm::dvec3& world) const {
        const glm::dvec3 p = world * mmPerUnit_;
        double nearest = kCellMm;
        for (int i = 0; i < 27; ++i) {
            const auto found =
                points_.find(cellOf(p + kCellMm * (glm::dvec3(i % 3, i / 3 % 3, i / 9) - 1.0)));
            if (found == points_.end()) continue;
            for (const glm::dvec3& q : found->second) nearest = std::min(nearest, glm::length(q - p));
        }
        return nearest;
    }

  private:
    glm::dvec3 place(const Geometry& geometry, HalfEdge corner) const {
        return (glm::dvec3(geometry.positions[geometry.indices[corner]]) + geometry.origin) * mmPerUnit_;
    }
    static std::uint64_t cellOf(const glm::dvec3& p) {
        const glm::i64vec3 cell(glm::floor(p / kCellMm));
        return static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15u ^
               static_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4fu ^
               static_cast<std::uint64_t>(cell.z) * 0x165667b19e3779f9u;
    }

    double mmPerUnit_;
    std::unordered_map<std::uint64_t, std::vector<glm::dvec3>> points_;
};

// Errors of red, green and blue, relative to the mean of the reference.
struct Histogram {
    static constexpr double kEdges[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5};
    int counts[std::size(kEdges) + 1] = {};
    int total = 0;
    std::vector<double> errors, noise;  // noise: what the reference itself may be off by
    double squares = 0,
           reference = 0;  // free of the reference's noise: products with two independent halves of it

    void add(double value, double a, double b, double mean) {
        const double error = std::abs(value - 0.5 * (a + b)) / mean;
        std::size_t bin = 0;
        while (bin < std::size(kEdges) && error >= kEdges[bin]) ++bin;
        ++counts[bin], ++total;
        errors.push_back(error), noise.push_back(0.5 * std::abs(a - b) / mean);
        squares += (value - a) * (value - b);
        reference += a * b;
    }
};

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

Picture sibling(const std::string& path, const char* name) {
    return readPicture(std::filesystem::path(path).replace_extension(name));
}

int run(int argc, char** argv) {
    const Scene scene = loadGltf(argv[1], {.skin = {}, .images = false});
    const Geometry geometry = flattenScene(scene);
    double mmPerUnit = 0;
    for (const GeometryDraw& draw : geometry.draws) {
        if (draw.skin) mmPerUnit = scene.materials[draw.material].skin->mmPerUnit;
    }
    const Seams seams(geometry, makeSkinMesh(geometry), mmPerUnit);
    const Picture picture = readPicture(argv[2]), diffuse = sibling(argv[2], ".diffuse.exr"),
                  position = sibling(argv[2], ".position.exr"),
                  character = sibling(argv[2], ".character.exr"), halfA = sibling(argv[3], ".a.diffuse.exr"),
                  halfB = sibling(argv[3], ".b.diffuse.exr");
    const double near = argc > 4 ? std::stod(argv[4]) : 2;
    const auto isSkin = [&](int x, int y) {
        return valueAt(character, x, y) > 0 && valueAt(picture, x, y, 3) > 0.999;
    };
    double mean = 0;
    int pixels = 0;
    for (int y = 0; y < diffuse.height; ++y) {
        for (int x = 0; x < diffuse.width; ++x) {
            if (!isSkin(x, y)) continue;
            for (int c = 0; c < 3; ++c) mean += valueAt(halfA, x, y, c) / 3;
            ++pixels;
        }
    }
    mean /= std::max(pixels, 1);
    Histogram histograms[2];
    for (int y = 0; y < diffuse.height; ++y) {
        for (int x = 0; x < diffuse.width; ++x) {
            if (!isSkin(x, y)) continue;
            Histogram& histogram = histograms[seams.distance(rgbAt(position, x, y)) < near ? 0 : 1];
            for (int c = 0; c < 3; ++c) {
                histogram.add(valueAt(diffuse, x, y, c), valueAt(halfA, x, y, c), valueAt(halfB, x, y, c),
                              mean);
            }
        }
    }
    std::printf("%-24s %10s %10s\n", "|error| / mean", "near", "elsewhere");
    for (std::size_t bin = 0; bin <= std::size(Histogram::kEdges); ++bin) {
        const bool last = bin == std::size(Histogram::kEdges);
        std::printf("%-5s %5.2f             ", last ? "from" : "below",
                    Histogram::kEdges[last ? bin - 1 : bin]);
        for (const Histogram& h : histograms)
            std::printf(" %8.2f %%", 100.0 * h.counts[bin] / std::max(h.total, 1));
        std::printf("\n");
    }
    for (const double share : {0.5, 0.9, 0.99}) {
        std::printf("quantile %4.2f           ", share);
        for (const Histogram& h : histograms) std::printf(" %8.2f %%", 100 * quantile(h.errors, share));
        std::printf("   of it the reference's noise");
        for (const Histogram& h : histograms) std::printf(" %6.2f %%", 100 * quantile(h.noise, share));
        std::printf("\n");
    }
    std::printf("%-24s", "relative L2");
    for (const Histogram& h : histograms)
        std::printf(" %8.2f %%", 100 * std::sqrt(std::max(h.squares / h.reference, 0.0)));
    std::printf("\n%-24s %10d %10d\n", "values", histograms[0].total, histograms[1].total);
    return histograms[0].total > 0 ? 0 : 1;
}

}  // namespace
}  // namespace cutis::test

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: seam_histogram SCENE RENDER.exr REFERENCE.exr [NEAR_MM]\n");
        return 2;
    }
    try {
        return cutis::test::run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "seam_histogram: error: %s\n", e.what());
        return 1;
    }
}
