#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cutis::test {

namespace {

constexpr double kPi = std::numbers::pi;

void addTriangle(Primitive& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec3 pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
    const glm::dvec3 area = cross(pb - pa, pc - pa);
    const double longest = std::max({length(pb - pa), length(pc - pb), length(pa - pc)});
    if (length(area) < 1e-6 * longest * longest) return;
    if (dot(area, glm::dvec3(mesh.normals[a] + mesh.normals[b] + mesh.normals[c])) < 0) std::swap(b, c);
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

// The direction of a cube face's point, equiangular; face 0..5, s and t in [0,1].
glm::dvec3 cubeDirection(int face, double s, double t) {
    const double a = std::tan((s - 0.5) * kPi / 2), b = std::tan((t - 0.5) * kPi / 2);
    glm::dvec3 direction(0);
    const int axis = face / 2;
    direction[axis] = face % 2 ? -1 : 1;
    direction[(axis + 1) % 3] = face % 2 ? -a : a;  // keeps the charts unmirrored
    direction[(axis + 2) % 3] = b;
    return normalize(direction);
}

}  // namespace

void ChartedMesh::addPatch(int columns, int rows,
                           const std::function<SurfacePoint(double s, double t)>& surface) {
    Chart chart{{}, {}, glm::dvec2(1e30), {}};
    glm::dvec2 max(-1e30);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const SurfacePoint point = surface(double(i) / columns, double(j) / rows);
            chart.mesh.positions.push_back(point.position);
            chart.mesh.normals.push_back(normalize(point.normal));
            chart.uv.push_back(point.uv);
            chart.min = glm::min(chart.min, point.uv), max = glm::max(max, point.uv);
        }
    chart.size = max - chart.min;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
            addTriangle(chart.mesh, a, b, d);
            addTriangle(chart.mesh, a, d, c);
        }
    charts_.push_back(std::move(chart));
}

void ChartedMesh::addQuad(const glm::dvec3& corner, const glm::dvec3& across, const glm::dvec3& up,
                          int segments) {
    const glm::dvec3 normal = normalize(cross(across, up));
    const glm::dvec2 size(length(across), length(up));
    addPatch(segments, segments, [&](double s, double t) {
        return SurfacePoint{corner + across * s + up * t, normal, size * glm::dvec2(s, 1 - t)};
    });
}

Primitive ChartedMesh::finish() const {
    double area = 0, widest = 0;
    for (const Chart& chart : charts_) {
        area += (chart.size.x + 2 * gap_) * (chart.size.y + 2 * gap_);
        widest = std::max(widest, chart.size.x + 2 * gap_);
    }
    const double rowWidth = std::max(widest, 1.1 * std::sqrt(area));
    std::vector<glm::dvec2> places;
    glm::dvec2 cursor(0), extent(0);
    double rowHeight = 0;
    for (const Chart& chart : charts_) {
        const glm::dvec2 size = chart.size + 2 * gap_;
        if (cursor.x > 0 && cursor.x + size.x > rowWidth * (1 + 1e-9)) {
            cursor = {0, cursor.y + rowHeight};
            rowHeight = 0;
        }
        places.push_back(cursor + gap_);
        cursor.x += size.x;
        rowHeight = std::max(rowHeight, size.y);
        extent = glm::max(extent, glm::dvec2(cursor.x, cursor.y + rowHeight));
    }
    const double scale = 1 / std::max(extent.x, extent.y);
    Primitive mesh;
    for (std::size_t i = 0; i < charts_.size(); ++i) {
        const Chart& chart = charts_[i];
        const std::uint32_t base = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), chart.mesh.positions.begin(), chart.mesh.positions.end());
        mesh.normals.insert(mesh.normals.end(), chart.mesh.normals.begin(), chart.mesh.normals.end());
        for (const glm::dvec2& uv : chart.uv) mesh.uv0.push_back((uv - chart.min + places[i]) * scale);
        for (const std::uint32_t index : chart.mesh.indices) mesh.indices.push_back(base + index);
    }
    return mesh;
}

Primitive makeBox(const glm::dvec3& min, const glm::dvec3& max, double chartGap) {
    const glm::dvec3 size = max - min;
    const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    ChartedMesh mesh(chartGap);
    mesh.addQuad(min + z, x, y);       // +Z
    mesh.addQuad(min + x, -x, y);      // -Z
    mesh.addQuad(min + x + z, -z, y);  // +X
    mesh.addQuad(min, z, y);           // -X
    mesh.addQuad(min + y + z, x, -z);  // +Y
    mesh.addQuad(min, x, z);           // -Y
    return mesh.finish();
}

