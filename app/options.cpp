#include "app/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "app/frame_files.h"
#include "app/usage_error.h"
#include "renderer/core/suggest.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/fields.h"
#include "renderer/scene/presets.h"

namespace cutis::app {
namespace {

constexpr int kMaxSide = 16384;                  // pixels
constexpr std::int64_t kMaxPixels = 1 << 26;     // 1 GiB as float RGBA
constexpr int kMinAtlas = 1, kMaxAtlas = 16384;  // texels
constexpr int kMaxGaussians = 32, kMaxTaps = 64;
constexpr double kMaxSeconds = 3.6e6;
constexpr unsigned kPicture = kRender | kReference;  // the same picture in two ways: the same options
constexpr unsigned kView = kPicture | kPlan | kCompare | kMeasure | kViewer;  // whatever shows a scene
constexpr int kMaxRepeats = 1000;
constexpr int kMaxFrame = 999999;
constexpr double kMinFps = 0.001, kMaxFps = 1000;
constexpr double kMinUiScale = 0.5, kMaxUiScale = 4;

[[noreturn]] void refuse(const std::string& text, const std::string& must) {
    throw UsageError("is '" + text + "', it must be " + must);
}

std::string plain(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

double parseNumber(const std::string& text, double min, double max) {
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* last = text.data() + text.size();
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    const bool number = error == std::errc() && end == last && std::isfinite(value);
    if (!number || value < min || value > max)
        refuse(text, "a number from " + plain(min) + " to " + plain(max));
    return value;
}

std::int64_t parseInteger(const std::string& text, std::int64_t min, std::int64_t max) {
    std::int64_t value = 0;
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc() || end != last || value < min || value > max)
        refuse(text, "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
    return value;
}

double parseField(const std::string& text, const Field& field) {
    return parseNumber(text, field.min, field.max);
}

std::string helpOf(const Field& field) {
    return field.help;
}

// An enumerator by its name; `names` in the order of the enumeration.
template <class Enum, std::size_t kCount>
Enum parseChoice(const std::string& text, const char* const (&names)[kCount]) {
    std::string must;
    for (std::size_t i = 0; i < kCount; ++i) {
        if (text == names[i]) return static_cast<Enum>(i);
        must += (i == 0 ? "" : i + 1 == kCount ? " or " : ", ") + std::string(names[i]);
    }
    refuse(text, must);
}

std::string parseText(const std::string& text) {
    if (text.empty()) throw UsageError("is empty");
    return text;
}

void parseSize(Request& request, const std::string& text) {
    const std::string must = "WIDTHxHEIGHT, each from 1 to " + std::to_string(kMaxSide) + ", as in 1280x720";
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) refuse(text, must);
    try {
        request.settings.width = static_cast<int>(parseInteger(text.substr(0, cross), 1, kMaxSide));
        request.settings.height = static_cast<int>(parseInteger(text.substr(cross + 1), 1, kMaxSide));
    } catch (const UsageError&) {
        refuse(text, must);
    }
    if (std::int64_t(request.settings.width) * request.settings.height > kMaxPixels)
        refuse(text, "at most " + std::to_string(kMaxPixels) + " pixels");
}

// "1-48", or one frame.
void parseFrames(Request& request, const std::string& text) {
    const std::string must = "A-B, two frames from 0 to " + std::to_string(kMaxFrame) + " in order, as in 1-48";
    const std::size_t dash = text.find('-');
    Request::FrameRange range;
    try {
        range.first = static_cast<int>(parseInteger(text.substr(0, dash), 0, kMaxFrame));
        range.last = dash == text.npos ? range.first
                                       : static_cast<int>(parseInteger(text.substr(dash + 1), 0, kMaxFrame));
    } catch (const UsageError&) {
        refuse(text, must);
    }
    if (range.last < range.first) refuse(text, must);
    request.frames = range;
}

void parseAovs(Request& request, const std::string& text, std::span<const char* const> names) {
    const std::vector<std::string> known(names.begin(), names.end());
    std::vector<std::string>& aovs = request.settings.aovs;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t comma = std::min(text.find(',', start), text.size());
        const std::string name = text.substr(start, comma - start);
        start = comma + 1;
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            std::string list;
            for (const std::string& aov : known) list += (list.empty() ? "" : ", ") + aov;
            throw UsageError("has no '" + name + "'" + didYouMean(name, known) + ": there are " + list);
        }
        if (std::find(aovs.begin(), aovs.end(), name) != aovs.end())
            throw UsageError("names '" + name + "' twice");
        aovs.push_back(name);
    }
}

