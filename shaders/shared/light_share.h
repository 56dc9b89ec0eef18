// What a texel of the light visibility holds, in 8 bits: the share of a light that arrives times LIGHT_ARRIVES, or
// LIGHT_FACED_AWAY. Of what stands before a light nothing is known where the surface faces away from it, and taken for open, such a
// texel would shine beside one that lies in shadow.
#ifndef CUTIS_SHARED_LIGHT_SHARE_H
#define CUTIS_SHARED_LIGHT_SHARE_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

const float LIGHT_ARRIVES = 254.0f / 255.0f;
const float LIGHT_FACED_AWAY = 1.0f;

CUTIS_SHARED_END
#endif
