// What comes back from a frame: pictures and figures.
#pragma once

#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/frame/inspect.h"
#include "renderer/gpu/commands.h"

namespace cutis {

struct Readbacks {
    gpu::Readback picture, aovs, nonfinite, tileCounts;
    InspectReadback inspect;
    bool skin = false;  // nonfinite and tileCounts are there
};

// Of the lit atlas; kept while it is.
struct SkinFigures {
    std::uint64_t texelsCovered = 0, texelsLit = 0, nonfinite = 0;
};

// To be recorded after the last row. `lit`: the atlas was lit anew.
Readbacks recordReadbacks(const FrameContext& frame, bool lit);

// Fills picture, AOVs and the figures that follow from them.
void takePictures(const FrameContext& frame, const Readbacks& readbacks, SkinFigures& skin, RenderResult& result);

// Fills what the frame and its plan say of themselves.
void fillStats(const FrameContext& frame, const Plan& plan, RenderStats& stats);

// Why a row did not run again: what it reads, in words.
std::string describeReads(const PassRow& row);

}  // namespace cutis
