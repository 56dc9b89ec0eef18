// Skin's specular lobe as a sum of isotropic ones, so that light from an environment is a few lookups of its
// prefiltered radiance. A shader reads what specularLobeTable gives (shaders/lib/environment.glsl).
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace cutis::skin {

// A share of the reflected light: a normalised lobe proportional to exp(cosθ/σ²) around `direction`.
// Directions are in the frame of the mirror direction R = reflect(-V, N): z along R, x in the plane of
// incidence, on the side of the normal, y = N × T where T is V's part along the surface.
struct SpecularLobe {
    glm::dvec3 direction;
    double sigma;   // radians
    double weight;  // of both when it is one of a pair; all weights sum to 1
    bool paired;    // there is another, mirrored in y
};

// Lobes for N·V = μ_j = (j / (LOBE_ROWS - 1))², one element each j. Their sum approximates f_s (N·ω) / ρ_dt
// as a density over ω. Fitted by expectation maximisation to half-vectors drawn from the distribution, from
// normal incidence downwards, each μ from the fit of the one before, so that lobes move smoothly and can be
// interpolated.
std::vector<std::vector<SpecularLobe>> fitSpecularLobes(double m);

// The same as shaders/shared/albedo_table.h lays it out. Taken from the cache when that roughness was fitted
// before.
std::vector<float> specularLobeTable(double m);

}  // namespace cutis::skin
