#include "renderer/scene/rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/error.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/light_samples.h"

namespace cutis {
namespace {

// Unit vector from a head towards a light at these angles (DESIGN §2.3): azimuth 0 is +Z and grows towards
// +X.
glm::dvec3 directionTo(const Placement& place) {
    const double azimuth = glm::radians(place.azimuth), elevation = glm::radians(place.elevation);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

// Rigid transform of a light whose -Z shines along `direction`, as glTF lights do.
glm::dmat4 lightToWorld(const Light& light) {
    const RectAxes axes = rectAxes(light.direction);
    const glm::dvec3 z = -light.direction, y = axes.y, x = glm::cross(y, z);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(light.position, 1)};
}

// The light as glTF can hold it: its colour within [0,1], nothing but a point of light.
Light punctual(const Light& light) {
    Light result = light;
    const glm::dvec3 rgb = lightIntensity(light);
    result.intensity = std::max({rgb.x, rgb.y, rgb.z});
    result.color = result.intensity > 0 ? rgb / result.intensity : glm::dvec3(1);
    result.temperature.reset();
    result.place.reset();
    result.radius = 0;
    result.samples = 0;
    if (light.type == LightType::rect) {
        result.type = LightType::spot;
        result.intensity *= light.size.x * light.size.y;  // L·A candela on the axis
        result.innerConeAngle = 0;
        result.outerConeAngle = std::numbers::pi / 2;
        result.size = {0, 0};
    }
    return result;
}

}  // namespace

void resolvePlacements(Rig& rig, const Scene& scene) {
    for (Light& light : rig.lights) {
        if (!light.place) continue;
        const Bounds head = headBounds(scene, light.place->subject);
        if (head.empty()) throw Error("cannot place light", "the scene is empty", light.name);
        const glm::dvec3 towards = directionTo(*light.place);
        light.position = head.centre() + light.place->distance * towards;
        light.direction = -towards;
    }
}

Rig rigFromScene(const Scene& scene) {
    Rig rig;
    rig.name = scene.name;
    rig.lights = scene.lights;
    return rig;
}

Scene sceneFromRig(const Rig& rig) {
    Scene scene;
    scene.name = rig.name;
    std::size_t rects = 0, round = 0;
    for (const Light& light : rig.lights) {
        if (!light.enabled) continue;
        rects += light.type == LightType::rect;
        round += light.type != LightType::rect && light.radius > 0;
        Node node;
        node.name = light.name;
        node.local = node.world = lightToWorld(light);
        node.light = static_cast<int>(scene.lights.size());
        scene.nodes.push_back(node);
        scene.lights.push_back(punctual(light));
    }
    if (rects) {
        warn(std::to_string(rects) + " rect light" + (rects > 1 ? "s are" : " is") +
             " written as spots of equal candela on their axes: glTF has no area lights");
    }
    if (round)
        warn("the radius of " + std::to_string(round) + " light(s) is lost: glTF has points of light only");
    if (!rig.environment.file.empty()) warn("the environment is not written: KHR_lights_punctual has none");
    if (scene.lights.size() < rig.lights.size())
        warn(std::to_string(rig.lights.size() - scene.lights.size()) + " disabled light(s) are not written");
    return scene;
}

}  // namespace cutis
