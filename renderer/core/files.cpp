#include "renderer/core/files.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>

#include "renderer/core/error.h"

namespace cutis {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kCacheMagic = 0x0001737474756375u;  // format 1; change it when the header changes

struct CacheHeader {
    std::uint64_t magic, key, bytes, checksum;
};

std::string reason(int error) {
    return error ? std::strerror(error) : "input/output error";
}

fs::path temporaryBeside(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    std::string name = ".";
    name +=
        path.stem().string() + "." + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
    // The extension stays last: image writers choose their format by it.
    return path.parent_path() / (name + path.extension().string());
}

// Temporary files of the writes under way. Never destroyed: a signal may come during exit.
struct UnfinishedWrites {
    std::mutex mutex;
    std::set<fs::path> files;
};
UnfinishedWrites& unfinishedWrites() {
    static UnfinishedWrites& writes = *new UnfinishedWrites;
    return writes;
}

// A file name that is known while it lives; the file is gone afterwards, unless it was renamed.
class TemporaryFile {
  public:
    explicit TemporaryFile(fs::path file) : file_(std::move(file)) {
        const std::lock_guard lock(unfinishedWrites().mutex);
        unfinishedWrites().files.insert(file_);
    }
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(file_, ignored);
        const std::lock_guard lock(unfinishedWrites().mutex);
        unfinishedWrites().files.erase(file_);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const fs::path& path() const { return file_; }

  private:
    fs::path file_;
};

// Throws Error unless it is a regular file.
std::uint64_t sizeOfFile(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw Error("cannot read file", "no such file", path.string());
    if (!fs::is_regular_file(status)) throw Error("cannot read file", "not a regular file", path.string());
    const std::uint64_t size = fs::file_size(path, error);
    if (error) throw Error("cannot read file", error.message(), path.string());
    return size;
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& path, std::uint64_t maxBytes) {
    const std::uint64_t size = sizeOfFile(path);
    if (size > maxBytes) {
        throw Error("cannot read file",
                    "it has " + std::to_string(size) + " bytes, the limit is " + std::to_string(maxBytes),
                    path.string());
    }
    return readFileStart(path, size);
}

std::vector<std::byte> readFileStart(const fs::path& path, std::uint64_t most) {
    std::vector<std::byte> bytes(std::min(sizeOfFile(path), most));
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in || !in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
        throw Error("cannot read file", reason(errno), path.string());
    return bytes;
}

fs::path placeToWrite(const fs::path& path) {
    std::error_code error;
    const fs::path place = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
    const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) throw Error("cannot write file", "no such folder", folder.string());
    if (fs::is_directory(place, error)) throw Error("cannot write file", "it is a folder", path.string());
    if (fs::exists(place, error) && !fs::is_regular_file(place, error))
        throw Error("cannot write file", "not a regular file", path.string());
    return place;
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    const fs::path place = placeToWrite(path);
    const TemporaryFile temporary(temporaryBeside(place));
    write(temporary.path());
    std::error_code error;
    fs::rename(temporary.path(), place, error);
    if (error) throw Error("cannot write file", error.message(), path.string());
}

void discardTemporaryFiles() {
    unfinishedWrites().mutex.lock();
    std::error_code ignored;
    for (const fs::path& file : unfinishedWrites().files) fs::remove(file, ignored);
}

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
    writeFileAtomically(path, [&](const fs::path& temporary) {
        errno = 0;
        std::ofstream out(temporary, std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out) throw Error("cannot write file", reason(errno), path.string());
    });
}

void writeFileAtomically(const fs::path& path, const std::string& text) {
    writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

fs::path cacheFolder() {
    fs::path folder;
    if (const char* own = std::getenv("CUTIS_CACHE_DIR"); own && *own) {
        folder = own;
    } else if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) {
        folder = fs::path(xdg) / "cutis";
    } else if (const char* home = std::getenv("HOME"); home && *home) {
        folder = fs::path(home) / ".cache" / "cutis";
    } else {
        return {};
    }
    std::error_code error;
    fs::create_directories(folder, error);
    return error ? fs::path{} : folder;
}

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    constexpr std::uint64_t kPrime = 0x100000001b3u;
    std::uint64_t hash = seed;
    // Eight bytes a step: the byte-wise loop is a serial chain of multiplications, too slow for 100 MB
    // scenes.
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t word;
        std::memcpy(&word, bytes.data() + i, 8);
        hash = (hash ^ word) * kPrime;
        hash ^= hash >> 29;
    }
    for (; i < bytes.size(); ++i) hash = (hash ^ static_cast<std::uint64_t>(bytes[i])) * kPrime;
    return (hash ^ bytes.size()) * kPrime;
}

std::vector<std::byte> readCache(const std::string& kind, std::uint64_t key) {
    const fs::path folder = cacheFolder();
    if (folder.empty()) return {};
    char name[32];
    std::snprintf(name, sizeof name, "-%016llx.bin", static_cast<unsigned long long>(key));
    const fs::path path = folder / (kind + name);
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return {};
    try {
        std::vector<std::byte> bytes = readFile(path);
        CacheHeader header{};
        if (bytes.size() < sizeof header) return {};
        std::memcpy(&header, bytes.data(), sizeof header);
        const std::span payload = std::span(bytes).subspan(sizeof header);
        if (header.magic != kCacheMagic || header.key != key || header.bytes != payload.size() ||
            header.checksum != hashBytes(payload)) {
            return {};
        }
        return {payload.begin(), payload.end()};
    } catch (const Error&) {
        return {};
    }
}

void writeCache(const std::string& kind, std::uint64_t key, std::span<const std::byte> payload) {
    const fs::path folder = cacheFolder();
    if (folder.empty()) return;
    const CacheHeader header{kCacheMagic, key, payload.size(), hashBytes(payload)};
    std::vector<std::byte> bytes(sizeof header + payload.size());
    std::memcpy(bytes.data(), &header, sizeof header);
    std::copy(payload.begin(), payload.end(), bytes.begin() + sizeof header);
    char name[32];
    std::snprintf(name, sizeof name, "-%016llx.bin", static_cast<unsigned long long>(key));
    try {
        writeFileAtomically(folder / (kind + name), bytes);
    } catch (const Error&) {
        // A cache that cannot be written costs time at the next start, nothing else.
    }
}

}  // namespace cutis
