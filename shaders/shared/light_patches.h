// The skin of a body in patches, for Gaussians that are wide beside it (passes/wide_gaussians.h).
#ifndef CUTIS_SHARED_LIGHT_PATCHES_H
#define CUTIS_SHARED_LIGHT_PATCHES_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

// The skin within one cube of space.
struct LightPatch {
    vec3 centre;  // mean over its area, scene units from the scene's origin
    float area;   // mm²
    vec3 normal;  // likewise, of unit length
    uint firstSample, sampleCount;
};

// A piece of a patch, and where the atlas has its light.
struct PatchSample {
    vec2 place;    // texels
    float island;  // 1-based
    float area;    // mm²
};

CUTIS_SHARED_END
#endif
