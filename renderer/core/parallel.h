// Loops over all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace cutis {

// Calls body(i) for every i in [0, count), on all cores, in no stated order. The first exception that a body throws
// is thrown here once all threads have stopped.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace cutis
