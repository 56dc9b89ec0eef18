// The light mixer: every light's own picture with a fader, like the channels of a mixing desk.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/mixing.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/style.h"

namespace cutis::app {
namespace {

// Stops against how the light was when its picture was taken.
double stopsOf(const Session& session, std::size_t index) {
    const Contribution& own = session.mixer.contributions[index];
    const Document& document = session.document();
    const double now =
        own.ofEnvironment ? document.rig.environment.intensity : document.rig.lights[index].intensity;
    const double then = own.ofEnvironment ? own.environment.intensity : own.light.intensity;
    return now > 0 ? std::log2(now / then) : -10;
}

void setStops(Session& session, std::size_t index, double stops) {
    const Contribution own = session.mixer.contributions[index];
    session.edits.apply(
        "Mix " + (own.ofEnvironment ? std::string("environment") : own.light.name), [&](Document& document) {
            if (own.ofEnvironment) {
                document.rig.environment.intensity = own.environment.intensity * std::exp2(stops);
            } else {
                document.rig.lights[index].intensity = own.light.intensity * std::exp2(stops);
            }
        });
}

void drawSwitches(Session& session, std::size_t index) {
    const Document& document = session.document();
    if (session.mixer.contributions[index].ofEnvironment) {
        const bool on = document.rig.environment.enabled;
        if (toggleButton("M", !on, IM_COL32(150, 150, 155, 255)))
            session.edits.apply("Mute environment", [&](Document& d) { d.rig.environment.enabled = !on; });
        return;
    }
    const bool solo = document.solo[index], on = document.rig.lights[index].enabled;
    if (toggleButton("S", solo, accentColor()))
        session.edits.apply("Solo", [&](Document& d) { d.solo[index] = !solo; });
    ImGui::SameLine();
    if (toggleButton("M", !on, IM_COL32(150, 150, 155, 255)))
        session.edits.apply("Mute", [&](Document& d) { d.rig.lights[index].enabled = !on; });
}

void drawChannel(Session& session, std::size_t index, float width, float height) {
    const bool ofEnvironment = session.mixer.contributions[index].ofEnvironment;
    ImGui::PushID(static_cast<int>(index));
    ImGui::BeginGroup();
    const bool chosen = !ofEnvironment && session.selectedLight == static_cast<int>(index);
    if (thumbnail(session, "own", kLightPictures + static_cast<int>(index), width, height, chosen) &&
        !ofEnvironment)
        session.selectedLight = static_cast<int>(index);
    const std::string name = ofEnvironment ? "environment" : session.document().rig.lights[index].name;
    shortText(name, false, width);
    double stops = stopsOf(session, index);
    constexpr double kLow = -6, kHigh = 4;
    ImGui::SetNextItemWidth(width);
    if (ImGui::SliderScalar("##stops", ImGuiDataType_Double, &stops, &kLow, &kHigh, "%+.1f stops",
                            ImGuiSliderFlags_AlwaysClamp))
        setStops(session, index, stops);
    drawSwitches(session, index);
    ImGui::EndGroup();
    ImGui::PopID();
}

}  // namespace

void drawMixerStrip(Session& session, const PixelRect& where) {
    ImGui::SetNextWindowPos({float(where.x), float(where.y)});
    ImGui::SetNextWindowSize({float(where.width), float(where.height)});
    ImGui::Begin("##mixer", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_NoBringToFrontOnFocus);
    const std::size_t count = session.mixer.contributions.size();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float gap = 2 * style.ItemSpacing.x, aspect = static_cast<float>(session.aspect());
    const float controls = 3 * ImGui::GetFrameHeightWithSpacing() + style.ScrollbarSize;
    // As high as the strip allows, as wide as all channels find room, and never too narrow for their
    // controls.
    const float high = std::max(float(where.height) - controls - 2 * style.WindowPadding.y, 20.0f);
    const float share =
        (ImGui::GetContentRegionAvail().x + gap) / static_cast<float>(std::max<std::size_t>(count, 1)) - gap;
    const float width = std::floor(std::max(std::min(high * aspect, share), ImGui::GetFontSize() * 6.5f));
    for (std::size_t i = 0; i < count && i < session.mixer.contributions.size(); ++i) {
        if (i) ImGui::SameLine(0, gap);
        drawChannel(session, i, width, std::min(width / aspect, high));
    }
    if (count == 0) ImGui::TextDisabled("Each light's own picture is rendered once the view's is complete.");
    ImGui::End();
}

}  // namespace cutis::app
