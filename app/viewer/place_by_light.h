// Place by light: where a light must stand so that what it does appears at a point of the skin.
#pragma once

#include "app/viewer/pick.h"

namespace cutis::app {

enum class PlaceBy {
    highlight,   // its mirror reflection towards the eye lies at the point
    shadowEdge,  // its terminator runs through the point: the light grazes it, from the side where it is now
};

// Unit direction from the point towards the light. `eye` is where the picture is taken from; `light` where
// the light is now (both in world metres). An orthographic camera's eye is any point far along its axis.
glm::dvec3 directionForEffect(PlaceBy by, const Hit& point, const glm::dvec3& eye, const glm::dvec3& light);

// Moves the light so. One that is placed keeps its subject and its distance from `subject` (its head's
// centre), at which it stays aimed; a free one keeps its distance from the point and aims at it; a
// directional one turns.
void placeByLight(Light& light, PlaceBy by, const Hit& point, const glm::dvec3& eye,
                  const glm::dvec3& subject);

}  // namespace cutis::app
