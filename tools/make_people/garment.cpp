#include "garment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "noise.h"

namespace cutis::people {
namespace {

constexpr double kDecimetre = 0.1;  // metres
// The cloth's cross-section at the neckline: a rolled rib of 18 mm, then cloth that lies 4 mm above the skin.
constexpr double kRibWidth = 0.018, kRibHeight = 0.0068, kClothHeight = 0.004;
constexpr double kTile = 0.02;  // metres that one tile of knit covers

double clothHeight(double below) {
    if (below <= 0.0005) return 0.002;                         // the edge lies close to the skin
    if (below < 0.003) return 0.8 * kRibHeight;                // and rolls up
    if (below < kRibWidth - 0.001) return kRibHeight;          // rib
    if (below < kRibWidth + 0.001) return 0.8 * kClothHeight;  // seam
    return kClothHeight;
}

std::vector<std::set<int>> neighbours(const QuadMesh& mesh) {
    std::vector<std::set<int>> out(mesh.positions.size());
    for (const QuadMesh::Face& face : mesh.faces)
        for (int k = 0; k < 4; ++k) {
            out[face.vertex[k]].insert(face.vertex[(k + 1) % 4]);
            out[face.vertex[(k + 1) % 4]].insert(face.vertex[k]);
        }
    return out;
}

// Cloth bridges hollows: smooth the body, then move each point out to where the skin stays below it. At the
// neckline it follows the skin: `below` is each vertex's distance from there.
void drape(QuadMesh& mesh, const std::vector<double>& below, unsigned seed) {
    const auto ring = neighbours(mesh);
    const std::vector<glm::dvec3> skin = mesh.positions;
    for (int step = 0; step < 12; ++step) {
        std::vector<glm::dvec3> next = mesh.positions;
        for (std::size_t i = 0; i < next.size(); ++i) {
            if (ring[i].size() < 3) continue;
            glm::dvec3 mean(0);
            for (const int j : ring[i]) mean += mesh.positions[j] / double(ring[i].size());
            next[i] = glm::mix(mesh.positions[i], mean, 0.6);
        }
        mesh.positions = std::move(next);
    }
    const std::vector<glm::dvec3> normals = computeNormals(mesh);
    for (std::size_t i = 0; i < skin.size(); ++i) {
        const double sunk = glm::dot(skin[i] - mesh.positions[i], normals[i]);
        const glm::dvec3 p =
            mesh.positions[i] / 0.05;  // folds of about 5 cm that run down rather than across
        const double fold = 0.0022 * gradientNoise({p.x * 1.3, p.y * 0.6, p.z * 1.3}, seed);
        constexpr double kFree = 0.06;  // metres from the neckline where the cloth hangs free
        const double t = std::clamp(below[i] / kFree, 0.0, 1.0), free = t * t * (3 - 2 * t);
        const glm::dvec3 hanging = mesh.positions[i] + normals[i] * (std::max(sunk, 0.0) + fold + 0.001);
        mesh.positions[i] = glm::mix(skin[i], hanging, free);
    }
}

// Triangles with a scalar at each vertex, cut along levels of the scalar.
struct Cut {
    std::vector<glm::dvec3> position, normal, base;
    std::vector<double> value;
    std::vector<std::uint32_t> indices;

    std::uint32_t between(std::uint32_t a, std::uint32_t b, double level,
                          std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>& made) {
        if (value[a] == level) return a;
        if (value[b] == level) return b;
        const auto [entry, added] = made.try_emplace(std::minmax(a, b), std::uint32_t(position.size()));
        if (added) {
            const double t = (level - value[a]) / (value[b] - value[a]);
            position.push_back(glm::mix(position[a], position[b], t));
            normal.push_back(glm::normalize(glm::mix(normal[a], normal[b], t)));
            base.push_back(glm::mix(base[a], base[b], t));
            value.push_back(level);
        }
        return entry->second;
    }

    // Splits triangles along value == level; keeps those above it, and those below it too unless `drop`.
    void split(double level, bool drop) {
        constexpr double kNear =
            0.0006;  // metres: vertices as near as this move to the level, or slivers arise
        for (double& v : value)
            if (std::abs(v - level) < kNear) v = level;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made;
        std::vector<std::uint32_t> out;
        const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
        };
        for (std::size_t t = 0; t < indices.size(); t += 3) {
            std::array<std::uint32_t, 3> v{indices[t], indices[t + 1], indices[t + 2]};
            const auto above = [&](std::uint32_t i) { return value[i] >= level; };
            const int count = above(v[0]) + above(v[1]) + above(v[2]);
            if (count == 3 || (count == 0 && !drop)) emit(v[0], v[1], v[2]);
            if (count == 0 || count == 3) continue;
            // Turn the triangle so that v[0] is alone on its side.
            while (above(v[0]) == above(v[1]) || above(v[0]) == above(v[2])) v = {v[1], v[2], v[0]};
            const std::uint32_t p = between(v[0], v[1], level, made), q = between(v[0], v[2], level, made);
            if (count == 1 || !drop) emit(v[0], p, q);
            if (count == 2 || !drop) {
                emit(p, v[1], v[2]);
                emit(p, v[2], q);
            }
        }
        indices = std::move(out);
    }
};

}  // namespace

