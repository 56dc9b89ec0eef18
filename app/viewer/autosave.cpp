#include "app/viewer/autosave.h"

#include <utility>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/skin_file.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

// A file while the program runs, and the same once it has ended without saving.
struct Kept {
    const char *running, *left;
};
constexpr Kept kRig{"autosave.rig.json", "recovered.rig.json"},
    kSkin{"autosave.skin.json", "recovered.skin.json"};
constexpr Kept kAll[] = {kRig, kSkin};

// Empty where there is no cache folder.
fs::path inCache(const char* name) {
    const fs::path folder = cacheFolder();
    return folder.empty() ? folder : folder / name;
}

bool isThere(const fs::path& file) {
    std::error_code error;
    return !file.empty() && fs::is_regular_file(file, error);
}

void removeFile(const fs::path& file) {
    std::error_code error;
    if (!file.empty()) fs::remove(file, error);
}

// True when there is nothing left to take.
template <class Take>
bool recover(Session& session, const Kept& kept, const Take& take) {
    const fs::path file = inCache(kept.left);
    if (!isThere(file)) return true;
    try {
        take(file);
    } catch (const Error& error) {
        session.complain(error.what());
        return false;
    }
    autosave(session);  // before its only copy goes
    removeFile(file);
    return true;
}

}  // namespace

void autosave(const Session& session) {
    if (cacheFolder().empty()) return;
    try {
        if (session.edits.unsaved()) {
            saveRig(session.document().rig, inCache(kRig.running));
        } else {
            removeFile(inCache(kRig.running));
        }
        if (session.skinUnsaved()) {
            writeFileAtomically(inCache(kSkin.running),
                                skinFileText(session.document().skin, *session.geometry));
        } else {
            removeFile(inCache(kSkin.running));
        }
    } catch (const Error&) {  // a full disk must not disturb the work
    }
}

void discardAutosave() {
    for (const Kept& kept : kAll) removeFile(inCache(kept.running));
}

bool keepAutosave() {
    bool any = false;
    for (const Kept& kept : kAll) {
        std::error_code error;
        if (isThere(inCache(kept.running))) fs::rename(inCache(kept.running), inCache(kept.left), error);
        any |= isThere(inCache(kept.left));
    }
    return any;
}

void recoverUnsaved(Session& session) {
    session.edits.endGesture();
    const bool rig = recover(session, kRig, [&](const fs::path& file) {
        const Rig left = loadRig(file);
        session.edits.apply("Recover rig",
                            [&](Document& document) { replaceRig(document, left, document.rigFile); });
    });
    session.edits.endGesture();
    const bool skin = recover(session, kSkin, [&](const fs::path& file) {
        if (!session.geometry) throw Error("cannot recover the skin", "there is no scene yet", file.string());
        const auto left = loadSkinFile(file, *session.geometry);
        session.edits.apply("Recover skin", [&](Document& document) { document.skin = left; });
    });
    session.edits.endGesture();
    session.recoverable = !rig || !skin;
    if (rig && skin) session.say("Recovered what was not saved");
}

}  // namespace cutis::app
