// Files read whole, files written whole or not at all, and the cache folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cutis {

// The bytes of a regular file. Throws Error when it is absent, unreadable or larger than maxBytes.
std::vector<std::byte> readFile(const std::filesystem::path& path, std::uint64_t maxBytes = std::uint64_t(8) << 30);
// Its first bytes, all where it has fewer: to see whether it is worth reading, before gigabytes of nothing are.
std::vector<std::byte> readFileStart(const std::filesystem::path& path, std::uint64_t bytes);

// Where what is written to `path` will lie: there, or where a link leads, which stays a link. Throws Error where its
// folder does not exist or something lies there that is no file to replace: a folder, a device, a pipe.
std::filesystem::path placeToWrite(const std::filesystem::path& path);

// Writes beside `path` and renames, so that a reader sees the old file or the new one, never a part.
// `write` gets the temporary path (same folder, same extension) and must create it. Throws Error and leaves no debris.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write);
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& path, const std::string& text);

// Removes what writes under way have written so far. Only for a program that ends at once (a signal): no further
// write starts or ends afterwards.
void discardTemporaryFiles();

// $CUTIS_CACHE_DIR, else $XDG_CACHE_HOME/cutis, else ~/.cache/cutis; created on demand. Empty when none can be made:
// caching is then off, never an error.
std::filesystem::path cacheFolder();

// FNV-1a over bytes, for naming cache entries by content; chain calls through `seed`.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = 0xcbf29ce484222325u);

// A cache entry's payload, or empty when it is absent or damaged (entries carry their own checksum).
std::vector<std::byte> readCache(const std::string& kind, std::uint64_t key);
// Best effort: a full or read-only disk leaves no entry and no error.
void writeCache(const std::string& kind, std::uint64_t key, std::span<const std::byte> payload);

}  // namespace cutis
