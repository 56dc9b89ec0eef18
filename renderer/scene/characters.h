// What a scene holds as a whole: world transforms, bounds, and who in it is a character.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace cutis {

// Fills all that follows from nodes, meshes and materials: world transforms, bounds and characters. loadGltf
// calls it; whoever makes a scene in code, or changes its nodes or the skin of its materials, calls it too.
// Throws Error when the nodes are not a forest.
void prepareScene(Scene& scene);

// Node::world from Node::local, then the placement of the cameras and lights that hang on nodes.
// Throws Error when the nodes are not a forest (a cycle, two parents, an index out of range).
void updateWorldTransforms(Scene& scene);

// Scene::bounds, and the bounds of the characters that were found, from world transforms.
void computeBounds(Scene& scene);

// Scene::characters and Scene::nodeCharacter. A character is a connected part of the node tree with skin:
// 1. Trees are apart: a root node never shares a character with another root node.
// 2. A node with a skin mesh is one character with all skin below it.
// 3. Where the children of a node without a skin mesh hold skin in several branches, each branch that is a
//    group is a character of its own (or several); the branches that are skin meshes themselves are one
//    character where their boxes touch (a head on its body), several where they do not (two heads).
// 4. Its root is the topmost ancestor that holds no other character. From what hangs there a character takes
//    the meshes that touch it (eyes, teeth, hair, clothes) unless they are far larger (floor, backdrop, sky).
// They come in node order, named after their root nodes and made unique ("Anna", "Anna 2").
void findCharacters(Scene& scene);

// True when the node has a mesh with at least one primitive of skin material.
bool hasSkin(const Scene& scene, int node);

// World bounds of the head of `subject`, a character's name or "*" for the heads of all characters together.
// The head is what lies within the top 260 mm (or an eighth of the height, if that is more) of the skin's
// bounds: the head of a standing figure or of a bust, and the whole of a head alone. Hair, clothes and set
// pieces do not count. In a scene without characters, "*" is the same of all meshes. Throws Error naming the
// characters that there are.
Bounds headBounds(const Scene& scene, const std::string& subject);

}  // namespace cutis
