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
    always, skin, litSkin, hiddenSkin, lights, shadows, translucency, oppositeSides, environment
};
inline constexpr int kNeedCount = 9;

// Each need with the reason for which it is met or not, in words.
struct Needs {
    bool met[kNeedCount] = {};
    std::string reason[kNeedCount];
    bool operator[](Need need) const { return met[static_cast<int>(need)]; }
    const std::string& why(Need need) const { return reason[static_cast<int>(need)]; }
};

struct NeedsInput {
    int skinDraws = 0, translucentSkinMaterials = 0;
    int lightSamples = 0, shadowedSamples = 0;
    bool environment = false;
    Merge merge = Merge::min;
    Chain chain = Chain::exact;
    bool prune = true;
};
Needs computeNeeds(const NeedsInput& input);

// What passes hand to one another.
enum class Resource {
    surface, seen, lightMaps, thickness, tiles, visibility, irradiance, levels, exitance, picture
};

struct PassRow {
    const char* name;
    Need need;
    std::vector<Resource> reads;     // must have been written by a row above that runs
    std::vector<Resource> readsIf;   // read when some row above wrote it
    std::vector<Resource> writes;
    void (*record)(FrameContext&);
};

// Every pass there is, in the order in which they run.
const std::vector<PassRow>& passTable();

struct Plan {
    std::vector<const PassRow*> rows;
    std::vector<std::string> reasons;  // of rows
    std::vector<LeftOut> leftOut;
};

// The rows whose need is met. Throws std::logic_error when a row reads what no row above writes.
Plan makePlan(const Needs& needs);

}  // namespace cutis
