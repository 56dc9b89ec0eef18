// What the atlas holds, seen on the surface: for looking into the passes.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gpu/commands.h"

namespace cutis {

// The image of the atlas, or the light maps, that `inspect` asks for, on their way back. Empty where no pass wrote them.
struct InspectReadback {
    gpu::Readback values{};
    int side = 0, shift = 0;  // texels along each side; the atlas' side is that, shifted
    struct LightMap {
        gpu::Readback depth;
        glm::vec3 depthToDistance;  // as shared::LightView has it
    };
    std::vector<LightMap> lightMaps{};  // of `side` texels, one for each group of receivers that is lit
};
InspectReadback recordInspect(const FrameContext& frame);

// The values at the atlas texels that pixels show (`atlas`: x, y in texels, 1 where there is skin): three
// channels, see Inspect; 0 where there is none. Light maps fill a picture of that size instead.
Picture lookUpInspected(const Inspect& inspect, const InspectReadback& readback, const Picture& atlas);

}  // namespace cutis
