// What pictures are compared with: exact solutions of the model of DESIGN §1.1 on simple bodies, in double.
// Lengths are millimetres unless a comment says otherwise.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/skin/profile.h"

namespace cutis::test {

// Σ w ½(1 + erf(x/√2v)): M at distance x from the edge of a half plane of unit irradiance (lit where x > 0).
double edgeResponse(const skin::Profile& profile, int channel, double x);

// Σ w exp(-t²/2v): M on the far side of an infinite slab of thickness t whose other face has unit irradiance.
double slabTransmission(const skin::Profile& profile, int channel, double thickness);

// M on a sphere under one directional light of unit irradiance at normal incidence.
//
// With |x-y|² = 2a²(1 - cosγ) the Gaussian of variance v is a von Mises-Fisher kernel of concentration κ =
// a²/v. Convolution on the sphere multiplies Legendre coefficients (Funk & Hecke):
//   M(θ) = Σ_l λ_l c_l P_l(cosθ),   λ_l = κ e^{-κ} ∫_{-1}^{1} e^{κt} P_l(t) dt,   λ_0 = 1 - e^{-2κ},
//   max(cosθ, 0) = Σ_l c_l P_l(cosθ).
class SphereDiffusion {
  public:
    SphereDiffusion(const skin::Profile& profile, double radius);
    // cosθ is the cosine between the surface normal and the direction to the light.
    double operator()(double cosTheta, int channel) const;

  private:
    std::vector<glm::dvec3> coefficients_;  // Σ_k w_k λ_l(κ_k) c_l, by l
};

// The same by brute force: the integral over the sphere on steps × 2·steps midpoints. For checking the
// series.
double integrateSphereDiffusion(const skin::Profile& profile, double radius, double cosTheta, int channel,
                                int steps);

// Irradiance at a point from a polygon of uniform radiance that emits towards it (Lambert 1760; Baum et al.
// 1989, eq. 1), clipped to the receiver's horizon. Corners in order, any unit of length; sign of the winding
// is ignored.
double polygonIrradiance(const glm::dvec3& point, const glm::dvec3& normal, std::vector<glm::dvec3> corners,
                         double radiance);

// Corners of a rect light: width horizontal, height upwards, facing `direction`.
std::array<glm::dvec3, 4> rectCorners(const glm::dvec3& centre, const glm::dvec3& direction, double width,
                                      double height);

// ∫ L(ω) (N·ω) dω over the hemisphere of a unit normal, on steps × 4·steps strata of equal projected solid
// angle.
glm::dvec3 integrateIrradiance(const glm::dvec3& normal,
                               const std::function<glm::dvec3(const glm::dvec3&)>& radiance, int steps);

}  // namespace cutis::test
