#include "app/viewer/place_by_light.h"

#include <algorithm>
#include <cmath>

namespace cutis::app {
namespace {

constexpr double kNear = 0.05;  // metres: no light comes nearer than this to what it is placed by

glm::dvec3 fromPlace(const Placement& place, const glm::dvec3& subject) {
    const double az = glm::radians(place.azimuth), el = glm::radians(place.elevation);
    return subject + place.distance *
                         glm::dvec3(std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el));
}

// Where the ray from the point leaves the sphere of that radius about the centre; a point outside it gets the
// place on the ray that is as far from it as the radius.
glm::dvec3 onSphere(const glm::dvec3& point, const glm::dvec3& towards, const glm::dvec3& centre,
                    double radius) {
    const glm::dvec3 o = point - centre;
    const double b = glm::dot(o, towards), c = glm::dot(o, o) - radius * radius;
    if (c > 0) return point + radius * towards;
    return point + (-b + std::sqrt(b * b - c)) * towards;
}

}  // namespace

glm::dvec3 directionForEffect(PlaceBy by, const Hit& point, const glm::dvec3& eye, const glm::dvec3& light) {
    const glm::dvec3 n = point.normal;
    if (by == PlaceBy::highlight) {
        const glm::dvec3 v = glm::normalize(eye - point.position);
        return glm::normalize(2 * glm::dot(n, v) * n - v);
    }
    const glm::dvec3 now = light - point.position;
    glm::dvec3 along = now - glm::dot(now, n) * n;
    if (glm::length(along) < 1e-9)
        along = std::abs(n.y) < 0.9 ? glm::cross(n, glm::dvec3(0, 1, 0)) : glm::dvec3(1, 0, 0);
    return glm::normalize(along);
}

void placeByLight(Light& light, PlaceBy by, const Hit& point, const glm::dvec3& eye,
                  const glm::dvec3& subject) {
    if (light.type == LightType::directional && !light.place) {
        light.direction = -directionForEffect(by, point, eye, point.position - light.direction);
        return;
    }
    const glm::dvec3 now = light.place ? fromPlace(*light.place, subject) : light.position;
    const glm::dvec3 towards = directionForEffect(by, point, eye, now);
    if (!light.place) {
        light.position = point.position + std::max(glm::length(now - point.position), kNear) * towards;
        light.direction = -towards;
        return;
    }
    Placement& place = *light.place;
    // A directional light has no position: all of the subject sees it in one direction.
    const glm::dvec3 away = light.type == LightType::directional
                                ? towards
                                : onSphere(point.position, towards, subject, place.distance) - subject;
    if (light.type != LightType::directional) place.distance = glm::length(away);
    const glm::dvec3 unit = glm::normalize(away);
    place.azimuth = glm::degrees(std::atan2(unit.x, unit.z));
    place.elevation = glm::degrees(std::asin(std::clamp(unit.y, -1.0, 1.0)));
}

}  // namespace cutis::app
