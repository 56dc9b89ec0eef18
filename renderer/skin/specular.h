// Specular reflection of skin's oily layer (DESIGN §1.2): the Kelemen & Szirmay-Kalos 2001 lobe with a
// Beckmann distribution, and its directional albedo. Everything is in double; shaders/lib/skin_specular.glsl
// is the twin.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shaders/shared/albedo_table.h"

namespace cutis::skin {

// Reflectance of skin at normal incidence, for an index of refraction of 1.4.
inline constexpr double kSkinF0 = 0.028;
// A smaller rms slope m is taken for this: the lobe is then narrower than a pixel.
inline constexpr double kMinRoughness = 1e-3;
inline constexpr int kAlbedoRowSize = ALBEDO_ROW_SIZE;

// D = exp(-tan²θ/m²) / (π m² cos⁴θ), in 1/sr; ∫ D cosθ dω = 1. 0 at and below the horizon.
double beckmann(double cosTheta, double m);

// F0 + (1 - F0)(1 - cosθ)⁵.
double schlick(double cosTheta, double f0 = kSkinF0);

// f_s = D(N·H) F(V·H) / (h·h) with h = L + V not normalised, in 1/sr, at specular scale 1; 0 unless V and L
// are both above the surface. Unit vectors, all pointing away from the surface.
double kelemenSpecular(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l, double m);

// ρ_dt(μ, m) = ∫ f_s (N·L) dω at N·V = μ, clamped to [0,1]. Exact to about 1e-6 for any μ in (0,1], m in
// [1e-3, 1].
double directionalAlbedo(double mu, double m);

// The scale to use in place of s where ρ_dt is `albedo`: min(s, 1/albedo), so that s·ρ_dt never exceeds 1
// (DESIGN §1.1). f_s takes the same scale.
double clampedScale(double s, double albedo);

// A row of the table: ρ_dt at μ_i = (i / (count - 1))², which is dense where ρ_dt is steep. count ≥ 2.
std::vector<float> directionalAlbedoRow(double m, int count = kAlbedoRowSize);

// The row of a layer of two lobes, f_s = (1 - weight)·f(m) + weight·f(narrower): (1 - weight)·ρ_dt(μ, m) +
// weight·ρ_dt(μ, narrower).
std::vector<float> mixedAlbedoRow(double m, double narrower, double weight, int count = kAlbedoRowSize);

// Linear interpolation in √μ, as shaders do.
double lookUpAlbedo(std::span<const float> row, double mu);

// ρ̄_dt: 2 ∫ min(1, s ρ_dt(μ, m)) μ dμ. The second form integrates the row as it is interpolated, so that
// energy balances exactly with what shaders look up.
double meanAlbedo(double m, double s = 1);
double meanAlbedo(std::span<const float> row, double s = 1);

}  // namespace cutis::skin
