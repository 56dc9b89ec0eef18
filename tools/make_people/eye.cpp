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
    // Only walls within three radii matter; on a half of the sphere of directions that is 2 cm away at most.
    std::vector<std::array<glm::dvec3, 3>> near;
    for (std::size_t t = 0; t + 2 < walls.indices.size(); t += 3) {
        std::array<glm::dvec3, 3> p{};
        bool close = false;
        for (int k = 0; k < 3; ++k) {
            p[k] = walls.positions[walls.indices[t + k]];
            close = close || glm::distance(p[k], eye.centre) < 1.7 * eye.radius;
        }
        if (close) near.push_back(p);
    }
    const auto hits = [&](const glm::dvec3& origin, const glm::dvec3& direction) {
        for (const auto& p : near) {  // Möller & Trumbore 1997
            const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], h = glm::cross(direction, e2);
            const double det = glm::dot(e1, h);
            if (std::abs(det) < 1e-18) continue;
            const glm::dvec3 s = origin - p[0], q = glm::cross(s, e1);
            const double u = glm::dot(s, h) / det, v = glm::dot(direction, q) / det;
            if (u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 1e-6) return true;
        }
        return false;
    };
    ball.colors.assign(ball.positions.size(), glm::dvec3(0));
    constexpr int kDirections = 64;
    parallelFor(ball.positions.size(), [&](std::size_t i) {
        const glm::dvec3 n = ball.normals[i];
        if (glm::dot(n, eye.gaze) < -0.2) return;  // the back of the ball is never seen
        const glm::dvec3 t =
            glm::normalize(glm::cross(n, std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 b = glm::cross(n, t);
        int open = 0;
        for (int k = 0; k < kDirections; ++k) {  // cosine-distributed, a golden-angle spiral
            const double u = (k + 0.5) / kDirections, phi = k * 2.399963229728653;
            const double r = std::sqrt(u), z = std::sqrt(1 - u);
            const glm::dvec3 d = r * std::cos(phi) * t + r * std::sin(phi) * b + z * n;
            if (!hits(ball.positions[i] + 1e-4 * n, d)) ++open;
        }
        ball.colors[i] = glm::dvec3(double(open) / kDirections);
    });
}

Raster makeEyeColors(const Raster& picture) {
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
                const double iris = 0.9 * glm::mix(grey, double(texel[c]), 0.55);
                out.at(x, y)[c] = float(glm::mix(iris, texel[c] * white[c], sclera));
            }
        }
    return out;
}

}  // namespace cutis::people
