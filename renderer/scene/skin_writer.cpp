#include "renderer/scene/skin_writer.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/gltf_parts.h"
#include "renderer/scene/skin_material.h"

namespace cutis {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;  // keys stay in their order

// Of a .glb file (glTF 2.0, §4.4): three words of header, two of each chunk, JSON first.
constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t word;
    std::memcpy(&word, &bytes[at], sizeof word);
    return word;
}

void setWord(std::vector<std::byte>& bytes, std::size_t at, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    std::memcpy(&bytes[at], &word, sizeof word);
}

bool refersToFiles(const Json& root) {
    for (const char* list : {"buffers", "images"}) {
        if (!root.contains(list)) continue;
        for (const Json& entry : root[list]) {
            if (entry.contains("uri") && !entry["uri"].get<std::string>().starts_with("data:")) return true;
        }
    }
    return false;
}

void setSkin(Json& material, const std::optional<SkinMaterial>& skin, const std::string& file) {
    const bool marked = material.contains("extras") && material["extras"].contains("skin");
    if (!skin && !marked) return;
    if (material.contains("extras") && !material["extras"].is_object()) {
        throw Error("cannot write skin", "extras of a material is not an object", file);
    }
    material["extras"]["skin"] = skin ? Json(skinMaterialJson(*skin)) : Json(false);
}

}  // namespace

void writeSkinExtras(const Scene& scene, const fs::path& output) {
    const std::string file = scene.file.string();
    if (output.extension() != scene.file.extension()) {
        throw Error("cannot write skin",
                    "the output must be a " + scene.file.extension().string() + " file as the scene is",
                    output.string());
    }
    // Which material of the file each of the scene is; the loader has checked the file by then.
    gltf::Document document(scene.file);
    Scene nodes;
    gltf::readNodes(document, nodes);
    const std::vector<int> places = gltf::readMaterials(document, nodes).sceneMaterial;

    std::vector<std::byte> bytes = readFile(scene.file, gltf::kMaxFileBytes);
    const bool binary = scene.file.extension() == ".glb";
    const std::size_t begin = binary ? kFileHeader + kChunkHeader : 0;
    const std::size_t end = binary ? begin + wordAt(bytes, kFileHeader) : bytes.size();
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    Json root = Json::parse(text + begin, text + end);
    if (refersToFiles(root) && fs::absolute(output).parent_path() != fs::absolute(scene.file).parent_path()) {
        throw Error("cannot write skin",
                    "the scene refers to files beside it: the output must lie there as well",
                    output.string());
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] != gltf::kNone) setSkin(root["materials"][i], scene.materials[places[i]].skin, file);
    }
    std::string changed = root.dump(binary ? -1 : 2);
    if (!binary) return writeFileAtomically(output, changed + '\n');
    changed.resize((changed.size() + 3) / 4 * 4, ' ');
    const auto chunk = std::as_bytes(std::span(changed));
    std::vector<std::byte> result(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin));
    result.insert(result.end(), chunk.begin(), chunk.end());
    result.insert(result.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end());
    setWord(result, kFileHeader, chunk.size());
    setWord(result, 8, result.size());  // of the whole file
    writeFileAtomically(output, result);
}

}  // namespace cutis
