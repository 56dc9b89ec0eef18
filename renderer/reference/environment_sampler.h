// Directions from which an environment lights a surface, drawn in proportion to what they give it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis::reference {

// The environment is radiance that is constant within each texel. A direction is drawn with
//   pdf(ω | n) = P(cell | bin of n) · P(texel | cell) / (solid angle of the texel),
// cells being blocks of texels: for each of a few hundred bins of normals, P(cell) goes with the light of the
// cell times its cosine (light and cosine sampled as one product); within a cell, P(texel) goes with the
// texel's light. The cosine is that at bin and cell centres with some slack, so that no light above the
// horizon is left out.
class EnvironmentSampler {
  public:
    // nullptr, disabled or black: it is empty.
    EnvironmentSampler(const Environment* environment, const EnvironmentSettings& settings);

    bool empty() const { return bins_.empty(); }
    struct Sky {
        glm::dvec3 radiance;  // intensity included
        double pdf;           // of sample() drawing this direction, per steradian
    };
    // What a world direction (towards the sky) shows, seen from a surface of unit normal n.
    Sky lookUp(const glm::dvec3& n, const glm::dvec3& direction) const;
    // A world direction for a surface of unit normal n; two pairs of random numbers in (0,1).
    glm::dvec3 sample(const glm::dvec3& n, const glm::dvec2& choice, const glm::dvec2& place) const;

  private:
    struct Cell {
        int x0, x1, y0, y1;             // texels
        double weight;                  // ∫ luminance dω
        std::vector<float> cumulative;  // over its texels, row by row; ends at 1
    };
    std::size_t texelIndex(const glm::dvec3& environmentDirection, int& x, int& y) const;
    std::size_t binOf(const glm::dvec3& n) const;
    void makeCells();
    void makeBins();

    const Environment* environment_ = nullptr;
    glm::dvec3 toEnvironment(const glm::dvec3& world) const;
    glm::dvec3 toWorld(const glm::dvec3& environment) const;

    double intensity_ = 0, cosine_ = 1, sine_ = 0;  // of the rotation about +Y
    int columns_ = 0, rows_ = 0;                    // of cells
    std::vector<double> solidAngles_;               // of a texel of each row
    std::vector<Cell> cells_;
    std::vector<std::vector<float>> bins_;  // cumulative P(cell) of each bin of normals
};

}  // namespace cutis::reference
