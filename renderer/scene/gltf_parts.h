// The stages of loadGltf, each in a file of its own: nodes → materials → meshes → images. Its own use only.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene.h"

namespace cutis::gltf {

inline constexpr int kNone = -1;

// --- gltf_nodes.cpp ---

// What the nodes of the file became.
struct NodeMap {
    std::vector<int> sceneNode;  // per node of the file: index into Scene::nodes; kNone: not in the scene
    std::vector<int> fileNode;   // per node of the scene: index into the file's nodes
};

// Nodes of the default scene (all where the file has no scenes), their cameras and lights, in the file's
// order. Node::mesh is an index into the file's meshes until readMeshes replaces it. Fails on cycles and
// nodes with two parents.
NodeMap readNodes(Document& document, Scene& scene);

// --- gltf_materials.cpp ---

// An image that a material of the scene uses, in the order of Scene::images.
struct ImageUse {
    std::size_t fileImage;                 // index into the file's images
    bool asColor = false, asData = false;  // sampled as sRGB colour; as numbers
};

struct MaterialMap {
    std::vector<int> sceneMaterial;  // per material of the file: index into Scene::materials; kNone: unused
    std::vector<ImageUse> images;
    bool skinMarked = false;  // some material of the file has extras.skin
};

// Materials that the scene's meshes use, with textures; Scene::images gets empty entries.
MaterialMap readMaterials(Document& document, Scene& scene);

// --- gltf_meshes.cpp, gltf_primitive.cpp ---

// Matrices that take a skinned mesh's vertices to its node's space, one per joint; empty without a skin.
using JointMatrices = std::vector<glm::dmat4>;

// Meshes that nodes use; a mesh with a skin becomes one of its own per node, in the pose that the nodes are
// in. Node::mesh becomes an index into Scene::meshes. World transforms must be up to date.
void readMeshes(Document& document, const NodeMap& nodes, const MaterialMap& materials, Scene& scene);

// One primitive, complete and checked; nothing when it has no triangles (points, lines, all degenerate).
// `material` is what it is made of, to know whether it needs tangents.
std::optional<Primitive> readPrimitive(Document& document, const JsonView& primitive,
                                       const JointMatrices& joints, const Material& material);

// --- gltf_images.cpp ---

// Decodes all images, in parallel. Images deeper than 8 bits become linear, as do their textures.
void readImages(Document& document, const std::vector<ImageUse>& uses, Scene& scene);

}  // namespace cutis::gltf
