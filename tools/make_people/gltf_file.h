// A glTF 2.0 file with one external buffer and external images, written the same way every time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh.h"

namespace cutis::people {

class GltfFile {
  public:
    GltfFile();

    // Each returns the new element's index.
    int addTexture(const std::string& imageUri, bool repeat = false);
    int addMaterial(const nlohmann::ordered_json& material);
    int addMesh(const std::string& name, const TriangleMesh& mesh, int material);
    int addCamera(const std::string& name, double yfov);
    int addNode(const nlohmann::ordered_json& node) { return add("nodes", node); }
    void setRoots(const std::vector<int>& nodes, const std::string& sceneName);
    void setCopyright(const std::string& text);

    // Writes `path` and the buffer beside it (same stem, .bin). Throws Error.
    void write(const std::filesystem::path& path);

  private:
    int add(const char* list, const nlohmann::ordered_json& element);
    int addAccessor(const std::vector<float>& values, int components, bool bounds);
    int addView(const void* data, std::size_t bytes, int target);

    nlohmann::ordered_json root_;
    std::vector<std::byte> buffer_;
};

}  // namespace cutis::people
