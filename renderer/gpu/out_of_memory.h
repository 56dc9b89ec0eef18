// The one failure of a device that less work mends.
#pragma once

#include "renderer/core/error.h"

namespace cutis::gpu {

// The device has no memory for what is asked of it.
class OutOfMemory : public Error {
  public:
    using Error::Error;
};

}  // namespace cutis::gpu
