#include "renderer/measure/front.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "renderer/core/error.h"
#include "renderer/scene/json_view.h"

namespace cutis {
namespace {

constexpr int kMaxSide = 16384;     // pixels of a picture, and texels of an atlas
constexpr int kMaxLightMap = 8192;  // texels
constexpr double kMaxError = 1e6;   // relative; beyond it a row says nothing
constexpr double kMaxTime = 1e9;    // milliseconds

// A field of a setting as reports write it: "auto" or a number.
int readField(const JsonView& row, const char* key, int automatic) {
    const JsonView field = row.member(key);
    const std::string text = field.string();
    if (text == "auto") return automatic;
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > kMaxSide)
        field.fail("must be auto or a whole number up to " + std::to_string(kMaxSide));
    return value;
}

double readNumber(const JsonView& row, const char* key, double max) {
    const double value = row.member(key).number();
    if (value < 0 || value > max) row.member(key).fail("must be from 0 to " + std::to_string(max));
    return value;
}

std::string readChoice(const JsonView& row, const char* key, const char* first, const char* second) {
    const std::string text = row.member(key).string();
    if (text != first && text != second)
        row.member(key).fail(std::string("must be ") + first + " or " + second);
    return text;
}

Setting readMeasuredSetting(const JsonView& row) {
    Setting setting;
    setting.name = row.member("name").string();
    setting.irradianceSize = readField(row, "irradiance_size", 0);
    setting.gaussians = readField(row, "gaussians", 0);
    setting.lightMapSize = readField(row, "light_map_size", 0);
    setting.areaSamples = readField(row, "area_samples", 0);
    setting.environmentSamples = readField(row, "environment_samples", -1);
    setting.merge = readChoice(row, "merge", "min", "opposite");
    setting.chain = readChoice(row, "chain", "exact", "published");
    setting.taps = row.find("taps") ? readField(row, "taps", 0) : 0;  // older reports have none
    setting.lights = readField(row, "lights", 0);
    setting.characters = readField(row, "characters", 0);
    return setting;
}

}  // namespace

MeasuredFront readFront(const std::string& text, const std::string& file) {
    const JsonSource source{"cannot read measurement", file};
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception&) {
        throw Error(source.what, "it is not JSON", source.file);
    }
    const JsonView root(json, source);
    if (root.member("cutis_measure").integer() != 1) root.member("cutis_measure").fail("must be 1");
    MeasuredFront front;
    front.device = root.member("device").string();
    front.width = static_cast<int>(root.member("width").index(kMaxSide + 1, "pixels"));
    front.height = static_cast<int>(root.member("height").index(kMaxSide + 1, "pixels"));
    if (front.width == 0 || front.height == 0) root.member("width").fail("must not be 0");
    for (const JsonView& row : root.member("settings").elements()) {
        if (row.find("failure")) continue;
        const Setting setting = readMeasuredSetting(row);
        if (setting.lights > 0 || setting.characters > 0) continue;
        if (readNumber(row, "nonfinite", kMaxError) > 0) continue;
        front.settings.push_back({setting,
                                  readNumber(row, "diffuse_rel_l2", kMaxError) +
                                      2 * readNumber(row, "diffuse_rel_l2_stderr", kMaxError),
                                  readNumber(row, "gpu_ms", kMaxTime)});
    }
    return front;
}

const MeasuredSetting* cheapestWithin(const MeasuredFront& front, double tolerance) {
    const MeasuredSetting* found = nullptr;
    for (const MeasuredSetting& measured : front.settings) {
        if (measured.error > tolerance) continue;
        if (!found || measured.milliseconds < found->milliseconds) found = &measured;
    }
    return found;
}

const MeasuredSetting* closest(const MeasuredFront& front) {
    const auto found = std::min_element(
        front.settings.begin(), front.settings.end(),
        [](const MeasuredSetting& a, const MeasuredSetting& b) { return a.error < b.error; });
    return found == front.settings.end() ? nullptr : &*found;
}

Setting settingForSize(const Setting& setting, const MeasuredFront& front, int width, int height) {
    const double pixels = static_cast<double>(width) * height;
    const double finer = std::max(1.0, std::sqrt(pixels / (static_cast<double>(front.width) * front.height)));
    Setting scaled = setting;
    scaled.irradianceSize = std::min(static_cast<int>(std::lround(setting.irradianceSize * finer)), kMaxSide);
    scaled.lightMapSize = std::min(static_cast<int>(std::lround(setting.lightMapSize * finer)), kMaxLightMap);
    return scaled;
}

}  // namespace cutis
