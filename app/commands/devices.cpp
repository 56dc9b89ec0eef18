// cutis devices: what there is to run on.
#include <cstdio>
#include <optional>

#include "app/command.h"
#include "renderer/core/error.h"
#include "renderer/gpu/device.h"

namespace cutis::app {
namespace {

// The device that cutis would take; none where it would find none that suits.
std::optional<std::uint32_t> chosenDevice() {
    try {
        return gpu::Device(gpu::DeviceOptions{}).info().index;
    } catch (const Error& error) {
        warn(error.what());
        return {};
    }
}

}  // namespace

int runDevices(const Request&) {
    const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
    const std::optional<std::uint32_t> chosen = chosenDevice();
    for (const gpu::DeviceInfo& device : devices) {
        std::printf("%c %u  %s  %s  %.1f GiB  %s", chosen == device.index ? '*' : ' ', device.index,
                    device.name.c_str(), device.type.c_str(), device.memoryBytes / 1073741824.0,
                    device.driver.c_str());
        if (!device.unsuitable.empty()) std::printf("  (unsuitable: %s)", device.unsuitable.c_str());
        std::putchar('\n');
    }
    if (!chosen) throw Error("no usable device", "none of the devices suits", "see the list");
    return 0;
}

}  // namespace cutis::app
