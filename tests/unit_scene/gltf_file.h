// glTF files made in code, right or wrong as a test wants them.
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cutis::test {

enum : int {
    kByte = 5120,
    kUnsignedByte = 5121,
    kShort = 5122,
    kUnsignedShort = 5123,
    kUnsignedInt = 5125,
    kFloat = 5126
};

struct GltfFile {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> binary;  // buffer 0

    // Appends values as a buffer view of their own; returns its index.
    template <typename T>
    int addView(const std::vector<T>& values, int stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4);
        const std::size_t offset = binary.size(), bytes = values.size() * sizeof(T);
        binary.resize(offset + bytes);
        std::memcpy(binary.data() + offset, values.data(), bytes);
        return addViewJson(offset, bytes, stride);
    }
    // Appends values as an accessor of `count` elements; `more` is merged into its JSON. Returns its index.
    template <typename T>
    int addAccessor(const std::vector<T>& values, const std::string& type, int componentType,
                    std::size_t count, const nlohmann::json& more = nlohmann::json::object()) {
        return addAccessorJson(addView(values), type, componentType, count, more);
    }
    int addAccessorJson(int view, const std::string& type, int componentType, std::size_t count,
                        const nlohmann::json& more = nlohmann::json::object());

    // A file of the given name in the folder: .glb, .gltf with NAME.bin beside it, or .gltf with all data in
    // it.
    std::filesystem::path saveGlb(const std::filesystem::path& folder,
                                  const std::string& name = "scene.glb") const;
    std::filesystem::path saveSeparate(const std::filesystem::path& folder,
                                       const std::string& uri = "scene.bin") const;
    std::filesystem::path saveEmbedded(const std::filesystem::path& folder) const;

  private:
    int addViewJson(std::size_t offset, std::size_t bytes, int stride);
};

std::string encodeBase64(const std::vector<std::byte>& bytes);
void writeBytes(const std::filesystem::path& path, const void* data, std::size_t size);

// One node with one mesh of one triangle (0,0,0) (1,0,0) (0,1,0) with indices: accessor 0 positions, accessor
// 1 indices.
GltfFile triangleFile();

}  // namespace cutis::test
