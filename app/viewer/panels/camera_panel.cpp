// The view: whom it frames, with which lens, how it is exposed.
#include <imgui.h>

#include "app/viewer/panels/panels.h"
#include "app/viewer/panels/widgets.h"

namespace cutis::app {
namespace {

void drawCameraChoice(Session& session) {
    const View& view = session.document().view;
    const auto& cameras = session.geometry->cameras;
    std::string shown = view.camera.empty() ? "by hand" : view.camera;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (view.camera == std::to_string(i) && !cameras[i].name.empty()) shown = cameras[i].name;
    label("Camera");
    const bool open = ImGui::BeginCombo("##camera", shown.c_str());
    if (!open) return optionHint("--camera");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::string index = std::to_string(i);
        const std::string name = cameras[i].name.empty() ? "camera " + index : cameras[i].name;
        if (ImGui::Selectable((name + "##" + index).c_str(), view.camera == index || view.camera == name))
            session.edits.apply("Camera " + name, [&](Document& document) { document.view.camera = index; });
    }
    if (ImGui::Selectable("auto", view.camera == "auto"))
        session.edits.apply("Camera auto", [](Document& document) { document.view.camera = "auto"; });
    hint("Framed on everyone's heads");
    ImGui::EndCombo();
}

void drawFraming(Session& session) {
    const auto& characters = session.geometry->characters;
    const auto nameOf = [&](int index) {
        return index < 0 ? std::string("everyone") : characters[static_cast<std::size_t>(index)].name;
    };
    label("Subject");
    if (ImGui::BeginCombo("##subject", nameOf(session.selectedCharacter).c_str())) {
        for (int i = -1; i < static_cast<int>(characters.size()); ++i)
            if (ImGui::Selectable((nameOf(i) + "##" + std::to_string(i)).c_str(),
                                  i == session.selectedCharacter))
                session.selectedCharacter = i;
        ImGui::EndCombo();
    }
    label("Frame");
    const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
    const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    for (const Framing framing : {Framing::face, Framing::bust, Framing::full, Framing::group}) {
        if (framing != Framing::face) ImGui::SameLine(0, gap);
        if (!ImGui::Button(framingName(framing), {width, 0})) continue;
        editView(session, std::string("Frame ") + framingName(framing), [&](OrbitCamera& camera) {
            frameSubject(camera, *session.geometry, session.selectedCharacter, framing, session.aspect());
        });
    }
    ImGui::PopStyleVar();
}

void drawLens(Session& session) {
    const Camera camera = currentCamera(session);
    if (camera.orthographic) {
        ImGui::TextDisabled("Parallel projection");
        return;
    }
    double degrees = glm::degrees(camera.yfov), millimetres = focalLength(camera.yfov);
    if (sliderRow("Field of view", degrees, 2, 100, "%.1f\xc2\xb0", true))
        editView(session, "Lens", [&](OrbitCamera& orbit) { orbit.yfov = glm::radians(degrees); });
    if (dragRow("Lens", millimetres, 0.5f, 10, 600, "%.0f mm"))
        editView(session, "Lens", [&](OrbitCamera& orbit) { orbit.yfov = fieldOfView(millimetres); });
    hint("Focal length that has this field of view on a full frame, 24 mm high");
}

}  // namespace

void drawCameraPanel(Session& session) {
    heading("Camera");
    drawCameraChoice(session);
    drawFraming(session);
    drawLens(session);
    double exposure = session.document().rig.exposure;
    if (fieldRow(fields::kExposure, exposure))
        session.edits.apply("Exposure", [&](Document& document) { document.rig.exposure = exposure; });
    Background background = session.document().background;
    if (enumRow("Background", "--background", background, kBackgroundNames))
        session.edits.apply("Background", [&](Document& document) { document.background = background; });
}

}  // namespace cutis::app