bool endsIn(const std::filesystem::path& path, const std::string& extension) {
    std::string own = path.extension().string();
    std::transform(own.begin(), own.end(), own.begin(), [](unsigned char c) { return std::tolower(c); });
    return own == extension;
}

// Adds an output whose extension is one of those; the same file twice is a mistake.
void addOutput(Request& request, const std::string& text, const std::vector<std::string>& extensions) {
    const std::filesystem::path path = parseText(text);
    const bool known = std::any_of(extensions.begin(), extensions.end(),
                                   [&](const std::string& extension) { return endsIn(path, extension); });
    if (!known) {
        std::string list;
        for (const std::string& extension : extensions) list += (list.empty() ? "" : " or ") + extension;
        refuse(text, "a file name ending in " + list);
    }
    for (const std::filesystem::path& other : request.outputs)
        if (other.lexically_normal() == path.lexically_normal())
            throw UsageError("names '" + text + "' twice");
    request.outputs.push_back(path);
}

std::string listOf(std::span<const char* const> names) {
    std::string list;
    for (const char* name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

// "0.2%" or "0.002".
double parseShare(const std::string& text) {
    const bool percent = text.ends_with('%');
    const auto share = [&] { return parseNumber(percent ? text.substr(0, text.size() - 1) : text, 0, 100); };
    try {
        const double value = percent ? share() / 100 : share();
        if (value > 0 && value <= 1) return value;
    } catch (const UsageError&) {
    }
    refuse(text, "a share above 0 and up to 1, as in 0.2% or 0.002");
}

// Seconds of "60s", "5m", "1.5h" or "60".
double parseDuration(const std::string& text) {
    double unit = 1;
    std::string number = text;
    if (!text.empty() && std::string("smh").find(text.back()) != std::string::npos) {
        unit = text.back() == 'h' ? 3600 : text.back() == 'm' ? 60 : 1;
        number.pop_back();
    }
    try {
        const double value = parseNumber(number, 0, kMaxSeconds) * unit;
        if (value > 0 && value <= kMaxSeconds) return value;
    } catch (const UsageError&) {
    }
    refuse(text, "a time of up to 1000 hours, as in 60s, 5m or 1h");
}

std::vector<Option> makeOptions() {
    const char* const output = "Output";
    const char* const light = "Light";
    const char* const view = "View";
    const char* const quality = "Skin and quality";
    return {
        {"-o, --output", "FILE", kPicture, output,
         "The picture: .exr is scene-linear float radiance with coverage as alpha, .png is exposed, tone "
         "mapped and "
         "sRGB. Repeat it for both in one run",
         true,
         [](Request& r, const std::string& text) {
             addOutput(r, text, {".exr", ".png"});
         }},
        {"-o, --output", "FILE", kRigExport, output,
         "The result: .glb holds the lights as KHR_lights_punctual, .json is a rig file", false,
         [](Request& r, const std::string& text) {
             addOutput(r, text, {".glb", ".json"});
         }},
        {"-o, --output", "FILE", kSkinExport, output,
         "The copy: .glb or .gltf as the scene is, beside it where the scene refers to other files", false,
         [](Request& r, const std::string& text) {
             addOutput(r, text, {".glb", ".gltf"});
         }},
        {"--aov", "LIST", kRender, output,
         "Also write OUT.NAME.exr beside the first output for each name of this comma-separated list: " +
             listOf(kAovNames),
         false, [](Request& r, const std::string& text) { parseAovs(r, text, kAovNames); }},
        {"--aov", "LIST", kReference, output,
         "Also write OUT.NAME.exr beside the first output for each name of this comma-separated list: " +
             listOf(reference::kAovNames),
         false, [](Request& r, const std::string& text) { parseAovs(r, text, reference::kAovNames); }},
        {"--halves", "", kReference, output,
         "Also write two estimates that share no random number, OUT.a.exr and OUT.b.exr, and "
         "OUT.a.diffuse.exr and "
         "OUT.b.diffuse.exr: what makes an error estimate unbiased",
         false, [](Request& r, const std::string&) { r.halves = true; }},
        {"--stats", "FILE", kPicture, output,
         "Write what ran, what was left out and why, times and bytes as JSON", false,
         [](Request& r, const std::string& text) { r.stats = parseText(text); }},
        {"--exposure", "EV", kView & ~kViewer, output,
         helpOf(fields::kExposure) + ", added to the rig's; for .png only (default: 0)", false,
         [](Request& r, const std::string& text) { r.exposure = parseField(text, fields::kExposure); }},
        {"-o, --output", "DIR", kCompare | kMeasure, output,
         "The folder of the report: a new one, or one that holds an earlier report", false,
         [](Request& r, const std::string& text) { r.outputs.push_back(parseText(text)); }},
        {"--size", "WxH", kPicture | kPlan | kCompare, output, "Pixels of the picture (default: 1280x720)",
         false, parseSize},
        {"--json", "", kPlan, output, "As JSON: the keys of --stats of cutis render, then all rows", false,
         [](Request& r, const std::string&) { r.json = true; }},
        {"--measure", "", kPlan, output, "Draw the picture a few times and give the median time of each row",
         false, [](Request& r, const std::string&) { r.measure = true; }},
        {"--size", "WxH", kViewer, "Window", "Pixels of the window (default: 1280x720)", false, parseSize},
        {"--ui-scale", "X", kViewer, "Window",
         "Size of text and controls: 1 is 100 %, 2 is 200 % (default: what the desktop asks for)", false,
         [](Request& r, const std::string& text) {
             r.uiScale = parseNumber(text, kMinUiScale, kMaxUiScale);
         }},
        {"--stats", "FILE", kViewer, "Window",
         "When the window closes, write how long frames took, and how long pictures took to follow edits",
         false, [](Request& r, const std::string& text) { r.stats = parseText(text); }},
        {"--size", "WxH", kMeasure, output, "Pixels of the pictures that are compared (default: 480x270)",
         false,
         [](Request& r, const std::string& text) {
             parseSize(r, text);
             r.measureSize = {r.settings.width, r.settings.height};
         }},

        {"--a", "RIG", kCompare, light,
         "The first rig of two, in place of each light alone: as --rig takes it", false,
         [](Request& r, const std::string& text) { r.rigA = parseText(text); }},
        {"--b", "RIG", kCompare, light, "The second rig", false,
         [](Request& r, const std::string& text) { r.rigB = parseText(text); }},

        {"--sweep", "SWEEP", kMeasure, "Accuracy",
         "The settings to try: quality, lights (1 to 64), characters (1 to 16), size (of the atlas, 256 to "
         "8192), stability (stiff and extreme cases: is each finite, does it keep its energy, how far is it "
         "off), or a "
         "JSON file of settings (default: quality)",
         false, [](Request& r, const std::string& text) { r.sweep = parseText(text); }},
        {"--repeats", "N", kMeasure, "Accuracy",
         "Timed runs of each setting, after one that warms up (default: 3)", false,
         [](Request& r, const std::string& text) {
             r.repeats = static_cast<int>(parseInteger(text, 1, kMaxRepeats));
         }},
        {"--tolerance", "E", kMeasure, "Accuracy",
         "Name the cheapest setting whose error of diffuse light is below this: 1% or 0.01", false,
         [](Request& r, const std::string& text) { r.tolerance = parseShare(text); }},

        {"--tolerance", "E", kRender, "Accuracy",
         "Take the cheapest setting whose error of diffuse light is below this, 1% or 0.01, by the last "
         "cutis measure "
         "of this scene on this device, else by that of the default scene",
         false, [](Request& r, const std::string& text) { r.tolerance = parseShare(text); }},

        {"--error", "E", kReference | kMeasure, "Accuracy",
         "Stop when the standard error of the picture and that of its diffuse light are below this, relative "
         "to them: "
         "0.2% or 0.002 (default: 0.5% without --budget, none with it)",
         false, [](Request& r, const std::string& text) { r.error = parseShare(text); }},
        {"--budget", "TIME", kReference | kMeasure, "Accuracy",
         "Stop after this much work, at two passes over the picture at the earliest: 60s, 5m or 1h", false,
         [](Request& r, const std::string& text) { r.budget = parseDuration(text); }},

        {"--rig", "RIG", kView, light,
         "The lights: a rig file, a preset (see cutis rig list), 'scene' for the scene's own, or 'none'. "
         "Default: the "
         "scene's own lights if it has any, else NAME.rig.json beside the scene NAME.gltf, else three-point",
         false, [](Request& r, const std::string& text) { r.rig = parseText(text); }},
        {"--light", "NAME", kView, light,
         "Only this light of the rig, switched on even where the rig has it off. Repeat it for several", true,
         [](Request& r, const std::string& text) { r.lights.push_back(parseText(text)); }},
        {"--env", "FILE", kView, light,
         "A lat-long environment (.exr, .hdr, …) in place of the rig's, or 'none'", false,
         [](Request& r, const std::string& text) { r.environment = parseText(text); }},
        {"--env-intensity", "X", kView, light,
         helpOf(fields::kEnvironmentIntensity) + ", in place of the rig's", false,
         [](Request& r, const std::string& text) {
             r.environmentIntensity = parseField(text, fields::kEnvironmentIntensity);
         }},
        {"--env-rotation", "DEG", kView, light, helpOf(fields::kRotation) + ", in place of the rig's", false,
         [](Request& r, const std::string& text) {
             r.environmentRotation = parseField(text, fields::kRotation);
         }},
        {"--exposure", "EV", kViewer, view, helpOf(fields::kExposure) + ", added to the rig's (default: 0)",
         false,
         [](Request& r, const std::string& text) { r.exposure = parseField(text, fields::kExposure); }},
        {"--background", "NAME", kRender | kViewer, view,
         "What lies behind the scene: none, env, the environment, or blurred. Alpha stays the coverage "
         "(default: none)",
         false,
         [](Request& r, const std::string& text) {
             r.background = parseChoice<Background>(text, kBackgroundNames);
         }},

        {"--camera", "CAMERA", kView, view,
         "A camera's name or index, 'auto', 'auto:AZ,EL': framed on the heads from that azimuth and "
         "elevation in "
         "degrees, or 'orbit:X,Y,Z,AZ,EL,DISTANCE,FOV': looking at a point in metres from these angles "
         "(default: the "
         "first camera of the scene, else auto)",
         false, [](Request& r, const std::string& text) { r.camera = parseText(text); }},

        {"--animation", "ANIMATION", kView, view,
         "The pose of this animation of the scene, by its name or its number from 0 (default: with --time or "
         "--frames the "
         "first, else the scene rests)",
         false, [](Request& r, const std::string& text) { r.animation = parseText(text); }},
        {"--time", "S", kView, view, "Seconds from where the animation begins (default: 0)", false,
         [](Request& r, const std::string& text) { r.time = parseNumber(text, 0, kMaxSeconds); }},
        {"--frames", "A-B", kRender, view,
         "Pictures of these frames of the animation, one a file: -o OUT.%04d.png puts the frame's number "
         "there",
         false, parseFrames},
        {"--fps", "N", kRender, view, "Frames a second: frame F shows the time F / N (default: 24)", false,
         [](Request& r, const std::string& text) { r.fps = parseNumber(text, kMinFps, kMaxFps); }},

        {"--skin", "GLOB", kView | kSkinExport, quality,
         "Materials whose names match are skin, or 'none', or a file that ends in .json says so, as the "
         "viewer saves it (default: those marked in the file, else those "
         "named like "
         "skin, head, face or body)",
         false, [](Request& r, const std::string& text) { r.skin = parseText(text); }},
        {"--irradiance-size", "N", kPicture | kPlan | kCompare | kViewer, quality,
         "The irradiance atlas is exactly N×N texels; below 8 it has 8 and skin takes N of them (default: "
         "chosen from the "
         "picture)",
         false,
         [](Request& r, const std::string& text) {
             r.settings.irradianceSize = static_cast<int>(parseInteger(text, kMinAtlas, kMaxAtlas));
         }},
        {"--gaussians", "K", kPicture | kPlan | kCompare | kViewer, quality,
         "Reduce each profile to K Gaussians, faster and less exact (default: all)", false,
         [](Request& r, const std::string& text) {
             r.settings.gaussians = static_cast<int>(parseInteger(text, 1, kMaxGaussians));
         }},
        {"--merge", "NAME", kPicture | kPlan | kCompare | kViewer, quality,
         "How the thicknesses that several lights see become one: min, the smallest, or opposite, the "
         "distance "
         "of the other side of the skin, whatever the lights (default: min)",
         false,
         [](Request& r, const std::string& text) {
             r.settings.merge = parseChoice<Merge>(text, kMergeNames);
         }},
        {"--chain", "NAME", kPicture | kPlan | kCompare | kViewer, quality,
         "How light is diffused: exact, or published, the chain of blurs as GPU Gems 3 prints it, to compare "
         "with "
         "(default: exact)",
         false,
         [](Request& r, const std::string& text) {
             r.settings.chain = parseChoice<Chain>(text, kChainNames);
         }},
        {"--taps", "N", kPicture | kPlan | kCompare | kViewer, quality,
         "Texels that each blur reads on either side, at the most: fewer are faster and less exact (default: "
         "12)",
         false,
         [](Request& r, const std::string& text) {
             r.settings.taps = static_cast<int>(parseInteger(text, 1, kMaxTaps));
         }},
        {"--seed", "N", kView, quality,
         "Starts the random numbers of whatever uses any; of a picture, other samples of its area lights and "
         "its sky "
         "(default: 0)",
         false,
         [](Request& r, const std::string& text) {
             r.settings.seed =
                 static_cast<std::uint32_t>(parseInteger(text, 0, std::numeric_limits<std::uint32_t>::max()));
         }},
        {"--no-prune", "", kPicture | kPlan, quality,
         "Run also what the scene does not need, on neutral inputs, to measure what leaving it out saves",
         false, [](Request& r, const std::string&) { r.settings.prune = false; }},

        {"--device", "DEVICE", kView, "Machine",
         "The GPU: part of its name, its index in cutis devices, or 'cpu' (default: $CUTIS_DEVICE, else the "
         "best)",
         false, [](Request& r, const std::string& text) { r.device = parseText(text); }},
        {"--scene", "SCENE", kRigCheck | kRigExport, "Placement",
         "The glTF scene whose heads the rig's placed lights aim at", false,
         [](Request& r, const std::string& text) { r.scene = parseText(text); }},
    };
}

}  // namespace

std::string_view Option::longName() const {
    return names.substr(names.rfind(' ') + 1);  // npos + 1 is 0
}

std::span<const Option> options() {
    static const std::vector<Option> all = makeOptions();
    return all;
}

void checkConflicts(const Request& request) {
    const bool dark = request.environment == "none";
    if (dark && request.environmentIntensity)
        throw UsageError("--env none and --env-intensity exclude each other");
    if (dark && request.environmentRotation)
        throw UsageError("--env none and --env-rotation exclude each other");
    const RenderSettings &asked = request.settings, free;
    const bool own = asked.irradianceSize != free.irradianceSize || asked.gaussians != free.gaussians ||
                     asked.merge != free.merge || asked.chain != free.chain || asked.taps != free.taps;
    if (request.tolerance && own)
        throw UsageError("--tolerance chooses what --irradiance-size, --gaussians, --merge, --chain and --taps set: they "
                         "exclude each other");
    if (request.frames && request.time) throw UsageError("--frames and --time exclude each other");
    if (request.fps && !request.frames) throw UsageError("--fps is that of --frames");
    if (request.frames) {
        std::vector<std::filesystem::path> files = request.outputs;
        if (!request.stats.empty()) files.push_back(request.stats);
        for (const std::filesystem::path& file : files) {
            if (!hasFrameNumber(file))
                throw UsageError("--frames writes many files: '" + file.string() +
                                 "' needs a place for the frame's number, as in OUT.%04d.png");
        }
    }
    if (request.rig == "none" && !request.lights.empty())
        throw UsageError("--rig none and --light exclude each other");
}

}  // namespace cutis::app
