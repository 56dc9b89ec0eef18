// Pictures on their way to disk.
#include <chrono>
#include <utility>

#include "app/output_files.h"
#include "app/viewer/actions.h"
#include "app/viewer/window.h"
#include "renderer/core/error.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

using Aovs = std::map<std::string, Picture>;

SaidOfSaving write(const fs::path& file, const Picture& picture, const Aovs& aovs, double exposure) {
    try {
        writePicture(file, picture, exposure);
        for (const auto& [name, values] : aovs) writeExr(aovFile(file, name), values);
    } catch (const std::exception& error) {
        return {error.what(), true};
    }
    return {"The picture is saved: " + file.string(), false};
}

void startWriting(Session& session, Aovs aovs) {
    SavedPicture& saved = session.saving;
    session.writing =
        std::async(std::launch::async, [saved = std::exchange(saved, {}), aovs = std::move(aovs)] {
            SaidOfSaving said = write(saved.file, *saved.picture, aovs, saved.exposure);
            Window::wake();
            return said;
        });
}

// Data channels are rendered for this picture alone.
void requestAovs(Session& session) {
    try {
        AsideJob job{kSavedPicture, stateFor(session, session.document())};
        job.state.settings.aovs.assign(std::begin(kAovNames), std::end(kAovNames));
        session.asideJobs.push_back(std::move(job));
    } catch (const Error& error) {
        session.saving = {};
        session.complain(error.what());
    }
}

}  // namespace

void savePicture(Session& session, const fs::path& file) {
    const std::string extension = lowercaseExtension(file);
    if (extension != ".png" && extension != ".exr") {
        session.complain("A picture's name must end in .png or .exr");
        return;
    }
    session.saving = {fs::absolute(file), session.saveAovs, nullptr, 0};
    session.announce("Saves " + file.string() + " when the full picture is there");
    continueSaving(session);
}

void continueSaving(Session& session) {
    using namespace std::chrono_literals;
    if (session.writing.valid() && session.writing.wait_for(0s) == std::future_status::ready) {
        const SaidOfSaving said = session.writing.get();
        said.failed ? session.complain(said.text) : session.say(said.text);
    }
    SavedPicture& saving = session.saving;
    if (saving.file.empty() || saving.picture || session.writing.valid() || !session.complete()) return;
    saving.picture = session.picture->composed;
    saving.exposure = session.document().rig.exposure;
    saving.aovs ? requestAovs(session) : startWriting(session, {});
}

void takeAovs(Session& session, AsideResult result) {
    if (!session.saving.picture) return;
    if (result.linear) return startWriting(session, std::move(result.aovs));
    session.saving = {};
    session.complain("The data channels could not be rendered: the picture is not saved");
}

}  // namespace cutis::app
