// Which setting `render --tolerance` takes.
#include "renderer/measure/front.h"

#include <gtest/gtest.h>

#include "renderer/core/error.h"
#include "renderer/measure/report.h"

namespace cutis {
namespace {

Measurement row(const Setting& setting, double error, double milliseconds) {
    Measurement made{.setting = setting};
    made.diffuse.relativeL2 = error;
    made.gpu.median = milliseconds;
    return made;
}

std::string report(std::vector<Measurement> rows) {
    return reportJson(rows, {.device = "GPU", .width = 480, .height = 270});
}

TEST(Front, HoldsWhatAReportSays) {
    const Setting rich{.name = "rich",
                       .irradianceSize = 1024,
                       .gaussians = 4,
                       .lightMapSize = 512,
                       .areaSamples = 3,
                       .environmentSamples = 0,
                       .merge = "opposite",
                       .chain = "published",
                       .taps = 6};
    std::vector<Measurement> rows = {row({.name = "default"}, 0.07, 40), row(rich, 0.02, 90),
                                     row({.name = "many", .lights = 8}, 0.01, 1),
                                     row({.name = "broken"}, 0, 0)};
    rows[0].diffuse.relativeL2Error = 0.005;
    rows[3].failure = "out of memory";
    const MeasuredFront front = readFront(report(rows), "measure.json");
    EXPECT_EQ(front.device, "GPU");
    EXPECT_EQ(front.width, 480);
    EXPECT_EQ(front.height, 270);
    ASSERT_EQ(front.settings.size(), 2u) << "neither failures nor other subjects";
    EXPECT_EQ(front.settings[0].setting, Setting{.name = "default"});
    EXPECT_NEAR(front.settings[0].error, 0.08, 1e-9) << "with twice its standard error";
    EXPECT_EQ(front.settings[1].setting, rich);
    EXPECT_NEAR(front.settings[1].milliseconds, 90, 1e-9);
}

TEST(Front, CheapestIsTheFastestThatIsCloseEnough) {
    MeasuredFront front{.device = {}, .width = 1, .height = 1, .settings = {}};
    front.settings = {{{.name = "a"}, 0.02, 50}, {{.name = "b"}, 0.04, 10}, {{.name = "c"}, 0.03, 20}};
    EXPECT_EQ(cheapestWithin(front, 0.05)->setting.name, "b");
    EXPECT_EQ(cheapestWithin(front, 0.035)->setting.name, "c");
    EXPECT_EQ(cheapestWithin(front, 0.01), nullptr);
    EXPECT_EQ(closest(front)->setting.name, "a");
    EXPECT_EQ(closest({}), nullptr);
}

TEST(Front, SizesGrowWithThePictureAndNeverShrink) {
    const MeasuredFront front{.device = {}, .width = 480, .height = 270, .settings = {}};
    const Setting setting{.name = "a", .irradianceSize = 600, .lightMapSize = 512};
    const Setting larger = settingForSize(setting, front, 960, 540);
    EXPECT_EQ(larger.irradianceSize, 1200);
    EXPECT_EQ(larger.lightMapSize, 1024);
    EXPECT_EQ(settingForSize(setting, front, 48, 27), setting);
    const Setting automatic = settingForSize({.name = "default"}, front, 960, 540);
    EXPECT_EQ(automatic, Setting{.name = "default"});
}

TEST(Front, OfTheDefaultSceneOffersAChoice) {
    const MeasuredFront front = defaultFront();
    ASSERT_GE(front.settings.size(), 3u);
    for (std::size_t i = 1; i < front.settings.size(); ++i) {
        EXPECT_LT(front.settings[i].error, front.settings[i - 1].error) << "closer than any faster one";
        EXPECT_GT(front.settings[i].milliseconds, front.settings[i - 1].milliseconds);
    }
}

TEST(Front, RefusesWhatIsNoReport) {
    const auto says = [](const std::string& text, const char* part) {
        try {
            readFront(text, "measure.json");
            ADD_FAILURE() << "accepted: " << text;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    says("{", "not JSON");
    says(R"({"cutis_measure":2})", "cutis_measure");
    says(R"({"cutis_measure":1,"device":"x","width":0,"height":270,"settings":[]})", "width");
    std::string broken = report({row({.name = "a"}, 0.1, 1)});
    broken.replace(broken.find("\"auto\""), 6, "\"-5\"");
    says(broken, "settings[0]");
}

}  // namespace
}  // namespace cutis
