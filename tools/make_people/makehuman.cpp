#include "makehuman.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/core/error.h"

namespace cutis::people {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json readJson(const fs::path& path) {
    std::ifstream file(path);
    if (!file) throw Error("MakeHuman data", "no such file", path.string());
    try {
        return json::parse(file);
    } catch (const json::exception& e) {
        throw Error("MakeHuman data", e.what(), path.string());
    }
}

std::vector<glm::dvec3> vectors3(const json& flat) {
    std::vector<glm::dvec3> out(flat.size() / 3);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
    return out;
}

// three.js' model format 3 with quads that carry a material and texture coordinates (type 11, ten numbers a
// face).
void readThreeJs(const json& model, const fs::path& path, QuadMesh& mesh, std::vector<int>* faceGroup) {
    constexpr int kQuadMaterialUv = 11, kStride = 10;
    mesh.positions = vectors3(model.at("vertices"));
    const json& uvs = model.at("uvs").at(0);
    for (std::size_t i = 0; i + 1 < uvs.size(); i += 2)
        mesh.uvs.emplace_back(uvs[i].get<double>(), 1 - uvs[i + 1].get<double>());
    const json& faces = model.at("faces");
    for (std::size_t i = 0; i + kStride <= faces.size(); i += kStride) {
        if (faces[i] != kQuadMaterialUv) throw Error("MakeHuman data", "not a mesh of quads", path.string());
        QuadMesh::Face face{};
        for (int k = 0; k < 4; ++k) {
            face.vertex[k] = faces[i + 1 + k];
            face.uv[k] = faces[i + 6 + k];
            if (face.vertex[k] < 0 || face.vertex[k] >= int(mesh.positions.size()) || face.uv[k] < 0 ||
                face.uv[k] >= int(mesh.uvs.size()))
                throw Error("MakeHuman data", "a face index is out of range", path.string());
        }
        mesh.faces.push_back(face);
        if (faceGroup) faceGroup->push_back(faces[i + 5]);
    }
}

}  // namespace

std::vector<int> BaseMesh::groupVertices(std::string_view group) const {
    const auto it = std::find(groups.begin(), groups.end(), group);
    if (it == groups.end()) throw Error("MakeHuman data", "the base mesh has no group " + std::string(group));
    std::set<int> vertices;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        if (faceGroup[f] == int(it - groups.begin()))
            vertices.insert(mesh.faces[f].vertex.begin(), mesh.faces[f].vertex.end());
    return {vertices.begin(), vertices.end()};
}

glm::dvec3 BaseMesh::joint(std::string_view name, const std::vector<glm::dvec3>& positions) const {
    const std::vector<int> vertices = groupVertices("joint-" + std::string(name));
    glm::dvec3 sum(0);
    for (const int v : vertices) sum += positions[v];
    return sum / double(vertices.size());
}

BaseMesh loadBaseMesh(const fs::path& data) {
    const fs::path path = data / "public/data/models/human_full_size.json";
    const json model = readJson(path);
    BaseMesh base;
    try {
        readThreeJs(model, path, base.mesh, &base.faceGroup);
        for (const json& material : model.at("materials")) base.groups.push_back(material.at("DbgName"));
        for (const json& bone : model.at("bones")) base.bones.push_back(bone.at("name"));
        const json &indices = model.at("skinIndices"), &weights = model.at("skinWeights");
        const std::size_t n = base.mesh.positions.size();
        if (indices.size() != 4 * n || weights.size() != 4 * n)
            throw Error("MakeHuman data", "bone weights do not fit the mesh", path.string());
        base.boneIndices.resize(n);
        base.boneWeights.resize(n);
        for (std::size_t i = 0; i < 4 * n; ++i) {
            base.boneIndices[i / 4][i % 4] = indices[i];
            base.boneWeights[i / 4][i % 4] = weights[i];
        }
    } catch (const json::exception& e) {
        throw Error("MakeHuman data", e.what(), path.string());
    }
    return base;
}

