// The tile of pores (renderer/skin/detail.h), shared by C++ and GLSL.
#ifndef CUTIS_SHARED_DETAIL_H
#define CUTIS_SHARED_DETAIL_H

#define DETAIL_SIZE 256   // texels along a side of its finest level
#define DETAIL_LEVELS 9   // down to one texel

#endif
