// The command line that makes the picture in the viewer.
#include <charconv>

#include "app/viewer/actions.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace {

// As a shell reads it back.
std::string shellWord(const std::string& text) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
    if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return text;
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

// As short as reads back as the same.
std::string numberText(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// The rig's file when it holds the rig as it is, else a copy named by its content.
std::filesystem::path rigFileOf(const Session& session) {
    const Document& document = session.document();
    if (!document.rigFile.empty() && !session.edits.unsaved()) return document.rigFile;
    const std::string text = rigToJson(document.rig);
    const std::uint64_t hash = hashBytes(std::as_bytes(std::span(text)));
    const std::filesystem::path folder = cacheFolder();
    if (folder.empty()) throw Error("cannot name the rig", "save it first: there is no cache folder");
    char digits[17] = {};
    std::to_chars(digits, digits + 16, hash, 16);
    const std::filesystem::path file = folder / ("rig-" + std::string(digits) + ".rig.json");
    writeFileAtomically(file, text);
    return file;
}

}  // namespace

std::string commandLine(Session& session) {
    const Document& document = session.document();
    const Quality& quality = document.quality;
    const auto pixels = std::to_string(session.view.width) + 'x' + std::to_string(session.view.height);
    std::string line = "cutis render " + shellWord(document.scene) + " -o picture.png --size " + pixels;
    line += " --rig " + shellWord(rigFileOf(session).string());
    bool solo = false;
    for (std::size_t i = 0; i < document.solo.size(); ++i) {
        if (!document.solo[i]) continue;
        line += " --light " + shellWord(document.rig.lights[i].name);
        solo = true;
    }
    if (solo) line += " --env none";
    const View& view = document.view;
    line += " --camera " + shellWord(view.camera.empty() ? toSelector(view.orbit) : view.camera);
    if (session.request.animation) line += " --animation " + shellWord(*session.request.animation);
    if (session.request.time) line += " --time " + numberText(*session.request.time);
    if (session.request.skin) line += " --skin " + shellWord(*session.request.skin);
    const auto nameOf = [](const auto& names, auto value) {
        return std::string(names[static_cast<int>(value)]);
    };
    if (document.background != Background::none)
        line += " --background " + nameOf(kBackgroundNames, document.background);
    if (quality.tolerance > 0) {
        char digits[32];
        return line + " --tolerance " +
               std::string(digits, std::to_chars(digits, digits + 32, quality.tolerance).ptr);
    }
    if (quality.irradianceSize) line += " --irradiance-size " + std::to_string(quality.irradianceSize);
    if (quality.gaussians) line += " --gaussians " + std::to_string(quality.gaussians);
    if (quality.merge != Quality{}.merge) line += " --merge " + nameOf(kMergeNames, quality.merge);
    if (quality.chain != Quality{}.chain) line += " --chain " + nameOf(kChainNames, quality.chain);
    if (quality.taps != Quality{}.taps) line += " --taps " + std::to_string(quality.taps);
    return line;
}

void copyCommandLine(Session& session) {
    try {
        session.clipboard = commandLine(session);
        const bool ownSkin = session.scene && session.openedScene == session.document().scene &&
                             session.document().skin != session.loadedSkin;
        session.say(ownSkin ? "Copied; changes of skin are not in it, no option expresses them"
                            : "Copied: " + session.clipboard);
    } catch (const Error& error) {
        session.complain(error.what());
    }
}

}  // namespace cutis::app
