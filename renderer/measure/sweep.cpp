#include "renderer/measure/sweep.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/measure/variants.h"
#include "renderer/scene/json_view.h"

namespace cutis {
namespace {

constexpr int kMaxAtlas = 16384, kMaxGaussians = 32, kMaxTaps = 64, kMaxLightMap = 8192, kMaxSamples = 4096,
              kMaxCopies = 512;
constexpr std::uint64_t kMaxSweepBytes = std::uint64_t(1) << 20;
constexpr std::size_t kMaxSettings = 1000;

std::string textOf(int value, int automatic) {
    return value == automatic ? "auto" : std::to_string(value);
}

// The default first, then one thing at a time, then what a hurry combines.
std::vector<Setting> qualitySweep() {
    std::vector<Setting> settings{{.name = "default"}};
    for (int size : {256, 512, 768, 1024, 2048}) {
        settings.push_back({.name = "atlas " + std::to_string(size), .irradianceSize = size});
    }
    for (int k : {1, 2, 3, 4, 5}) {
        settings.push_back(
            {.name = std::to_string(k) + (k == 1 ? " gaussian" : " gaussians"), .gaussians = k});
    }
    for (int taps : {1, 3, 6, 24}) {
        settings.push_back({.name = std::to_string(taps) + (taps == 1 ? " tap" : " taps"), .taps = taps});
    }
    for (int size : {256, 512, 2048}) {
        settings.push_back({.name = "light maps " + std::to_string(size), .lightMapSize = size});
    }
    for (int samples : {1, 4, 16}) {
        settings.push_back({.name = "area lights in " + std::to_string(samples), .areaSamples = samples});
    }
    for (int samples : {8, 32}) {
        settings.push_back(
            {.name = "environment in " + std::to_string(samples), .environmentSamples = samples});
    }
    settings.push_back({.name = "merge opposite", .merge = "opposite"});
    settings.push_back({.name = "published chain", .chain = "published"});
    settings.push_back(
        {.name = "draft", .irradianceSize = 512, .gaussians = 3, .lightMapSize = 512, .areaSamples = 1});
    settings.push_back(
        {.name = "fast", .irradianceSize = 768, .gaussians = 4, .lightMapSize = 512, .areaSamples = 4});
    settings.push_back({.name = "fine", .irradianceSize = 2048, .lightMapSize = 2048, .areaSamples = 16});
    return settings;
}

std::vector<Setting> doubling(int from, int to, const char* what, int Setting::*field) {
    std::vector<Setting> settings;
    for (int value = from; value <= to; value *= 2) {
        Setting setting;
        setting.name = std::to_string(value) + what + (value == 1 ? "" : "s");
        setting.*field = value;
        settings.push_back(setting);
    }
    return settings;
}

int readInteger(const JsonView& entry, const char* key, int fallback, int min, int max) {
    const auto value = entry.find(key);
    if (!value) return fallback;
    const std::int64_t number = value->integer();
    if (number < min || number > max) {
        value->fail("must be from " + std::to_string(min) + " to " + std::to_string(max));
    }
    return static_cast<int>(number);
}

Setting readSetting(const JsonView& entry, std::set<std::string>& names) {
    entry.allowOnly({"name", "irradiance_size", "gaussians", "light_map_size", "area_samples",
                     "environment_samples", "merge", "chain", "taps", "lights", "characters"});
    Setting setting;
    setting.name = entry.member("name").string();
    if (setting.name.empty() || setting.name.size() > 100)
        entry.member("name").fail("must have 1 to 100 characters");
    if (!names.insert(setting.name).second) entry.member("name").fail("another setting has this name");
    setting.irradianceSize = readInteger(entry, "irradiance_size", 0, 1, kMaxAtlas);
    setting.gaussians = readInteger(entry, "gaussians", 0, 1, kMaxGaussians);
    setting.lightMapSize = readInteger(entry, "light_map_size", 0, 16, kMaxLightMap);
    setting.areaSamples = readInteger(entry, "area_samples", 0, 1, kMaxSamples);
    setting.environmentSamples = readInteger(entry, "environment_samples", -1, 0, kMaxSamples);
    setting.taps = readInteger(entry, "taps", 0, 1, kMaxTaps);
    setting.lights = readInteger(entry, "lights", 0, 1, kMaxCopies);
    setting.characters = readInteger(entry, "characters", 0, 1, kMaxCopies);
    setting.merge = entry.string("merge", "min");
    if (setting.merge != "min" && setting.merge != "opposite")
        entry.member("merge").fail("must be min or opposite");
    setting.chain = entry.string("chain", "exact");
    if (setting.chain != "exact" && setting.chain != "published")
        entry.member("chain").fail("must be exact or published");
    return setting;
}

}  // namespace

bool Setting::sameSubject(const Setting& other) const {
    return lights == other.lights && characters == other.characters;
}

const std::vector<SettingField>& settingFields() {
    static const std::vector<SettingField> fields{
        {"irradiance_size", [](const Setting& s) { return textOf(s.irradianceSize, 0); }},
        {"gaussians", [](const Setting& s) { return textOf(s.gaussians, 0); }},
        {"light_map_size", [](const Setting& s) { return textOf(s.lightMapSize, 0); }},
        {"area_samples", [](const Setting& s) { return textOf(s.areaSamples, 0); }},
        {"environment_samples", [](const Setting& s) { return textOf(s.environmentSamples, -1); }},
        {"merge", [](const Setting& s) { return s.merge; }},
        {"chain", [](const Setting& s) { return s.chain; }},
        {"taps", [](const Setting& s) { return textOf(s.taps, 0); }},
        {"lights", [](const Setting& s) { return textOf(s.lights, 0); }},
        {"characters", [](const Setting& s) { return textOf(s.characters, 0); }},
    };
    return fields;
}

const std::vector<std::string>& sweepNames() {
    static const std::vector<std::string> names{"quality", "lights", "characters", "size"};
    return names;
}

std::vector<Setting> builtInSweep(const std::string& name) {
    if (name == "quality") return qualitySweep();
    if (name == "lights") return doubling(1, 64, " light", &Setting::lights);
    if (name == "characters") return doubling(1, 16, " character", &Setting::characters);
    if (name == "size") return doubling(256, 8192, " texel", &Setting::irradianceSize);
    throw std::invalid_argument("no sweep is named " + name);
}

std::vector<Setting> loadSweep(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = readFile(file, kMaxSweepBytes);
    const JsonSource source{"cannot load sweep", file.string()};
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(reinterpret_cast<const char*>(bytes.data()),
                                     reinterpret_cast<const char*>(bytes.data()) + bytes.size());
    } catch (const nlohmann::json::exception&) {
        throw Error(source.what, "it is not JSON", source.file);
    }
    const JsonView root(json, source);
    root.allowOnly({"cutis_sweep", "settings"});
    if (root.member("cutis_sweep").integer() != 1) root.member("cutis_sweep").fail("must be 1");
    const std::vector<JsonView> entries = root.member("settings").elements();
    if (entries.empty() || entries.size() > kMaxSettings) {
        root.member("settings").fail("must hold 1 to " + std::to_string(kMaxSettings) + " settings");
    }
    std::vector<Setting> settings;
    std::set<std::string> names;
    for (const JsonView& entry : entries) settings.push_back(readSetting(entry, names));
    return settings;
}

void applySetting(const Setting& setting, Scene& scene, Rig& rig, RenderSettings& quality) {
    if (setting.characters > 0) repeatCharacters(scene, setting.characters);
    if (setting.lights > 0) repeatLights(rig, scene, setting.lights);
    quality.irradianceSize = setting.irradianceSize;
    quality.gaussians = setting.gaussians;
    quality.lightMapSize = setting.lightMapSize;
    quality.merge = setting.merge == "opposite" ? Merge::opposite : Merge::min;
    quality.chain = setting.chain == "published" ? Chain::published : Chain::exact;
    if (setting.taps > 0) quality.taps = setting.taps;
    for (Light& light : rig.lights) {
        const bool area = light.type == LightType::rect || light.radius > 0;
        if (area && setting.areaSamples > 0) light.samples = setting.areaSamples;
    }
    if (setting.environmentSamples >= 0) rig.environment.shadowSamples = setting.environmentSamples;
}

}  // namespace cutis
