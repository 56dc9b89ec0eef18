#include "app/viewer/autosave.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <string>
#include <utility>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/skin_file.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

// What is kept, as the end of a file's name.
constexpr const char *kRig = ".rig.json", *kSkin = ".skin.json";
constexpr const char* kAll[] = {kRig, kSkin};
constexpr int kMostPrograms = 16;  // that run at once, each with files of its own

// Empty where there is no cache folder.
fs::path inCache(const std::string& name) {
    const fs::path folder = cacheFolder();
    return folder.empty() ? folder : folder / name;
}

// "autosave" of the first program, "autosave-2" of one that runs beside it.
std::string nameOf(int program) {
    return program == 0 ? "autosave" : "autosave-" + std::to_string(program + 1);
}

// That these files are some program's own, for as long as it runs, however it ends.
class Claim {
  public:
    // Of this program when it holds; else another one has it, or there is no cache folder.
    explicit Claim(const fs::path& file)
        : file_(file.empty() ? -1 : open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
        // A disk that knows no locks has one program, as far as anybody can tell.
        if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) release();
    }
    Claim(Claim&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    Claim& operator=(Claim&& other) noexcept {
        std::swap(file_, other.file_);
        return *this;
    }
    ~Claim() { release(); }
    bool holds() const { return file_ >= 0; }
    void release() {
        if (file_ >= 0) close(file_);
        file_ = -1;
    }

  private:
    int file_ = -1;
};

// This program's number, and its claim on it. Beyond kMostPrograms nothing is kept.
struct Own {
    Claim claim{fs::path()};
    int number = 0;
};

Own& own() {
    static Own all;
    return all;
}

fs::path runningFile(const char* kind) {
    return own().number < kMostPrograms ? inCache(nameOf(own().number) + kind) : fs::path();
}

fs::path lockFile(int program) {
    return inCache(nameOf(program) + ".lock");
}

fs::path leftFile(const char* kind) {
    return inCache(std::string("recovered") + kind);
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
bool recover(Session& session, const char* kind, const Take& take) {
    const fs::path file = leftFile(kind);
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
    if (runningFile(kRig).empty()) return;
    try {
        if (session.edits.unsaved()) {
            saveRig(session.document().rig, runningFile(kRig));
        } else {
            removeFile(runningFile(kRig));
        }
        if (session.skinUnsaved()) {
            writeFileAtomically(runningFile(kSkin), skinFileText(session.document().skin, *session.geometry));
        } else {
            removeFile(runningFile(kSkin));
        }
    } catch (const Error&) {  // a full disk must not disturb the work
    }
}

void discardAutosave() {
    for (const char* kind : kAll) removeFile(runningFile(kind));
}

bool findLeftBehind() {
    std::error_code error;
    for (int program = 0; program < kMostPrograms; ++program) {
        const auto running = [&](const char* kind) { return inCache(nameOf(program) + kind); };
        if (program == own().number || (!isThere(running(kRig)) && !isThere(running(kSkin)))) continue;
        if (!Claim(lockFile(program)).holds()) continue;
        for (const char* kind : kAll)
            if (isThere(running(kind))) fs::rename(running(kind), leftFile(kind), error);
    }
    return std::any_of(std::begin(kAll), std::end(kAll),
                       [](const char* kind) { return isThere(leftFile(kind)); });
}

bool keepAutosave() {
    own() = {};
    own().number = kMostPrograms;
    const bool left = findLeftBehind();
    for (int program = 0; program < kMostPrograms && !own().claim.holds(); ++program) {
        own().claim = Claim(lockFile(program));
        if (own().claim.holds()) own().number = program;
    }
    return left;
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