std::vector<glm::dvec3> applyTargets(const fs::path& data, const BaseMesh& base,
                                     const std::map<std::string, double>& weights) {
    const fs::path listPath = data / "src/json/targets/target-list.json";
    std::vector<std::string> names;
    const json list = readJson(listPath);
    for (const auto& [name, tags] : list.at("targets").items()) names.push_back(name);
    std::sort(names.begin(), names.end());  // the order of the rows in targets.bin

    const fs::path path = data / "public/data/targets/targets.bin";
    std::ifstream rows(path, std::ios::binary);
    if (!rows) throw Error("MakeHuman data", "no such file", path.string());
    std::vector<glm::dvec3> positions = base.mesh.positions;
    std::vector<std::int16_t> row(positions.size() * 3);
    const auto add = [&](const std::string& name, double weight) {
        const std::string full = "data/targets/" + name + ".target";
        const auto it = std::lower_bound(names.begin(), names.end(), full);
        if (it == names.end() || *it != full) throw Error("recipe", "there is no shape target " + name);
        const auto bytes = std::streamsize(row.size() * sizeof(row[0]));
        rows.seekg((it - names.begin()) * bytes);
        if (!rows.read(reinterpret_cast<char*>(row.data()), bytes))
            throw Error("MakeHuman data", "shorter than the list of targets says", path.string());
        constexpr double kDecimetres = 1e-3;  // one step of the stored integers
        for (std::size_t i = 0; i < positions.size(); ++i)
            positions[i] += weight * kDecimetres * glm::dvec3(row[3 * i], row[3 * i + 1], row[3 * i + 2]);
    };
    for (const auto& [name, weight] : weights) {
        const std::size_t side = name.find('?');
        if (side == std::string::npos) {
            add(name, weight);
            continue;
        }
        for (const char* letter : {"l", "r"}) add(std::string(name).replace(side, 1, letter), weight);
    }
    return positions;
}

Proxy loadProxy(const fs::path& data, const std::string& name) {
    const fs::path folder = data / "public/data/proxies" / name;
    const fs::path path = folder / (fs::path(name).filename().string() + ".json");
    const json model = readJson(path);
    Proxy proxy;
    try {
        readThreeJs(model, path, proxy.mesh, nullptr);
        for (const json& r : model.at("ref_vIdxs")) proxy.references.push_back({r.at(0), r.at(1), r.at(2)});
        for (const json& w : model.at("weights")) proxy.weights.emplace_back(w.at(0), w.at(1), w.at(2));
        for (const json& o : model.at("offsets")) proxy.offsets.emplace_back(o.at(0), o.at(1), o.at(2));
    } catch (const json::exception& e) {
        throw Error("MakeHuman data", e.what(), path.string());
    }
    const std::size_t n = proxy.mesh.positions.size();
    if (proxy.references.size() != n || proxy.weights.size() != n || proxy.offsets.size() != n)
        throw Error("MakeHuman data", "the proxy's fit does not cover its mesh", path.string());
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "textures"))
        if (entry.path().extension() == ".png" && (proxy.texture.empty() || entry.path() < proxy.texture))
            proxy.texture = entry.path();
    return proxy;
}

QuadMesh fitProxy(const Proxy& proxy, const BaseMesh& base, const std::vector<glm::dvec3>& positions) {
    const auto headHeight = [&](const std::vector<glm::dvec3>& p) {
        return glm::distance(base.joint("head", p), base.joint("head-2", p));
    };
    const double scale = headHeight(positions) / headHeight(base.mesh.positions);
    QuadMesh mesh = proxy.mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::dvec3 p = proxy.offsets[i] * scale;
        for (int k = 0; k < 3; ++k) p += proxy.weights[i][k] * positions.at(proxy.references[i][k]);
        mesh.positions[i] = p;
    }
    return mesh;
}

}  // namespace cutis::people
