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

// --- gltf_meshes.cpp, gltf_primitive.cpp, gltf_draco.cpp, gltf_deformation.cpp ---

// Meshes and skins that nodes use; a mesh that deforms becomes one of its own per node. Node::mesh becomes an index into
// Scene::meshes, Node::skin and Node::weights are filled in.
void readMeshes(Document& document, const NodeMap& nodes, const MaterialMap& materials, Scene& scene);

// One primitive, complete and checked, not posed yet; nothing when it has no triangles (points, lines, all degenerate).
// `material` is what it is made of, to know whether it needs tangents; `joints` how many its skin has, 0 without one.
std::optional<Primitive> readPrimitive(Document& document, const JsonView& primitive, std::size_t joints,
                                       const Material& material);

// Supplies the accessors of a primitive that KHR_draco_mesh_compression compresses with their data.
void decompressPrimitive(Document& document, const JsonView& primitive);

// Fills Primitive::deformation, where the primitive has morph targets, or joints while its skin has some. `vertices`
// says which vertex of the file each vertex of the primitive is, `count` how many the file has.
void readDeformation(Document& document, const JsonView& entry, std::size_t joints,
                     const std::vector<std::uint32_t>& vertices, std::size_t count, Primitive& primitive);

// --- gltf_animations.cpp ---

// Animations of nodes of the scene, and Node::rest of those that they move. Meshes must have been read.
void readAnimations(Document& document, const NodeMap& nodes, Scene& scene);

// --- gltf_images.cpp ---

// Decodes all images, in parallel. Images deeper than 8 bits become linear, as do their textures.
void readImages(Document& document, const std::vector<ImageUse>& uses, Scene& scene);

}  // namespace cutis::gltf
