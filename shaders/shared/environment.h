// How the prefiltered environment is laid out, shared by C++ and GLSL.
#ifndef CUTIS_SHARED_ENVIRONMENT_H
#define CUTIS_SHARED_ENVIRONMENT_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

// The radiance array: cubes that hold the environment convolved with wider and wider lobes. Lobe i is in mip i/2 of cube
// i%2: as interpolation between texels shows it, it is a normalised exp(cosθ/σ²) of σ_i = 2^(i/2) times
// ENVIRONMENT_SPREAD, in radians, from i = 1 on; lobe 0 is the environment itself, which its texels blur by about
// ENVIRONMENT_SPREAD_0. At i = 2, 4, ... σ is the width of a texel at a face's centre.
const uint ENVIRONMENT_FACE = 128u;  // texels along an edge of mip 0
const uint ENVIRONMENT_MIPS = 6u;
const uint ENVIRONMENT_LOBES = 12u;
const float ENVIRONMENT_SPREAD = 1.0f / 64.0f;
const float ENVIRONMENT_SPREAD_0 = 1.0f / 128.0f;

// Two pairs of cubes: all of the environment, and all but its compact sources, which rough surfaces reflect exactly.
const uint ENVIRONMENT_ALL = 0u;
const uint ENVIRONMENT_SOFT = 2u;
const uint ENVIRONMENT_CUBES = 4u;

// Light that is taken to come from one direction.
struct EnvironmentSource {
    vec3 flux;  // RGB ∫ L dω
    vec3 mean;  // mean direction; shorter than 1 where the light is spread (EnvironmentCluster::centroid)
};

CUTIS_SHARED_END
#endif
