#include "app/viewer/actions.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <new>
#include <utility>

#include "app/inputs.h"
#include "app/viewer/autosave.h"
#include "app/viewer/window.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/environment_sun.h"
#include "renderer/scene/presets.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/skin_file.h"

namespace cutis::app {
namespace fs = std::filesystem;

std::string lowercaseExtension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

namespace {

// Runs what may throw Error for something that the user gave.
template <class Function>
bool attempt(Session& session, const Function& function) {
    try {
        function();
        return true;
    } catch (const Error& error) {
        session.complain(error.what());
    } catch (const std::bad_alloc&) {
        session.complain("out of memory: the file is too large for this machine");
    }
    return false;
}

void startNextTask(Session& session) {
    if (session.task.valid() || session.nextTasks.empty()) return;
    session.task = std::async(std::launch::async, [work = std::move(session.nextTasks.front())] {
        std::function<void(Session&)> end = work();
        Window::wake();
        return end;
    });
    session.nextTasks.pop_front();
}

// The interface waits for none: what was begun before comes first.
void startTask(Session& session, std::function<std::function<void(Session&)>()> work) {
    session.nextTasks.push_back(std::move(work));
    startNextTask(session);
}

// A rig from a file with its environment's name made absolute.
Rig loadWholeRig(const fs::path& file) {
    Rig rig = loadRig(file);
    if (!rig.environment.file.empty())
        rig.environment.file =
            fs::absolute(file.parent_path() / rig.environment.file).lexically_normal().string();
    return rig;
}

}  // namespace

void openFile(Session& session, const fs::path& file) {
    const std::string extension = lowercaseExtension(file);
    if (extension == ".gltf" || extension == ".glb") return openScene(session, file.string());
    if (file.string().ends_with(".skin.json")) return openSkin(session, file);
    if (extension == ".json") return openRig(session, file);
    openEnvironment(session, file);
}

void whenSaved(Session& session, std::function<void(Session&)> act) {
    if (!session.edits.unsaved() && !session.skinUnsaved()) return act(session);
    session.afterSaving = std::move(act);
    showDialog(session, Dialog::unsaved);
}

namespace {

void startOpening(Session& session, const std::string& scene) {
    Request request;
    request.operands = {scene};
    request.settings = session.request.settings;
    const Quality& quality = session.document().quality;
    request.settings.irradianceSize = quality.irradianceSize;
    request.settings.gaussians = quality.gaussians;
    request.settings.merge = quality.merge;
    request.settings.chain = quality.chain;
    request.settings.taps = quality.taps;
    request.background = session.document().background;
    session.opening = request;
}

}  // namespace

void openScene(Session& session, const std::string& scene) {
    whenSaved(session, [scene](Session& s) { startOpening(s, scene); });
}

void openRig(Session& session, const fs::path& file) {
    attempt(session, [&] {
        const Rig rig = loadWholeRig(file);
        whenSaved(session, [rig, file](Session& s) {
            s.edits.endGesture();
            s.edits.apply("Open rig " + file.filename().string(), [&](Document& document) {
                replaceRig(document, rig, fs::absolute(file).lexically_normal());
            });
            s.edits.markSaved();
            rememberFile(s, file);
            s.say("Opened " + file.string());
        });
    });
}

void openSkin(Session& session, const fs::path& file) {
    attempt(session, [&] {
        if (!session.geometry) throw Error("cannot open skin", "there is no scene yet", file.string());
        const auto skin = loadSkinFile(file, *session.geometry);
        session.edits.endGesture();
        session.edits.apply("Open skin " + file.filename().string(),
                            [&](Document& document) { document.skin = skin; });
        session.savedSkin = skin;
        rememberFile(session, file);
        session.say("Opened " + file.string());
    });
}

void openPreset(Session& session, const std::string& name) {
    attempt(session, [&] {
        Rig rig = presetRig(name);
        session.edits.endGesture();
        session.edits.apply("Preset " + name, [&](Document& document) {
            rig.environment = document.rig.environment;  // a preset has lights only
            replaceRig(document, rig, {});
        });
    });
}

void openEnvironment(Session& session, const fs::path& file) {
    // Refuses what is no environment before it becomes part of the document.
    startTask(session, [file]() -> std::function<void(Session&)> {
        loadEnvironment(file);
        return [file](Session& s) {
            s.edits.endGesture();
            s.edits.apply("Environment " + file.filename().string(), [&](Document& document) {
                EnvironmentSettings& environment = document.rig.environment;
                environment.file = fs::absolute(file).lexically_normal().string();
                environment.enabled = true;
                environment.sunRemoved = false;
            });
            s.edits.endGesture();
            rememberFile(s, file);
        };
    });
}

void takeSun(Session& session) {
    const EnvironmentSettings& settings = session.document().rig.environment;
    if (settings.file.empty() || settings.sunRemoved) return;
    session.announce("Looks for the sun ...");
    startTask(session, [settings]() -> std::function<void(Session&)> {
        const std::optional<EnvironmentSun> sun = findSun(loadEnvironment(settings.file, false));
        if (!sun) return [](Session& s) { s.say("Nothing stands out in this environment like a sun"); };
        return [light = sunLight(*sun, settings), settings](Session& s) {
            if (s.document().rig.environment != settings)
                return s.say("The environment has changed meanwhile");
            s.edits.endGesture();
            s.edits.apply("Take the sun out",
                          [&](Document& document) { s.selectedLight = takeSunOut(document, light); });
            s.edits.endGesture();
            s.say("The sun is a light of the rig now; the environment shines without it");
        };
    });
}

void continueTask(Session& session) {
    using namespace std::chrono_literals;
    if (!session.task.valid() || session.task.wait_for(0s) != std::future_status::ready) return;
    attempt(session, [&] { session.task.get()(session); });
    startNextTask(session);
}

bool saveRig(Session& session) {
    const fs::path file = session.document().rigFile;
    if (!file.empty()) return saveRigAs(session, file);
    showDialog(session, Dialog::saveRig, "untitled.rig.json");
    return false;
}

bool saveRigAs(Session& session, const fs::path& file) {
    const std::function<void(Session&)> after = std::exchange(session.afterSaving, nullptr);
    const bool saved = attempt(session, [&] {
        const fs::path whole = fs::absolute(file).lexically_normal();
        cutis::saveRig(rigForFile(session.document().rig, whole), whole);
        if (session.document().rigFile != whole) {
            session.edits.endGesture();
            session.edits.apply("Save as " + whole.filename().string(),
                                [&](Document& document) { document.rigFile = whole; });
            session.edits.endGesture();
        }
        session.edits.markSaved();
        autosave(session);
        rememberFile(session, whole);
        session.say("Saved " + whole.string());
    });
    if (saved && after) {
        session.afterSaving = after;
        saveNext(session);
    }
    return saved;
}

bool saveSkinAs(Session& session, const fs::path& file) {
    const std::function<void(Session&)> after = std::exchange(session.afterSaving, nullptr);
    const bool saved = attempt(session, [&] {
        if (!session.geometry) throw Error("cannot save skin", "there is no scene yet", file.string());
        writeFileAtomically(file, skinFileText(session.document().skin, *session.geometry));
        session.savedSkin = session.document().skin;
        autosave(session);
        rememberFile(session, file);
        session.say("Saved " + file.string());
    });
    if (saved && after) after(session);
    return saved;
}

void saveNext(Session& session) {
    if (session.edits.unsaved()) {
        saveRig(session);
    } else if (session.skinUnsaved()) {
        showDialog(session, Dialog::saveSkin, "untitled.skin.json");
    } else if (session.afterSaving) {
        std::exchange(session.afterSaving, nullptr)(session);
    }
}

void quit(Session& session) {
    whenSaved(session, [](Session& s) {
        s.quit = !s.saves() || s.quitsWhenSaved == s.edits.version();
        if (s.quit) return;
        s.quitsWhenSaved = s.edits.version();
        s.announce("Ends when the picture is saved; quit once more to end at once, without it");
    });
}

void continueQuitting(Session& session) {
    if (!session.quitsWhenSaved || session.saves()) return;
    session.quit = *std::exchange(session.quitsWhenSaved, std::nullopt) == session.edits.version();
}

namespace {

// The chosen light stays the chosen one where undo or redo puts the lights into another order.
template <class Step>
void keepChosen(Session& session, const Step& step) {
    const std::size_t count = session.document().rig.lights.size();
    const std::string name = session.hasLight() ? session.light().name : "";
    step();
    const std::vector<Light>& lights = session.document().rig.lights;
    if (name.empty() || lights.size() != count || session.light().name == name) return;
    const auto there =
        std::find_if(lights.begin(), lights.end(), [&](const Light& light) { return light.name == name; });
    if (there != lights.end()) session.selectedLight = static_cast<int>(there - lights.begin());
}

}  // namespace

void undo(Session& session) {
    const std::string label = session.edits.undoLabel();
    keepChosen(session, [&] { session.edits.undo(); });
    session.say(label.empty() ? "Nothing to undo" : "Undone: " + label);
}

void redo(Session& session) {
    const std::string label = session.edits.redoLabel();
    keepChosen(session, [&] { session.edits.redo(); });
    session.say(label.empty() ? "Nothing to redo" : "Redone: " + label);
}

void showDialog(Session& session, Dialog dialog, const std::string& path) {
    session.dialog = dialog;
    session.dialogOpens = true;
    session.dialogPath = path;
}

}  // namespace cutis::app
