// Pictures of scenes under rigs: what the program's `render`, `compare`, `measure` and viewer call.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/core/interrupted.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/scene.h"

namespace cutis {

namespace gpu {
class Device;
}

// How thicknesses become one per texel (DESIGN §1.4). min: the smallest that any light sample sees. opposite: the distance
// of the other side of the skin, from its shape alone: linear in the lights, and the environment shines through too.
enum class Merge { min, opposite };
inline constexpr const char* kMergeNames[] = {"min", "opposite"};

// How light is diffused. exact: DESIGN §1.4, with its corrections. published: as GPU Gems 3, ch. 14 prints it (seven fixed
// taps, stretch by two lengths, thickness stored in 8 bits), to compare with.
enum class Chain { exact, published };
inline constexpr const char* kChainNames[] = {"exact", "published"};

// What the atlas holds, shown on the surface as the AOV kInspectedName: for looking into the passes. level:
// the irradiance blurred to the variance of Gaussian `index`; stretch: how many times longer a texel is one
// way than across; texelDensity: texels per millimetre; shadow: the share of light `index` of the rig that
// arrives. lightMap is not seen on the surface: the maps of sample `part` of light `index`, beside each other
// and upright, as distances from the light in metres, 0 where it sees nothing.
struct Inspect {
    enum class What { none, level, stretch, texelDensity, shadow, lightMap };
    What what = What::none;
    int index = 0;
    int part = 0;
    bool operator==(const Inspect&) const = default;
};
inline constexpr const char* kInspectedName = "inspected";

struct RenderSettings {
    int width = 1280, height = 720;
    int irradianceSize = 0;  // the atlas is exactly this many texels square; 0: chosen from the picture
    int gaussians = 0;       // the profile is reduced to this many Gaussians; 0: all
    int lightMapSize = 0;    // texels along each side of a light map; 0: chosen from the picture
    Merge merge = Merge::min;
    Chain chain = Chain::exact;
    int taps = 12;              // of each blur of the exact chain, on either side at the most, at least 1
    bool reducedLevels = true;  // wide Gaussians are blurred at the lower resolution that their width allows
    double detail = 1;  // atlas and light maps are as fine as a picture of so many times the pixels along each side asks
    int repeats = 1;    // all of the frame is drawn so often, for its times alone
    bool prune = true;  // false: run also what could be left out, on neutral inputs
    std::uint32_t seed = 0;         // other samples of area lights and of the sky; means over seeds converge
    std::vector<std::string> aovs;  // of kAovNames
    Inspect inspect = {};
    // Asked after each command of the frame, which is then run by itself: a millisecond or so more in all on a GPU. Where it
    // says true, render throws Interrupted. Empty: nobody asks, and the frame runs as one.
    StopAsked stopAsked = {};
};

// Names that --aov takes, in the order that --help prints.
inline constexpr const char* kAovNames[] = {"diffuse", "specular", "irradiance", "thickness", "albedo",
                                            "normal",  "position", "depth",      "character"};

// A Renderer finds out by itself what has changed since the picture before, but does not compare vertices and texels:
// whoever changes meshes, nodes or images of a scene, or the texels of an environment, in place, counts their revision up.
// After poseScene alone that is poseRevision: then only what stands otherwise than before is drawn anew.
// Materials, which of them are skin, the rig and the camera are compared by value.
struct RenderInput {
    const Scene* scene = nullptr;
    std::uint64_t sceneRevision = 0;
    std::uint64_t poseRevision = 0;
    Rig rig = {};                              // enabled lights only count; placements resolved (resolvePlacements)
    const Environment* environment = nullptr;  // nullptr: none
    std::uint64_t environmentRevision = 0;
    Camera camera = {};  // see cameraFor in scene/camera.h
};

struct PassStats {
    std::string name;
    int runs = 0;          // 0: what it wrote for an earlier picture is still right
    double gpuMs = 0;      // of the last frame
    std::string reason = {};  // why it runs, or "unchanged: ..." with what it reads
    std::vector<double> repeatedMs = {};  // of each frame of RenderSettings::repeats
    std::uint64_t bytes = 0;              // of GPU memory that it wrote or worked in
};

struct LeftOut {
    std::string name, reason;
};

// Figures of one picture; `--stats` writes them with the keys of DESIGN §2.1.
struct RenderStats {
    std::string device;
    std::vector<PassStats> passes;
    std::vector<PassStats> prepared;  // what was uploaded and filtered before the frame, or was there already
    std::vector<LeftOut> leftOut;
    std::vector<LeftOut> notPrepared;  // the same of `prepared`
    int atlasWidth = 0, atlasHeight = 0;
    std::uint64_t atlasTexelsCovered = 0;  // that hold skin
    std::uint64_t atlasTexelsLit = 0;      // of them; the others are not seen, nor is their light
    double atlasMmPerTexel = 0;  // median over covered texels
    int lights = 0, lightSamples = 0, characters = 0, gaussians = 0;
    int lightMaps = 0, lightMapsDrawn = 0;  // in use, and drawn for this picture
    std::uint64_t bytesGpu = 0;
    std::uint64_t nonfinite = 0;  // over all covered texels and pixels of everything written
    double loadMs = 0, frameMs = 0;  // all before the frame; the frame
};

struct RenderResult {
    Picture picture;                      // scene-linear radiance, alpha = coverage
    std::map<std::string, Picture> aovs;  // by name
    RenderStats stats;
};

// Draws one picture after another and keeps on the device whatever the next one does not change: uploads, filtered
// environments, light maps, lit skin. A camera that moves costs the composite alone, a light that moves its own maps and
// what they light. Where a call throws, the next one starts afresh; after Interrupted it goes on from the passes that have
// run. Not for several threads.
class Renderer {
  public:
    // any: skin is lit whether this view shows it or not, and texels stay as they are until the view asks for far finer or
    // coarser ones, so that the camera is free. one: only what the picture shows is lit, which is less. Either way a scene
    // that moves keeps the layout of its skin that it has at rest.
    enum class Views { any, one };
    // The device must outlive it.
    explicit Renderer(gpu::Device& device, Views views = Views::any);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Scene and environment are used during the call alone. Throws Error.
    RenderResult render(const RenderInput& input, const RenderSettings& settings);
    // Counts in a picture of a sequence to come. From then on atlas and light maps are as fine as the finest of all pictures
    // that were counted in asks, and stay so, for a texel that changes its size between two pictures shows.
    void anticipate(const RenderInput& input, const RenderSettings& settings);
    // What `render` would run, with its memory, but for the figures that only running gives. Frees all that is kept.
    RenderStats plan(const RenderInput& input, const RenderSettings& settings);
    // Frees all that is kept.
    void forget();

  private:
    struct State;
    std::unique_ptr<State> makeState() const;
    gpu::Device& device_;
    Views views_;
    std::unique_ptr<State> state_;
};

// One picture alone.
RenderResult renderPicture(gpu::Device& device, const RenderInput& input, const RenderSettings& settings);

}  // namespace cutis
