// Finds and loads the module that holds the image codec.
#pragma once

#include "renderer/scene/codec/image_codec.h"

namespace cutis {

// The codec; loads it at the first call, from beside the program or from where it was built. Any thread may
// call. Throws Error when it cannot be loaded.
const ImageCodec& imageCodec();

}  // namespace cutis
