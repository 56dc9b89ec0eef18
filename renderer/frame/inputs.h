// What a picture is made of, as values to compare: a hash for each Input (frame/plan.h).
#pragma once

#include "renderer/frame/kept.h"

namespace cutis {

// The scene itself is compared by address and RenderInput::sceneRevision, an environment likewise; all else by value.
// Needs frame.geometry, frame.lighting and frame.detail to be up to date, but for the hash of geometry.
InputHashes hashInputs(const FrameContext& frame);
std::uint64_t hashGeometry(const RenderInput& input);

}  // namespace cutis
