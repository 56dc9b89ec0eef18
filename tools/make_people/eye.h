// Eyeballs: one closed surface of sclera and cornea whose iris is painted under the cornea's bulge.
#pragma once

#include <vector>

#include "mesh.h"
#include "raster.h"

namespace cutis::people {

// A ball in metres and where it looks.
struct Eye {
    glm::dvec3 centre;
    double radius;
    glm::dvec3 gaze;  // unit length
};

// The best sphere (least squares) through points.
Eye fitEye(const std::vector<glm::dvec3>& points);

// `irisScale` widens the painted iris; u, v run over MakeHuman's eye picture.
TriangleMesh makeEyeball(const Eye& eye, double irisScale);

// Multiplies the ball's colours by how open each point is to the outside, so that lids and sockets shade it.
// `walls` are the surfaces around it.
void shadeByOpenness(TriangleMesh& ball, const Eye& eye, const TriangleMesh& walls);

// MakeHuman's eye picture made plausible as albedo: its sclera darkened and reddened towards the corners.
Raster makeEyeColors(const Raster& picture, const glm::dvec3& irisGain);

}  // namespace cutis::people
