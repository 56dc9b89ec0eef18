// Lighting as photographers name it, shown on the character at hand.
#include <imgui.h>

#include <cmath>

#include "app/viewer/actions.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/thumbnails.h"
#include "renderer/scene/presets.h"

namespace cutis::app {

void drawPresetPanel(Session& session) {
    requestPresetThumbnails(session);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - gap) / 2);
    for (std::size_t i = 0; i < presets().size(); ++i) {
        const Preset& preset = presets()[i];
        if (i % 2) ImGui::SameLine(0, gap);
        ImGui::BeginGroup();
        if (thumbnail(session, preset.name.c_str(), kPresetPictures + static_cast<int>(i), width,
                      width * kThumbnailHeight / kThumbnailWidth, session.document().rig.name == preset.name))
            openPreset(session, preset.name);
        hint(preset.summary.c_str());
        ImGui::TextDisabled("%s", preset.name.c_str());
        ImGui::EndGroup();
    }
}

}  // namespace cutis::app
