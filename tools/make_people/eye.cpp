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
// the sclera at the limbus, 5.9 mm from the axis, and stands 1.3 mm proud of the sclera's sphere at its top.
constexpr double kLimbusRadius = 5.9 / 12, kCornealBulge = 1.0 / 12;

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

TriangleMesh makeEyeball(const Eye& eye, double irisScale) {
    constexpr int kRings = 40, kSegments = 48;
    const glm::dvec3 axis = eye.gaze, right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), axis)),
                     up = glm::cross(axis, right);
    const double limbus = std::asin(kLimbusRadius);
    TriangleMesh mesh;
    for (int i = 0; i <= kRings; ++i) {
        // Half of the rings over the cornea and the limbus, which is what one sees.
        const double t = double(i) / kRings;
        const double theta =
            t < 0.5 ? 2 * t * 1.3 * limbus : 1.3 * limbus + (2 * t - 1) * (kPi * 0.75 - 1.3 * limbus);
        const double s = std::clamp(1 - theta / (1.12 * limbus), 0.0, 1.0);
        const double radius = eye.radius * (1 + kCornealBulge * s * s * (3 - 2 * s) * 1.15);
        const double irisAngle = limbus * irisScale;
        const double r = theta < irisAngle
                             ? kPictureIris * std::sin(theta) / std::sin(irisAngle)
                             : kPictureIris + (kPictureBall - kPictureIris) *
                                                  std::min(1.0, (theta - irisAngle) / (kPi / 2 - irisAngle));
        for (int j = 0; j <= kSegments; ++j) {
            const double phi = 2 * kPi * j / kSegments;
            const glm::dvec3 around = std::cos(phi) * right + std::sin(phi) * up;
            mesh.positions.push_back(eye.centre +
                                     radius * (std::cos(theta) * axis + std::sin(theta) * around));
            mesh.uvs.push_back(kPictureCentre + r * glm::dvec2(std::cos(phi), -std::sin(phi)));
        }
    }
    const auto at = [](int i, int j) { return std::uint32_t(i * (kSegments + 1) + j); };
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kSegments; ++j) {
            if (i > 0) mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
            mesh.indices.insert(mesh.indices.end(), {at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    // Normals from the profile: neighbours along both directions, one-sided at the two ends.
    mesh.normals.resize(mesh.positions.size());
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j <= kSegments; ++j) {
            const glm::dvec3 along =
                mesh.positions[at(std::min(kRings, i + 1), j)] - mesh.positions[at(std::max(0, i - 1), j)];
            const double phi = 2 * kPi * j / kSegments;
            const glm::dvec3 tangent = -std::sin(phi) * right + std::cos(phi) * up;
            mesh.normals[at(i, j)] = i == 0 ? axis : glm::normalize(glm::cross(along, tangent));
        }
    return mesh;
}

void shadeByOpenness(TriangleMesh& ball, const Eye& eye, const TriangleMesh& walls) {
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
    ball.colors.assign(ball.positions.size(), glm::dvec3(0));
    parallelFor(ball.positions.size(), [&](std::size_t i) {
        const glm::dvec3 n = ball.normals[i], origin = ball.positions[i] + 1e-4 * n;
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
        ball.colors[i] =
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
            // The painted irises are more colourful than real ones: pull them towards their own grey.
            const double grey = 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
            for (int c = 0; c < 3; ++c) {
                const double iris = 0.9 * irisGain[c] * glm::mix(grey, double(texel[c]), 0.55);
                out.at(x, y)[c] = float(glm::mix(iris, texel[c] * white[c], sclera));
            }
        }
    return out;
}

}  // namespace cutis::people
