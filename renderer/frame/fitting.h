// What to draw when the device has no memory for a picture as it was asked for.
#pragma once

#include "renderer/frame/renderer.h"
#include "renderer/gpu/out_of_memory.h"

namespace cutis {

// Coarser settings than these, with which the device has room for the picture: the atlas and the light maps
// that the program chooses become half as fine, and again. Warns, saying what is coarser. Throws Error where
// what the settings fix (the size of the atlas, of light maps, of the picture) leaves no room, saying what
// would fit. `problem` is what drawing with `settings` ended with.
RenderSettings settingsThatFit(gpu::Device& device, const RenderInput& input, const RenderSettings& settings,
                               const gpu::OutOfMemory& problem);

}  // namespace cutis
