// The figures of a picture as `--stats` writes them.
#pragma once

#include <string>

#include "renderer/frame/renderer.h"

namespace cutis::app {

// JSON with the keys that docs/command-line.md lists, all of them always there.
std::string statsToJson(const RenderStats& stats);

}  // namespace cutis::app
