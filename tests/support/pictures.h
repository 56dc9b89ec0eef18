// Reading and comparing pictures, in double.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "renderer/scene/picture.h"

namespace cutis::test {

// Channel c of the pixel in column x, row y (row 0 at the top). c must be below picture.channels.
double valueAt(const Picture& picture, int x, int y, int c = 0);
// The first three channels.
glm::dvec3 rgbAt(const Picture& picture, int x, int y);

// ‖picture - reference‖ / ‖reference‖ over the first three channels of all pixels. Throws when sizes differ.
double relativeL2(const Picture& picture, const Picture& reference);
// The largest difference of two values, all channels; not a number where one is. Throws when sizes differ.
double worstDifference(const Picture& a, const Picture& b);
// Adds `addend` to `sum`, channel by channel. An empty `sum` becomes a copy.
void addPicture(Picture& sum, const Picture& addend);
// Values that are infinite or not a number.
std::size_t countNonfinite(const Picture& picture);

// ‖a‖/‖b‖ of two sequences that are given element by element.
class NormRatio {
  public:
    void add(double numerator, double denominator) {
        above_ += numerator * numerator, below_ += denominator * denominator, ++count_;
    }
    double value() const;
    std::size_t count() const { return count_; }

  private:
    double above_ = 0, below_ = 0;
    std::size_t count_ = 0;
};

// A lat-long environment: radiance(ω) at the texel centres, with the orientation of DESIGN §2.3.
Picture makeEnvironment(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance);
// The direction that a point of a lat-long environment lies in; u, v in [0,1], v = 0 at +Y.
glm::dvec3 latLongDirection(double u, double v);

}  // namespace cutis::test
