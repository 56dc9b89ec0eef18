// Test bodies as triangle meshes with texture coordinates. Lengths are metres, as in a scene.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis::test {

inline constexpr double kMm = 1e-3;  // metres in a millimetre

struct SurfacePoint {
    glm::dvec3 position, normal;
    glm::dvec2 uv;  // in the chart's own units: ChartedMesh takes them as metres
};

// Collects patches, each a chart of its own, and lays the charts out in [0,1]² at one common scale, so that a
// patch whose uv are lengths on its surface has the same texels per metre as any other.
class ChartedMesh {
  public:
    // `gap` metres are kept free around each chart.
    explicit ChartedMesh(double gap) : gap_(gap) {}

    // Samples surface(s, t), s and t in [0,1], on (columns+1) × (rows+1) vertices. Triangles that have no
    // area are left out; the others wind so that they face where their normals point.
    void addPatch(int columns, int rows, const std::function<SurfacePoint(double s, double t)>& surface);
    // The parallelogram corner + s·across + t·up, facing across × up.
    void addQuad(const glm::dvec3& corner, const glm::dvec3& across, const glm::dvec3& up, int segments = 12);

    // The mesh with its charts in rows of about equal width.
    Primitive finish() const;

  private:
    struct Chart {
        Primitive mesh;
        std::vector<glm::dvec2> uv;
        glm::dvec2 min, size;
    };
    double gap_;
    std::vector<Chart> charts_;
};

// A box, each face a chart without distortion.
Primitive makeBox(const glm::dvec3& min, const glm::dvec3& max, double chartGap = 0.01);

// A square of side `size` in the plane z = 0, facing +Z, centred on the origin. Its texture coordinates are
// uvFromPlate · (x, -y), moved and scaled as one to fit [0,1]² with a margin.
Primitive makePlate(double size, const glm::dmat2& uvFromPlate = glm::dmat2(1));

enum class SphereMapping {
    latLong,  // one chart, poles at ±Y, seam towards -Z
    cube,     // six charts, equiangular
};
// A sphere round the origin, its frame turned by `orientation` first (which moves poles and seams only). `detail` multiplies the
// number of triangles along each way: 192 round it where that is 1.
Primitive makeSphere(double radius, SphereMapping mapping, const glm::dmat3& orientation = glm::dmat3(1), double detail = 1);

// A sphere-like head with a nose towards +Z, six charts: a body that casts shadows on itself.
Primitive makeNosedSphere(double radius);

// A bowl: the half of a thick spherical shell with z ≤ 0, open towards +Z, rim in z = 0. The inner wall has
// `radius`, the outer radius + thickness.
Primitive makeBowl(double radius, double thickness);

}  // namespace cutis::test
