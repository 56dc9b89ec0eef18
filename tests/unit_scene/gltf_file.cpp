#include "gltf_file.h"

#include <cstdint>
#include <fstream>

namespace cutis::test {
namespace fs = std::filesystem;

int GltfFile::addViewJson(std::size_t offset, std::size_t bytes, int stride) {
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
    if (stride) json["bufferViews"].back()["byteStride"] = stride;
    return int(json["bufferViews"].size()) - 1;
}

int GltfFile::addAccessorJson(int view, const std::string& type, int componentType, std::size_t count,
                              const nlohmann::json& more) {
    nlohmann::json accessor = {{"type", type}, {"componentType", componentType}, {"count", count}};
    if (view >= 0) accessor["bufferView"] = view;
    accessor.update(more);
    json["accessors"].push_back(accessor);
    return int(json["accessors"].size()) - 1;
}

fs::path GltfFile::saveGlb(const fs::path& folder, const std::string& name) const {
    nlohmann::json whole = json;
    if (!binary.empty() && !whole.contains("buffers")) whole["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> chunk = binary;
    chunk.resize((chunk.size() + 3) / 4 * 4);
    std::string file;
    const auto put = [&](std::uint32_t word) { file.append(reinterpret_cast<const char*>(&word), 4); };
    file += "glTF", put(2), put(std::uint32_t(12 + 8 + text.size() + (chunk.empty() ? 0 : 8 + chunk.size())));
    put(std::uint32_t(text.size())), file += "JSON" + text;
    if (!chunk.empty()) {
        put(std::uint32_t(chunk.size()));
        file.append("BIN\0", 4).append(reinterpret_cast<const char*>(chunk.data()), chunk.size());
    }
    writeBytes(folder / name, file.data(), file.size());
    return folder / name;
}

fs::path GltfFile::saveSeparate(const fs::path& folder, const std::string& uri) const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", binary.size()}, {"uri", uri}}};
    writeBytes(folder / "scene.bin", binary.data(), binary.size());
    const std::string text = whole.dump();
    writeBytes(folder / "scene.gltf", text.data(), text.size());
    return folder / "scene.gltf";
}

fs::path GltfFile::saveEmbedded(const fs::path& folder) const {
    nlohmann::json whole = json;
    if (!binary.empty()) {
        whole["buffers"] = {{{"byteLength", binary.size()},
                             {"uri", "data:application/octet-stream;base64," + encodeBase64(binary)}}};
    }
    const std::string text = whole.dump();
    writeBytes(folder / "scene.gltf", text.data(), text.size());
    return folder / "scene.gltf";
}

std::string encodeBase64(const std::vector<std::byte>& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

void writeBytes(const fs::path& path, const void* data, std::size_t size) {
    std::ofstream out(path, std::ios::binary);
    out.write(static_cast<const char*>(data), std::streamsize(size));
    if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

GltfFile triangleFile() {
    GltfFile file;
    file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", kFloat, 3);
    file.addAccessor<std::uint16_t>({0, 1, 2}, "SCALAR", kUnsignedShort, 3);
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    file.json["scenes"] = {{{"nodes", {0}}}};
    return file;
}

}  // namespace cutis::test
