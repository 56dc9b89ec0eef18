// Which characters a new pose changes: those that moved, and those whose light or sky the moved ones may stand in.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/geometry.h"
#include "renderer/frame/kept.h"

namespace cutis {

// A hash of what a view of a light or of the sky shows: of the poses of all that may be seen in it.
std::uint64_t contentOf(const shared::LightView& view, const Geometry& geometry);

class ChangedGroups {
  public:
    // A flag for each receiver group, for the rows that work group by group (PassRow::byGroup): false where all that they make
    // of it is what the last frame left. Empty where they run on everything: at first, when more than a pose has changed, or when
    // what is lit depends on the view. `inputs`: of this frame.
    std::vector<bool> find(const FrameContext& frame, const InputHashes& inputs);
    // That frame was drawn.
    void note() { drawn_ = asked_; }
    // Some of it was.
    void forget() { drawn_ = {}; }

  private:
    struct State {
        InputHashes inputs{};
        std::vector<bool> needs;
        std::vector<std::uint64_t> groups;  // hashes of all that each group's light depends on
    };
    State asked_, drawn_;  // of the frame that find was last called for, and of the last that was drawn
};

}  // namespace cutis
