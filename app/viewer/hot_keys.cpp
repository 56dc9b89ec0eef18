#include "app/viewer/hot_keys.h"

#include <GLFW/glfw3.h>

#include "app/viewer/actions.h"
#include "app/viewer/comparing.h"

namespace cutis::app {
namespace {

void toggleSolo(Session& session) {
    if (!session.hasLight()) return;
    const auto index = static_cast<std::size_t>(session.selectedLight);
    session.edits.apply("Solo " + session.light().name,
                        [&](Document& document) { document.solo[index] = !document.solo[index]; });
}

void selectLight(Session& session, int step) {
    const int count = static_cast<int>(session.document().rig.lights.size());
    if (count) session.selectedLight = (session.selectedLight + step + count) % count;
}

void changeStops(Session& session, double stops) {
    editLight(session, "Intensity", [&](Light& light) { brighten(light, stops); });
}

void frame(Session& session, Framing framing) {
    editView(session, std::string("Frame ") + framingName(framing), [&](OrbitCamera& camera) {
        frameSubject(camera, *session.geometry, session.selectedCharacter, framing, session.aspect());
    });
}

void duplicate(Session& session) {
    if (!session.hasLight()) return;
    int copy = 0;
    session.edits.apply("Duplicate " + session.light().name,
                        [&](Document& document) { copy = duplicateLight(document, session.selectedLight); });
    session.selectedLight = copy;
}

void toggleCompare(Session& session, CompareMode mode) {
    session.compareMode = session.compareMode == mode ? CompareMode::off : mode;
}

constexpr int kCtrl = GLFW_MOD_CONTROL, kShift = GLFW_MOD_SHIFT;

constexpr HotKey kHotKeys[] = {
    {GLFW_KEY_F1, 0, "F1", "This help", [](Session& s) { s.showHelp = !s.showHelp; }},
    {GLFW_KEY_Z, kCtrl, "Ctrl+Z", "Undo", undo, true},
    {GLFW_KEY_Z, kCtrl | kShift, "Ctrl+Shift+Z", "Redo", redo, true},
    {GLFW_KEY_S, kCtrl, "Ctrl+S", "Save the rig", [](Session& s) { saveRig(s); }},
    {GLFW_KEY_S, kCtrl | kShift, "Ctrl+Shift+S", "Save the rig as",
     [](Session& s) { showDialog(s, Dialog::saveRig, s.document().rigFile.string()); }},
    {GLFW_KEY_O, kCtrl, "Ctrl+O", "Open a scene, rig or environment",
     [](Session& s) { showDialog(s, Dialog::open); }},
    {GLFW_KEY_P, kCtrl, "Ctrl+P", "Save the picture",
     [](Session& s) { showDialog(s, Dialog::savePicture, "picture.png"); }},
    {GLFW_KEY_E, kCtrl, "Ctrl+E", "Save the comparison of A and B",
     [](Session& s) { showDialog(s, Dialog::saveComparison, "comparison"); }},
    {GLFW_KEY_C, kCtrl | kShift, "Ctrl+Shift+C", "Copy the command line of this picture", copyCommandLine},
    {GLFW_KEY_Q, kCtrl, "Ctrl+Q", "Quit", quit},
    {GLFW_KEY_S, 0, "S", "Solo the chosen light", toggleSolo},
    {GLFW_KEY_M, 0, "M", "Mute the chosen light",
     [](Session& s) { editLight(s, "Mute", [](Light& light) { light.enabled = !light.enabled; }); }},
    {GLFW_KEY_UP, 0, "Up", "Choose the light above", [](Session& s) { selectLight(s, -1); }, true},
    {GLFW_KEY_DOWN, 0, "Down", "Choose the light below", [](Session& s) { selectLight(s, 1); }, true},
    {GLFW_KEY_D, kCtrl, "Ctrl+D", "Duplicate the chosen light", duplicate},
    {GLFW_KEY_RIGHT_BRACKET, 0, "]", "A third of a stop brighter",
     [](Session& s) { changeStops(s, 1 / 3.0); }, true},
    {GLFW_KEY_LEFT_BRACKET, 0, "[", "A third of a stop darker", [](Session& s) { changeStops(s, -1 / 3.0); },
     true},
    {GLFW_KEY_1, 0, "1", "Frame the face", [](Session& s) { frame(s, Framing::face); }},
    {GLFW_KEY_2, 0, "2", "Frame head and shoulders", [](Session& s) { frame(s, Framing::bust); }},
    {GLFW_KEY_3, 0, "3", "Frame the whole figure", [](Session& s) { frame(s, Framing::full); }},
    {GLFW_KEY_4, 0, "4", "Frame everyone", [](Session& s) { frame(s, Framing::group); }},
    {GLFW_KEY_A, 0, "A", "Store as A", [](Session& s) { storeCurrent(s, 0); }},
    {GLFW_KEY_B, 0, "B", "Store as B", [](Session& s) { storeCurrent(s, 1); }},
    {GLFW_KEY_W, 0, "W", "Compare by a wipe", [](Session& s) { toggleCompare(s, CompareMode::wipe); }},
    {GLFW_KEY_D, 0, "D", "Difference of A and B",
     [](Session& s) { toggleCompare(s, CompareMode::difference); }},
    {GLFW_KEY_X, 0, "X", "Light mixer", [](Session& s) { s.mixer.shown = !s.mixer.shown; }},
    {GLFW_KEY_SPACE, 0, "Space", "Play or pause the animation", [](Session& s) { s.playback.toggle(); }},
    {GLFW_KEY_RIGHT, 0, "Right", "The next frame", [](Session& s) { s.playback.step(1); }, true},
    {GLFW_KEY_LEFT, 0, "Left", "The frame before", [](Session& s) { s.playback.step(-1); }, true},
    {GLFW_KEY_HOME, 0, "Home", "To where the animation begins", [](Session& s) { s.playback.seek(0); }},
    {GLFW_KEY_T, 0, "T", "Time line", [](Session& s) { s.showTimeLine = !s.showTimeLine; }},
    {GLFW_KEY_L, 0, "L", "Place the chosen light by dragging",
     [](Session& s) { s.placing = s.placing ? std::nullopt : std::optional(PlaceBy::highlight); }},
    {GLFW_KEY_F5, 0, "F5", "Compile the shaders anew", [](Session& s) { s.reloadShaders = true; }},
    {GLFW_KEY_TAB, 0, "Tab", "Panels", [](Session& s) { s.showPanels = !s.showPanels; }},
    {GLFW_KEY_H, 0, "H", "Light handles", [](Session& s) { s.showHandles = !s.showHandles; }},
};

}  // namespace

std::span<const HotKey> hotKeys() {
    return kHotKeys;
}

void runHotKey(Session& session, const KeyPress& press, bool typing) {
    const int modifiers = press.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT);
    const bool function = press.key >= GLFW_KEY_F1 && press.key <= GLFW_KEY_F25;
    if (typing && !function && !(modifiers & GLFW_MOD_CONTROL)) return;
    // In a text field, undo and redo are the field's own.
    if (typing && press.key == GLFW_KEY_Z) return;
    for (const HotKey& row : kHotKeys)
        if (row.key == press.key && row.modifiers == modifiers && (row.repeats || !press.again)) {
            session.edits.endGesture();
            row.run(session);
            session.edits.endGesture();
            return;
        }
}

}  // namespace cutis::app
