// What a frame runs: the needs of the scene, and the pass table that serves them. The only place that decides.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/frame/renderer.h"

namespace cutis {

struct FrameContext;

// What a scene may need. A row of the pass table runs when its need is met.
enum class Need {
    always, skin, litSkin, hiddenSkin, lights, areaLights, shadows, translucency, oppositeSides, environment,
    skinSpecular, transparency, seams, motion, clearcoat, sheen, transmission, secondLobe, detail, wideGaussians
};
inline constexpr int kNeedCount = 20;

// Each need with the reason for which it is met or not, in words.
struct Needs {
    bool met[kNeedCount] = {};
    std::string reason[kNeedCount];
    bool operator[](Need need) const { return met[static_cast<int>(need)]; }
    const std::string& why(Need need) const { return reason[static_cast<int>(need)]; }
};

struct NeedsInput {
    int skinDraws = 0, translucentSkinMaterials = 0;
    int lightSamples = 0, shadowedSamples = 0, areaSamples = 0;
    int shinySkinMaterials = 0, blendedDraws = 0;
    int twoLobedMaterials = 0, poredMaterials = 0;  // of skin that shines
    bool poresResolved = false;                     // some pixel is narrow enough for them
    int coatedMaterials = 0, sheenMaterials = 0, glassMaterials = 0;  // of what is not skin
    std::size_t seams = 0;  // edges of UV islands beyond which the skin goes on
    int wideGaussians = 0;  // beside the body whose skin they blur (frame/light_patches.h)
    bool environment = false;
    int animations = 0;
    Merge merge = Merge::min;
    Chain chain = Chain::exact;
    bool prune = true;
    bool anyView = false;  // skin is lit for every view, not for one
};
Needs computeNeeds(const NeedsInput& input);
// What rows leave out of themselves: needs that are not met and have no row of their own.
std::vector<LeftOut> leftOutWithinRows(const Needs& needs);

// What a picture is made of, in parts that change apart from one another. A row names those that it reads, and runs again
// only when one of them has changed (frame/inputs.h).
enum class Input {
    geometry,             // meshes, where they stand at rest, which of them are skin, and its size in mm
    pose,                 // where they stand now, and how they are deformed
    textures,             // images, and which of them are sampled
    materials,            // all that a material has but what follows
    skinLayer,            // roughness and specular scale of skin
    pores,                // of skin: all that materials say of them
    skinMix,              // how much of its albedo light meets before it scatters
    profiles,             // diffusion profiles as they are used, and which skin is translucent
    levels,               // of diffusion: how many there are, which charts share them, and their resolutions
    chain,                // how light is diffused, and by how many taps
    atlasDetail,          // what the layout of the atlas is chosen from
    lightMapSize,
    lightMapsNeeded,      // which of them anything looks up
    groupsSeen,           // characters, and the rest, that the picture may show
    lightPlaces,          // of the light samples: all but their light
    lightPower,           // and that
    environment,          // what is left of it once light samples are drawn
    environmentRotation,
    environmentPower,
    camera,
    pictureSize,
    aovs
};
inline constexpr int kInputCount = 22;

// What rows hand to one another.
enum class Resource {
    // Made before the frame
    environmentMaps, environmentSettings, skyDirections, meshes, occluders, textures, materials, pores, layout, draws, ranges, profiles,
    stretch, seams, lightPatches, oppositeVertices, lights, viewBuffers, target,
    // Written by passes
    surface, seen, lightMaps, thickness, tiles, visibility, irradiance, levels, exitance, picture
};

// When a row runs: submitting commands of its own, with all uploads before the frame, or as a pass of the frame.
enum class Phase { alone, upload, frame };

struct PassRow {
    const char* name;
    Phase phase;
    Need need;
    std::vector<Input> inputs;
    std::vector<Resource> reads;         // must have been written by a row above that runs
    std::vector<Resource> readsIf = {};  // read when some row above wrote it
    std::vector<Need> variants = {};     // other needs that change what it does
    std::vector<Resource> updates = {};  // changed in place: all rows that write or update one of these run together
    std::vector<Resource> writes;
    void (*record)(FrameContext&) = nullptr;
    void (*ahead)(FrameContext&) = nullptr;   // of a row before the frame: what of it the CPU can do before it is recorded (frame/ahead.h)
    void (*forget)(FrameContext&) = nullptr;  // frees what it wrote: before it runs again, and when it is left out
    bool amends = false;                      // it replaces only what has changed of what it wrote, and frees that itself
    bool byGroup = false;                     // where nothing but poses has changed it does so too, for the groups in Changes::groups
};

// Every pass there is, in the order in which they run.
const std::vector<PassRow>& passTable();

struct Plan {
    std::vector<const PassRow*> rows;
    std::vector<std::string> reasons;  // of rows
    std::vector<LeftOut> leftOut;        // rows of the frame, and why
    std::vector<LeftOut> leftOutBefore;  // rows before it
};

// The rows whose need is met. Throws std::logic_error when a row reads what no row above writes.
Plan makePlan(const Needs& needs);

}  // namespace cutis
