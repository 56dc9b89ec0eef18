#include "gltf_file.h"

#include <algorithm>
#include <cstring>

#include "renderer/core/files.h"

namespace cutis::people {
namespace {

using nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertexTarget = 34962, kIndexTarget = 34963;

template <class Vector>
std::vector<float> flatten(const std::vector<Vector>& values) {
    std::vector<float> out;
    for (const Vector& v : values)
        for (int k = 0; k < Vector::length(); ++k) out.push_back(float(v[k]));
    return out;
}

}  // namespace

GltfFile::GltfFile() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "cutis make_people"}};
}

int GltfFile::add(const char* list, const ordered_json& element) {
    root_[list].push_back(element);
    return int(root_[list].size()) - 1;
}

int GltfFile::addView(const void* data, std::size_t bytes, int target) {
    const std::size_t offset = buffer_.size();
    buffer_.resize(offset + (bytes + 3) / 4 * 4);
    std::memcpy(&buffer_[offset], data, bytes);
    return add("bufferViews",
               {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", target}});
}

int GltfFile::addAccessor(const std::vector<float>& values, int components, bool bounds) {
    constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const int view = addView(values.data(), values.size() * sizeof(float), kVertexTarget);
    ordered_json accessor = {{"bufferView", view},
                             {"componentType", kFloat},
                             {"count", values.size() / components},
                             {"type", kTypes[components]}};
    if (bounds) {
        std::vector<float> low(values.begin(), values.begin() + components), high = low;
        for (std::size_t i = 0; i < values.size(); ++i) {
            low[i % components] = std::min(low[i % components], values[i]);
            high[i % components] = std::max(high[i % components], values[i]);
        }
        accessor["min"] = low;
        accessor["max"] = high;
    }
    return add("accessors", accessor);
}

int GltfFile::addTexture(const std::string& imageUri, bool repeat) {
    if (!root_.contains("samplers")) {
        constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClamp = 33071, kRepeat = 10497;
        for (const int wrap : {kClamp, kRepeat})
            add("samplers", {{"magFilter", kLinear},
                             {"minFilter", kLinearMipmapLinear},
                             {"wrapS", wrap},
                             {"wrapT", wrap}});
    }
    return add("textures", {{"sampler", repeat ? 1 : 0}, {"source", add("images", {{"uri", imageUri}})}});
}

int GltfFile::addMaterial(const ordered_json& material) {
    const ordered_json extensions = material.value("extensions", ordered_json::object());
    for (const auto& [name, value] : extensions.items()) {
        ordered_json& used = root_["extensionsUsed"];
        if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
    }
    return add("materials", material);
}

int GltfFile::addMesh(const std::string& name, const TriangleMesh& mesh, int material) {
    ordered_json attributes;
    attributes["POSITION"] = addAccessor(flatten(mesh.positions), 3, true);
    attributes["NORMAL"] = addAccessor(flatten(mesh.normals), 3, false);
    if (!mesh.tangents.empty()) attributes["TANGENT"] = addAccessor(flatten(mesh.tangents), 4, false);
    attributes["TEXCOORD_0"] = addAccessor(flatten(mesh.uvs), 2, false);
    if (!mesh.colors.empty()) attributes["COLOR_0"] = addAccessor(flatten(mesh.colors), 3, false);
    const int view = addView(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t), kIndexTarget);
    const int indices = add("accessors", {{"bufferView", view},
                                          {"componentType", kUnsignedInt},
                                          {"count", mesh.indices.size()},
                                          {"type", "SCALAR"}});
    ordered_json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", material}};
    return add("meshes", {{"name", name}, {"primitives", {primitive}}});
}

int GltfFile::addCamera(const std::string& name, double yfov) {
    ordered_json perspective = {{"yfov", yfov}, {"znear", 0.02}};
    return add("cameras", {{"name", name}, {"type", "perspective"}, {"perspective", perspective}});
}

void GltfFile::setRoots(const std::vector<int>& nodes, const std::string& sceneName) {
    root_["scene"] = 0;
    root_["scenes"] = ordered_json::array({{{"name", sceneName}, {"nodes", nodes}}});
}

void GltfFile::setCopyright(const std::string& text) {
    root_["asset"]["copyright"] = text;
}

void GltfFile::write(const std::filesystem::path& path) {
    std::filesystem::path bin = path;
    bin.replace_extension(".bin");
    root_["buffers"] =
        ordered_json::array({{{"uri", bin.filename().string()}, {"byteLength", buffer_.size()}}});
    writeFileAtomically(bin, std::span<const std::byte>(buffer_));
    writeFileAtomically(path, root_.dump(1) + "\n");
}

}  // namespace cutis::people
