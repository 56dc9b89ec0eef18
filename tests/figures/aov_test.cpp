// What the AOVs hold (DESIGN §2.1): units, zeros where nothing is seen, coverage, and their sum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kWidth = 240, kHeight = 120;
constexpr double kView = 0.48;  // metres across: 2 mm a pixel
constexpr double kRadius = 0.09, kEyeDistance = 0.5;

// Two characters left and right, and a ball without skin between and behind them, under light from the
// camera.
class Aovs : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        SceneBuilder builder;
        const auto at = [](double x, double z) { return glm::translate(glm::dmat4(1), glm::dvec3(x, 0, z)); };
        builder.addObject("left", makeSphere(kRadius, SphereMapping::cube),
                          builder.addSkin(SkinMaterial{}, kLeftAlbedo), at(-0.13, 0));
        builder.addObject("right", makeSphere(kRadius, SphereMapping::cube),
                          builder.addSkin(SceneBuilder::plainSkin(), kRightAlbedo), at(0.13, 0));
        builder.addObject("ball", makeSphere(0.03, SphereMapping::cube), builder.addMatte(), at(0, -0.1));
        builder.setOrthographicCamera({0, 0, kEyeDistance}, {0, 0, 0}, kView);
        RenderJob job{.scene = builder.scene(), .lights = {directionalLight("key", {0, 0, -1}, kLux)}};
        job.width = kWidth, job.height = kHeight;
        job.aovs = {"diffuse", "specular", "irradiance", "thickness", "albedo",
                    "normal",  "position", "depth",      "character"};
        result_ = new Rendered(render(job));
    }
    static void TearDownTestSuite() { delete std::exchange(result_, nullptr); }
    static const Rendered& result() { return *result_; }

    static inline const glm::dvec3 kLeftAlbedo{0.8, 0.6, 0.5}, kRightAlbedo{0.4, 0.3, 0.2};
    static constexpr double kLux = 2;
    static inline Rendered* result_ = nullptr;

    // Where a pixel's centre lies in the plane z = 0.
    static glm::dvec2 place(int x, int y) {
        return {(x + 0.5) * kView / kWidth - kView / 2, (kHeight / 2 - y - 0.5) * kView / kWidth};
    }
    // Calls see(x, y, offset from the ball's centre) for pixels at least 3 px inside a ball's disc.
    template <class See>
    static void eachPixelOf(double centreX, double radius, See see) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const glm::dvec2 offset = place(x, y) - glm::dvec2(centreX, 0);
                if (length(offset) < radius - 0.006) see(x, y, offset);
            }
    }
};

// Data AOVs hold one point that is seen within the pixel, not always its centre: the point must lie in the
// pixel and on the ball, and normal and depth must be that point's.
TEST_F(Aovs, PositionNormalAndDepthAreThoseOfAPointInThePixel) {
    double outside = 0, off = 0, normal = 0, depth = 0;
    glm::dvec2 bias(0);
    int count = 0;
    eachPixelOf(-0.13, kRadius, [&](int x, int y, const glm::dvec2&) {
        const glm::dvec3 position = rgbAt(result().aov("position"), x, y);
        const glm::dvec3 fromCentre = position - glm::dvec3(-0.13, 0, 0);
        const glm::dvec2 offset = (glm::dvec2(position) - place(x, y)) * (kWidth / kView);
        outside = std::max({outside, std::abs(offset.x), std::abs(offset.y)});
        bias += offset, ++count;
        off = std::max(off, std::abs(length(fromCentre) - kRadius));
        normal = std::max(normal, length(rgbAt(result().aov("normal"), x, y) - normalize(fromCentre)));
        depth = std::max(depth, std::abs(valueAt(result().aov("depth"), x, y) - (kEyeDistance - position.z)));
    });
    expectAtMost("position AOV, pixels from the pixel's centre", outside, 0.501);
    expectAtMost("position AOV, mean pixels from the centre", length(bias) / count, 0.01);
    expectAtMost("position AOV, metres from the surface", off, 0.0002);
    expectAtMost("normal AOV", normal, 0.005);
    expectAtMost("depth AOV [m]", depth, 1e-5);
}

TEST_F(Aovs, IrradianceIsLuxTimesCosine) {
    double worst = 0;
    for (const double centre : {-0.13, 0.13})
        eachPixelOf(centre, kRadius, [&](int x, int y, const glm::dvec2&) {
            const double exact = kLux * valueAt(result().aov("normal"), x, y, 2);
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(valueAt(result().aov("irradiance"), x, y, c) - exact));
        });
    expectAtMost("irradiance AOV, of 2 lux", worst, 0.04);
}

