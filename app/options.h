// The one table of options, from which the command line, --help and docs/command-line.md come.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/background.h"
#include "renderer/frame/renderer.h"

namespace cutis::app {

// What a command line asks for, checked as far as it can be without opening a file.
struct Request {
    std::vector<std::string> operands;  // SCENE, RIG: what is not an option

    std::vector<std::filesystem::path> outputs;
    std::filesystem::path stats;             // empty: none
    std::optional<std::string> rig;          // file, preset, "scene" or "none"; unset: see loadInputs
    std::vector<std::string> lights;         // names; empty: all
    std::optional<std::string> environment;  // file or "none"; unset: the rig's
    std::optional<double> environmentIntensity, environmentRotation;  // unset: the rig's
    std::string camera;                                               // as cameraFor takes it
    std::optional<std::string> animation;                             // name or number; unset: the first, with a time
    std::optional<double> time;                                       // seconds
    std::optional<std::string> skin;                                  // as GltfOptions takes it
    std::filesystem::path scene;                                      // for commands whose operand is a rig
    double exposure = 0;                                              // EV, added to the rig's
    std::string device;                                               // as gpu::DeviceOptions takes it
    Background background = Background::none;                         // of cutis render
    RenderSettings settings;

    // Of cutis render: pictures of first to last, at frame / fps seconds.
    struct FrameRange {
        int first = 0, last = 0;
    };
    std::optional<FrameRange> frames;
    std::optional<double> fps;

    double uiScale = 0;  // of cutis view: size of its interface; 0: as the desktop asks

    // Of cutis plan.
    bool json = false, measure = false;

    // Of cutis compare: rigs as --rig takes them; both or neither.
    std::optional<std::string> rigA, rigB;

    std::optional<double> tolerance;  // of cutis render and cutis measure: of the diffuse light

    // Of cutis measure.
    std::string sweep = "quality";  // a built-in sweep or a file
    int repeats = 3;
    struct {
        int width = 480, height = 270;
    } measureSize;

    // Of cutis reference and cutis measure.
    std::optional<double> error;  // relative standard error to reach
    double budget = 0;            // seconds; 0: none
    bool halves = false;          // write the two independent halves as well
};

// Commands that take an option, as a set of bits.
enum CommandSet : unsigned { kNoCommand = 0, kRender = 1, kRigCheck = 2, kRigExport = 4, kReference = 8, kCompare = 16, kMeasure = 32, kViewer = 64, kPlan = 128, kSkinExport = 256 };

struct Option {
    std::string_view names;    // "-o, --output", the long one last
    std::string_view metavar;  // empty: a flag
    unsigned commands;         // CommandSet
    std::string_view group;    // heading in --help
    std::string help;
    bool repeatable;
    // Puts the text into the request, or throws UsageError saying what it must be.
    void (*parse)(Request& request, const std::string& text);

    std::string_view longName() const;
    bool isFlag() const { return metavar.empty(); }
};

std::span<const Option> options();

// What no single option shows: options that exclude each other. Throws UsageError.
void checkConflicts(const Request& request);

}  // namespace cutis::app
