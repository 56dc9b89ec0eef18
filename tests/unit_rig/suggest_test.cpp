#include "renderer/core/suggest.h"

#include <gtest/gtest.h>

namespace cutis {
namespace {

TEST(Suggest, FindsMisspellings) {
    const std::vector<std::string> names = {"intensity", "inner_cone_angle", "outer_cone_angle", "radius",
                                            "size"};
    EXPECT_EQ(nearestName("intensty", names), "intensity");
    EXPECT_EQ(nearestName("intnesity", names), "intensity");  // neighbours swapped
    EXPECT_EQ(nearestName("Radius", names), "radius");
    EXPECT_EQ(nearestName("outer_cone", names), "");  // six letters short: not a misspelling
    EXPECT_EQ(nearestName("outerConeAngle", names), "outer_cone_angle");
    EXPECT_EQ(nearestName("siz", names), "size");
}

TEST(Suggest, StaysSilentOtherwise) {
    EXPECT_EQ(nearestName("", {"a"}), "");
    EXPECT_EQ(nearestName("banana", {"radius", "size"}), "");
    EXPECT_EQ(nearestName(std::string(1000000, 'x'), {"radius"}), "");
    EXPECT_EQ(didYouMean("banana", {"radius"}), "");
    EXPECT_EQ(didYouMean("raduis", {"radius"}), " (did you mean 'radius'?)");
}

}  // namespace
}  // namespace cutis
