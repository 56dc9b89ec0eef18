#include "renderer/scene/codec_module.h"

#include <dlfcn.h>

#include <filesystem>

#include "renderer/core/error.h"

namespace cutis {
namespace fs = std::filesystem;
namespace {

fs::path modulePath() {
    const fs::path built = CUTIS_IMAGE_CODEC;
    std::error_code error;
    const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / built.filename();
    return fs::exists(beside, error) ? beside : built;
}

const ImageCodec& loadCodec() {
    const fs::path path = modulePath();
    // Lazy: resolving the calls of 250 libraries at once is a fifth of the time that loading them takes.
    void* module = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* entry = module ? ::dlsym(module, "cutisImageCodec") : nullptr;
    if (!entry) throw Error("cannot load the image codec", ::dlerror(), path.string());
    return *reinterpret_cast<const ImageCodec* (*)()>(entry)();
}

}  // namespace

const ImageCodec& imageCodec() {
    static const ImageCodec& codec = loadCodec();
    return codec;
}

}  // namespace cutis
