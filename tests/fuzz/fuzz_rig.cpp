// Rig files. One that loads must be written and read again as the same rig.
#include <cstdlib>

#include "fuzz.h"
#include "renderer/scene/rig.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cutis;
    fuzz::expectCleanly([&] {
        const Rig rig = parseRig(std::string(reinterpret_cast<const char*>(data), size), "input.rig.json");
        const std::string text = rigToJson(rig);
        if (rigToJson(parseRig(text, "written.rig.json")) != text) std::abort();
    });
    return 0;
}
