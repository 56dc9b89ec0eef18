// The exact evaluation of the model (DESIGN §1) on the CPU, in double: what every picture's error is measured
// against. docs/reference.md says how it is computed and what its standard error means.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/scene/picture.h"
#include "renderer/scene/scene.h"

namespace cutis::reference {

struct Input {
    const Scene* scene = nullptr;
    Rig rig;  // enabled lights only count; placements resolved (resolvePlacements)
    const Environment* environment = nullptr;  // nullptr: none
    Camera camera;                             // see cameraFor in scene/camera.h
};

// Channels that are written besides the picture: those of `cutis render` and the picture's standard error.
inline constexpr const char* kAovNames[] = {"diffuse", "specular", "irradiance", "thickness", "albedo",
                                            "normal",  "position", "depth",      "character", "stderr"};

// Every pixel has this many sequences of samples, independent of each other; a pass over the picture takes
// this many further samples of each. Within a sequence samples are stratified against each other, so that
// errors fall faster than with the root of their number; the spread of the sequences' means is what the
// standard error comes from.
inline constexpr int kSequences = 8, kSamplesPerSequence = 4;
inline constexpr int kSamplesPerPass = kSequences * kSamplesPerSequence;

struct Settings {
    int width = 1280, height = 720;
    int gaussians = 0;       // the profile is reduced to this many Gaussians; 0: all
    std::uint32_t seed = 0;  // another seed gives another, independent estimate
    double error = 0.005;    // stops when Result::pictureError and diffuseError are both below; 0: never
    double budget = 0;       // seconds of work after which it stops, after one pass at least; 0: no limit
    int maxPasses = 0;       // stops after so many, those of the saved state included; 0: no limit
    bool resume = true;  // goes on from the state that an earlier run saved in the cache, and saves its own
    std::vector<std::string> aovs;  // of kAovNames
};

struct Progress {
    int passes = 0;                 // done so far
    double fraction = 0;            // of the pass under way
    double error = 0, seconds = 0;  // the larger of the two errors, 0 while unknown; seconds of this run
    double secondsLeft = -1;        // until error or budget is reached; negative while unknown
};

struct Hooks {
    std::function<void(const Progress&)> progress;  // called from working threads, one at a time
    const std::atomic<bool>* stop = nullptr;  // when it becomes true, the run saves its state and returns
};

struct Result {
    Picture picture;                      // scene-linear radiance times coverage; alpha is coverage
    std::map<std::string, Picture> aovs;  // by name
    // Two estimates that share no random number, from the even and from the odd sequences; their mean is the
    // whole.
    Picture halves[2], diffuseHalves[2];
    Picture standardError, diffuseStandardError;  // of one pixel and channel, absolute
    // Standard error over all covered pixels: √(Σ error²) / √(Σ value²), over RGB.
    double pictureError = 0, diffuseError = 0;
    int passes = 0;  // of kSamplesPerPass samples a pixel, those of earlier runs included
    std::uint64_t nonfinite = 0;
    double seconds = 0;        // of this run
    bool interrupted = false;  // Hooks::stop ended it: there is no picture, but a saved state
};

// A hash of the scene and its light, whatever the camera, the size and the settings.
std::uint64_t subjectKey(const Input& input);

// Evaluates the picture. The same input, size and seed give the same bits for the same number of passes, on
// any number of threads and however often the work was interrupted. Throws Error.
Result evaluate(const Input& input, const Settings& settings, const Hooks& hooks = {});

}  // namespace cutis::reference
