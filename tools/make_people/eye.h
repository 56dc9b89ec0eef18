// Eyes: a ball of sclera that a disc of iris closes, and before the disc the cap of a clear cornea.
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

// The white, from the limbus back. u, v of it and of the iris run over MakeHuman's eye picture.
TriangleMesh makeSclera(const Eye& eye, double irisScale);

// A disc in the plane of the limbus, where the iris appears to be behind a cornea that refracts (3 mm behind
// its top). `irisScale` widens it.
TriangleMesh makeIris(const Eye& eye, double irisScale);

// The clear cap over the iris; its edge lies within the sclera.
TriangleMesh makeCornea(const Eye& eye, double irisScale);

// Multiplies the colours of a part of the ball by how open each point is to the outside, so that lids and
// sockets shade it. `walls` are the surfaces around it.
void shadeByOpenness(TriangleMesh& part, const Eye& eye, const TriangleMesh& walls);

// MakeHuman's eye picture made plausible as albedo: its sclera darkened and reddened towards the corners.
Raster makeEyeColors(const Raster& picture, const glm::dvec3& irisGain);

}  // namespace cutis::people
