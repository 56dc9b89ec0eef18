// What menus and panels do, without a window: recovery of what was not saved, the figures of the comparison.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/viewer/actions.h"
#include "app/viewer/autosave.h"
#include "app/viewer/comparing.h"
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
