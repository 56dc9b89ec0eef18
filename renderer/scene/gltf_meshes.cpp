#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessors.h"
#include "renderer/scene/gltf_parts.h"

namespace cutis::gltf {
namespace {

class MeshReader {
  public:
    MeshReader(Document& document, const NodeMap& nodes, const MaterialMap& materials, Scene& scene)
        : document_(document), nodes_(nodes), materials_(materials), scene_(scene) {}

    void run() {
        std::map<int, int> sceneMesh;  // per mesh of the file without a skin
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            Node& node = scene_.nodes[i];
            if (node.mesh == kNone) continue;
            const JsonView nodeEntry = document_.entry("nodes", std::size_t(nodes_.fileNode[i]));
            const JsonView meshEntry = document_.entry("meshes", std::size_t(node.mesh));
            warnOfMorphs(nodeEntry, meshEntry);
            if (const auto skin = nodeEntry.find("skin")) {
                node.mesh = addMesh(meshEntry, readJointMatrices(*skin, node.world));
                continue;
            }
            const auto [known, isNew] = sceneMesh.try_emplace(node.mesh, kNone);
            if (isNew) known->second = addMesh(meshEntry, {});
            node.mesh = known->second;
        }
    }

  private:
    int addMesh(const JsonView& entry, const JointMatrices& joints) {
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

    // A skinned mesh ignores its node's transform: its joints place it in the world, and the inverse brings
    // it back to the node, which keeps its place in the tree.
    JointMatrices readJointMatrices(const JsonView& reference, const glm::dmat4& world) {
        const JsonView skin = document_.resolve(reference, "skins");
        const JsonView joints = skin.member("joints");
        if (std::abs(glm::determinant(world)) < 1e-30)
            reference.fail("its node is flattened by a scale of 0");
        const glm::dmat4 toNode = glm::inverse(world);
        std::vector<glm::mat4> inverseBind(joints.size(), glm::mat4(1));
        if (const auto given = skin.find("inverseBindMatrices")) {
            inverseBind = readMat4(document_, *given);
            if (inverseBind.size() < joints.size()) given->fail("there are fewer matrices than joints");
        }
        JointMatrices matrices;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const JsonView joint = joints.element(i);
            const int node = nodes_.sceneNode[joint.index(nodes_.sceneNode.size(), "nodes")];
            if (node == kNone) joint.fail("the joint is not in the scene");
            matrices.push_back(toNode * scene_.nodes[node].world * glm::dmat4(inverseBind[i]));
        }
        return matrices;
    }

    void warnOfMorphs(const JsonView& node, const JsonView& mesh) {
        const auto onNode = node.find("weights");
        const auto weights = onNode ? onNode : mesh.find("weights");
        if (!weights) return;
        if (std::ranges::any_of(weights->numbers(), [](double w) { return w != 0; })) {
            warn("morph targets are not supported yet and left out, " + weights->where());
        }
    }

    Document& document_;
    const NodeMap& nodes_;
    const MaterialMap& materials_;
    Scene& scene_;
};

}  // namespace

void readMeshes(Document& document, const NodeMap& nodes, const MaterialMap& materials, Scene& scene) {
    MeshReader(document, nodes, materials, scene).run();
}

}  // namespace cutis::gltf
