// A lat-long environment as a few thousand directional sources, for sums over all of its light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis {

// Some light of an environment, as if it all came from one direction.
struct EnvironmentCluster {
    glm::dvec3 flux{0};  // RGB ∫ L dω: irradiance of a surface that faces it
    glm::dvec3 centroid{
        0};  // mean direction weighted by R+G+B: its length is 1 - variance/2, so that where all of the
             // cluster is above the horizon of normal n, its irradiance is flux · dot(n, centroid)
    double solidAngle = 0;  // sr
    double spread() const;  // rms angle to the centroid, radians
};

inline constexpr std::size_t kMaxEnvironmentClusters = 4096;

// All light of the environment, each texel with its exact solid angle: Σ flux = ∫ L dω. Rectangles of texels
// are halved, where flux times spread is largest first, until there are maxClusters or none can be halved; a
// sun of one texel is thus a cluster of its own early on. Empty when the environment is black.
std::vector<EnvironmentCluster> clusterEnvironment(const Environment& environment,
                                                   std::size_t maxClusters = kMaxEnvironmentClusters);

// Irradiance of a surface with unit normal n, nothing occluded.
glm::dvec3 irradianceFrom(std::span<const EnvironmentCluster> clusters, const glm::dvec3& n);

// Direction of the point (u, v) of a lat-long image, both in [0,1], v = 0 at +Y; and the inverse.
glm::dvec3 environmentDirection(double u, double v);
glm::dvec2 environmentCoordinates(const glm::dvec3& direction);

// Where the light of `direction` comes from once the environment is turned by `degrees` about +Y,
// counter-clockwise seen from above.
glm::dvec3 rotateAboutY(const glm::dvec3& direction, double degrees);

// n directions evenly over the sphere (a spherical Fibonacci lattice): the directions in which visibility is
// found.
std::vector<glm::dvec3> visibilityDirections(int n);

// A direction in which visibility is found, and the part of the sphere that it stands for.
struct VisibilityDirection {
    glm::dvec3 direction{0};  // unit
    double solidAngle = 0;    // sr; all together 4π
};

// n directions, dense where the light of the environment is and never sparse: the lattice of
// visibilityDirections(n), warped by what each part of the sphere sends, a third of it spread evenly. The
// shadow of a small bright source is thus an average over many directions. Each stands for the part of the
// sphere that is nearest to it. A seed other than 0 gives others, as good as these.
std::vector<VisibilityDirection> visibilityDirections(const Environment& environment, int n,
                                                      std::uint32_t seed = 0);

// The part of an environment nearest to one visibility direction.
struct DirectionalFlux {
    glm::dvec3 flux{0};  // RGB ∫ L dω
    glm::dvec3 direction{
        0};  // unit; mean direction of that light, or the visibility direction itself where there is none
};

// Shares all flux out to the nearest of `directions`, after rotation and intensity; one element a direction.
std::vector<DirectionalFlux> fluxPerDirection(std::span<const EnvironmentCluster> clusters,
                                              std::span<const glm::dvec3> directions, double rotationDegrees,
                                              double intensity);

}  // namespace cutis
