// Polygon meshes of the data maker. Positions are in metres, +Y up, facing +Z, unless a comment says
// otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace cutis::people {

// Quads with positions and texture coordinates indexed apart, as OBJ and subdivision have them.
struct QuadMesh {
    struct Face {
        std::array<int, 4> vertex;
        std::array<int, 4> uv;
    };
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec2> uvs;      // row 0 of the image at v = 0, as glTF has it
    std::vector<glm::dvec3> normals;  // one a position, or none
    std::vector<Face> faces;
};

// Triangles with one index a corner: what glTF stores. Arrays beside positions are empty or as long.
struct TriangleMesh {
    std::vector<glm::dvec3> positions, normals;
    std::vector<glm::dvec4> tangents;   // w: sign of the bitangent
    std::vector<glm::dvec2> uvs;        // the map that cutis samples
    std::vector<glm::dvec2> sourceUvs;  // where the same point lies on MakeHuman's map; not stored
    std::vector<glm::dvec3> colors;     // linear
    std::vector<double> cover;          // share hidden under hair, 0 to 1; not stored
    std::vector<std::uint32_t> indices;
};

// Catmull-Clark, `levels` times, then to the limit surface with its normals (OpenSubdiv). Borders stay sharp
// in the texture and smooth in space.
QuadMesh subdivide(const QuadMesh& mesh, int levels);

// The faces that keep(face) wants, with only the positions and texture coordinates they use.
template <class Keep>
QuadMesh selectFaces(const QuadMesh& mesh, const Keep& keep) {
    QuadMesh out;
    std::vector<int> position(mesh.positions.size(), -1), uv(mesh.uvs.size(), -1);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (!keep(f)) continue;
        QuadMesh::Face face = mesh.faces[f];
        for (int& v : face.vertex) {
            if (position[v] < 0) {
                position[v] = int(out.positions.size());
                out.positions.push_back(mesh.positions[v]);
            }
            v = position[v];
        }
        for (int& t : face.uv) {
            if (uv[t] < 0) {
                uv[t] = int(out.uvs.size());
                out.uvs.push_back(mesh.uvs[t]);
            }
            t = uv[t];
        }
        out.faces.push_back(face);
    }
    return out;
}

// Area-weighted vertex normals.
std::vector<glm::dvec3> computeNormals(const QuadMesh& mesh);

// One vertex a pair of position and texture coordinate; two triangles a quad, cut along the shorter diagonal.
TriangleMesh triangulate(const QuadMesh& mesh);

// Per-vertex tangents along u from the texture coordinates, orthogonal to the normals.
void computeTangents(TriangleMesh& mesh);

}  // namespace cutis::people
