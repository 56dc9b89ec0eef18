// What menus and panels do, without a window: recovery of what was not saved, the figures of the comparison.
#include <GLFW/glfw3.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/viewer/actions.h"
#include "app/viewer/autosave.h"
#include "app/viewer/comparing.h"
#include "app/viewer/hot_keys.h"
#include "renderer/scene/fields.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/rig.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

using namespace app;
using namespace std::chrono_literals;

class SessionTest : public testing::Test {
  protected:
    SessionTest() { setenv("CUTIS_CACHE_DIR", folder_.path().c_str(), 1); }
    ~SessionTest() override { unsetenv("CUTIS_CACHE_DIR"); }

    static std::unique_ptr<Session> openTwoHeads() {
        auto session = std::make_unique<Session>();
        session->geometry = std::make_shared<Scene>(twoHeads());
        session->openedScene = "heads.glb";
        Document document;
        document.scene = session->openedScene;
        document.skin = skinOf(*session->geometry);
        Light key;
        key.name = "key";
        document.rig.lights = {key};
        document.solo = {false};
        session->loadedSkin = session->savedSkin = document.skin;
        session->edits.reset(document);
        return session;
    }
    static void makeRedder(Session& session) {
        session.edits.apply("Scale", [](Document& document) {
            for (auto& skin : document.skin)
                if (skin) skin->scale = 1.5;
        });
    }

    const TemporaryFolder folder_;
};

TEST_F(SessionTest, RigAndSkinThatWereNotSavedAreRecovered) {
    const auto session = openTwoHeads();
    autosave(*session);
    EXPECT_FALSE(keepAutosave()) << "nothing has changed";
    session->edits.apply("Intensity", [](Document& document) { document.rig.lights[0].intensity = 7; });
    makeRedder(*session);
    autosave(*session);

    // The program has ended badly; the next one starts, and works on something else before it recovers.
    EXPECT_TRUE(keepAutosave());
    const auto next = openTwoHeads();
    next->edits.apply("Name", [](Document& document) { document.rig.name = "other"; });
    autosave(*next);
    next->recoverable = true;
    recoverUnsaved(*next);
    EXPECT_FALSE(next->recoverable);
    EXPECT_FALSE(next->messageIsError) << next->message;
    EXPECT_EQ(next->document().rig.lights.at(0).intensity, 7);
    EXPECT_EQ(next->document().skin, session->document().skin);
    EXPECT_TRUE(next->edits.unsaved() && next->skinUnsaved());
    next->edits.undo();
    EXPECT_EQ(next->document().skin, next->savedSkin);
    EXPECT_EQ(next->edits.undoLabel(), "Recover rig");

    discardAutosave();
    EXPECT_FALSE(keepAutosave());
}

TEST_F(SessionTest, SkinOfAnotherSceneStaysToBeRecovered) {
    const auto session = openTwoHeads();
    makeRedder(*session);
    autosave(*session);
    ASSERT_TRUE(keepAutosave());
    const auto other = openTwoHeads();
    for (Material& material : other->geometry->materials) material.name += " of another scene";
    recoverUnsaved(*other);
    EXPECT_TRUE(other->recoverable && other->messageIsError);
    EXPECT_EQ(other->document().skin, other->savedSkin);
    const auto same = openTwoHeads();
    recoverUnsaved(*same);
    EXPECT_FALSE(same->recoverable);
    EXPECT_EQ(same->document().skin, session->document().skin);
}

TEST_F(SessionTest, WhatIsSavedIsNotKept) {
    const auto session = openTwoHeads();
    makeRedder(*session);
    autosave(*session);
    session->edits.undo();
    autosave(*session);
    EXPECT_FALSE(keepAutosave());
}

