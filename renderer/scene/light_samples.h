// A rig's lights as infinitesimal sources, and the light of one such source at a point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis {

struct SamplingOptions {
    std::size_t limit = 65536;  // more samples than this over all lights are an Error
    // Other samples of lights with an area, as good as these: means over several seeds converge to the light.
    std::uint32_t seed = 0;
    // What is lit stands about here: decides where the samples of rect lights lie that are large against their distance.
    std::optional<glm::dvec3> subject = {};
};

// The samples of every enabled light, in the rig's order; their sum is the light. Placements must be
// resolved.
//  - directional, and point or spot of radius 0: one sample, the light itself.
//  - point of radius R: isotropic samples in the ball of radius R, candela split equally. Their density falls
//  so that
//    the ball is an evenly bright disc from every side, as a Lambertian sphere is; and since it depends on
//    the radius alone, the irradiance outside is that of the point light (Newton's shell theorem holds for
//    any 1/r² field).
//  - spot of radius R: an even disc across its axis, candela split equally, every sample with the light's own
//  cone.
//  - rect: cell centres of a grid, or a point-symmetric lattice where no grid has nearly square cells. A
//  sample of a
//    light of radiance L, area A and n samples has L·A/n candela along its normal.
//    One that fills more than 2 sr as the subject sees it is divided by solid angle instead (SphericalRectangle):
//    cells of one size on a light much larger than its distance would all but miss what shines most. A sample that
//    stands for Ω/n then gives a subject that faces it L·Ω/n.
// A seed other than 0 shifts grids and lattices as on a torus, and turns balls. Deterministic. Throws Error
// when there are more than options.limit.
std::vector<LightSample> sampleLights(const Rig& rig, const SamplingOptions& options = {});

// How many samples sampleLights makes of a light: `samples` for one with an area, where 0 stands for 6
// (radius) or 9 (rect); 1 for one without.
int sampleCount(const Light& light);

// Unoccluded irradiance (RGB, in the unit of the light) that one sample gives a surface at p with unit normal
// n: I · attenuation · cosθ_emitted · cosθ_received / r². The attenuation of cone and range is that which
// KHR_lights_punctual recommends: saturate((cosθ - cosOuter) / max(0.001, cosInner - cosOuter))² and
// saturate(1 - (r/range)⁴). A sample of a rect light stands for a piece of area A' = 4 radius², not for a point: r² becomes
// r² + (3 cos²θ_emitted - 2)·A'/π where that is more, the mean over the piece to second order, and on the axis what a disc of
// that area gives exactly. As points, the centres of 3 × 3 cells of a 0.9 × 1.2 m light give 0.7 % too much at 2 m, and one
// point 7 %; so they give 0.1 and 0.8 %.
glm::dvec3 irradianceFrom(const LightSample& sample, const glm::dvec3& p, const glm::dvec3& n);

// Unit axes of a rect light that shines along `direction`: x along its width, which is horizontal, and y
// along its height. With a vertical direction the width lies along +X.
struct RectAxes {
    glm::dvec3 x, y;
};
RectAxes rectAxes(const glm::dvec3& direction);

// Temperatures that a light may have, in kelvin.
inline constexpr double kMinTemperature = 1000, kMaxTemperature = 40000;

// Colour of a black body: linear Rec.709 of luminance 1. Planck's law integrated over the CIE 1931 observer,
// in the analytic form of Wyman, Sloan & Shirley, "Simple Analytic Approximations to the CIE XYZ Color
// Matching Functions", JCGT 2(2), 2013. Colours outside the gamut (below about 1900 K) are clipped to it.
// Needs a temperature in the range above; others are clamped to it.
glm::dvec3 colorFromTemperature(double kelvin);

// Colour times intensity: RGB in the light's own unit.
glm::dvec3 lightIntensity(const Light& light);

}  // namespace cutis
