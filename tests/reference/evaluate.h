// Exact pictures of scenes made in code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/reference/reference.h"
#include "renderer/scene/scene.h"

namespace cutis::test {

struct ReferenceJob {
    Scene scene = {};
    std::vector<Light> lights = {};
    std::optional<Picture> environment = {};  // lat-long, three channels
    int width = 64, height = 64;
    int passes = 8;
    std::uint32_t seed = 0;
    std::vector<std::string> aovs = {};
};

reference::Result evaluate(const ReferenceJob& job);

// Standardised errors (value - exact) / standard error of many pixels: where the estimate is unbiased and its
// error estimate honest, their mean is 0 and their mean square is (n - 1) / (n - 3) for n passes, Student's
// t.
class ErrorCover {
  public:
    void add(double value, double exact, double standardError);
    std::size_t count() const { return count_; }
    double mean() const { return sum_ / static_cast<double>(count_); }
    double meanSquare() const { return squares_ / static_cast<double>(count_); }

  private:
    double sum_ = 0, squares_ = 0;
    std::size_t count_ = 0;
};

}  // namespace cutis::test