Primitive makePlate(double size, const glm::dmat2& uvFromPlate) {
    ChartedMesh mesh(0.02 * size);
    mesh.addPatch(16, 16, [&](double s, double t) {
        const glm::dvec2 place = glm::dvec2(s - 0.5, t - 0.5) * size;
        // Image rows grow downwards: y is flipped so that the identity is unmirrored, seen from +Z.
        return SurfacePoint{glm::dvec3(place, 0), {0, 0, 1}, uvFromPlate * glm::dvec2(place.x, -place.y)};
    });
    return mesh.finish();
}

Primitive makeSphere(double radius, SphereMapping mapping, const glm::dmat3& orientation, double detail) {
    ChartedMesh mesh(0.1 * radius);
    const int quarter = static_cast<int>(std::lround(48 * detail));
    if (mapping == SphereMapping::latLong) {
        mesh.addPatch(4 * quarter, 2 * quarter, [&](double s, double t) {
            const double longitude = (s - 0.5) * 2 * kPi, latitude = (0.5 - t) * kPi;  // longitude 0 at +Z
            const glm::dvec3 normal =
                orientation * glm::dvec3(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                         std::cos(longitude) * std::cos(latitude));
            return SurfacePoint{normal * radius, normal, glm::dvec2(2 * s, t) * (kPi * radius)};
        });
        return mesh.finish();
    }
    for (int face = 0; face < 6; ++face)
        mesh.addPatch(quarter, quarter, [&](double s, double t) {
            const glm::dvec3 normal = orientation * cubeDirection(face, s, t);
            return SurfacePoint{normal * radius, normal, glm::dvec2(s, 1 - t) * (kPi / 2 * radius)};
        });
    return mesh.finish();
}

Primitive makeNosedSphere(double radius) {
    const auto position = [radius](const glm::dvec3& n) {
        const double angle = std::acos(std::clamp(n.z, -1.0, 1.0));
        return n * (radius * (1 + 0.45 * std::exp(-angle * angle / (2 * 0.2 * 0.2))));
    };
    ChartedMesh mesh(0.1 * radius);
    for (int face = 0; face < 6; ++face)
        mesh.addPatch(48, 48, [&](double s, double t) {
            const double step = 1e-4;
            const glm::dvec3 n = cubeDirection(face, s, t);
            const glm::dvec3 alongS =
                position(cubeDirection(face, s + step, t)) - position(cubeDirection(face, s - step, t));
            const glm::dvec3 alongT =
                position(cubeDirection(face, s, t + step)) - position(cubeDirection(face, s, t - step));
            const glm::dvec3 normal = normalize(cross(alongS, alongT));
            return SurfacePoint{position(n), dot(normal, n) < 0 ? -normal : normal,
                                glm::dvec2(s, 1 - t) * (kPi / 2 * radius)};
        });
    return mesh.finish();
}

Primitive makeBowl(double radius, double thickness) {
    // Azimuthal equidistant charts of the two walls; s goes round, t from the rim to the bottom.
    const auto wall = [](double wallRadius, double sign) {
        return [=](double s, double t) {
            const double phi = 2 * kPi * s, fromBottom = (1 - t) * kPi / 2;
            const glm::dvec3 outwards(std::sin(fromBottom) * std::cos(phi),
                                      std::sin(fromBottom) * std::sin(phi), -std::cos(fromBottom));
            return SurfacePoint{outwards * wallRadius, outwards * sign,
                                glm::dvec2(std::cos(phi), sign * std::sin(phi)) * (fromBottom * wallRadius)};
        };
    };
    ChartedMesh mesh(0.1 * radius);
    mesh.addPatch(128, 64, wall(radius, -1));
    mesh.addPatch(128, 64, wall(radius + thickness, 1));
    mesh.addPatch(128, 2, [&](double s, double t) {
        const double phi = 2 * kPi * s, r = radius + t * thickness;
        return SurfacePoint{{r * std::cos(phi), r * std::sin(phi), 0},
                            {0, 0, 1},
                            glm::dvec2(std::cos(phi), -std::sin(phi)) * r};
    });
    return mesh.finish();
}

}  // namespace cutis::test
