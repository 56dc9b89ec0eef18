// glTF files, .gltf and .glb alike (the loader goes by content).
#include "fuzz.h"
#include "renderer/scene/gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cutis;
    fuzz::expectCleanly([&] {
        // Images are another target's.
        loadGltf(fuzz::inputFile({data, size}, "input.gltf"), {.skin = {}, .images = false});
    });
    return 0;
}
