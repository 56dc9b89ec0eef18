// A glTF file opened: its JSON and its bytes, nothing interpreted yet. Used by the loader's own files only.
//
// The JSON is read with nlohmann::json rather than through tinygltf: Debian 12's version (2.7.0) reads past
// the end of a truncated .glb, recurses without bound, takes values of a wrong type for absent, loads images
// only as JPEG, PNG, BMP or GIF data, and its errors do not say where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/json_view.h"

namespace cutis::gltf {

// What a hostile file may make the loader allocate.
inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t(4) << 30;  // of each file
inline constexpr std::uint64_t kMaxDecodedBytes = kMaxFileBytes;        // of all vertex data; of all images

class Document {
  public:
    // Reads the file, checks the container, the version and the required extensions. Throws Error.
    explicit Document(const std::filesystem::path& file);
    ~Document();
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    const std::filesystem::path& file() const { return file_; }
    JsonView root() const;
    // Element `index` of the root's array `name` ("meshes"), and how many there are.
    JsonView entry(const char* name, std::size_t index) const;
    std::size_t count(const char* name) const;
    // The entry that a reference (a value that is an index into the root's array `name`) means.
    JsonView resolve(const JsonView& reference, const char* name) const;

    // The bytes of a buffer view, checked to lie within its buffer, decompressed where they are compressed. Loads the
    // buffer when it is used first.
    std::span<const std::byte> bufferView(std::size_t index);
    // The bytes of a URI value: a data URI's, or those of a file within the folder of the glTF file.
    std::vector<std::byte> readUri(const JsonView& uri) const;
    // The first bytes of it, at most so many.
    std::vector<std::byte> readUriStart(const JsonView& uri, std::uint64_t bytes) const;

    // The data of an accessor, tightly packed, that something else than a buffer view holds.
    void supply(std::size_t accessor, std::vector<std::byte> data) { supplied_[accessor] = std::move(data); }
    const std::vector<std::byte>* suppliedTo(std::size_t accessor) const {
        const auto found = supplied_.find(accessor);
        return found == supplied_.end() ? nullptr : &found->second;
    }

    // Counts bytes about to be allocated for vertex data; fails at `where` beyond kMaxDecodedBytes.
    void spend(std::uint64_t bytes, const JsonView& where);

  private:
    std::span<const std::byte> buffer(std::size_t index);
    // The bytes of a buffer that a value's `buffer`, `byteOffset` and `byteLength` mean.
    std::span<const std::byte> slice(const JsonView& view);
    // What EXT_meshopt_compression of a buffer view holds; in gltf_meshopt.cpp.
    std::vector<std::byte> decodeMeshopt(const JsonView& extension);
    void parse(std::span<const std::byte> text);
    void checkHead() const;
    void openContainer();
    void checkExtensions() const;
    std::filesystem::path fileOfUri(const JsonView& uri) const;

    std::filesystem::path file_;
    JsonSource source_;
    std::unique_ptr<nlohmann::json> json_;
    std::vector<std::byte> bytes_;            // the file itself; a .glb's binary chunk stays in it
    std::span<const std::byte> binaryChunk_;  // of bytes_
    std::vector<std::optional<std::vector<std::byte>>> buffers_;  // loaded ones outside the binary chunk
    std::map<std::size_t, std::vector<std::byte>> decoded_;       // per buffer view that is compressed
    std::map<std::size_t, std::vector<std::byte>> supplied_;      // per accessor
    std::uint64_t loaded_ = 0;  // bytes of buffers_
    std::uint64_t spent_ = 0;
};

}  // namespace cutis::gltf
