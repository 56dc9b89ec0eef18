// What the atlas holds, seen on the surface: for looking into the passes.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gpu/commands.h"

namespace cutis {

// The image of the atlas that `inspect` asks for, on its way back. Empty where no pass wrote it.
struct InspectReadback {
    gpu::Readback values;
    int side = 0, shift = 0;  // texels along each side; the atlas' side is that, shifted
};
InspectReadback recordInspect(const FrameContext& frame);

// The values at the atlas texels that pixels show (`atlas`: x, y in texels, 1 where there is skin): three
// channels, see Inspect; 0 where there is none.
Picture lookUpInspected(const Inspect& inspect, const InspectReadback& readback, const Picture& atlas);

}  // namespace cutis