TEST_F(Aovs, AlbedoIsTheMaterials) {
    const auto check = [&](double centre, const glm::dvec3& albedo) {
        eachPixelOf(centre, kRadius, [&](int x, int y, const glm::dvec2&) {
            ASSERT_LT(length(rgbAt(result().aov("albedo"), x, y) - albedo), 0.004);
        });
    };
    check(-0.13, kLeftAlbedo);
    check(0.13, kRightAlbedo);
}

TEST_F(Aovs, CharactersCountFromOneAndThicknessIsNoneInTheLight) {
    double left = -1, right = -1;
    eachPixelOf(-0.13, 0.5 * kRadius, [&](int x, int y, const glm::dvec2&) {
        left = valueAt(result().aov("character"), x, y);
        ASSERT_EQ(valueAt(result().aov("thickness"), x, y), 60000);
    });
    eachPixelOf(0.13, kRadius, [&](int x, int y, const glm::dvec2&) {
        right = valueAt(result().aov("character"), x, y);
        ASSERT_TRUE(right == 1 || right == 2) << right;
    });
    EXPECT_EQ(left + right, 3);
    EXPECT_EQ(left * right, 2);
    eachPixelOf(0, 0.03, [&](int x, int y, const glm::dvec2&) {
        ASSERT_EQ(valueAt(result().aov("character"), x, y), 0) << "not a character";
    });
}

TEST_F(Aovs, DiffuseAndSpecularMakeThePicture) {
    double largest = 0, worst = 0, specularRight = 0;
    for (const double centre : {-0.13, 0.13})
        eachPixelOf(centre, kRadius, [&](int x, int y, const glm::dvec2&) {
            for (int c = 0; c < 3; ++c) {
                const double total = valueAt(result().picture, x, y, c);
                const double specular = valueAt(result().aov("specular"), x, y, c);
                worst =
                    std::max(worst, std::abs(total - valueAt(result().aov("diffuse"), x, y, c) - specular));
                largest = std::max(largest, total);
                if (centre > 0) specularRight = std::max(specularRight, specular);
            }
        });
    EXPECT_GT(largest, 0.3);
    EXPECT_EQ(specularRight, 0) << "a specular scale of 0";
    expectAtMost("picture less diffuse and specular", worst / largest, 0.001);
}

// Flat in the middle of a large body: L_d = albedo · E/π, whatever the mix, for s = 0.
TEST_F(Aovs, DiffuseIsAlbedoTimesIrradianceOverPi) {
    for (int c = 0; c < 3; ++c) {
        const double exact = kRightAlbedo[c] * kLux / kPi;
        const int x = static_cast<int>((0.13 + kView / 2) / kView * kWidth);
        EXPECT_NEAR(valueAt(result().aov("diffuse"), x, kHeight / 2, c), exact, 0.01 * exact)
            << "channel " << c;
    }
}

TEST_F(Aovs, AreZeroAndUncoveredWhereNothingIsSeen) {
    int outside = 0, edge = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double fromLeft = length(place(x, y) - glm::dvec2(-0.13, 0));
            const double alpha = valueAt(result().picture, x, y, 3);
            ASSERT_GE(alpha, 0);
            ASSERT_LE(alpha, 1);
            if (std::abs(fromLeft - kRadius) < 0.001) edge += alpha > 0.05 && alpha < 0.95;
            const double nearest =
                std::min({fromLeft - kRadius, length(place(x, y) - glm::dvec2(0.13, 0)) - kRadius,
                          length(place(x, y)) - 0.03});
            if (nearest < 0.006) continue;
            ++outside;
            ASSERT_EQ(alpha, 0);
            ASSERT_EQ(rgbAt(result().picture, x, y), glm::dvec3(0));
            for (const auto& [name, picture] : result().aovs)
                for (int c = 0; c < picture.channels; ++c) ASSERT_EQ(valueAt(picture, x, y, c), 0) << name;
        }
    EXPECT_GT(outside, 5000);
    EXPECT_GT(edge, 30) << "edges are antialiased: coverage between 0 and 1";
    eachPixelOf(-0.13, kRadius, [&](int x, int y, const glm::dvec2&) {
        ASSERT_NEAR(valueAt(result().picture, x, y, 3), 1, 1e-5);
    });
}

TEST_F(Aovs, StatsCountWhatIsThere) {
    const Stats& stats = result().stats;
    EXPECT_EQ(stats.characters, 2);
    EXPECT_EQ(stats.lights, 1);
    EXPECT_EQ(stats.lightSamples, 1);
    EXPECT_EQ(stats.gaussians, 6);
    EXPECT_EQ(stats.nonfinite, 0);
    EXPECT_GT(stats.bytesGpu, 0);
    EXPECT_GT(stats.texelsCovered, 0);
    EXPECT_LE(stats.texelsCovered, double(stats.atlasWidth) * stats.atlasHeight);
    EXPECT_GT(stats.frameMs, 0);
    EXPECT_FALSE(stats.device.empty());
}

}  // namespace
}  // namespace cutis::test
