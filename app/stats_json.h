// The figures of a picture as `--stats` writes them.
#pragma once

#include <string>

#include "renderer/frame/renderer.h"

namespace cutis::app {

// JSON with the keys that docs/command-line.md lists, all of them always there.
std::string statsToJson(const RenderStats& stats);

// The same with "rows": every row of the pass table, on or off, in the order in which they run. Without `measured`, what
// only running gives is null.
std::string planToJson(const RenderStats& stats, bool measured);

// Median of a row's repeated times but the first, which compiles programs.
double medianMs(const PassStats& row);

}  // namespace cutis::app
