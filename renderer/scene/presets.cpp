#include "renderer/scene/presets.h"

#include <cctype>
#include <numbers>

#include "renderer/core/error.h"
#include "renderer/core/suggest.h"

namespace cutis {
namespace {

constexpr double kKeyIrradiance = 2.5;  // at the centre of the head
constexpr double kDegree = std::numbers::pi / 180;

// Where a light stands, as Placement, and what colour it has.
struct Stand {
    double azimuth, elevation;  // degrees
    double distance;            // metres
    double kelvin;
};

Light placed(const char* name, LightType type, const Stand& stand) {
    Light light;
    light.name = name;
    light.type = type;
    light.temperature = stand.kelvin;
    light.place = Placement{"*", stand.azimuth, stand.elevation, stand.distance};
    return light;
}

// A diffuse panel that gives the head `irradiance`: L = E d² / A, 10 % high where the panel is as large as it
// is far.
Light softbox(const char* name, const Stand& stand, glm::dvec2 size, double irradiance) {
    Light light = placed(name, LightType::rect, stand);
    light.size = size;
    light.intensity = irradiance * stand.distance * stand.distance / (size.x * size.y);
    return light;
}

// A reflector dish on a stand: a spot with a soft edge, wide enough for a group of heads.
Light dish(const char* name, const Stand& stand, double radius, double irradiance) {
    Light light = placed(name, LightType::spot, stand);
    light.radius = radius;
    light.innerConeAngle = 22 * kDegree;
    light.outerConeAngle = 38 * kDegree;
    light.intensity = irradiance * stand.distance * stand.distance;
    return light;
}

// Temperatures: daylight-balanced flash is 5600 K; fills are a little cooler, as sky light is, rims a little
// warmer. Distances are 1.6 m and more, so that a group of heads is lit evenly; softboxes span 25° to 40°
// from there.

std::vector<Light> threePoint() {
    return {softbox("key", {45, 35, 2.0, 5400}, {0.9, 1.2}, kKeyIrradiance),
            softbox("fill", {-45, 8, 2.2, 6800}, {1.2, 1.2}, kKeyIrradiance / 4),
            dish("rim", {-150, 30, 2.0, 4600}, 0.09, 1.6 * kKeyIrradiance)};
}

// High and to the side, so that the nose's shadow meets the cheek's and leaves a lit triangle below the far
// eye.
std::vector<Light> rembrandt() {
    return {softbox("key", {52, 45, 1.8, 5200}, {0.6, 0.8}, kKeyIrradiance),
            softbox("fill", {-45, 5, 2.2, 6500}, {1.2, 1.2}, kKeyIrradiance / 8)};
}

// Straight above the lens: a butterfly-shaped shadow below the nose.
std::vector<Light> butterfly() {
    return {softbox("key", {0, 45, 1.8, 5600}, {0.7, 0.7}, kKeyIrradiance),
            softbox("fill", {0, -20, 2.0, 5900}, {1.2, 0.8}, kKeyIrradiance / 6)};
}

// A little to the side and above the eyes: the nose's shadow loops down to the corner of the mouth, off the
// cheek's.
std::vector<Light> loop() {
    return {softbox("key", {35, 28, 1.8, 5500}, {0.7, 0.9}, kKeyIrradiance),
            softbox("fill", {-40, 5, 2.2, 6300}, {1.2, 1.2}, kKeyIrradiance / 4)};
}

// From the side: one half of the face lit, the other in shadow. At 90° the light would graze the lit half, too.
std::vector<Light> split() {
    return {softbox("key", {78, 8, 1.8, 5400}, {0.6, 0.9}, kKeyIrradiance),
            softbox("fill", {-60, 5, 2.4, 6500}, {1.2, 1.2}, kKeyIrradiance / 12)};
}

// Two lights from behind draw the outline and shine through the ears; a faint fill keeps the face readable.
std::vector<Light> rim() {
    return {dish("rim left", {-145, 20, 2.0, 5000}, 0.09, 1.5 * kKeyIrradiance),
            dish("rim right", {145, 20, 2.0, 5000}, 0.09, 1.5 * kKeyIrradiance),
            softbox("fill", {0, 20, 2.2, 6500}, {1.5, 1.0}, kKeyIrradiance / 5)};
}

// Above and below the lens, as two halves of a shell: the beauty light, nearly without shadows.
std::vector<Light> clamshell() {
    return {softbox("key", {0, 38, 1.8, 5600}, {1.0, 0.7}, kKeyIrradiance),
            softbox("reflector", {0, -38, 1.6, 5800}, {1.0, 0.6}, kKeyIrradiance / 2)};
}

std::vector<Light> single() {
    return {softbox("key", {40, 35, 1.8, 5600}, {0.6, 0.8}, kKeyIrradiance)};
}

struct Entry {
    Preset preset;
    std::string title;
    std::vector<Light> (*lights)();
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = {
        {{"three-point", "soft key, cool fill 4:1, warm rim from behind"}, "Three-point", threePoint},
        {{"rembrandt", "high side key, a lit triangle on the far cheek, fill 8:1"}, "Rembrandt", rembrandt},
        {{"butterfly", "key straight above the lens, fill from below 6:1"}, "Butterfly", butterfly},
        {{"loop", "key a little to the side and above, fill 4:1"}, "Loop", loop},
        {{"split", "key from the side, half of the face dark, fill 12:1"}, "Split", split},
        {{"rim", "two lights from behind that glow through ears, faint fill"}, "Rim", rim},
        {{"clamshell", "key above and reflector below the lens 2:1"}, "Clamshell", clamshell},
        {{"single", "one soft key"}, "Single", single},
    };
    return all;
}

std::string normalized(std::string name) {
    for (char& c : name)
        c = c == ' ' || c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name;
}

const Entry* find(const std::string& name) {
    const std::string wanted = normalized(name);
    for (const Entry& entry : entries())
        if (entry.preset.name == wanted) return &entry;
    return nullptr;
}

}  // namespace

const std::vector<Preset>& presets() {
    static const std::vector<Preset> all = [] {
        std::vector<Preset> result;
        for (const Entry& entry : entries()) result.push_back(entry.preset);
        return result;
    }();
    return all;
}

bool isPreset(const std::string& name) {
    return find(name) != nullptr;
}

Rig presetRig(const std::string& name) {
    const Entry* entry = find(name);
    if (!entry) {
        std::vector<std::string> names;
        std::string list;
        for (const Preset& preset : presets()) {
            names.push_back(preset.name);
            list += (list.empty() ? "" : ", ") + preset.name;
        }
        throw Error("no preset '" + name + "'" + didYouMean(normalized(name), names), "there are " + list);
    }
    Rig rig;
    rig.name = entry->title;
    rig.lights = entry->lights();
    return rig;
}

}  // namespace cutis
