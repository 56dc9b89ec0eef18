#include "app/output_folder.h"

#include <unistd.h>

#include <fstream>
#include <iterator>

#include "renderer/core/error.h"

namespace cutis::app {
namespace fs = std::filesystem;

void prepareOutputFolder(const fs::path& folder, const std::string& marker) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error))
        throw Error("cannot write report", "it is not a folder", folder.string());
    if (fs::is_directory(folder, error)) {
        if (!fs::is_empty(folder, error) && !fs::exists(folder / marker, error))
            throw Error("cannot write report", "the folder holds other files", folder.string());
    } else if (!fs::create_directory(folder, error)) {
        throw Error("cannot write report", error ? error.message() : "no such folder", folder.string());
    }
    if (access(folder.c_str(), W_OK) != 0)
        throw Error("cannot write report", "the folder is not writable", folder.string());
}

std::string commandLine() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    const std::string words((std::istreambuf_iterator<char>(file)), {});
    std::string line, word;
    bool first = true;
    for (char c : words) {
        if (c != '\0') {
            word += c;
            continue;
        }
        if (first) word = fs::path(word).filename().string();
        first = false;
        constexpr const char* kPlain =
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,%@";
        const bool plain = !word.empty() && word.find_first_not_of(kPlain) == std::string::npos;
        line += line.empty() ? "" : " ";
        if (plain) {
            line += word;
        } else {
            line += '\'';
            for (char w : word) line += w == '\'' ? std::string("'\\''") : std::string(1, w);
            line += '\'';
        }
        word.clear();
    }
    return line;
}

}  // namespace cutis::app
