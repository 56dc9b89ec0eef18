// Lights and environments as plain data, the same for a rig file, a glTF scene and the viewer.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cutis {

enum class LightType { directional, point, spot, rect };

// Placement relative to the head of a subject (DESIGN §2.3).
struct Placement {
    std::string subject = "*";  // a character's name, or "*" for all together
    double azimuth = 0;         // degrees; 0 in front (+Z), grows towards +X
    double elevation = 0;       // degrees, towards +Y
    double distance = 1;        // metres from the head's centre
    bool operator==(const Placement&) const = default;
};

struct Light {
    std::string name;
    LightType type = LightType::point;
    bool enabled = true;
    glm::dvec3 color{1};               // linear Rec.709
    std::optional<double> temperature = {};  // kelvin; its colour multiplies `color`
    double intensity = 1;               // lux (directional), candela (point, spot), radiance (rect)
    double innerConeAngle = 0, outerConeAngle = 0.7853981633974483;  // radians from the axis (spot)
    double radius = 0;                  // metres: a point or spot light of this size is an area light
    glm::dvec2 size{0, 0};              // metres, width and height (rect)
    int samples = 0;                    // light samples of an area light; 0: chosen by cutis
    double range = 0;                   // metres, KHR_lights_punctual; 0: none
    bool shadow = true;
    std::optional<Placement> place = {};     // wins over position and direction, which it fills when it is resolved
    glm::dvec3 position{0}, direction{0, 0, -1};  // world; direction is where the light shines to, unit length
    bool operator==(const Light&) const = default;
};

struct EnvironmentSettings {
    std::string file;  // as written; relative to the rig file. Empty: none
    bool enabled = true;
    double intensity = 1;
    double rotation = 0;     // degrees about +Y, counter-clockwise seen from above
    int shadowSamples = 0;  // directions drawn from it that become light samples with shadows
    bool sunRemoved = false;  // it shines without its sun (environment_sun.h)
    bool operator==(const EnvironmentSettings&) const = default;
};

struct Rig {
    std::string name;
    double exposure = 0;  // EV
    std::vector<Light> lights;
    EnvironmentSettings environment;
    bool operator==(const Rig&) const = default;
};

// A lat-long environment: radiance, sanitized (finite, non-negative). Row 0 is +Y; the centre column lies towards -Z
// and columns grow towards +X to the right of it.
struct Environment {
    std::string name;
    int width = 0, height = 0;
    std::vector<glm::vec3> radiance;  // width · height, linear Rec.709
};

// One infinitesimal source: what a light map is drawn for and what a texel sums (DESIGN §1.4).
struct LightSample {
    int light = -1;  // index into Rig::lights; -1 - k for the k-th environment sample
    bool directional = false;
    glm::dvec3 position{0};      // world (not directional)
    glm::dvec3 direction{0, 0, -1};  // where it shines to: light direction, cone axis or rect normal
    glm::dvec3 intensity{0};     // RGB: lux (directional), candela at normal emission otherwise
    bool cosineEmission = false;  // rect: intensity falls with the cosine to `direction`, front side only
    double cosInner = 2, cosOuter = -2;  // spot cone; outer ≤ -1: no cone
    double range = 0;
    bool shadow = true;
    double radius = 0;  // metres (radians when directional): extent of the part of an area light it stands for
};

}  // namespace cutis
