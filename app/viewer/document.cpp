#include "app/viewer/document.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/characters.h"
#include "renderer/scene/fields.h"

namespace cutis::app {
namespace {

constexpr double kUsefulIrradiance = 1.5;  // at the head: with white skin, a radiance of about a half

std::size_t at(int index) {
    return static_cast<std::size_t>(index);
}

// Intensity of a light of that type, in its own unit, that gives irradiance 1 at `distance` metres on its
// axis: E = lux; E = cd / d²; E = L · A / d².
double intensityForUnitIrradiance(const Light& light, LightType type, double distance) {
    if (type == LightType::directional) return 1;
    const double area = std::max(light.size.x * light.size.y, 1e-6);
    return distance * distance / (type == LightType::rect ? area : 1);
}

}  // namespace

Rig effectiveRig(const Document& document) {
    Rig rig = document.rig;
    const bool anySolo = std::find(document.solo.begin(), document.solo.end(), true) != document.solo.end();
    for (std::size_t i = 0; anySolo && i < rig.lights.size(); ++i)
        rig.lights[i].enabled = i < document.solo.size() && document.solo[i];
    if (anySolo) rig.environment.enabled = false;
    return rig;
}

void applyQuality(const Quality& quality, const MeasuredFront& front, Rig& rig, RenderSettings& settings) {
    if (const MeasuredSetting* chosen = measuredOf(quality, front); quality.tolerance > 0 && chosen) {
        Scene unused;  // of settings that repeat characters, which none in a front does
        applySetting(settingForSize(chosen->setting, front, settings.width, settings.height), unused, rig,
                     settings);
        return;
    }
    settings.irradianceSize = quality.irradianceSize;
    settings.gaussians = quality.gaussians;
    settings.merge = quality.merge;
    settings.chain = quality.chain;
    settings.taps = quality.taps;
}

const MeasuredSetting* measuredOf(const Quality& quality, const MeasuredFront& front) {
    if (quality.tolerance > 0) {
        const MeasuredSetting* chosen = cheapestWithin(front, quality.tolerance);
        return chosen ? chosen : closest(front);
    }
    Setting own;
    own.irradianceSize = quality.irradianceSize;
    own.gaussians = quality.gaussians;
    own.merge = kMergeNames[static_cast<int>(quality.merge)];
    own.chain = kChainNames[static_cast<int>(quality.chain)];
    own.taps = quality.taps == Quality{}.taps ? 0 : quality.taps;
    const auto found =
        std::find_if(front.settings.begin(), front.settings.end(), [&](const MeasuredSetting& row) {
            own.name = row.setting.name;
            return row.setting == own;
        });
    return found == front.settings.end() ? nullptr : &*found;
}

int takeSunOut(Document& document, const Light& sun) {
    Light light = sun;
    light.name = uniqueLightName(document.rig, sun.name);
    document.rig.environment.sunRemoved = true;
    document.rig.lights.push_back(light);
    document.solo.resize(document.rig.lights.size(), false);
    return static_cast<int>(document.rig.lights.size()) - 1;
}

void addGaussian(skin::Profile& profile) {
    if (profile.gaussians.size() >= std::size_t(skin::kMaxGaussians)) return;
    double widest = 0.01;  // mm²
    for (const skin::Gaussian& gaussian : profile.gaussians) widest = std::max(widest, gaussian.variance);
    profile.gaussians.push_back({3 * widest, glm::dvec3(0)});
}

void removeGaussian(skin::Profile& profile, std::size_t index) {
    if (profile.gaussians.size() <= 1 || index >= profile.gaussians.size()) return;
    profile.gaussians.erase(profile.gaussians.begin() + static_cast<std::ptrdiff_t>(index));
}

void setProfile(Document& document, std::size_t material, const skin::Profile& profile) {
    if (material >= document.skin.size() || !document.skin[material] || profile.gaussians.empty()) return;
    skin::Profile held = profile;
    const glm::dvec3 total = skin::totalWeight(held);
    for (int c = 0; c < 3; ++c) {
        if (!(total[c] > 1)) continue;
        for (skin::Gaussian& gaussian : held.gaussians) gaussian.weight[c] /= total[c];
    }
    const glm::dvec3 left = skin::totalWeight(held);
    if (!(left.x + left.y + left.z > 0)) return;  // skin that gives nothing back is no skin
    document.skin[material]->profile = held;
}

skin::Profile normalized(const skin::Profile& profile) {
    skin::Profile result = skin::sorted(profile);
    const glm::dvec3 total = skin::totalWeight(result);
    for (skin::Gaussian& gaussian : result.gaussians) {
        for (int c = 0; c < 3; ++c) {
            if (total[c] > 0) gaussian.weight[c] /= total[c];
        }
    }
    // A channel without any weight scatters least.
    for (int c = 0; c < 3; ++c)
        if (!(total[c] > 0) && !result.gaussians.empty()) result.gaussians.front().weight[c] = 1;
    return result;
}

int addLight(Document& document, LightType type) {
    Light light;
    light.name = uniqueLightName(document.rig, "light");
    light.type = type;
    light.temperature = 5600;
    light.place = Placement{"*", 35, 25, 1.5};
    light.size = {0.5, 0.5};
    if (type == LightType::spot) light.innerConeAngle = 0.3, light.outerConeAngle = 0.6;
    if (type != LightType::rect)
        light.size = {0, 0};
    else
        light.size = {0.5, 0.5};
    light.intensity = kUsefulIrradiance * intensityForUnitIrradiance(light, type, light.place->distance);
    document.rig.lights.push_back(light);
    document.solo.resize(document.rig.lights.size(), false);
    return static_cast<int>(document.rig.lights.size()) - 1;
}

int duplicateLight(Document& document, int light) {
    Light copy = document.rig.lights.at(at(light));
    copy.name = uniqueLightName(document.rig, copy.name);
    document.rig.lights.insert(document.rig.lights.begin() + light + 1, copy);
    document.solo.insert(document.solo.begin() + light + 1, false);
    return light + 1;
}

void deleteLight(Document& document, int light) {
    document.rig.lights.erase(document.rig.lights.begin() + light);
    document.solo.erase(document.solo.begin() + light);
}

void moveLight(Document& document, int light, int to) {
    const Light moved = document.rig.lights.at(at(light));
    const bool solo = document.solo.at(at(light));
    deleteLight(document, light);
    to = std::clamp(to, 0, static_cast<int>(document.rig.lights.size()));
    document.rig.lights.insert(document.rig.lights.begin() + to, moved);
    document.solo.insert(document.solo.begin() + to, solo);
}

void replaceRig(Document& document, Rig rig, const std::filesystem::path& file) {
    document.rig = std::move(rig);
    document.rigFile = file;
    document.solo.assign(document.rig.lights.size(), false);
}

std::string uniqueLightName(const Rig& rig, const std::string& name) {
    const auto taken = [&](const std::string& candidate) {
        return std::any_of(rig.lights.begin(), rig.lights.end(),
                           [&](const Light& light) { return light.name == candidate; });
    };
    // "key 2" counts on from "key", not to "key 2 2".
    std::string stem = name;
    const std::size_t blank = name.rfind(' ');
    if (blank != name.npos && blank + 1 < name.size() &&
        std::all_of(name.begin() + static_cast<std::ptrdiff_t>(blank) + 1, name.end(),
                    [](char c) { return c >= '0' && c <= '9'; }))
        stem = name.substr(0, blank);
    std::string candidate = name;
    for (int number = 2; taken(candidate); ++number) candidate = stem + ' ' + std::to_string(number);
    return candidate;
}

void changeType(Light& light, LightType type, double distance) {
    if (light.type == type) return;
    const double irradiance = light.intensity / intensityForUnitIrradiance(light, light.type, distance);
    if (type == LightType::rect && !(light.size.x > 0 && light.size.y > 0)) light.size = {0.5, 0.5};
    if (type != LightType::rect) light.size = {0, 0};
    if (type == LightType::rect || type == LightType::directional) light.radius = 0;
    if (type == LightType::directional) light.samples = 0, light.range = 0;
    const bool spot = type == LightType::spot;
    light.innerConeAngle = spot ? 0.3 : Light{}.innerConeAngle;
    light.outerConeAngle = spot ? 0.6 : Light{}.outerConeAngle;
    light.type = type;
    light.intensity = irradiance * intensityForUnitIrradiance(light, type, distance);
}

void brighten(Light& light, double stops) {
    // A file may have given it more than panels do.
    const double most = std::max(light.intensity, fields::kIntensity.high);
    light.intensity = std::min(light.intensity * std::exp2(stops), most);
}

void turnLight(Light& light, double azimuth, double elevation, const glm::dvec3& pivot) {
    Light turned = light;
    if (!light.place) placeLight(turned, pivot);
    const double before = turned.place->elevation;
    const double oldAzimuth = turned.place->azimuth;
    turned.place->azimuth += azimuth;
    turned.place->azimuth -= 360 * std::floor((turned.place->azimuth + 180) / 360);
    turned.place->elevation = std::clamp(before + elevation, -90.0, 90.0);
    if (light.place) {
        light.place = turned.place;
        return;
    }
    // Free: about +Y by the azimuth, then about the horizontal axis across the new direction.
    const double turn = glm::radians(azimuth), tilt = glm::radians(turned.place->elevation - before);
    const double facing = glm::radians(oldAzimuth) + turn;
    const glm::dquat rotation = glm::angleAxis(-tilt, glm::dvec3(std::cos(facing), 0, -std::sin(facing))) *
                                glm::angleAxis(turn, glm::dvec3(0, 1, 0));
    light.position = pivot + rotation * (light.position - pivot);
    light.direction = glm::normalize(rotation * light.direction);
}

void placeLight(Light& light, const glm::dvec3& pivot) {
    if (light.place) return;
    // A directional light has no position: it stands where it shines from.
    const bool directional = light.type == LightType::directional;
    const glm::dvec3 away = directional ? -2.0 * light.direction : light.position - pivot;
    Placement place;
    place.distance = std::max(glm::length(away), 0.01);
    const glm::dvec3 towards = away / place.distance;
    place.azimuth = glm::degrees(std::atan2(towards.x, towards.z));
    place.elevation = glm::degrees(std::asin(std::clamp(towards.y, -1.0, 1.0)));
    light.place = place;
}

void aimAt(Light& light, const glm::dvec3& position, const glm::dvec3& point) {
    const glm::dvec3 towards = point - position;
    if (!(glm::length(towards) > 1e-6)) return;
    light.place.reset();
    light.position = position;
    light.direction = glm::normalize(towards);
}

Rig rigForFile(Rig rig, const std::filesystem::path& file) {
    if (rig.environment.file.empty()) return rig;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    const std::filesystem::path relative =
        std::filesystem::path(rig.environment.file).lexically_relative(folder);
    const std::string text = relative.generic_string();
    if (!text.empty() && !text.starts_with("../../")) rig.environment.file = text;
    return rig;
}

void applySkin(Scene& scene, const std::vector<std::optional<SkinMaterial>>& skin) {
    bool changed = false;
    for (std::size_t i = 0; i < std::min(skin.size(), scene.materials.size()); ++i) {
        changed |= skin[i].has_value() != scene.materials[i].skin.has_value();
        scene.materials[i].skin = skin[i];
    }
    if (changed) findCharacters(scene);
}

std::vector<std::optional<SkinMaterial>> skinOf(const Scene& scene) {
    std::vector<std::optional<SkinMaterial>> skin;
    for (const Material& material : scene.materials) skin.push_back(material.skin);
    return skin;
}

}  // namespace cutis::app
