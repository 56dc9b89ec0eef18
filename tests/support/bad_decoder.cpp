// A library for LD_PRELOAD that does to `cutis-codec` what a hostile file does that has found a fault in a
// decoder. CUTIS_BAD_DECODER: zlib's inflate, which PNG files need, is to "spin" or to "crash", or the
// program is to "end" as soon as it starts. In other programs nothing changes.
#include <dlfcn.h>
#include <errno.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>

namespace {

bool shall(const char* what) {
    const char* kind = std::getenv("CUTIS_BAD_DECODER");
    return kind && std::strcmp(kind, what) == 0 &&
           std::strcmp(program_invocation_short_name, "cutis-codec") == 0;
}

__attribute__((constructor)) void start() {
    if (shall("end")) ::_exit(1);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int inflate(void* stream, int flush) {
    if (shall("crash")) std::raise(SIGSEGV);
    for (volatile bool spins = shall("spin"); spins;) {
    }
    using Inflate = int (*)(void*, int);
    static const auto real = reinterpret_cast<Inflate>(::dlsym(RTLD_NEXT, "inflate"));
    return real(stream, flush);
}
