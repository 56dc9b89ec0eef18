// Files that were opened last, one a line in the cache folder.
#include <algorithm>
#include <sstream>

#include "app/viewer/actions.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxRecent = 10;
constexpr std::uint64_t kMaxBytes = 1 << 16;

fs::path listFile() {
    const fs::path folder = cacheFolder();
    return folder.empty() ? folder : folder / "recent.txt";
}

}  // namespace

std::vector<fs::path> loadRecentFiles() {
    std::vector<fs::path> files;
    std::error_code error;
    if (listFile().empty() || !fs::is_regular_file(listFile(), error)) return files;
    try {
        const std::vector<std::byte> bytes = readFile(listFile(), kMaxBytes);
        std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        for (std::string line; std::getline(lines, line) && files.size() < kMaxRecent;)
            if (!line.empty()) files.emplace_back(line);
    } catch (const Error&) {  // no list is not worth a message
    }
    return files;
}

void rememberFile(Session& session, const fs::path& file) {
    const fs::path whole = fs::absolute(file).lexically_normal();
    std::erase(session.recent, whole);
    session.recent.insert(session.recent.begin(), whole);
    session.recent.resize(std::min(session.recent.size(), kMaxRecent));
    if (listFile().empty()) return;
    std::string text;
    for (const fs::path& recent : session.recent) text += recent.string() + '\n';
    try {
        writeFileAtomically(listFile(), text);
    } catch (const Error&) {  // a full disk must not disturb the work
    }
}

}  // namespace cutis::app
