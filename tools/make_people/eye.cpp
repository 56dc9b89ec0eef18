#include "eye.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "renderer/core/parallel.h"

namespace cutis::people {
namespace {

constexpr double kPi = 3.14159265358979323846;

// MakeHuman's eye picture holds one ball seen from the front here: centre, radius of the iris, radius of the
// ball.
constexpr glm::dvec2 kPictureCentre{0.7045, 0.295};
constexpr double kPictureIris = 0.1165, kPictureBall = 0.285;

// Anatomy (Atchison & Smith 2000): in an eye of radius 12 mm the cornea is a cap of radius 7.8 mm that meets
// the sclera at the limbus, 5.9 mm from the axis.
constexpr double kLimbusRadius = 5.9 / 12, kCornealRadius = 7.8 / 12;
constexpr int kSegments = 48;

// Axes of an eye, z along its gaze.
glm::dmat3 axesOf(const Eye& eye) {
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), eye.gaze));
    return {right, glm::cross(eye.gaze, right), eye.gaze};
}

// The angle from the gaze, seen from the middle of the eye, at which iris and sclera meet.
double limbusOf(double irisScale) {
    return std::asin(kLimbusRadius) * irisScale;
}

// A surface of revolution: rings[i] is a place (distance from the axis, height) in the half plane of the
// axis. Normals follow from neighbouring rings, one-sided at both ends.
TriangleMesh revolve(const Eye& eye, const std::vector<glm::dvec2>& rings) {
    const glm::dmat3 axes = axesOf(eye);
    const int last = static_cast<int>(rings.size()) - 1;
    TriangleMesh mesh;
    for (int i = 0; i <= last; ++i) {
        const glm::dvec2 along = rings[std::min(last, i + 1)] - rings[std::max(0, i - 1)];
        const glm::dvec2 normal =
            rings[i].x == 0 ? glm::dvec2(0, 1) : glm::normalize(glm::dvec2(-along.y, along.x));
        for (int j = 0; j <= kSegments; ++j) {
            const double phi = 2 * kPi * j / kSegments;
            const glm::dvec2 around(std::cos(phi), std::sin(phi));
            mesh.positions.push_back(eye.centre + axes * glm::dvec3(rings[i].x * around, rings[i].y));
            mesh.normals.push_back(axes * glm::dvec3(normal.x * around, normal.y));
        }
    }
    const auto at = [](int i, int j) { return std::uint32_t(i * (kSegments + 1) + j); };
    for (int i = 0; i < last; ++i)
        for (int j = 0; j < kSegments; ++j) {
            if (rings[i].x > 0)
                mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
            mesh.indices.insert(mesh.indices.end(), {at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return mesh;
}

// Texture coordinates of a surface of revolution whose rings lie at these distances from the iris's centre in
// the picture.
std::vector<glm::dvec2> pictureUvs(const std::vector<double>& radii) {
    std::vector<glm::dvec2> uvs;
    for (const double r : radii)
        for (int j = 0; j <= kSegments; ++j) {
            const double phi = 2 * kPi * j / kSegments;
            uvs.push_back(kPictureCentre + r * glm::dvec2(std::cos(phi), -std::sin(phi)));
        }
    return uvs;
}

}  // namespace

Eye fitEye(const std::vector<glm::dvec3>& points) {
    // |p|² = 2 c·p + (r² - |c|²): linear in c and the last term. Solved about the mean by normal equations.
    glm::dvec3 mean(0);
    for (const glm::dvec3& p : points) mean += p / double(points.size());
    glm::dmat3 matrix(0);
    glm::dvec3 right(0);
    double meanSquare = 0;
    for (const glm::dvec3& p : points) meanSquare += glm::dot(p - mean, p - mean) / double(points.size());
    for (const glm::dvec3& p : points) {
        const glm::dvec3 q = p - mean;
        matrix += glm::outerProduct(q, q);
        right += 0.5 * (glm::dot(q, q) - meanSquare) * q;
    }
    const glm::dvec3 offset = glm::inverse(matrix) * right;
    return {mean + offset, std::sqrt(meanSquare + glm::dot(offset, offset)), {0, 0, 1}};
}

TriangleMesh makeSclera(const Eye& eye, double irisScale) {
    constexpr int kRings = 26;
    const double limbus = limbusOf(irisScale), end = 0.75 * kPi;
    std::vector<glm::dvec2> rings;
    std::vector<double> pictureRadii;
    for (int i = 0; i <= kRings; ++i) {
        // Denser towards the limbus, of which one sees most.
        const double t = double(i) / kRings, angle = glm::mix(limbus, end, t * (0.4 + 0.6 * t));
        rings.push_back(eye.radius * glm::dvec2(std::sin(angle), std::cos(angle)));
        const double share = std::min(1.0, (angle - limbus) / (kPi / 2 - limbus));
        pictureRadii.push_back(glm::mix(kPictureIris, kPictureBall, share));
    }
    TriangleMesh mesh = revolve(eye, rings);
    mesh.uvs = pictureUvs(pictureRadii);
    return mesh;
}

TriangleMesh makeIris(const Eye& eye, double irisScale) {
    constexpr int kRings = 10;
    const double limbus = limbusOf(irisScale);
    std::vector<glm::dvec2> rings;
    std::vector<double> pictureRadii;
    for (int i = 0; i <= kRings; ++i) {
        const double t = double(i) / kRings;
        rings.push_back(eye.radius * glm::dvec2(t * std::sin(limbus), std::cos(limbus)));
        pictureRadii.push_back(t * kPictureIris);
    }
    TriangleMesh mesh = revolve(eye, rings);
    mesh.uvs = pictureUvs(pictureRadii);
    return mesh;
}

TriangleMesh makeCornea(const Eye& eye, double irisScale) {
    constexpr int kRings = 20;
    constexpr double kWithin = 1.06;  // of the cap's half angle: to below the sclera
    const double radius = kCornealRadius * irisScale * eye.radius, limbus = limbusOf(irisScale);
    const double half = std::asin(eye.radius * std::sin(limbus) / radius);
    const double centre = eye.radius * std::cos(limbus) - radius * std::cos(half);
    std::vector<glm::dvec2> rings;
    for (int i = 0; i <= kRings; ++i) {
        const double angle = kWithin * half * i / kRings;
        rings.push_back({radius * std::sin(angle), centre + radius * std::cos(angle)});
    }
    TriangleMesh mesh = revolve(eye, rings);
    mesh.uvs.assign(mesh.positions.size(), glm::dvec2(0));
    return mesh;
}

void shadeByOpenness(TriangleMesh& part, const Eye& eye, const TriangleMesh& walls) {
    struct Wall {
        std::array<glm::dvec3, 3> corner;
        glm::dvec3 centre;
        double radius;
    };
    constexpr double kReach = 1.7;  // radii of the ball: lids and socket, not the far side of the nose
    std::vector<Wall> near;
    for (std::size_t t = 0; t + 2 < walls.indices.size(); t += 3) {
        Wall wall{};
        for (int k = 0; k < 3; ++k) wall.corner[k] = walls.positions[walls.indices[t + k]];
        wall.centre = (wall.corner[0] + wall.corner[1] + wall.corner[2]) / 3.0;
        for (const glm::dvec3& p : wall.corner)
            wall.radius = std::max(wall.radius, glm::distance(p, wall.centre));
        if (glm::distance(wall.centre, eye.centre) < kReach * eye.radius) near.push_back(wall);
    }
    const auto hits = [](const Wall& wall, const glm::dvec3& origin, const glm::dvec3& direction) {
        // Möller & Trumbore 1997
        const glm::dvec3 e1 = wall.corner[1] - wall.corner[0], e2 = wall.corner[2] - wall.corner[0];
        const glm::dvec3 h = glm::cross(direction, e2), s = origin - wall.corner[0], q = glm::cross(s, e1);
        const double det = glm::dot(e1, h);
        if (std::abs(det) < 1e-18) return false;
        const double u = glm::dot(s, h) / det, v = glm::dot(direction, q) / det;
        return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 1e-6;
    };
    constexpr int kDirections = 64;
    part.colors.assign(part.positions.size(), glm::dvec3(0));
    parallelFor(part.positions.size(), [&](std::size_t i) {
        const glm::dvec3 n = part.normals[i], origin = part.positions[i] + 1e-4 * n;
        if (glm::dot(n, eye.gaze) < -0.2) return;  // the back of the ball is never seen
        const glm::dvec3 t =
            glm::normalize(glm::cross(n, std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 b = glm::cross(n, t);
        std::array<glm::dvec3, kDirections> direction;
        std::array<bool, kDirections> open;
        open.fill(true);
        for (int k = 0; k < kDirections; ++k) {  // cosine-distributed, a golden-angle spiral
            const double u = (k + 0.5) / kDirections, phi = k * 2.399963229728653, r = std::sqrt(u);
            direction[k] = r * std::cos(phi) * t + r * std::sin(phi) * b + std::sqrt(1 - u) * n;
        }
        for (const Wall& wall : near) {
            const glm::dvec3 to = wall.centre - origin;
            const double distance2 = glm::dot(to, to), radius2 = wall.radius * wall.radius;
            if (glm::dot(to, n) < -wall.radius) continue;
            // Directions outside of the cone about the wall's bounding sphere miss it.
            const double along = distance2 > radius2 ? std::sqrt(distance2 - radius2) : -1;
            for (int k = 0; k < kDirections; ++k)
                if (open[k] && glm::dot(to, direction[k]) >= along && hits(wall, origin, direction[k]))
                    open[k] = false;
        }
        // A renderer shadows the ball as well, though not by all of this: meet it half way.
        part.colors[i] =
            glm::dvec3(std::sqrt(double(std::count(open.begin(), open.end(), true)) / kDirections));
    });
}

Raster makeEyeColors(const Raster& picture, const glm::dvec3& irisGain) {
    Raster out(picture.width, picture.height, 3);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const float* texel = picture.at(x, y);
            const glm::dvec2 uv((x + 0.5) / out.width, (y + 0.5) / out.height);
            const double r = glm::distance(uv, kPictureCentre);
            const double sclera = std::clamp((r - kPictureIris * 0.97) / (kPictureIris * 0.12), 0.0, 1.0);
            const double corner = std::clamp((r - kPictureIris * 1.1) / (kPictureBall * 0.45), 0.0, 1.0);
            // Sclera reflects about 60 % and is warmer towards the corners, where the conjunctiva is thicker.
            const glm::dvec3 white =
                glm::mix(glm::dvec3(0.78, 0.80, 0.82), glm::dvec3(0.74, 0.66, 0.63), corner);
            // The limbus is a dark ring, where the sclera grows thin over the iris.
            const double ring =
                1 - 0.5 * std::clamp((r - kPictureIris * 0.82) / (kPictureIris * 0.15), 0.0, 1.0);
            // The painted irises are more colourful than real ones: pull them towards their own grey.
            const double grey = 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
            for (int c = 0; c < 3; ++c) {
                const double iris = 0.75 * ring * irisGain[c] * glm::mix(grey, double(texel[c]), 0.55);
                out.at(x, y)[c] = float(glm::mix(iris, texel[c] * white[c], sclera));
            }
        }
    return out;
}

}  // namespace cutis::people
