// How the mouse moves the view: a camera that turns round a point, as plain data and pure functions.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace cutis::app {

struct OrbitCamera {
    glm::dvec3 target{0};  // world metres: what the view turns round
    double azimuth = 0;    // degrees; 0 looks from +Z, growing towards +X
    double elevation = 0;  // degrees, towards +Y, within ±kMaxElevation
    double distance = 1;   // metres from the target
    double yfov = 0.35;    // vertical field of view, radians
    bool operator==(const OrbitCamera&) const = default;
};

inline constexpr double kMaxElevation = 89;  // straight above, the azimuth would lose its meaning
inline constexpr double kMinFieldOfView = 0.02, kMaxFieldOfView = 2.6;  // radians

Camera toCamera(const OrbitCamera& orbit, double aspect);
// As `--camera` takes it, digits enough to be the same picture.
std::string toSelector(const OrbitCamera& orbit);
// The same eye and direction; its target is the point on the axis nearest to `pivot`. Roll is lost, and an
// orthographic camera becomes a perspective one that shows as much at the pivot.
OrbitCamera fromCamera(const Camera& camera, const glm::dvec3& pivot);

// A drag by (dx, dy) pixels, y downwards, in a view `height` pixels high. Half the height turns by 90°.
void orbitBy(OrbitCamera& camera, double dx, double dy, double height);
// Moves the target along the view plane so that it stays under the mouse.
void panBy(OrbitCamera& camera, double dx, double dy, double height);
// Each step of a wheel nears the target by a tenth; negative steps go back.
void dollyBy(OrbitCamera& camera, double steps);

enum class Framing { face, bust, full, group };
const char* framingName(Framing framing);

// Keeps the direction and the field of view, and shows: the head, head and shoulders, or all of the character
// of that index, or the heads of everyone. Index -1 means everyone. A scene without characters shows what
// there is.
void frameSubject(OrbitCamera& camera, const Scene& scene, int character, Framing framing, double aspect);

// The focal length in millimetres that has this vertical field on a full frame (24 mm high), and back.
double focalLength(double yfov);
double fieldOfView(double focalLengthMm);

// Where a world point appears: x, y in [0, 1] from the top left, z its depth along the axis in metres, which
// is negative behind the camera.
glm::dvec3 project(const Camera& camera, double aspect, const glm::dvec3& point);

}  // namespace cutis::app
