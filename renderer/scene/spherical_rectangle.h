// Samples of a rectangle by the solid angle that it fills.
#pragma once

#include <glm/glm.hpp>

namespace cutis {

// A rectangle as a point sees it (Ureña, Fajardo & King, "An Area-Preserving Parametrization for Spherical
// Rectangles", EGSR 2013). Lengths in any one unit.
class SphericalRectangle {
  public:
    // `centre` and the unit axes x and y with the rectangle's extents along them; `eye` must not lie in its
    // plane.
    SphericalRectangle(const glm::dvec3& centre, const glm::dvec3& x, const glm::dvec3& y,
                       const glm::dvec2& size, const glm::dvec3& eye);

    double solidAngle() const { return solidAngle_; }  // steradians, up to 2π
    // The place on the rectangle, relative to its centre along x and y, that parts of [0,1]² in the ratio of
    // their areas map to parts in the ratio of their solid angles.
    glm::dvec2 placeOf(const glm::dvec2& unit) const;

  private:
    glm::dvec2 low_, high_;                            // corners, seen from the eye along x and y
    glm::dvec2 middle_;                                // of the rectangle, likewise
    double height_ = 0;                                // of the eye over the plane, negative
    double b0_ = 0, b1_ = 0, k_ = 0, solidAngle_ = 0;  // of the paper
};

}  // namespace cutis
