#include "mesh.h"

#include <map>
#include <utility>

namespace cutis::people {

std::vector<glm::dvec3> computeNormals(const QuadMesh& mesh) {
    std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0));
    for (const QuadMesh::Face& face : mesh.faces) {
        const glm::dvec3 area = glm::cross(mesh.positions[face.vertex[2]] - mesh.positions[face.vertex[0]],
                                           mesh.positions[face.vertex[3]] - mesh.positions[face.vertex[1]]);
        for (const int v : face.vertex) normals[v] += area;
    }
    for (glm::dvec3& n : normals) n = glm::dot(n, n) > 0 ? glm::normalize(n) : glm::dvec3(0, 0, 1);
    return normals;
}

TriangleMesh triangulate(const QuadMesh& mesh) {
    TriangleMesh out;
    const std::vector<glm::dvec3> normals = mesh.normals.empty() ? computeNormals(mesh) : mesh.normals;
    std::map<std::pair<int, int>, std::uint32_t> corners;
    const auto corner = [&](int vertex, int uv) {
        const auto [entry, added] = corners.try_emplace({vertex, uv}, std::uint32_t(out.positions.size()));
        if (added) {
            out.positions.push_back(mesh.positions[vertex]);
            out.normals.push_back(normals[vertex]);
            out.uvs.push_back(mesh.uvs[uv]);
        }
        return entry->second;
    };
    for (const QuadMesh::Face& face : mesh.faces) {
        std::array<std::uint32_t, 4> c{};
        for (int i = 0; i < 4; ++i) c[i] = corner(face.vertex[i], face.uv[i]);
        const auto distance = [&](int i, int j) {
            return glm::distance(mesh.positions[face.vertex[i]], mesh.positions[face.vertex[j]]);
        };
        const int first = distance(0, 2) <= distance(1, 3) ? 0 : 1;
        const auto at = [&](int i) { return c[(first + i) % 4]; };
        for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            if (at(i) == at(j) || at(j) == at(k) || at(k) == at(i)) continue;  // a quad that was a triangle
            out.indices.insert(out.indices.end(), {at(i), at(j), at(k)});
        }
    }
    return out;
}

void computeTangents(TriangleMesh& mesh) {
    std::vector<glm::dvec3> tangent(mesh.positions.size(), glm::dvec3(0)), bitangent = tangent;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* v = &mesh.indices[i];
        const glm::dvec3 e1 = mesh.positions[v[1]] - mesh.positions[v[0]],
                         e2 = mesh.positions[v[2]] - mesh.positions[v[0]];
        const glm::dvec2 d1 = mesh.uvs[v[1]] - mesh.uvs[v[0]], d2 = mesh.uvs[v[2]] - mesh.uvs[v[0]];
        const double det = d1.x * d2.y - d1.y * d2.x;
        const double sign = det < 0 ? -1 : 1;  // weight by area: the division by |det| is left out
        for (int k = 0; k < 3; ++k) {
            tangent[v[k]] += sign * (e1 * d2.y - e2 * d1.y);
            bitangent[v[k]] += sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    // glTF's bitangent points up the image, against growing v.
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3& n = mesh.normals[i];
        glm::dvec3 t = tangent[i] - n * glm::dot(n, tangent[i]);
        if (glm::dot(t, t) < 1e-30)
            t = glm::cross(n, std::abs(n.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
        t = glm::normalize(t);
        mesh.tangents[i] = glm::dvec4(t, glm::dot(glm::cross(n, t), bitangent[i]) > 0 ? -1 : 1);
    }
}

}  // namespace cutis::people
