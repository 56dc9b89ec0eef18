// White furnace and specular albedo: skin in an environment of radiance 1 all round.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/skin/specular.h"
#include "tests/reference/bodies.h"
#include "tests/reference/evaluate.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr int kSize = 10;
constexpr double kRadius = 100;  // mm

// A ball of 100 mm that fills the picture to 0.95 of its radius at the middle of each side.
reference::Result evaluateBall(const SkinMaterial& skin, const glm::dvec3& albedo, int passes) {
    SceneBuilder builder;
    builder.addObject("ball", makeFineSphere(kRadius * kMm, 128), builder.addSkin(skin, albedo));
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, 1.9 * kRadius * kMm);
    return evaluate({.scene = builder.scene(),
                     .environment = makeEnvironment(32, 16, [](const glm::dvec3&) { return glm::dvec3(1); }),
                     .width = kSize,
                     .height = kSize,
                     .passes = passes,
                     .aovs = {"specular"}});
}

// Noise averages out over the picture, a bias would not: the figure is of the sum over all pixels that are
// covered.
class Agreement {
  public:
    void add(const reference::Result& result, int pixel, double exact) {
        const int x = pixel % kSize, y = pixel / kSize;
        if (valueAt(result.picture, x, y, 3) < 1) return;
        for (int c = 0; c < 3; ++c) {
            sum_ += valueAt(result.picture, x, y, c), exact_ += exact;
            cover_.add(valueAt(result.picture, x, y, c), exact, valueAt(result.standardError, x, y, c));
        }
    }
    void expect(const std::string& name, double limit) const {
        ASSERT_GT(cover_.count(), 180u);
        expectAtMost("reference " + name + ", relative error of the sum", std::abs(sum_ / exact_ - 1), limit);
        reportFigure("reference " + name + ", mean square of error / standard error", cover_.meanSquare());
        EXPECT_GT(cover_.meanSquare(), 0.6);
        EXPECT_LT(cover_.meanSquare(), 2.6);
    }

  private:
    double sum_ = 0, exact_ = 0;
    ErrorCover cover_;
};

TEST(ReferenceEnergy, WhiteFurnace) {
    for (double roughness : {0.1, 0.3, 0.7}) {
        SkinMaterial skin;
        skin.roughness = roughness;
        const auto result = evaluateBall(skin, glm::dvec3(1), 32);
        Agreement agreement;
        for (int i = 0; i < kSize * kSize; ++i) agreement.add(result, i, 1);
        agreement.expect("white furnace, roughness " + std::to_string(roughness).substr(0, 3), 0.002);
    }
}

// Black skin shows its specular layer alone: s·ρ_dt(μ), averaged over each pixel.
TEST(ReferenceEnergy, SpecularAlbedo) {
    SkinMaterial skin;
    skin.roughness = 0.25;
    const auto result = evaluateBall(skin, glm::dvec3(0), 32);
    const std::vector<float> row = skin::directionalAlbedoRow(skin.roughness, 2000);
    Agreement agreement;
    for (int i = 0; i < kSize * kSize; ++i) {
        const int x = i % kSize, y = i / kSize;
        if (glm::length(glm::dvec2(x - 4.5, y - 4.5)) > 4.7) continue;  // the corners show the sky
        double exact = 0;
        constexpr int kParts = 32;
        for (int k = 0; k < kParts * kParts; ++k) {
            const glm::dvec2 place =
                (glm::dvec2(x, y) + (glm::dvec2(k % kParts, k / kParts) + 0.5) / double(kParts)) /
                    double(kSize) * 1.9 -
                0.95;
            exact += skin::lookUpAlbedo(row, std::sqrt(1 - glm::dot(place, place))) / (kParts * kParts);
        }
        agreement.add(result, i, exact);
    }
    agreement.expect("specular albedo", 0.005);
}

}  // namespace
}  // namespace cutis::test
