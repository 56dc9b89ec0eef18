#include "fuzz.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "renderer/core/error.h"

namespace cutis::fuzz {
namespace fs = std::filesystem;
namespace {

// Removed with all it holds at the program's end.
struct Folder {
    Folder() { fs::create_directories(path); }
    ~Folder() {
        std::error_code error;
        fs::remove_all(path, error);
    }
    fs::path path = fs::path("/dev/shm") / ("cutis-fuzz-" + std::to_string(::getpid()));
};

}  // namespace

void expectCleanly(const std::function<void()>& load) {
    // Warnings would fill the terminal.
    setWarningSink([](const std::string&) {});
    try {
        load();
    } catch (const Error& error) {
        if (std::string(error.what()).find('\n') == std::string::npos) return;
        std::fprintf(stderr, "a message of several lines: %s\n", error.what());
        std::abort();
    }
}

fs::path inputFile(std::span<const std::uint8_t> input, const char* name) {
    static const Folder folder;
    const fs::path path = folder.path / name;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
    return path;
}

}  // namespace cutis::fuzz
