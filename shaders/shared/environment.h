// How the prefiltered environment is laid out, shared by C++ and GLSL.
#ifndef CUTIS_SHARED_ENVIRONMENT_H
#define CUTIS_SHARED_ENVIRONMENT_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

// The radiance cube: texels along an edge of a face of level 0, and levels.
const uint ENVIRONMENT_FACE = 256u;
const uint ENVIRONMENT_LEVELS = 7u;
// Level l ≥ 1 is the environment convolved with exp(cosθ/σ²), normalised, σ = 2^l times this, in radians: 1.5 times the
// width of its texels at a face's centre. Level 0 is the environment itself, whose texels amount to about σ_0.
const float ENVIRONMENT_SPREAD = 3.0f / 256.0f;
const float ENVIRONMENT_SPREAD_0 = 1.0f / 256.0f;

// Light that is taken to come from one direction.
struct EnvironmentSource {
    vec3 flux;  // RGB ∫ L dω
    vec3 mean;  // mean direction; shorter than 1 where the light is spread (EnvironmentCluster::centroid)
};

CUTIS_SHARED_END
#endif
