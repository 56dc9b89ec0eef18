// Controls under a mouse, without a window.
#include "app/viewer/panels/widgets.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace cutis::app {
namespace {

// The value of a field's row after a drag by so many pixels, ten a frame.
double dragged(const Field& field, double value, int pixels) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 600};
    io.Fonts->Build();
    float x = 300, y = 0;
    const auto frame = [&](bool down) {
        io.DeltaTime = 1 / 60.0f;
        io.MousePos = {x, y};
        io.MouseDown[0] = down;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({600, 200});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
        const float top = ImGui::GetCursorScreenPos().y;
        fieldRow(field, value);
        y = (top + ImGui::GetItemRectMax().y) / 2;
        ImGui::End();
        ImGui::EndFrame();
    };
    for (int i = 0; i < 3; ++i) frame(false);
    frame(true);
    for (int i = 0; i < pixels / 10; ++i) {
        x += 10;
        frame(true);
    }
    frame(false);
    ImGui::DestroyContext();
    return value;
}

// 60 pixels of half a percent and more are worth a fifth at least, whatever the range, and no more than
// a factor of four.
TEST(Widgets, DragsMoveFieldsOfManyDecades) {
    for (const Field* field :
         {&fields::kIntensity, &fields::kEnvironmentIntensity, &fields::kDistance, &fields::kScale,
          &fields::kDetailScale, &fields::kMmPerUnit, &fields::kVariance}) {
        const double before = 2, after = dragged(*field, before, 60);
        EXPECT_GT(after, 1.2 * before) << field->label;
        EXPECT_LT(after, 4 * before) << field->label;
    }
    EXPECT_GT(dragged(fields::kIntensity, 0, 60), 0) << "a light that is off can be dragged brighter";
}

}  // namespace
}  // namespace cutis::app
