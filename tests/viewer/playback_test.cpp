// The time line without a window: what plays, where it ends, and that frames are those of `cutis render
// --frames`.
#include "app/viewer/playback.h"

#include <gtest/gtest.h>

#include <thread>

#include "app/viewer/scene_poser.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"
#include "tests/support/walking_body.h"

namespace cutis::test {
namespace {

using app::Playback;
using app::Pose;
using app::ScenePoser;

Scene twoAnimations() {
    Scene scene;
    scene.animations.resize(2);
    scene.animations[0].name = "nod";
    scene.animations[0].duration = 1;
    scene.animations[1].name = "walk";
    scene.animations[1].duration = 2;
    return scene;
}

class TimeLine : public testing::Test {
  protected:
    TimeLine() { playback_.open(twoAnimations(), {}); }
    double seconds() const { return playback_.pose().seconds; }
    Playback playback_;
};

TEST_F(TimeLine, AStillSceneHasNone) {
    playback_.open(Scene(), {});
    EXPECT_TRUE(playback_.empty());
    playback_.toggle();
    playback_.step(1);
    playback_.advance(1);
    EXPECT_FALSE(playback_.playing());
    EXPECT_EQ(playback_.pose(), Pose());
}

TEST_F(TimeLine, PlaysTheFirstAnimationFromRestAtItsSpeed) {
    EXPECT_EQ(playback_.pose().animation, kAtRest);
    playback_.advance(5);  // what passes before it plays does not count
    playback_.toggle();
    EXPECT_EQ(playback_.pose(), (Pose{0, 0}));
    playback_.speed = 0.5;
    playback_.advance(0.5);
    EXPECT_DOUBLE_EQ(seconds(), 0.25);
    playback_.toggle();
    playback_.advance(0.5);
    EXPECT_DOUBLE_EQ(seconds(), 0.25);
}

TEST_F(TimeLine, LoopsOrStopsAtTheEnd) {
    playback_.choose(1);
    playback_.toggle();
    playback_.advance(4.5);
    EXPECT_DOUBLE_EQ(seconds(), 0.5);
    playback_.loop = false;
    playback_.advance(4.5);
    EXPECT_EQ(seconds(), 2);
    EXPECT_FALSE(playback_.playing());
    playback_.toggle();  // anew from the beginning
    EXPECT_EQ(seconds(), 0);
    EXPECT_TRUE(playback_.playing());
}

TEST_F(TimeLine, StepsGoFromFrameToFrameAndPause) {
    playback_.choose(1);
    playback_.toggle();
    playback_.step(1);
    EXPECT_FALSE(playback_.playing());
    EXPECT_EQ(playback_.frame(), 1);
    EXPECT_DOUBLE_EQ(seconds(), 1 / 24.0);
    for (int i = 0; i < 10; ++i) playback_.step(1);
    EXPECT_EQ(playback_.frame(), 11);
    playback_.seek(10.5 / 24);
    playback_.step(1);
    EXPECT_EQ(playback_.frame(), 11);
    playback_.seek(10.5 / 24);
    playback_.step(-1);
    EXPECT_EQ(playback_.frame(), 10);
    playback_.step(-100);
    EXPECT_EQ(seconds(), 0);
    playback_.step(1000);
    EXPECT_EQ(seconds(), 2);
    EXPECT_EQ(playback_.frame(), 48);
}

TEST_F(TimeLine, SeeksWithinTheAnimation) {
    playback_.seek(1);  // at rest there is no time
    EXPECT_EQ(playback_.pose(), Pose());
    playback_.choose(0);
    playback_.seek(3);
    EXPECT_EQ(seconds(), 1);
    playback_.seek(-1);
    EXPECT_EQ(seconds(), 0);
    playback_.choose(kAtRest);
    EXPECT_EQ(playback_.duration(), 0);
}

// Two copies take turns: the one that is shown is never written to.
TEST(ScenePoser, PosesTheCopyThatIsNotShown) {
    const TemporaryFolder folder;
    auto shown = std::make_shared<Scene>(loadGltf(writeWalkingBody(folder.path()), {}));
    const auto place = [](const Scene& scene) { return scene.nodes.at(1).world[3].z; };  // of the hips
    ScenePoser poser;
    poser.open(std::make_shared<Scene>(*shown));
    for (const double seconds : {2.0, 1.0, 0.0}) {
        const double before = place(*shown);
        poser.start({0, seconds});
        EXPECT_TRUE(poser.busy());
        std::optional<ScenePoser::Posed> posed;
        while (!(posed = poser.take(shown))) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_FALSE(poser.busy());
        EXPECT_EQ(posed->pose, (Pose{0, seconds}));
        EXPECT_EQ(place(*shown), before);
        EXPECT_NEAR(place(*posed->scene), 0.3 * seconds, 1e-6);  // metres: floats of the file
        shown = posed->scene;
    }
}

}  // namespace
}  // namespace cutis::test
