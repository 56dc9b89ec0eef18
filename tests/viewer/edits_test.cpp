// The edit list without a window: every change can be undone, drags are one edit, and what is unsaved is known.
#include <gtest/gtest.h>

#include "app/viewer/edits.h"

namespace cutis::test {
namespace {

using app::Document;
using app::EditList;

Document twoLights() {
    Document document;
    app::addLight(document, LightType::rect);
    app::addLight(document, LightType::spot);
    document.rig.lights[0].name = "key";
    document.rig.lights[1].name = "rim";
    return document;
}

void setIntensity(EditList& edits, double value) {
    edits.apply("Intensity of key", [&](Document& d) { d.rig.lights[0].intensity = value; });
}

class Edits : public testing::Test {
  protected:
    Edits() { edits_.reset(twoLights()); }
    double intensity() const { return edits_.document().rig.lights[0].intensity; }
    EditList edits_;
};

TEST_F(Edits, UndoAndRedoGoThroughTheStates) {
    const double first = intensity();
    setIntensity(edits_, 3);
    edits_.endGesture();
    setIntensity(edits_, 4);
    EXPECT_EQ(edits_.undoLabel(), "Intensity of key");
    edits_.undo();
    EXPECT_EQ(intensity(), 3);
    edits_.undo();
    EXPECT_EQ(intensity(), first);
    EXPECT_FALSE(edits_.canUndo());
    edits_.undo();  // nothing happens
    edits_.redo();
    edits_.redo();
    EXPECT_EQ(intensity(), 4);
    EXPECT_FALSE(edits_.canRedo());
}

TEST_F(Edits, ADragIsOneEdit) {
    const double first = intensity();
    for (int i = 1; i <= 100; ++i) setIntensity(edits_, i);
    EXPECT_EQ(intensity(), 100);
    edits_.undo();
    EXPECT_EQ(intensity(), first);
    edits_.redo();
    EXPECT_EQ(intensity(), 100);
}

TEST_F(Edits, AnotherLabelOrAReleaseStartsAnotherEdit) {
    setIntensity(edits_, 3);
    edits_.apply("Mute key", [](Document& d) { d.rig.lights[0].enabled = false; });
    setIntensity(edits_, 5);
    edits_.undo();
    EXPECT_EQ(intensity(), 3);
    EXPECT_FALSE(edits_.document().rig.lights[0].enabled);
    setIntensity(edits_, 6);  // after undo nothing grows
    edits_.undo();
    EXPECT_EQ(intensity(), 3);
}

TEST_F(Edits, ANewEditCutsOffRedo) {
    setIntensity(edits_, 3);
    edits_.undo();
    edits_.apply("Mute key", [](Document& d) { d.rig.lights[0].enabled = false; });
    EXPECT_FALSE(edits_.canRedo());
}

TEST_F(Edits, WhatChangesNothingIsNoEdit) {
    const std::uint64_t version = edits_.version();
    edits_.apply("Nothing", [](Document&) {});
    EXPECT_FALSE(edits_.canUndo());
    EXPECT_EQ(edits_.version(), version);
}

TEST_F(Edits, AFailedEditLeavesTheDocument) {
    const Document before = edits_.document();
    EXPECT_THROW(edits_.apply("Bad",
                              [](Document& d) {
                                  d.rig.lights.clear();
                                  throw std::runtime_error("bad file");
                              }),
                 std::runtime_error);
    EXPECT_TRUE(edits_.document() == before);
    EXPECT_FALSE(edits_.canUndo());
}

TEST_F(Edits, KnowWhatIsUnsaved) {
    EXPECT_FALSE(edits_.unsaved());
    edits_.apply("Solo key", [](Document& d) { d.solo[0] = true; });
    EXPECT_FALSE(edits_.unsaved()) << "solo is not in a rig file";
    setIntensity(edits_, 3);
    EXPECT_TRUE(edits_.unsaved());
    edits_.markSaved();
    EXPECT_FALSE(edits_.unsaved());
    edits_.undo();
    EXPECT_TRUE(edits_.unsaved()) << "the file has what was undone";
    edits_.redo();
    EXPECT_FALSE(edits_.unsaved());
}

TEST_F(Edits, HistoryIsBounded) {
    for (int i = 0; i < 1500; ++i) {
        setIntensity(edits_, i + 10);
        edits_.endGesture();
    }
    int undone = 0;
    for (; edits_.canUndo(); ++undone) edits_.undo();
    EXPECT_EQ(undone, 1000);
}

TEST(Rig, SoloSilencesOthersAndTheEnvironment) {
    Document document = twoLights();
    document.rig.environment.file = "sky.exr";
    document.rig.lights[1].enabled = false;
    EXPECT_TRUE(app::effectiveRig(document).lights[0].enabled);
    EXPECT_FALSE(app::effectiveRig(document).lights[1].enabled);
    document.solo[1] = true;  // solo wins over mute
    const Rig rig = app::effectiveRig(document);
    EXPECT_FALSE(rig.lights[0].enabled);
    EXPECT_TRUE(rig.lights[1].enabled);
    EXPECT_FALSE(rig.environment.enabled);
}

TEST(Rig, SoloFollowsItsLight) {
    Document document = twoLights();
    document.solo[1] = true;
    app::moveLight(document, 1, 0);
    EXPECT_EQ(document.rig.lights[0].name, "rim");
    EXPECT_TRUE(document.solo[0]);
    EXPECT_FALSE(document.solo[1]);
    EXPECT_EQ(app::duplicateLight(document, 0), 1);
    EXPECT_EQ(document.rig.lights[1].name, "rim 2");
    EXPECT_FALSE(document.solo[1]);
    app::deleteLight(document, 0);
    EXPECT_EQ(document.solo.size(), 2u);
    EXPECT_EQ(app::uniqueLightName(document.rig, "rim 2"), "rim 3");
}

// At `distance`, on the axis: E = cd / d² = L · A / d² = lux.
TEST(Rig, ChangingTheTypeKeepsTheBrightness) {
    Light light;
    light.intensity = 8;
    const double distance = 2;
    app::changeType(light, LightType::rect, distance);
    EXPECT_DOUBLE_EQ(light.intensity * light.size.x * light.size.y / 4, 2);
    app::changeType(light, LightType::directional, distance);
    EXPECT_DOUBLE_EQ(light.intensity, 2);
    app::changeType(light, LightType::spot, distance);
    EXPECT_DOUBLE_EQ(light.intensity, 8);
    EXPECT_LT(light.innerConeAngle, light.outerConeAngle);
}

// A free light that is turned goes where a placed one goes, and still aims at the pivot.
TEST(Rig, FreeAndPlacedLightsTurnAlike) {
    const glm::dvec3 pivot(0.1, 1.6, -0.2);
    Light free;
    free.position = pivot + glm::dvec3(0.5, 0.4, 1.1);
    free.direction = glm::normalize(pivot - free.position);
    Light placed = free;
    app::placeLight(placed, pivot);
    app::turnLight(free, 33, 12, pivot);
    app::turnLight(placed, 33, 12, pivot);
    Light seen = free;
    app::placeLight(seen, pivot);
    EXPECT_NEAR(seen.place->azimuth, placed.place->azimuth, 1e-9);
    EXPECT_NEAR(seen.place->elevation, placed.place->elevation, 1e-9);
    EXPECT_NEAR(seen.place->distance, placed.place->distance, 1e-12);
    EXPECT_NEAR(glm::length(free.direction - glm::normalize(pivot - free.position)), 0, 1e-12);
}

TEST(Rig, EnvironmentGetsARelativeNameNearTheFile) {
    Rig rig;
    rig.environment.file = "/data/hdri/sky.exr";
    EXPECT_EQ(app::rigForFile(rig, "/data/default/a.rig.json").environment.file, "../hdri/sky.exr");
    EXPECT_EQ(app::rigForFile(rig, "/home/ann/rigs/a.rig.json").environment.file, "/data/hdri/sky.exr");
}

}  // namespace
}  // namespace cutis::test
