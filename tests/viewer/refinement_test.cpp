// The mean of pictures of a still camera.
#include "app/viewer/refinement.h"

#include <gtest/gtest.h>

namespace cutis::test {
namespace {

using app::Refinement;

std::shared_ptr<const Picture> pictureOf(float value) {
    return std::make_shared<const Picture>(Picture{2, 1, 4, std::vector<float>(8, value)});
}

TEST(Refinement, PixelsComeFirst) {
    Refinement refinement(pictureOf(1), true);
    for (int i = 1; i < Refinement::kPixelPictures; ++i) {
        ASSERT_EQ(refinement.next(), Refinement::Step::pixels);
        refinement.add(*pictureOf(2));
    }
    EXPECT_EQ(refinement.next(), Refinement::Step::shadows);
    EXPECT_NEAR(refinement.mean().values[0],
                (1 + 2.0 * (Refinement::kPixelPictures - 1)) / Refinement::kPixelPictures, 1e-6);
}

TEST(Refinement, HardLightIsDoneWithThem) {
    Refinement refinement(pictureOf(1), false);
    for (int i = 1; i < Refinement::kPixelPictures; ++i) refinement.add(*pictureOf(1));
    EXPECT_EQ(refinement.next(), Refinement::Step::none);
    refinement.add(*pictureOf(9));  // nothing is asked for any more
    EXPECT_EQ(refinement.mean().values[0], 1);
}

// Each set of samples counts as much as the first: 1 and 4 sets of 2 are 9/5, whatever the pixels' pictures
// are.
TEST(Refinement, ShadowsAreTheMeanOverAllSets) {
    Refinement refinement(pictureOf(1), true);
    for (int i = 1; i < Refinement::kPixelPictures; ++i) refinement.add(*pictureOf(1));
    for (int i = 0; i < 4; ++i) refinement.add(*pictureOf(2));
    EXPECT_EQ(refinement.shadowPictures(), 5);
    EXPECT_NEAR(refinement.mean().values[0], 1.8, 1e-6);
}

TEST(Refinement, ConvergesWhenOneMoreChangesNothing) {
    Refinement refinement(pictureOf(1), true);
    for (int i = 1; i < Refinement::kPixelPictures; ++i) refinement.add(*pictureOf(1));
    refinement.add(*pictureOf(1.1f));
    EXPECT_EQ(refinement.next(), Refinement::Step::shadows) << "it moved by 5 %";
    refinement.add(*pictureOf(1.05f));
    EXPECT_EQ(refinement.next(), Refinement::Step::none) << "it did not move";
}

TEST(Refinement, EndsAtSomePoint) {
    Refinement refinement(pictureOf(1), true);
    for (int i = 1; i < Refinement::kPixelPictures; ++i) refinement.add(*pictureOf(1));
    int added = 0;
    for (; refinement.next() != Refinement::Step::none && added < 1000; ++added)
        refinement.add(*pictureOf(added % 2 ? 0.0f : 10.0f));
    EXPECT_EQ(added, Refinement::kMostShadowPictures - 1);
}

TEST(Refinement, OtherSizesAreNotMixed) {
    Refinement refinement(pictureOf(1), false);
    refinement.add(Picture{1, 1, 4, std::vector<float>(4, 5)});
    EXPECT_EQ(refinement.pixelPictures(), 1);
}

}  // namespace
}  // namespace cutis::test
