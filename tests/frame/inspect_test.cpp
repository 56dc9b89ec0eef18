// What the atlas holds, seen on the surface.
#include <algorithm>
#include <cmath>

#include "tests/frame/small_scene.h"
#include "tests/support/pictures.h"

namespace cutis::test {
namespace {

class InspectTest : public SmallSceneTest {
  protected:
    InspectTest() : renderer_(device()) {
        small_.settings.width = 80;
        small_.settings.height = 60;
    }

    Picture inspected(Inspect::What what, int index = 0) {
        RenderSettings settings = small_.settings;
        settings.inspect = {what, index};
        settings.aovs = {"irradiance"};
        RenderResult result = renderer_.render(small_.input, settings);
        irradiance_ = result.aovs.at("irradiance");
        gaussians_ = result.stats.gaussians;
        mmPerTexel_ = result.stats.atlasMmPerTexel;
        return result.aovs.at(kInspectedName);
    }

    // Mean of the first channel over pixels that show something.
    static double meanOf(const Picture& picture) {
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < picture.values.size(); i += 3)
            if (picture.values[i] > 0) sum += picture.values[i], ++count;
        return count > 0 ? sum / count : 0;
    }
    SmallScene small_;
    Renderer renderer_;
    Picture irradiance_;
    int gaussians_ = 0;
    double mmPerTexel_ = 0;
};

TEST_F(InspectTest, TexelsAreAsDenseAsTheStatsSay) {
    const Picture density = inspected(Inspect::What::texelDensity);
    // The stats give the median over the atlas, this the mean over what is seen.
    EXPECT_NEAR(meanOf(density) * mmPerTexel_, 1, 0.5);
    const Picture stretch = inspected(Inspect::What::stretch);
    for (std::size_t i = 0; i < stretch.values.size(); ++i) {
        if (stretch.values[i] != 0) EXPECT_GE(stretch.values[i], 0.999f);
    }
    EXPECT_GT(meanOf(stretch), 1);
}

TEST_F(InspectTest, LevelsAreEverFartherFromTheFirst) {
    // Texels of this picture are 7 mm wide; the wider blurs must be as wide.
    small_.scene.materials[small_.skinMaterial].skin->scale = 8;
    const Picture first = inspected(Inspect::What::level, 0);
    ASSERT_GT(gaussians_, 2);
    double before = 0;
    for (int k = 1; k < gaussians_; ++k) {
        const double away = relativeL2(inspected(Inspect::What::level, k), first);
        EXPECT_GE(away, before) << "level " << k;
        before = away;
    }
    EXPECT_GT(before, 0.05);
    EXPECT_LT(before, 0.5);
    EXPECT_EQ(meanOf(inspected(Inspect::What::level, 99)), 0) << "there is no such level";
}

TEST_F(InspectTest, ShadowIsTheShareThatArrives) {
    const Picture shadow = inspected(Inspect::What::shadow, 0);
    double least = 1, most = 0;
    for (std::size_t i = 0; i < shadow.values.size(); i += 3) {
        if (irradiance_.values[i] <= 0) continue;
        least = std::min<double>(least, shadow.values[i]);
        most = std::max<double>(most, shadow.values[i]);
    }
    EXPECT_GE(least, 0);
    EXPECT_EQ(most, 1) << "somewhere nothing is in its way";
    EXPECT_EQ(meanOf(inspected(Inspect::What::shadow, 99)), 0) << "there is no such light";
}

// Of one spot above the scene: what it sees lies before it, as far as things in the scene are.
TEST_F(InspectTest, LightMapsHoldDistancesFromTheLight) {
    const Light& light = small_.input.rig.lights.at(0);
    ASSERT_NE(light.type, LightType::directional);
    double nearest = 1e9, farthest = 0;
    const Bounds& bounds = small_.scene.bounds;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                            corner & 4 ? bounds.max.z : bounds.min.z);
        farthest = std::max(farthest, glm::length(at - light.position));
    }
    nearest = glm::length(glm::clamp(light.position, bounds.min, bounds.max) - light.position);
    const Picture map = inspected(Inspect::What::lightMap, 0);
    double seen = 0;
    for (std::size_t i = 0; i < map.values.size(); i += 3) {
        if (map.values[i] == 0) continue;
        ++seen;
        // Along the axis of the map, which for what stands at its edge is less than the distance: 0.5 holds to 60 degrees.
        EXPECT_GT(map.values[i], 0.5 * nearest);
        EXPECT_LT(map.values[i], 1.001 * farthest);
    }
    EXPECT_GT(seen / (map.values.size() / 3.0), 0.05) << "it sees something";
    EXPECT_EQ(meanOf(inspected(Inspect::What::lightMap, 99)), 0) << "there is no such light";
}

// A picture is the same whether something is inspected beside it or not.
TEST_F(InspectTest, LeavesThePictureAlone) {
    const RenderResult plain = renderer_.render(small_.input, small_.settings);
    RenderSettings settings = small_.settings;
    settings.inspect = {Inspect::What::stretch, 0};
    EXPECT_EQ(renderer_.render(small_.input, settings).picture.values, plain.picture.values);
    EXPECT_FALSE(plain.aovs.contains(kInspectedName));
}

// Other seeds are other samples of the same light: single pictures differ, all are as bright.
TEST_F(InspectTest, SeedsChangeSoftShadowsAlone) {
    const auto pictureOf = [&](std::uint32_t seed) {
        RenderSettings settings = small_.settings;
        settings.seed = seed;
        return renderer_.render(small_.input, settings).picture.values;
    };
    const std::vector<float> first = pictureOf(0), other = pictureOf(1);
    double difference = 0, whole = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
        difference += std::abs(first[i] - other[i]), whole += first[i];
    EXPECT_GT(difference / whole, 1e-5);
    EXPECT_LT(difference / whole, 0.1);
    EXPECT_EQ(pictureOf(0), first);
}

}  // namespace
}  // namespace cutis::test
