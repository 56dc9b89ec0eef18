// How the prefiltered environment is laid out, shared by C++ and GLSL.
#ifndef CUTIS_SHARED_ENVIRONMENT_H
#define CUTIS_SHARED_ENVIRONMENT_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

// The radiance array: cubes that hold the environment convolved with wider and wider lobes. Lobe 0 is the environment
// itself, which its texels blur by about ENVIRONMENT_SPREAD_0. Lobe i from 1 on is, as interpolation between texels shows
// it, a normalised exp(cosθ/σ²) of σ_i = 2^(i/2) times ENVIRONMENT_SPREAD, in radians. What interpolation does wrong grows
// as the square of texel over σ: at a face's centre that is 1/1.4 for lobe 1, 1/2 for lobe 2, at most 1/2.8 for all others.
const uint ENVIRONMENT_FACE = 128u;  // texels along an edge of mip 0
const uint ENVIRONMENT_MIPS = 5u;
const uint ENVIRONMENT_LOBES = 12u;
const float ENVIRONMENT_SPREAD = 1.0f / 64.0f;
const float ENVIRONMENT_SPREAD_0 = 1.0f / 128.0f;

// Three sets of lobes. A source that is small beside the lobe of a surface is better reflected exactly, one that is not is
// better left in the map: so mirrors look up all of the environment, surfaces above ENVIRONMENT_MEDIUM_FROM (m or alpha) all
// but its smallest sources, and those above ENVIRONMENT_ROUGH_FROM all but its compact sources.
const uint ENVIRONMENT_ALL = 0u;
const uint ENVIRONMENT_MEDIUM = 5u;
const uint ENVIRONMENT_ROUGH = 7u;  // cubes from 10 on: it begins with lobe 3
const uint ENVIRONMENT_CUBES = 12u;
const float ENVIRONMENT_MEDIUM_FROM = 0.03f, ENVIRONMENT_ROUGH_FROM = 0.15f;

CUTIS_SHARED_FUNCTION uint environmentSet(float roughness) {
    return roughness <= ENVIRONMENT_MEDIUM_FROM  ? ENVIRONMENT_ALL
           : roughness <= ENVIRONMENT_ROUGH_FROM ? ENVIRONMENT_MEDIUM
                                                 : ENVIRONMENT_ROUGH;
}
CUTIS_SHARED_FUNCTION uint environmentFirstLobe(uint set) {
    return set == ENVIRONMENT_ROUGH ? 3u : 0u;
}

// Where a lobe of a set is: cube of the array, and mip.
CUTIS_SHARED_FUNCTION uint environmentLobeCube(uint set, uint lobe) {
    return set + (lobe < 3u ? lobe : 3u + ((lobe - 1u) & 1u));
}
CUTIS_SHARED_FUNCTION uint environmentLobeMip(uint lobe) {
    return lobe < 3u ? 0u : (lobe - 3u) / 2u;
}

// Light that is taken to come from one direction.
struct EnvironmentSource {
    vec3 flux;  // RGB ∫ L dω
    vec3 mean;  // mean direction; shorter than 1 where the light is spread (EnvironmentCluster::centroid)
};

CUTIS_SHARED_END
#endif
