// Which layer of the light maps holds which view, from one picture to the next: a view that was drawn already keeps its
// layer, in whatever order lights come.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shaders/shared/scene.h"

namespace cutis {

class LightMapLayers {
  public:
    struct Move {
        std::uint32_t from, to;  // layers of the image before and of the one that takes its place
    };
    struct Assignment {
        bool newImage = false;            // of layers() layers
        std::vector<Move> moves;          // what to copy into it
        std::vector<std::uint32_t> draw;  // views whose layer does not hold them yet
    };
    // Fills LightView::layer of every view. Those that are not needed get any layer, and nothing is drawn for them.
    // `contents`, a hash a view of what it shows; empty where that never changes.
    Assignment assign(std::vector<shared::LightView>& views, const std::vector<bool>& needed,
                      const std::vector<std::uint64_t>& contents = {});
    std::uint32_t layers() const { return static_cast<std::uint32_t>(held_.size()); }
    void forget() { held_.clear(); }

  private:
    std::vector<std::optional<std::uint64_t>> held_;  // a layer: a hash of the view that it holds and of its content
};

}  // namespace cutis
