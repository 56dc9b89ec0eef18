// How the prefiltered environment is laid out, shared by C++ and GLSL.
#ifndef CUTIS_SHARED_ENVIRONMENT_H
#define CUTIS_SHARED_ENVIRONMENT_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

// The radiance cube: texels along an edge of a face of level 0, and levels.
const uint ENVIRONMENT_FACE = 128u;
const uint ENVIRONMENT_LEVELS = 6u;
// Level l ≥ 1, as interpolation between its texels shows it, is the environment convolved with a normalised lobe
// exp(cosθ/σ²) of σ = 2^l times this, in radians: 1.25 times the width of its texels at a face's centre. Level 0 is the
// environment itself, which its texels blur by about σ_0.
const float ENVIRONMENT_SPREAD = 2.5f / 128.0f;
const float ENVIRONMENT_SPREAD_0 = 1.0f / 128.0f;

// Light that is taken to come from one direction.
struct EnvironmentSource {
    vec3 flux;  // RGB ∫ L dω
    vec3 mean;  // mean direction; shorter than 1 where the light is spread (EnvironmentCluster::centroid)
};

CUTIS_SHARED_END
#endif
