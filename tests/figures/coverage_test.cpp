// What blended surfaces let through: a light map holds a surface at each texel or none, so partial cover is a pattern
// of both whose average is what arrives.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

struct Sheets {
    const char* name;
    std::vector<double> alphas;  // of sheets one behind the other
};

class Coverage : public ::testing::TestWithParam<Sheets> {};

// A plate under sheets of constant alpha and a light straight above: Π (1 - alpha) of it arrives, everywhere.
TEST_P(Coverage, BlendedSheetsPassWhatTheyDoNotCover) {
    SceneBuilder builder;
    builder.addObject("plate", makePlate(40 * kMm), builder.addSkin(SceneBuilder::plainSkin()));
    double passed = 1, height = 0.1;
    for (double alpha : GetParam().alphas) {
        Material sheet;
        sheet.name = "sheet", sheet.alphaMode = AlphaMode::blend, sheet.doubleSided = true;
        sheet.baseColor = {0.5f, 0.5f, 0.5f, static_cast<float>(alpha)};
        glm::dmat4 place(1);
        place[3] = {0, 0, height, 1};
        builder.addObject("sheet", makePlate(120 * kMm), builder.addMaterial(sheet), place);
        passed *= 1 - alpha;
        height += 0.02;
    }
    builder.setOrthographicCamera({0, 0, 0.05}, {0, 0, 0}, 0.02);
    RenderJob job{.scene = builder.scene(), .width = 64, .height = 64, .irradianceSize = 256};
    job.lights = {directionalLight("sun", {0, 0, -1}, 1)};
    job.aovs = {"irradiance"};
    const Rendered result = render(job);
    double sum = 0, spread = 0;
    const Picture& irradiance = result.aov("irradiance");
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double value = rgbAt(irradiance, x, y).g;
            sum += value / (64 * 64), spread += (value - passed) * (value - passed) / (64 * 64);
        }
    expectAtMost(std::string("mean behind ") + GetParam().name, std::abs(sum - passed), 0.01);
    expectAtMost(std::string("spread behind ") + GetParam().name, std::sqrt(spread), 0.15);
}

INSTANTIATE_TEST_SUITE_P(Sheets, Coverage,
                         ::testing::Values(Sheets{"quarter", {0.25}}, Sheets{"thin", {1.0 / 16}}, Sheets{"half", {0.5}},
                                           Sheets{"two halves", {0.5, 0.5}}, Sheets{"clear", {0}},
                                           Sheets{"full", {1}}),
                         [](const auto& sheets) {
                             std::string name = sheets.param.name;
                             std::erase(name, ' ');
                             return name;
                         });

}  // namespace
}  // namespace cutis::test
