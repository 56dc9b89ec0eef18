// Pores of skin (renderer/skin/detail.h), shared by C++ and GLSL.
#ifndef CUTIS_SHARED_DETAIL_H
#define CUTIS_SHARED_DETAIL_H
#include "shared/interop.h"

#define DETAIL_SIZE 256   // texels along a side of the tile's finest level
#define DETAIL_LEVELS 9   // down to one texel

CUTIS_SHARED_BEGIN

// Of one material.
struct Pores {
    float strength;      // multiplies their slopes
    float tiles;         // tiles a metre
    vec3 offset;         // place of the scene's origin, in tiles
    float normalTexels;  // of the normal map; 0: there is none
    float variance[DETAIL_LEVELS];  // E|s|² that each level shows
};

CUTIS_SHARED_END

#endif