// Two programs at once: neither takes what the other has not saved, nor writes over it.
TEST_F(SessionTest, ProgramsThatRunAtOnceKeepTheirOwn) {
    const int other = open((folder_ / "autosave.lock").c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_EQ(flock(other, LOCK_EX), 0);
    Rig ofTheOther;
    ofTheOther.name = "other";
    saveRig(ofTheOther, folder_ / "autosave.rig.json");

    EXPECT_FALSE(keepAutosave()) << "the other is still running";
    const auto session = openTwoHeads();
    session->edits.apply("Name", [](Document& document) { document.rig.name = "own"; });
    autosave(*session);
    EXPECT_EQ(loadRig(folder_ / "autosave.rig.json").name, "other");
    discardAutosave();
    EXPECT_EQ(loadRig(folder_ / "autosave.rig.json").name, "other");

    // It ends without saving: whoever starts next recovers that.
    EXPECT_FALSE(findLeftBehind());
    close(other);
    EXPECT_TRUE(findLeftBehind());
    const auto next = openTwoHeads();
    recoverUnsaved(*next);
    EXPECT_EQ(next->document().rig.name, "other");
    discardAutosave();
}

TEST_F(SessionTest, MessagesEnd) {
    const auto session = openTwoHeads();
    const auto now = std::chrono::steady_clock::now();
    session->say("Saved");
    session->endMessage(now);
    EXPECT_EQ(session->message, "Saved");
    session->endMessage(now + 30s);
    EXPECT_EQ(session->message, "");
    session->complain("cannot be opened");
    session->endMessage(now + 30s);
    EXPECT_EQ(session->message, "cannot be opened");
    session->endMessage(now + 90s);
    EXPECT_EQ(session->message, "");
    EXPECT_FALSE(session->messageIsError);
    // What is under way is said until it has come to an end.
    session->announce("Looks for the sun");
    session->endMessage(now + 1h);
    EXPECT_EQ(session->message, "Looks for the sun");
    session->takeBack("another");
    EXPECT_EQ(session->message, "Looks for the sun");
    session->takeBack("Looks for the sun");
    EXPECT_EQ(session->message, "");
}

// A picture that is to be saved is not lost to a hasty end, unless that is asked for twice.
TEST_F(SessionTest, QuittingWaitsForWhatIsBeingSaved) {
    const auto session = openTwoHeads();
    savePicture(*session, folder_ / "picture.png");
    ASSERT_TRUE(session->saves()) << "there is no picture yet";
    quit(*session);
    EXPECT_FALSE(session->quit);
    continueQuitting(*session);
    EXPECT_FALSE(session->quit);
    session->saving = {};
    continueQuitting(*session);
    EXPECT_TRUE(session->quit) << "it is saved";

    session->quit = false;
    savePicture(*session, folder_ / "picture.png");
    quit(*session);
    quit(*session);
    EXPECT_TRUE(session->quit) << "asked for twice";

    session->quit = false;
    session->quitsWhenSaved.reset();
    quit(*session);
    makeRedder(*session);
    session->saving = {};
    continueQuitting(*session);
    EXPECT_FALSE(session->quit) << "something was edited meanwhile";
}

// A key that is held repeats steps; what it turns on stays on.
TEST_F(SessionTest, KeysThatAreHeldRepeatSteps) {
    const auto session = openTwoHeads();
    const double before = session->light().intensity;
    for (const bool again : {false, true, true}) {
        runHotKey(*session, {GLFW_KEY_RIGHT_BRACKET, 0, again}, false);
        runHotKey(*session, {GLFW_KEY_S, 0, again}, false);
    }
    EXPECT_NEAR(session->light().intensity, 2 * before, 1e-9);
    EXPECT_TRUE(session->document().solo[0]);
    for (int i = 0; i < 10000; ++i) runHotKey(*session, {GLFW_KEY_RIGHT_BRACKET, 0, true}, false);
    EXPECT_EQ(session->light().intensity, fields::kIntensity.high);
}

// A window that has changed its size shows a picture that is not the view's.
TEST_F(SessionTest, APictureOfAnotherSizeIsNotComplete) {
    const auto session = openTwoHeads();
    session->view = {0, 0, 4, 2};
    WorkerResult picture;
    picture.version = session->shownVersion();
    picture.full = true;
    picture.linear = std::make_shared<const Picture>(Picture{4, 2, 4, std::vector<float>(32, 0.5f)});
    session->picture = picture;
    EXPECT_TRUE(session->complete());
    session->view.width = 5;
    EXPECT_FALSE(session->complete());
}

TEST_F(SessionTest, TheChosenLightStaysChosenInAnotherOrder) {
    const auto session = openTwoHeads();
    session->edits.apply("Add", [](Document& document) { addLight(document, LightType::spot); });
    session->edits.endGesture();
    session->edits.apply("Reorder", [](Document& document) { moveLight(document, 1, 0); });
    session->selectedLight = 0;
    const std::string name = session->light().name;
    ASSERT_NE(name, "key");
    undo(*session);
    EXPECT_EQ(session->light().name, name);
    EXPECT_EQ(session->selectedLight, 1);
    redo(*session);
    EXPECT_EQ(session->selectedLight, 0);
}

// Waits for what runs in the background.
template <class Done>
void waitFor(const Done& done) {
    for (int i = 0; i < 10000 && !done(); ++i) std::this_thread::sleep_for(1ms);
    ASSERT_TRUE(done());
}

// Of the same pictures the panel and the command line say the same, to the last digit, and write the same
// report.
TEST_F(SessionTest, ThePanelSaysWhatTheCommandLineSays) {
    const std::string scene = folder_ / "heads.glb", out = folder_ / "command";
    writeGlb(twoHeads(), scene);
    expectSuccess(runCutis({"compare", scene, "--a", "butterfly", "--b", "rim", "--size", "96x54", "--device",
                            "cpu", "--exposure", "-1", "-o", out}));
    const nlohmann::json told = nlohmann::json::parse(readText(out + "/compare.json"));

    const auto session = openTwoHeads();
    session->compareMode = CompareMode::difference;
    const char* names[] = {"butterfly", "rim"};
    for (std::size_t slot = 0; slot < 2; ++slot) {
        StoredState& state = session->compared[slot];
        state = {true, names[slot], session->document(), nullptr};
        state.document.rig.exposure = -1;
        const std::string file = std::string(slot == 0 ? "/A-" : "/B-") + names[slot] + ".exr";
        state.linear = std::make_shared<const Picture>(readPicture(out + file));
    }
    updateDifference(*session);
    waitFor([&] { return session->comparing.wait_for(0s) == std::future_status::ready; });
    updateDifference(*session);
    ASSERT_TRUE(session->figures);
    const nlohmann::json& row = told["pictures"][0];
    EXPECT_EQ(session->figures->relativeL2, row["rel_l2"].get<double>());
    EXPECT_EQ(session->figures->p99, row["p99"].get<double>());
    EXPECT_EQ(session->figures->flip, row["flip"].get<double>());
    EXPECT_EQ(session->figures->lightRatio, row["light_ratio"].get<double>());
    EXPECT_GT(session->figures->flip, 0.01) << "two rigs that differ";

    saveComparison(*session, folder_ / "panel");
    waitFor([&] { return session->writing.wait_for(0s) == std::future_status::ready; });
    const SaidOfSaving said = session->writing.get();
    EXPECT_FALSE(said.failed) << said.text;
    ASSERT_EQ(filesIn(folder_ / "panel"), filesIn(out));
    for (const std::string& file : filesIn(out)) {
        const std::string panel = folder_ / ("panel/" + file), command = out + "/" + file;
        // An EXR file says when it was written.
        const bool same = file.ends_with(".exr") ? readPicture(panel).values == readPicture(command).values
                                                 : readText(panel) == readText(command);
        EXPECT_TRUE(same) << file;
    }
}

}  // namespace
}  // namespace cutis::test
