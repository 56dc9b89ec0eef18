// The command line that makes the picture in the viewer.
#include <algorithm>
#include <charconv>

#include "app/viewer/actions.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/skin_file.h"

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

// A file in the cache folder with that text, named by its content: KIND-HASH.KIND.json.
std::filesystem::path cachedFile(const std::string& kind, const std::string& text) {
    const std::uint64_t hash = hashBytes(std::as_bytes(std::span(text)));
    const std::filesystem::path folder = cacheFolder();
    if (folder.empty()) throw Error("cannot name the " + kind, "save it first: there is no cache folder");
    char digits[17] = {};
    std::to_chars(digits, digits + 16, hash, 16);
    const std::filesystem::path file = folder / (kind + '-' + digits + '.' + kind + ".json");
    writeFileAtomically(file, text);
    return file;
}

// The rig's file when it holds the rig as it is, else a copy.
std::filesystem::path rigFileOf(const Session& session) {
    const Document& document = session.document();
    if (!document.rigFile.empty() && !session.edits.unsaved()) return document.rigFile;
    return cachedFile("rig", rigToJson(document.rig));
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
    if (session.posed.animation != kAtRest) {
        // By its number where other animations have the same name, or it has none.
        const auto& animations = session.geometry->animations;
        const std::string& name = animations[static_cast<std::size_t>(session.posed.animation)].name;
        const auto named = std::count_if(animations.begin(), animations.end(),
                                         [&](const Animation& animation) { return animation.name == name; });
        const bool byName = !name.empty() && named == 1;
        line += " --animation " + shellWord(byName ? name : std::to_string(session.posed.animation));
        line += " --time " + numberText(session.posed.seconds);
    }
    if (document.skin != session.loadedSkin && session.geometry) {
        const std::string text = skinFileText(document.skin, *session.geometry);
        line += " --skin " + shellWord(cachedFile("skin", text).string());
    } else if (session.request.skin && session.request.operands[0] == document.scene) {
        line += " --skin " + shellWord(*session.request.skin);
    }
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
        session.say("Copied: " + session.clipboard);
    } catch (const Error& error) {
        session.complain(error.what());
    }
}

}  // namespace cutis::app
