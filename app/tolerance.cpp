#include "app/tolerance.h"

#include <cstdio>
#include <optional>
#include <span>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/reference/reference.h"

namespace cutis::app {
namespace {

constexpr const char* kCacheKind = "measurement";

std::uint64_t measurementKey(const Inputs& inputs, const gpu::DeviceInfo& device) {
    const reference::Input subject{.scene = &inputs.scene,
                                   .rig = inputs.rig,
                                   .environment = inputs.environment ? &*inputs.environment : nullptr,
                                   .camera = inputs.camera};
    return hashBytes(std::as_bytes(std::span(device.name)), reference::subjectKey(subject));
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
    return text;
}

}  // namespace

void recordMeasurement(const Inputs& inputs, const gpu::DeviceInfo& device, const std::string& measureJson) {
    writeCache(kCacheKind, measurementKey(inputs, device), std::as_bytes(std::span(measureJson)));
}

KnownFront knownFront(const Inputs& inputs, const gpu::DeviceInfo& device) {
    const std::vector<std::byte> recorded = readCache(kCacheKind, measurementKey(inputs, device));
    if (recorded.empty()) return {defaultFront(), false};
    try {
        return {readFront({reinterpret_cast<const char*>(recorded.data()), recorded.size()},
                          (cacheFolder() / kCacheKind).string()),
                true};
    } catch (const Error&) {  // whole, but of another version: the next measurement replaces it
        return {defaultFront(), false};
    }
}

bool anyMeasurement() {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(cacheFolder(), error))
        if (entry.path().filename().string().starts_with(kCacheKind)) return true;
    return false;
}

std::string KnownFront::where() const {
    return std::string(ofThisScene ? "this scene" : "the default scene") + " at " +
           std::to_string(front.width) + "x" + std::to_string(front.height) + " on " + front.device;
}

void applyTolerance(double tolerance, Inputs& inputs, const gpu::DeviceInfo& device,
                    RenderSettings& settings) {
    const KnownFront known = knownFront(inputs, device);
    const MeasuredFront& front = known.front;
    const std::string where = known.where();
    const std::string hint =
        known.ofThisScene ? "" : "; cutis measure of this scene would tell what holds for it";
    const MeasuredSetting* chosen = cheapestWithin(front, tolerance);
    if (!chosen) {
        const MeasuredSetting* best = closest(front);
        throw Error("no setting is within " + percent(tolerance),
                    best ? "of those measured on " + where + " the closest, '" + best->setting.name +
                               "', is within " + percent(best->error) + hint
                         : "nothing was measured on " + where,
                    "--tolerance");
    }
    std::fprintf(stderr, "cutis: --tolerance %s: taking '%s', measured on %s: within %s in %.3g ms%s\n",
                 percent(tolerance).c_str(), chosen->setting.name.c_str(), where.c_str(),
                 percent(chosen->error).c_str(), chosen->milliseconds, hint.c_str());
    const Setting setting = settingForSize(chosen->setting, front, settings.width, settings.height);
    applySetting(setting, inputs.scene, inputs.rig, settings);
}

}  // namespace cutis::app
