// One picture of one scene under one rig: what the program's `render`, `compare` and `measure` call.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "renderer/scene/picture.h"
#include "renderer/scene/scene.h"

namespace cutis {

namespace gpu {
class Device;
}

// How thicknesses become one per texel (DESIGN §1.4). min: the smallest that any light sample sees. opposite: the distance
// of the other side of the skin, from its shape alone: linear in the lights, and the environment shines through too.
enum class Merge { min, opposite };

// How light is diffused. exact: DESIGN §1.4, with its corrections. published: as GPU Gems 3, ch. 14 prints it (seven fixed
// taps, stretch by two lengths, thickness stored in 8 bits), to compare with.
enum class Chain { exact, published };

struct RenderSettings {
    int width = 1280, height = 720;
    int irradianceSize = 0;  // the atlas is exactly this many texels square; 0: chosen from the picture
    int gaussians = 0;       // the profile is reduced to this many Gaussians; 0: all
    int lightMapSize = 0;    // texels along each side of a light map; 0: chosen from the picture
    Merge merge = Merge::min;
    Chain chain = Chain::exact;
    bool reducedLevels = true;  // wide Gaussians are blurred at the lower resolution that their width allows
    int repeats = 1;    // the frame is drawn so often, for its times alone
    bool prune = true;  // false: run also what could be left out, on neutral inputs
    std::uint32_t seed = 0;
    std::vector<std::string> aovs;  // of kAovNames
};

// Names that --aov takes, in the order that --help prints.
inline constexpr const char* kAovNames[] = {"diffuse", "specular", "irradiance", "thickness", "albedo",
                                            "normal",  "position", "depth",      "character"};

struct RenderInput {
    const Scene* scene = nullptr;
    Rig rig;                                  // enabled lights only count; placements resolved (resolvePlacements)
    const Environment* environment = nullptr;  // nullptr: none
    Camera camera;                            // see cameraFor in scene/camera.h
};

struct PassStats {
    std::string name;
    int runs = 0;
    double gpuMs = 0;    // of the last frame
    std::string reason;  // why it runs
    std::vector<double> repeatedMs = {};  // of each frame of RenderSettings::repeats
};

struct LeftOut {
    std::string name, reason;
};

// Figures of one picture; `--stats` writes them with the keys of DESIGN §2.1.
struct RenderStats {
    std::string device;
    std::vector<PassStats> passes;
    std::vector<LeftOut> leftOut;
    int atlasWidth = 0, atlasHeight = 0;
    std::uint64_t atlasTexelsCovered = 0;  // that hold skin
    std::uint64_t atlasTexelsLit = 0;      // of them; the others are not seen, nor is their light
    double atlasMmPerTexel = 0;  // median over covered texels
    int lights = 0, lightSamples = 0, characters = 0, gaussians = 0;
    std::uint64_t bytesGpu = 0;
    std::uint64_t nonfinite = 0;  // over all covered texels and pixels of everything written
    double loadMs = 0, frameMs = 0;
};

struct RenderResult {
    Picture picture;                      // scene-linear radiance, alpha = coverage
    std::map<std::string, Picture> aovs;  // by name
    RenderStats stats;
};

RenderResult renderPicture(gpu::Device& device, const RenderInput& input, const RenderSettings& settings);

}  // namespace cutis
