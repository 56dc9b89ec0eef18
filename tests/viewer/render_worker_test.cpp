// The worker with a renderer that only notes what it was asked for.
#include "app/viewer/render_worker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <semaphore>

#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/cli/program.h"
#include "tests/support/walking_body.h"

namespace cutis::test {
namespace {

using namespace app;
using namespace std::chrono_literals;

RenderState stateOf(double exposure, int width = 400, int height = 200) {
    RenderState state;
    state.scene = std::make_shared<Scene>(twoHeads());
    state.rig.exposure = exposure;
    state.settings.width = width;
    state.settings.height = height;
    return state;
}

// One function for the view and for drafts.
Renderers both(const RenderFunction& function) {
    Renderers renderers;
    renderers.view = renderers.draft = function;
    return renderers;
}

RenderResult greyPicture(const RenderSettings& settings) {
    RenderResult result;
    result.picture = {settings.width, settings.height, 4, {}};
    result.picture.values.assign(std::size_t(settings.width) * settings.height * 4, 0.18f);
    result.stats.device = "paper";
    return result;
}

// Results until the full picture of `version`, or for five seconds.
std::vector<WorkerResult> resultsUntil(RenderWorker& worker, std::uint64_t version) {
    std::vector<WorkerResult> results;
    const auto end = std::chrono::steady_clock::now() + 5s;
    while (std::chrono::steady_clock::now() < end) {
        if (auto result = worker.takeResult()) results.push_back(std::move(*result));
        if (!results.empty() && results.back().version == version && results.back().full) break;
        std::this_thread::sleep_for(1ms);
    }
    return results;
}

TEST(RenderWorker, RefinesFromAQuarterToTheFullPicture) {
    std::vector<int> widths;
    {
        RenderWorker worker(
            [&] {
                return both([&](const RenderInput&, const RenderSettings& settings) {
                    widths.push_back(settings.width);
                    std::this_thread::sleep_for(std::chrono::milliseconds(120));  // slower than "instant"
                    return greyPicture(settings);
                });
            },
            [] {});
        worker.show(1, stateOf(0));
        const std::vector<WorkerResult> results = resultsUntil(worker, 1);
        ASSERT_FALSE(results.empty());
        EXPECT_TRUE(results.back().full);
        EXPECT_EQ(results.back().display.width, 400);
        EXPECT_EQ(results.back().display.height, 200);
        EXPECT_EQ(results.back().display.rgba.size(), 400u * 200 * 4);
        EXPECT_EQ(results.back().stats.device, "paper");
    }
    ASSERT_GE(widths.size(), 2u);  // more full ones may have followed
    EXPECT_EQ(std::vector<int>(widths.begin(), widths.begin() + 2), (std::vector<int>{100, 400}));
}

// Pictures of 0.1 and 0.3 in turn: their mean is shown, but the first one is what is saved.
TEST(RenderWorker, AStillViewIsTheMeanOfPicturesFromSlightlyTurnedCameras) {
    std::vector<glm::dmat4> cameras;
    RenderWorker worker(
        [&] {
            return both([&](const RenderInput& input, const RenderSettings& settings) {
                RenderResult result = greyPicture(settings);
                if (settings.width == 400) {
                    cameras.push_back(input.camera.world);
                    for (std::size_t i = 0; i < result.picture.values.size(); ++i)
                        result.picture.values[i] = cameras.size() % 2 ? 0.1f : 0.3f;
                }
                return result;
            });
        },
        [] {});
    worker.show(1, stateOf(0));
    std::optional<WorkerResult> last;
    for (int i = 0; i < 5000 && !(last && last->refined == Refinement::kPixelPictures); ++i) {
        if (auto result = worker.takeResult()) last = std::move(result);
        std::this_thread::sleep_for(1ms);
    }
    ASSERT_TRUE(last && last->refined == Refinement::kPixelPictures);
    EXPECT_EQ(last->linear->values[0], 0.1f);
    Picture mean = *last->linear;
    mean.values.assign(mean.values.size(), 0.2f);
    EXPECT_NEAR(last->display.rgba[0], toDisplay(mean, 0).rgba[0], 1);
    ASSERT_EQ(cameras.size(), std::size_t(Refinement::kPixelPictures));
    for (std::size_t i = 1; i < cameras.size(); ++i) {
        EXPECT_NE(cameras[i], cameras[0]);
        // A third of a pixel of 200 in a field of 0.6 rad is 1 mrad.
        EXPECT_LT(glm::length(glm::dvec3(cameras[i][2] - cameras[0][2])), 1e-3);
    }
}

// A soft light is averaged over other samples, on another renderer, until that changes nothing.
TEST(RenderWorker, SoftShadowsAreRefinedBesideTheView) {
    std::mutex mutex;
    std::vector<std::uint32_t> viewSeeds, shadowSeeds;
    const auto note = [&](std::vector<std::uint32_t>& seeds, float value) -> RenderFunction {
        return [&, value](const RenderInput&, const RenderSettings& settings) {
            const std::lock_guard lock(mutex);
            seeds.push_back(settings.seed);
            RenderResult result = greyPicture(settings);
            result.picture.values.assign(result.picture.values.size(), value);
            return result;
        };
    };
    RenderWorker worker(
        [&] {
            Renderers renderers = both(note(viewSeeds, 0.2f));
            renderers.openShadows = [&] { return note(shadowSeeds, 0.1f); };
            return renderers;
        },
        [] {});
    RenderState state = stateOf(0);
    Light soft;
    soft.type = LightType::rect;
    soft.size = {1, 1};
    state.rig.lights = {soft};
    worker.show(1, state);
    std::optional<WorkerResult> last;
    for (int i = 0; i < 5000 && !(last && last->converged); ++i) {
        if (auto result = worker.takeResult()) last = std::move(result);
        std::this_thread::sleep_for(1ms);
    }
    ASSERT_TRUE(last && last->converged);
    EXPECT_EQ(last->refined, Refinement::kPixelPictures);
    EXPECT_GT(last->shadowSets, 2);
    const std::lock_guard lock(mutex);
    for (const std::uint32_t seed : viewSeeds) EXPECT_EQ(seed, 0u);
    ASSERT_EQ(shadowSeeds.size(), std::size_t(last->shadowSets - 1));
    for (std::size_t i = 0; i < shadowSeeds.size(); ++i) EXPECT_EQ(shadowSeeds[i], i + 1);
    // One set of 0.2 among those of 0.1.
    Picture mean = *last->linear;
    mean.values.assign(mean.values.size(), 0.1f + 0.1f / static_cast<float>(last->shadowSets));
    EXPECT_NEAR(last->display.rgba[0], toDisplay(mean, 0).rgba[0], 1);
    EXPECT_EQ(last->linear->values[0], 0.2f) << "what is saved is the first";
}

TEST(RenderWorker, ARestartOpensEverythingAnew) {
    int opened = 0;
    RenderWorker worker(
        [&] {
            ++opened;
            return both(
                [](const RenderInput&, const RenderSettings& settings) { return greyPicture(settings); });
        },
        [] {});
    worker.show(1, stateOf(0));
    resultsUntil(worker, 1);
    worker.restart();
    worker.show(2, stateOf(0));
    ASSERT_FALSE(resultsUntil(worker, 2).empty());
    EXPECT_EQ(opened, 2);
}

TEST(RenderWorker, AnotherExposureIsNotRenderedAnew) {
    int rendered = 0;
    RenderWorker worker(
        [&] {
            return both([&](const RenderInput&, const RenderSettings& settings) {
                ++rendered;
                return greyPicture(settings);
            });
        },
        [] {});
    RenderState state = stateOf(0);
    worker.show(1, state);
    for (int i = 0; i < 5000; ++i) {
        const auto result = worker.takeResult();
        if (result && result->refined == Refinement::kPixelPictures) break;
        std::this_thread::sleep_for(1ms);
    }
    const int before = rendered;
    state.rig.exposure = 1;
    worker.show(2, state);
    const std::vector<WorkerResult> results = resultsUntil(worker, 2);
    ASSERT_FALSE(results.empty());
    EXPECT_EQ(results.back().version, 2u);
    EXPECT_EQ(results.back().display.rgba[0], toDisplay(*results.back().linear, 1).rgba[0]);
    EXPECT_LE(rendered - before, Refinement::kPixelPictures - 1);  // the refinement, but no first picture
}

// The scene stands in the pose that was asked for, and whoever keeps what it has uploaded hears of each
// change once.
TEST(RenderWorker, PosesTheSceneBeforeItIsDrawn) {
    const TemporaryFolder folder;
    using Drawn = std::pair<double, std::uint64_t>;  // where the hips are, the pose's revision
    std::mutex mutex;
    std::vector<Drawn> drawn;
    RenderWorker worker(
        [&] {
            return both([&](const RenderInput& input, const RenderSettings& settings) {
                const std::lock_guard lock(mutex);
                drawn.emplace_back(input.scene->nodes.at(1).world[3].z, input.poseRevision);
                return greyPicture(settings);
            });
        },
        [] {});
    RenderState state = stateOf(0);
    state.scene = std::make_shared<Scene>(loadGltf(writeWalkingBody(folder.path()), {}));
    std::uint64_t version = 0;
    for (const double seconds : {0.0, 1.0, 1.0, 2.0}) {
        state.pose = {0, seconds};
        state.rig.exposure += 1;
        worker.show(++version, state);
        ASSERT_FALSE(resultsUntil(worker, version).empty());
    }
    worker.renderAside({7, state});
    while (worker.takeAside().empty()) std::this_thread::sleep_for(1ms);
    const std::lock_guard lock(mutex);
    std::uint64_t revisions = 0;
    double last = -1;
    for (const auto& [place, revision] : drawn) {
        if (std::abs(place - last) > 1e-6) ++revisions;
        last = place;
        EXPECT_EQ(revision, revisions) << place;
    }
    EXPECT_EQ(revisions, 3u);
    EXPECT_NEAR(last, 0.6, 1e-6);
}

// The picture that it was lost with comes all the same, or, where that loses the next one too, the reason.
TEST(RenderWorker, ALostDeviceIsOpenedAnew) {
    int opened = 0;
    RenderWorker worker(
        [&] {
            ++opened;
            return both([number = opened](const RenderInput& input, const RenderSettings& settings) {
                if (number == 1 || input.rig.exposure == 2)
                    throw Error("rendering", "the device was lost (driver crash or time-out)");
                return greyPicture(settings);
            });
        },
        [] {});
    worker.show(1, stateOf(0));
    ASSERT_FALSE(resultsUntil(worker, 1).empty());
    EXPECT_EQ(worker.status().devicesLost, 1);
    EXPECT_EQ(worker.status().error, "");
    EXPECT_EQ(opened, 2);
    worker.show(2, stateOf(2));
    for (int i = 0; i < 5000 && worker.status().devicesLost < 3; ++i) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(worker.status().devicesLost, 3) << "tried once more, not again and again";
    EXPECT_NE(worker.status().error.find("lost"), std::string::npos);
    worker.show(3, stateOf(0));
    ASSERT_FALSE(resultsUntil(worker, 3).empty());
}

// A full picture that takes long, as a renderer does that asks between passes.
TEST(RenderWorker, ANewerStateInterruptsAllButTheFirstPicture) {
    std::mutex mutex;
    std::vector<std::pair<double, int>> finished;  // exposure, width
    int interrupted = 0;
    std::binary_semaphore fullBegun(0);
    const RenderFunction slow = [&](const RenderInput& input, const RenderSettings& settings) {
        EXPECT_EQ(bool(settings.stopAsked), settings.width != 100) << "the draft is finished whatever comes";
        const bool endless = settings.width == 400 && input.rig.exposure == 1;
        if (endless) fullBegun.release();
        for (int i = 0; endless && i < 5000; ++i) {
            if (settings.stopAsked()) {
                const std::lock_guard lock(mutex);
                ++interrupted;
                throw Interrupted();
            }
            std::this_thread::sleep_for(1ms);
        }
        const std::lock_guard lock(mutex);
        finished.emplace_back(input.rig.exposure, settings.width);
        return greyPicture(settings);
    };
    RenderWorker worker([&] { return both(slow); }, [] {});
    worker.show(1, stateOf(1));
    ASSERT_TRUE(fullBegun.try_acquire_for(5s));
    worker.show(2, stateOf(2));
    ASSERT_FALSE(resultsUntil(worker, 2).empty());
    EXPECT_EQ(worker.status().error, "");
    const std::lock_guard lock(mutex);
    EXPECT_EQ(interrupted, 1);
    ASSERT_GE(finished.size(), 3u);
    EXPECT_EQ(finished[0], std::pair(1.0, 100));
    EXPECT_EQ(finished[1], std::pair(2.0, 100));
    EXPECT_EQ(finished[2], std::pair(2.0, 400));
}

// Interrupted pictures beside the view are made once it rests.
TEST(RenderWorker, PicturesBesideTheViewWaitForEdits) {
    std::binary_semaphore begun(0);
    std::atomic<int> tries = 0;
    RenderWorker worker(
        [&] {
            return both([&](const RenderInput&, const RenderSettings& settings) {
                if (settings.width != 64 || ++tries > 1) return greyPicture(settings);
                begun.release();
                while (!settings.stopAsked()) std::this_thread::sleep_for(1ms);
                throw Interrupted();
            });
        },
        [] {});
    worker.renderAside({7, stateOf(0, 64, 48)});
    ASSERT_TRUE(begun.try_acquire_for(5s));
    worker.show(1, stateOf(0));
    ASSERT_FALSE(resultsUntil(worker, 1).empty());
    std::vector<AsideResult> beside;
    for (int i = 0; i < 5000 && beside.empty(); ++i) {
        beside = worker.takeAside();
        std::this_thread::sleep_for(1ms);
    }
    ASSERT_EQ(beside.size(), 1u);
    EXPECT_NE(beside[0].linear, nullptr);
    EXPECT_EQ(tries, 2);
}

TEST(RenderWorker, PicturesBesideTheViewFollowIt) {
    std::vector<int> widths;
    std::vector<AsideResult> beside;
    {
        RenderWorker worker(
            [&] {
                return both([&](const RenderInput&, const RenderSettings& settings) {
                    widths.push_back(settings.width);
                    return greyPicture(settings);
                });
            },
            [] {});
        worker.renderAside({7, stateOf(0, 64, 48)});
        for (int i = 0; i < 5000 && beside.empty(); ++i) {
            for (AsideResult& result : worker.takeAside()) beside.push_back(std::move(result));
            std::this_thread::sleep_for(1ms);
        }
        EXPECT_EQ(worker.status().aside, 0u);
    }
    ASSERT_EQ(beside.size(), 1u);
    EXPECT_EQ(beside[0].id, 7);
    ASSERT_NE(beside[0].linear, nullptr);
    EXPECT_EQ(beside[0].display.width, 64);
    EXPECT_EQ(widths, std::vector<int>{64});
}

// A light that changes is drafted apart; a camera that moves is lit as it was, at first in a small picture.
TEST(RenderWorker, DraftsAreLitCoarselyAndMovesAsTheFullPicture) {
    using Asked = std::tuple<std::string, int, double>;  // by which renderer, how wide, in what detail
    std::vector<Asked> asked;
    const auto note = [&](const std::string& name) -> RenderFunction {
        return [&asked, name](const RenderInput&, const RenderSettings& settings) {
            asked.emplace_back(name, settings.width, settings.detail);
            std::this_thread::sleep_for(std::chrono::milliseconds(110));
            return greyPicture(settings);
        };
    };
    {
        RenderWorker worker([&] { return Renderers{note("view"), note("draft")}; }, [] {});
        RenderState state = stateOf(0);
        worker.show(1, state);
        resultsUntil(worker, 1);
        state.camera.world[3].x += 1;
        worker.show(2, state);
        resultsUntil(worker, 2);
    }
    ASSERT_GE(asked.size(), 3u);
    EXPECT_EQ(asked[0], Asked("draft", 100, 1));
    EXPECT_EQ(asked[1], Asked("view", 400, 1));
    const auto small =
        std::find_if(asked.begin() + 2, asked.end(), [](const Asked& a) { return std::get<1>(a) != 400; });
    ASSERT_NE(small, asked.end());
    EXPECT_EQ(std::get<0>(*small), "view");
    EXPECT_EQ(std::get<2>(*small) * std::get<1>(*small), 400);
}

TEST(RenderWorker, ANewerStateEndsTheRefinement) {
    std::binary_semaphore begun(0), go(0);
    std::vector<std::pair<double, int>> asked;
    RenderWorker worker(
        [&] {
            return both([&](const RenderInput& input, const RenderSettings& settings) {
                asked.emplace_back(input.rig.exposure, settings.width);
                if (asked.size() == 1) {
                    begun.release();
                    go.acquire();
                }
                return greyPicture(settings);
            });
        },
        [] {});
    worker.show(1, stateOf(1));
    begun.acquire();
    worker.show(2, stateOf(2));  // never rendered: 3 replaces it
    worker.show(3, stateOf(3));
    go.release();
    const std::vector<WorkerResult> results = resultsUntil(worker, 3);
    ASSERT_FALSE(results.empty());
    EXPECT_TRUE(results.back().full);
    ASSERT_GE(asked.size(), 2u);
    EXPECT_EQ(asked[0], (std::pair<double, int>(1, 100)));
    for (std::size_t i = 1; i < asked.size(); ++i) EXPECT_EQ(asked[i].first, 3);
}

// Memory that is short for refining the picture that is there is asked for once, not again and again.
TEST(RenderWorker, RefinementEndsWhereMemoryIsShort) {
    std::atomic<int> pictures = 0;
    RenderWorker worker(
        [&] {
            return both([&](const RenderInput&, const RenderSettings& settings) {
                if (settings.width == 400 && ++pictures > 1) throw std::bad_alloc();
                return greyPicture(settings);
            });
        },
        [] {});
    worker.show(1, stateOf(0));
    for (int i = 0; i < 5000 && worker.status().error.empty(); ++i) std::this_thread::sleep_for(1ms);
    EXPECT_NE(worker.status().error.find("out of memory"), std::string::npos);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(pictures, 2);
}

// The view is there all the same.
TEST(RenderWorker, AFailureBesideTheViewIsNoneOfTheView) {
    RenderWorker worker(
        [] {
            return both([](const RenderInput& input, const RenderSettings& settings) {
                if (input.rig.exposure == 1) throw Error("thumbnail", "too large");
                return greyPicture(settings);
            });
        },
        [] {});
    worker.show(1, stateOf(0));
    ASSERT_FALSE(resultsUntil(worker, 1).empty());
    worker.renderAside({7, stateOf(1)});
    for (int i = 0; i < 5000 && worker.status().asideError.empty(); ++i) std::this_thread::sleep_for(1ms);
    EXPECT_NE(worker.status().asideError.find("too large"), std::string::npos);
    EXPECT_EQ(worker.status().error, "");
    const std::vector<AsideResult> failed = worker.takeAside();
    ASSERT_EQ(failed.size(), 1u);
    EXPECT_FALSE(failed[0].linear);
}

TEST(RenderWorker, AFailureIsToldAndTheNextStateIsTried) {
    RenderWorker worker(
        [] {
            return both([](const RenderInput& input, const RenderSettings& settings) {
                if (input.rig.exposure == 1) throw Error("device", "lost");
                return greyPicture(settings);
            });
        },
        [] {});
    worker.show(1, stateOf(1));
    for (int i = 0; i < 5000 && worker.status().error.empty(); ++i) std::this_thread::sleep_for(1ms);
    EXPECT_NE(worker.status().error.find("lost"), std::string::npos);
    worker.show(2, stateOf(0));
    const std::vector<WorkerResult> results = resultsUntil(worker, 2);
    ASSERT_FALSE(results.empty());
    EXPECT_EQ(worker.status().error, "");
}

}  // namespace
}  // namespace cutis::test
