// Which camera a picture is taken with.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace cutis {

// The camera that `selector` names:
//   NAME         a camera of the scene
//   INDEX        the same by its place in the file, from 0
//   auto         made: a long lens (yfov 0.35) from the front (+Z) on the heads and shoulders of all
//                characters, or on all there is in a scene without characters
//   auto:AZ,EL   the same from azimuth AZ (0 = +Z, growing towards +X) and elevation EL (towards +Y), degrees
//   orbit:X,Y,Z,AZ,EL,DISTANCE,FOV   orbitCamera with angles in degrees: what the viewer writes for a view
//                that was moved by hand
//   (empty)      the file's first camera, else auto
// `aspect` (width / height) is the picture's, and the returned camera's: the made camera holds its subject
// inside for any, a camera of the file keeps its vertical field (yfov, ymag). Throws Error: the cameras that
// there are, or what is wrong with the angles.
Camera cameraFor(const Scene& scene, const std::string& selector, double aspect);

// A level camera that looks at `target` (metres) from azimuth (degrees; 0 is +Z, growing towards +X) and
// elevation (degrees, towards +Y) at `distance` metres, with a vertical field of view in radians.
Camera orbitCamera(const glm::dvec3& target, double azimuth, double elevation, double distance, double yfov,
                   double aspect);

}  // namespace cutis
