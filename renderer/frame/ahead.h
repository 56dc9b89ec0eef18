// Work of rows before the frame that needs no device: it runs on threads of its own, beside what the rows
// that run alone have the device do.
#pragma once

#include <future>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/frame/kept.h"

namespace cutis {

class Ahead {
  public:
    // Frees what the rows that run wrote, and begins PassRow::ahead of each, after that of the rows that
    // write what it reads. Until wait() the geometry stands at rest, and nothing else may read where it
    // stands.
    Ahead(FrameContext& frame, const Plan& plan, const std::vector<RowDecision>& decisions);
    // Throws what any of them threw.
    void wait();

  private:
    AtRest atRest_;  // outlives the work
    std::vector<std::shared_future<void>> work_;
};

}  // namespace cutis
