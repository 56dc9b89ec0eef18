// Perceived difference of two pictures as one flips between them: FLIP (Andersson, Nilsson, Akenine-Möller,
// Oskarsson, Åström & Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images", PACMCGIT 3(2)).
#pragma once

#include "renderer/scene/picture.h"

namespace cutis {

// Pixels in a degree of the field of view; the paper's: a 3840 pixel wide, 0.7 m wide screen seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0;

// The difference of each pixel, in [0, 1], of two display-referred pictures: three or four channels of linear
// Rec.709 in [0, 1] (values outside are clamped), equal size. Throws std::invalid_argument when sizes differ.
Picture flipMap(const Picture& picture, const Picture& reference,
                double pixelsPerDegree = kFlipPixelsPerDegree);

// Its mean over all pixels.
double meanOf(const Picture& map);

// What writePng shows, in linear light: exposed by 2^exposure and tone mapped.
Picture displayLight(const Picture& sceneLinear, double exposure);

}  // namespace cutis
