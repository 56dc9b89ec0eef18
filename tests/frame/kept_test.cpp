// Which rows run again, on the pass table itself and without a device.
#include "renderer/frame/kept.h"

#include <gtest/gtest.h>

#include <string>

namespace cutis::test {
namespace {

NeedsInput everything(bool anyView) {
    return {.skinDraws = 2, .translucentSkinMaterials = 1, .lightSamples = 3, .shadowedSamples = 3, .environment = true,
            .anyView = anyView};
}

// Rows of the frame that run once `changed` inputs are other than before.
std::string rowsAfter(std::initializer_list<Input> changed, bool anyView = true) {
    const Needs needs = computeNeeds(everything(anyView));
    const Plan plan = makePlan(needs);
    InputHashes inputs{};
    Kept kept;
    kept.note(plan, needs, inputs);
    for (const Input input : changed) inputs[static_cast<std::size_t>(input)] = 1;
    const std::vector<RowDecision> decisions = kept.decide(plan, needs, inputs);
    std::string rows;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        if (decisions[i].run && plan.rows[i]->phase == Phase::frame) rows += std::string(plan.rows[i]->name) + " ";
    }
    return rows;
}

TEST(Kept, WhatIsLitForAnyView) {
    EXPECT_EQ(rowsAfter({}), "");
    EXPECT_EQ(rowsAfter({Input::camera}), "composite ");
    EXPECT_EQ(rowsAfter({Input::pictureSize}), "composite ");
    EXPECT_EQ(rowsAfter({Input::aovs}), "composite ");
    EXPECT_EQ(rowsAfter({Input::lightPower}), "irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::environmentPower}), "irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::environmentRotation}),
              "environment_visibility irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::lightPlaces}), "light_maps thickness irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::skinMix}), "irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::skinLayer}), "irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::chain}), "diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::profiles}), "thickness irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::atlasDetail}),
              "surface light_maps thickness environment_visibility irradiance diffusion exitance composite ");
}

// Rows that work on the list of needed tiles in place begin with its first writer.
TEST(Kept, WhatIsLitForOneView) {
    EXPECT_EQ(rowsAfter({Input::camera}, false),
              "visible thickness needed_texels environment_visibility irradiance diffusion exitance composite ");
    EXPECT_EQ(rowsAfter({Input::lightPlaces}, false),
              "visible light_maps thickness needed_texels environment_visibility irradiance diffusion exitance "
              "composite ");
    EXPECT_EQ(rowsAfter({Input::lightPower}, false), "irradiance diffusion exitance composite ");
}

TEST(Kept, ANeedThatComesOrGoes) {
    const Needs before = computeNeeds(everything(true));
    NeedsInput input = everything(true);
    input.environment = false;
    const Needs after = computeNeeds(input);
    const Plan plan = makePlan(after);
    Kept kept;
    kept.note(makePlan(before), before, {});
    std::string rows;
    const std::vector<RowDecision> decisions = kept.decide(plan, after, {});
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        if (decisions[i].run && plan.rows[i]->phase == Phase::frame) rows += std::string(plan.rows[i]->name) + " ";
    }
    EXPECT_EQ(rows, "irradiance diffusion exitance composite ");
    std::string gone;
    for (const PassRow* row : kept.leftOver(plan)) gone += std::string(row->name) + " ";
    for (const char* row : {"environment_maps", "environment_settings", "sky_occluders", "environment_visibility"}) {
        EXPECT_NE(gone.find(row), std::string::npos) << row;
    }
}

TEST(Kept, ALightMapRowKnowsThatOnlyPlacesChanged) {
    const Needs needs = computeNeeds(everything(true));
    const Plan plan = makePlan(needs);
    InputHashes inputs{};
    Kept kept;
    kept.note(plan, needs, inputs);
    inputs[static_cast<std::size_t>(Input::lightPlaces)] = 1;
    const auto changesOf = [&](const char* name) {
        const std::vector<RowDecision> decisions = kept.decide(plan, needs, inputs);
        for (std::size_t i = 0; i < plan.rows.size(); ++i) {
            if (plan.rows[i]->name == std::string(name)) return decisions[i].changes;
        }
        return Changes{};
    };
    EXPECT_TRUE(changesOf("light_maps").only({Input::lightPlaces}));
    EXPECT_FALSE(changesOf("thickness").only({Input::lightPlaces})) << "the maps changed too";
    inputs[static_cast<std::size_t>(Input::materials)] = 1;
    EXPECT_FALSE(changesOf("light_maps").only({Input::lightPlaces}));
}

}  // namespace
}  // namespace cutis::test
