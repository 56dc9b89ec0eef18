#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/core/error.h"
#include "renderer/scene/deform.h"
#include "renderer/scene/gltf_accessors.h"
#include "renderer/scene/gltf_parts.h"

namespace cutis::gltf {
namespace {

class MeshReader {
  public:
    MeshReader(Document& document, const NodeMap& nodes, const MaterialMap& materials, Scene& scene)
        : document_(document), nodes_(nodes), materials_(materials), scene_(scene) {}

    void run() {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            Node& node = scene_.nodes[i];
            if (node.mesh == kNone) continue;
            const JsonView nodeEntry = document_.entry("nodes", std::size_t(nodes_.fileNode[i]));
            const JsonView meshEntry = document_.entry("meshes", std::size_t(node.mesh));
            if (const auto skin = nodeEntry.find("skin")) node.skin = readSkin(*skin, node);
            readWeights(nodeEntry, meshEntry, node);
            node.mesh = meshFor(meshEntry, node);
            if (node.skin != kNone && jointsMirror(node)) turnOver(scene_.meshes[node.mesh]);
        }
    }

  private:
    // Whether the joints, as they rest, place the mesh in its node as its mirror image.
    bool jointsMirror(const Node& node) const {
        const Skin& skin = scene_.skins[node.skin];
        std::vector<glm::dmat4> matrices;
        for (std::size_t i = 0; i < skin.joints.size(); ++i)
            matrices.push_back(glm::inverse(node.world) * scene_.nodes[skin.joints[i]].world *
                               skin.inverseBind[i]);
        return mirrors(matrices);
    }

    // What its joints mirror keeps its front in front. A mesh that deforms belongs to one node.
    static void turnOver(Mesh& mesh) {
        for (Primitive& p : mesh.primitives) {
            if (!p.deformation || p.deformation->firstInfluence.empty()) continue;
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3)
                std::swap(p.indices[i + 1], p.indices[i + 2]);
        }
    }

    // The mesh as it is read with a skin of that many joints. One that deforms is copied for every node after
    // the first.
    int meshFor(const JsonView& entry, const Node& node) {
        const std::size_t joints = node.skin == kNone ? 0 : scene_.skins[node.skin].joints.size();
        const auto [known, isNew] = known_.try_emplace({node.mesh, joints}, kNone);
        if (isNew) return known->second = addMesh(entry, joints);
        const Mesh& mesh = scene_.meshes[known->second];
        if (std::ranges::none_of(mesh.primitives,
                                 [](const Primitive& p) { return p.deformation != nullptr; }))
            return known->second;
        for (const Primitive& p : mesh.primitives) {
            document_.spend(
                p.positions.size() * (sizeof(glm::vec3) * 2 + sizeof(glm::vec4) * 2 + sizeof(glm::vec2) * 2) +
                    p.indices.size() * sizeof(std::uint32_t),
                entry);
        }
        scene_.meshes.push_back(Mesh(mesh));
        return int(scene_.meshes.size()) - 1;
    }

    int addMesh(const JsonView& entry, std::size_t joints) {
        Mesh mesh;
        mesh.name = entry.string("name");
        for (const JsonView& primitive : entry.member("primitives").elements()) {
            int material = int(scene_.materials.size()) - 1;  // the default one, see readMaterials
            if (const auto reference = primitive.find("material")) {
                material =
                    materials_.sceneMaterial[reference->index(materials_.sceneMaterial.size(), "materials")];
            }
            auto read = readPrimitive(document_, primitive, joints, scene_.materials[material]);
            if (!read) continue;
            read->material = material;
            mesh.primitives.push_back(std::move(*read));
        }
        scene_.meshes.push_back(std::move(mesh));
        return int(scene_.meshes.size()) - 1;
    }

    int readSkin(const JsonView& reference, const Node& node) {
        const std::size_t index = reference.index(document_.count("skins"), "skins");
        if (std::abs(glm::determinant(node.world)) < 1e-30)
            reference.fail("its node is flattened by a scale of 0");
        const auto [known, isNew] = sceneSkin_.try_emplace(index, int(scene_.skins.size()));
        if (!isNew) return known->second;
        const JsonView entry = document_.entry("skins", index);
        const JsonView joints = entry.member("joints");
        if (joints.size() == 0) joints.fail("a skin has at least one joint");
        if (const auto root = entry.find("skeleton")) root->index(nodes_.sceneNode.size(), "nodes");
        Skin skin;
        skin.name = entry.string("name");
        for (const JsonView& joint : joints.elements()) {
            skin.joints.push_back(nodes_.sceneNode[joint.index(nodes_.sceneNode.size(), "nodes")]);
            if (skin.joints.back() == kNone) joint.fail("the joint is not in the scene");
        }
        skin.inverseBind.assign(skin.joints.size(), glm::dmat4(1));
        if (const auto given = entry.find("inverseBindMatrices")) {
            const std::vector<glm::mat4> matrices = readMat4(document_, *given);
            if (matrices.size() < skin.joints.size()) given->fail("there are fewer matrices than joints");
            for (std::size_t i = 0; i < skin.joints.size(); ++i) {
                skin.inverseBind[i] = glm::dmat4(matrices[i]);
                for (int c = 0; c < 4; ++c) {
                    for (int r = 0; r < 4; ++r) {
                        if (!std::isfinite(matrices[i][c][r]))
                            given->fail("matrix " + std::to_string(i) + " is not finite");
                    }
                }
            }
        }
        scene_.skins.push_back(std::move(skin));
        return known->second;
    }

    // The node's own, else the mesh's, else 0.
    static void readWeights(const JsonView& node, const JsonView& mesh, Node& to) {
        std::size_t targets = 0;
        for (const JsonView& primitive : mesh.member("primitives").elements()) {
            if (const auto list = primitive.find("targets")) targets = std::max(targets, list->size());
        }
        const auto own = node.find("weights");
        if (const auto weights = own ? own : mesh.find("weights")) to.weights = weights->numbers();
        to.weights.resize(targets, 0.0);
    }

    Document& document_;
    const NodeMap& nodes_;
    const MaterialMap& materials_;
    Scene& scene_;
    std::map<std::pair<int, std::size_t>, int>
        known_;                             // mesh of the file and number of joints: mesh of the scene
    std::map<std::size_t, int> sceneSkin_;  // per skin of the file
};

}  // namespace

void readMeshes(Document& document, const NodeMap& nodes, const MaterialMap& materials, Scene& scene) {
    MeshReader(document, nodes, materials, scene).run();
}

}  // namespace cutis::gltf