double belowNeckline(const glm::dvec3& base, double drop) {
    // A crew neck: outside of an ellipsoid about the root of the neck that reaches the pit of the throat in
    // front, the trapezius at the sides and the seventh vertebra behind; a cylinder above its centre. On the
    // base mesh, decimetres.
    constexpr glm::dvec3 kCentre{0, 5.75, 0.12}, kRadii{0.80, 0.92, 0.76};
    glm::dvec3 d = base - kCentre;
    d.y = std::min(d.y, 0.0);
    constexpr double kMeanRadius = 0.8;
    constexpr double kTop =
        6.0;  // nothing above is shirt: the underside of the chin lies outside of the cylinder
    return std::min(kDecimetre * kMeanRadius * (glm::length(d / kRadii) - 1) - drop,
                    kDecimetre * (kTop - base.y));
}

TriangleMesh makeShirt(const QuadMesh& body, const QuadMesh& base, double drop, unsigned seed) {
    QuadMesh cloth = body;
    std::vector<double> below;
    for (const glm::dvec3& p : base.positions) below.push_back(belowNeckline(p, drop));
    drape(cloth, below, seed);
    const QuadMesh fine = subdivide(cloth, 1), fineBase = subdivide(base, 1);
    Cut cut;
    cut.position = fine.positions;
    cut.normal = fine.normals;
    cut.base = fineBase.positions;
    for (const glm::dvec3& p : cut.base) cut.value.push_back(belowNeckline(p, drop));
    for (const QuadMesh::Face& face : fine.faces)
        for (const int k : {0, 1, 2, 0, 2, 3}) cut.indices.push_back(std::uint32_t(face.vertex[k]));
    cut.split(0, true);
    for (const double level : {0.003, kRibWidth - 0.001, kRibWidth + 0.001}) cut.split(level, false);

    TriangleMesh out;
    std::map<std::uint32_t, std::uint32_t> used;
    for (const std::uint32_t i : cut.indices) {
        const auto [entry, added] = used.try_emplace(i, std::uint32_t(out.positions.size()));
        if (added) {
            out.positions.push_back(cut.position[i] + cut.normal[i] * clothHeight(cut.value[i]));
            const glm::dvec3 p = cut.base[i] * kDecimetre;
            // Around and down the body: close enough to a tailor's pattern for a texture this fine.
            const double around = std::abs(p.x) > 0.17 ? p.z : std::atan2(p.x, p.z) * 0.13;
            out.uvs.push_back(glm::dvec2(around, -p.y) / kTile);
        }
        out.indices.push_back(entry->second);
    }
    out.normals.assign(out.positions.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < out.indices.size(); t += 3) {
        const std::uint32_t* v = &out.indices[t];
        const glm::dvec3 area =
            glm::cross(out.positions[v[1]] - out.positions[v[0]], out.positions[v[2]] - out.positions[v[0]]);
        for (int k = 0; k < 3; ++k) out.normals[v[k]] += area;
    }
    for (glm::dvec3& n : out.normals) n = glm::dot(n, n) > 0 ? glm::normalize(n) : glm::dvec3(0, 0, 1);
    computeTangents(out);
    return out;
}

Raster makeKnit(int size) {
    constexpr int kStitches = 14;  // across a tile: a fine jersey of 1.4 mm
    constexpr double kPi = 3.14159265358979323846, kDepth = 0.10;
    const auto height = [&](double u, double v) {
        const double column = u * kStitches, x = column - std::floor(column);
        const double slant = (x < 0.5 ? x : 1 - x) * 0.9;
        const double row = v * kStitches - slant;
        const double rib = std::abs(std::sin(2 * kPi * x)), loop = 0.5 + 0.5 * std::cos(2 * kPi * row);
        return kDepth * (0.6 * rib + 0.4 * loop * rib);
    };
    Raster out(size, size, 3);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size, v = (y + 0.5) / size, e = 0.5 / size;
            const double scale = kStitches;  // heights are in stitches
            const double du = (height(u + e, v) - height(u - e, v)) / (2 * e * scale);
            const double dv = (height(u, v + e) - height(u, v - e)) / (2 * e * scale);
            const glm::dvec3 n = glm::normalize(glm::dvec3(-du, dv, 1));
            for (int c = 0; c < 3; ++c) out.at(x, y)[c] = float(0.5 + 0.5 * n[c]);
        }
    return out;
}

}  // namespace cutis::people
