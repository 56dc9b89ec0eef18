#include "renderer/skin/energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cutis::skin {

double transmittedFraction(double s, double albedo) {
    return 1 - std::clamp(s * albedo, 0.0, 1.0);
}

double exitScale(double s, double albedo, double meanAlbedo) {
    const double passed = 1 - std::clamp(meanAlbedo, 0.0, 1.0);
    return passed > 1e-9 ? transmittedFraction(s, albedo) / passed : 0;
}

double gatheredShare(double variance, double area) {
    return -std::expm1(-area / (2 * std::numbers::pi * variance));
}

}  // namespace cutis::skin
