// Posed meshes against ones baked by other means.
#include "renderer/scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderer/core/error.h"
#include "renderer/scene/characters.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRings = 17, kSides = 24;

// A tube of radius 0.1 from y = 0 to 1, bound to joint 0 at its foot and to joint 1 from y = 0.5 up, blended
// between 0.4 and 0.6.
double upperShare(double y) {
    return std::clamp((y - 0.4) / 0.2, 0.0, 1.0);
}

Primitive tube() {
    Primitive p;
    auto d = std::make_shared<Deformation>();
    d->firstInfluence.push_back(0);
    for (int ring = 0; ring < kRings; ++ring) {
        for (int side = 0; side < kSides; ++side) {
            const double y = double(ring) / (kRings - 1), angle = 2 * kPi * side / kSides;
            p.normals.emplace_back(std::cos(angle), 0, std::sin(angle));
            p.positions.emplace_back(0.1 * std::cos(angle), y, 0.1 * std::sin(angle));
            p.tangents.emplace_back(0, 1, 0, 1);
            const auto upper = float(upperShare(y));
            if (upper < 1) d->influences.push_back({0, 1 - upper});
            if (upper > 0) d->influences.push_back({1, upper});
            d->firstInfluence.push_back(std::uint32_t(d->influences.size()));
            if (ring + 1 == kRings) continue;
            const std::uint32_t a = ring * kSides + side, b = ring * kSides + (side + 1) % kSides;
            p.indices.insert(p.indices.end(), {a, a + kSides, b, b, a + kSides, b + kSides});
        }
    }
    d->positions = p.positions, d->normals = p.normals, d->tangents = p.tangents;
    p.deformation = std::move(d);
    p.material = 0;
    return p;
}

AnimationSampler rotationOverOneSecond(double degrees, const glm::dvec3& axis) {
    AnimationSampler curve{Interpolation::linear, 4, {0, 1}, {}};
    for (const double angle : {0.0, degrees * kPi / 180}) {
        const glm::dquat q = glm::angleAxis(angle, axis);
        for (const double v : {q.x, q.y, q.z, q.w}) curve.values.push_back(float(v));
    }
    return curve;
}

// Nodes: 0 the tube, moved and scaled, which must not matter; 1 the lower joint; 2, below it, the upper one.
Scene bendingTube(double degrees) {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back({"tube", {tube()}});
    scene.nodes.resize(3);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].skin = 0;
    scene.nodes[0].local = glm::translate(glm::dmat4(1), glm::dvec3(3, -2, 1)) *
                           glm::scale(glm::dmat4(1), glm::dvec3(2, 0.5, 1));
    scene.nodes[1].children = {2};
    scene.nodes[2].parent = 1;
    scene.nodes[2].local = glm::translate(glm::dmat4(1), glm::dvec3(0, 0.5, 0));
    scene.nodes[2].rest = Transform{.translation = {0, 0.5, 0}};
    scene.skins.push_back(
        {"", {1, 2}, {glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0, -0.5, 0))}});
    scene.animations.push_back(
        {"bend", {rotationOverOneSecond(degrees, {0, 0, 1})}, {{0, 2, AnimatedProperty::rotation}}, 1});
    prepareScene(scene);
    return scene;
}

struct WorldVertex {
    glm::dvec3 position, normal, tangent;
};

std::vector<WorldVertex> worldVertices(const Scene& scene, int node) {
    const Node& n = scene.nodes[node];
    const Primitive& p = scene.meshes[n.mesh].primitives[0];
    std::vector<WorldVertex> vertices;
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        const glm::dmat3 linear(n.world);
        vertices.push_back({glm::dvec3(n.world * glm::dvec4(p.positions[i], 1)),
                            glm::normalize(glm::inverseTranspose(linear) * glm::dvec3(p.normals[i])),
                            glm::normalize(linear * glm::dvec3(p.tangents[i]))});
    }
    return vertices;
}

// The baked tube: each vertex where the blend of standing still and turning about the joint puts it; normals
// across the baked surface by finite differences of it.
glm::dvec3 bent(double y, double angle, double bend, double radius = 0.1) {
    const glm::dvec3 p(radius * std::cos(angle), y, radius * std::sin(angle));
    const glm::dvec3 r(p.x * std::cos(bend) - (p.y - 0.5) * std::sin(bend),
                       0.5 + p.x * std::sin(bend) + (p.y - 0.5) * std::cos(bend), p.z);
    return glm::mix(p, r, upperShare(y));
}

// Positions within 1e-6 m. Normals within 1e-6 where the weights are constant; there the surface is rigid.
TEST(Pose, ABentTubeStandsWhereTheBakedOneDoes) {
    for (const double degrees : {0.0, 30.0, 90.0, -120.0}) {
        Scene scene = bendingTube(degrees);
        poseScene(scene, 0, 1);
        const std::vector<WorldVertex> vertices = worldVertices(scene, 0);
        const double bend = degrees * kPi / 180;
        for (int ring = 0; ring < kRings; ++ring) {
            const double y = double(ring) / (kRings - 1), share = upperShare(y);
            for (int side = 0; side < kSides; ++side) {
                const double angle = 2 * kPi * side / kSides;
                const WorldVertex& v = vertices[ring * kSides + side];
                EXPECT_LT(glm::distance(v.position, bent(y, angle, bend)), 1e-6) << degrees << " " << ring;
                // The inverse transpose of the blended rotation, by an independent inversion.
                const glm::dmat3 turned(std::cos(bend), std::sin(bend), 0, -std::sin(bend), std::cos(bend), 0,
                                        0, 0, 1);
                const glm::dmat3 blend = glm::dmat3(1) * (1 - share) + turned * share;
                const glm::dvec3 normal = glm::normalize(glm::inverseTranspose(blend) *
                                                         glm::dvec3(std::cos(angle), 0, std::sin(angle)));
                EXPECT_LT(glm::distance(v.normal, normal), 1e-6) << degrees << " " << ring;
                EXPECT_LT(glm::distance(v.tangent, glm::normalize(blend * glm::dvec3(0, 1, 0))), 1e-6);
            }
        }
    }
}

TEST(Pose, APoseDoesNotDependOnTheOneBefore) {
    Scene once = bendingTube(90), often = bendingTube(90);
    const std::vector<glm::vec3> rest = once.meshes[0].primitives[0].positions;
    poseScene(once, 0, 0.4);
    for (const double t : {0.9, 0.1, 3.0, 0.4}) poseScene(often, 0, t);
    EXPECT_EQ(once.meshes[0].primitives[0].positions, often.meshes[0].primitives[0].positions);
    EXPECT_EQ(once.meshes[0].primitives[0].normals, often.meshes[0].primitives[0].normals);
    EXPECT_EQ(once.nodes[2].world, often.nodes[2].world);
    poseScene(once, kAtRest, 0);
    poseScene(often, 0, 0);
    EXPECT_EQ(once.meshes[0].primitives[0].positions, often.meshes[0].primitives[0].positions);
    EXPECT_EQ(once.bounds.max, often.bounds.max);
}

// Two tubes bound to the same two joints, the second a metre aside: both bend, each about its own axis.
TEST(Pose, SkinsShareASkeleton) {
    Scene scene = bendingTube(90);
    Primitive aside = tube();
    auto d = std::make_shared<Deformation>(*aside.deformation);
    for (glm::vec3& p : d->positions) p.x += 1;
    aside.deformation = d;
    scene.meshes.push_back({"aside", {aside}});
    Node node;
    node.mesh = 1;
    node.skin = 1;
    scene.nodes.push_back(node);
    const glm::dmat4 back = glm::translate(glm::dmat4(1), glm::dvec3(-1, 0, 0));
    scene.skins.push_back(
        {"", {2, 1}, {scene.skins[0].inverseBind[1] * back, scene.skins[0].inverseBind[0] * back}});
    auto swapped = std::make_shared<Deformation>(*d);
    for (Influence& i : swapped->influences) i.joint = 1 - i.joint;  // its joints come in the other order
    scene.meshes[1].primitives[0].deformation = swapped;
    poseScene(scene, 0, 1);
    const std::vector<WorldVertex> a = worldVertices(scene, 0), b = worldVertices(scene, 3);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_LT(glm::distance(a[i].position, b[i].position), 1e-6) << i;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(scene.bounds.max[c], 0.5 + (c == 0 ? -0.4 : c == 1 ? 0.1 : -0.4), 1e-6) << c;
}

// A unit sphere whose targets swell it and stretch it to an ellipsoid of half axis 3 along y.
Scene morphingSphere(bool ownNormals) {
    Primitive p;
    MorphTarget swell, stretch;
    constexpr int kBands = 24;
    for (int band = 0; band <= kBands; ++band) {
        for (int side = 0; side < 2 * kBands; ++side) {
            const double polar = kPi * band / kBands, angle = kPi * side / kBands;
            const glm::vec3 n(std::sin(polar) * std::cos(angle), std::cos(polar),
                              std::sin(polar) * std::sin(angle));
            const auto v = std::uint32_t(p.positions.size());
            p.positions.push_back(n), p.normals.push_back(n);
            swell.vertices.push_back(v), swell.positions.push_back(n);
            if (n.y != 0) {
                stretch.vertices.push_back(v), stretch.positions.emplace_back(0, 2 * n.y, 0);
                const glm::dvec3 after = glm::normalize(glm::dvec3(n.x, n.y / 3, n.z));
                stretch.normals.push_back(glm::vec3(after) - n);
            }
            const std::uint32_t next = v - side + (side + 1) % (2 * kBands);
            if (band == kBands) continue;
            if (band > 0) p.indices.insert(p.indices.end(), {v, next, v + 2 * kBands});
            if (band + 1 < kBands)
                p.indices.insert(p.indices.end(), {next, next + 2 * kBands, v + 2 * kBands});
        }
    }
    auto d = std::make_shared<Deformation>();
    d->positions = p.positions, d->normals = p.normals;
    d->ownNormals = ownNormals;
    if (!ownNormals) stretch.normals.clear();
    d->targets = {swell, stretch};
    p.deformation = d;
    p.material = 0;
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back({"sphere", {p}});
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].weights = {0, 0};
    scene.animations.push_back({"morph",
                                {{Interpolation::linear, 2, {0, 1, 2}, {0, 0, 1, 0, 0, 1}}},
                                {{0, 0, AnimatedProperty::weights}},
                                2});
    prepareScene(scene);
    return scene;
}

TEST(Pose, AMorphingSphereIsTheBakedOne) {
    for (const bool ownNormals : {true, false}) {
        Scene scene = morphingSphere(ownNormals);
        const std::vector<glm::vec3> rest = scene.meshes[0].primitives[0].positions;
        // A pole's vertices have one triangle each: where normals follow from triangles theirs are that
        // one's.
        const auto isPole = [&](std::size_t i) { return !ownNormals && std::abs(rest[i].y) > 0.999; };
        // Normals that follow from triangles of 7.5 degrees are off by up to 0.002 at a stretch of 3.
        const double tolerance = ownNormals ? 1e-6 : 0.01;
        const Primitive& p = scene.meshes[0].primitives[0];
        poseScene(scene, 0, 0.25);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            EXPECT_LT(glm::distance(p.positions[i], 1.25f * rest[i]), 1e-6) << i;
            EXPECT_TRUE(isPole(i) || glm::distance(p.normals[i], rest[i]) < tolerance) << i;
        }
        poseScene(scene, 0, 2);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            EXPECT_LT(glm::distance(p.positions[i], rest[i] * glm::vec3(1, 3, 1)), 1e-6) << i;
            const glm::dvec3 normal = glm::normalize(glm::dvec3(rest[i]) / glm::dvec3(1, 3, 1));
            EXPECT_TRUE(isPole(i) || glm::distance(glm::dvec3(p.normals[i]), normal) < tolerance) << i;
        }
        EXPECT_NEAR(scene.bounds.max.y, 3, 1e-6);
        poseScene(scene, kAtRest, 0);
        EXPECT_EQ(p.positions, rest);
    }
}

// Morphed first, then skinned: a target that lifts the tube by 1 along y moves its bent half along -x.
TEST(Pose, TargetsMoveVerticesBeforeJointsDo) {
    Scene scene = bendingTube(90);
    auto d = std::make_shared<Deformation>(*scene.meshes[0].primitives[0].deformation);
    MorphTarget lift;
    for (std::uint32_t v = 0; v < d->positions.size(); ++v)
        lift.vertices.push_back(v), lift.positions.emplace_back(0, 1, 0);
    d->targets = {lift};
    scene.meshes[0].primitives[0].deformation = d;
    poseScene(scene, 0, 1);
    const std::vector<WorldVertex> before = worldVertices(scene, 0);
    scene.nodes[0].weights = {1};
    poseScene(scene, 0, 1);
    const std::vector<WorldVertex> after = worldVertices(scene, 0);
    EXPECT_LT(glm::distance(after.front().position - before.front().position, glm::dvec3(0, 1, 0)), 1e-6);
    EXPECT_LT(glm::distance(after.back().position - before.back().position, glm::dvec3(-1, 0, 0)), 1e-6);
}

// A joint that mirrors turns normals as it does the surface, and bitangents the other way.
TEST(Pose, MirroredJointsTurnNormalsAndTangents) {
    Scene scene = bendingTube(0);
    for (const int joint : {1, 2}) scene.nodes[joint].rest.reset();
    scene.nodes[1].local = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
    scene.nodes[0].local = glm::dmat4(1);
    scene.animations.clear();
    poseScene(scene, kAtRest, 0);
    const Primitive& p = scene.meshes[0].primitives[0];
    const Deformation& d = *p.deformation;
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        EXPECT_LT(glm::distance(p.normals[i], d.normals[i] * glm::vec3(-1, 1, 1)), 1e-6);
        EXPECT_EQ(p.tangents[i].w, -1);
    }
}

TEST(Pose, CamerasLightsAndCharactersFollowTheirNodes) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].skin = SkinMaterial{};
    Primitive p = tube();
    p.deformation = nullptr;
    scene.meshes.push_back({"tube", {p}});
    scene.cameras.resize(1), scene.lights.resize(1);
    scene.nodes.resize(2);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].camera = 0;
    scene.nodes[1].light = 0;
    for (Node& node : scene.nodes) node.rest = Transform{};
    scene.animations.push_back(
        {"walk",
         {{Interpolation::linear, 3, {0, 2}, {0, 0, 0, 4, 0, 0}}, rotationOverOneSecond(90, {0, 1, 0})},
         {{0, 0, AnimatedProperty::translation}, {1, 1, AnimatedProperty::rotation}},
         2});
    prepareScene(scene);
    poseScene(scene, 0, 1);
    EXPECT_NEAR(scene.cameras[0].world[3].x, 2, 1e-12);
    EXPECT_LT(glm::distance(scene.lights[0].direction, glm::dvec3(-1, 0, 0)), 1e-6);
    ASSERT_EQ(scene.characters.size(), 1u);
    EXPECT_NEAR(scene.characters[0].bounds.centre().x, 2, 1e-6);
    EXPECT_NEAR(scene.bounds.centre().x, 2, 1e-6);
    EXPECT_EQ(restWorldTransforms(scene)[0], glm::dmat4(1));
}

TEST(Pose, WhatLeavesTheWorldIsAnError) {
    Scene scene = bendingTube(90);
    scene.animations[0].samplers.push_back({Interpolation::linear, 3, {0, 1}, {1, 1, 1, 1e30f, 1, 1}});
    scene.animations[0].channels.push_back({1, 2, AnimatedProperty::scale});
    poseScene(scene, 0, 0);
    try {
        poseScene(scene, 0, 0.5);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "cannot pose scene: at 0.5 s of \"bend\" it reaches beyond 1e9 units");
    }
}

TEST(Pose, AnimationsAreFoundByNameAndNumber) {
    Scene scene = bendingTube(90);
    scene.animations.push_back({"walk", {}, {}, 0});
    EXPECT_EQ(findAnimation(scene, "bend"), 0);
    EXPECT_EQ(findAnimation(scene, "walk"), 1);
    EXPECT_EQ(findAnimation(scene, "1"), 1);
    for (const char* wrong : {"2", "-1", "wlak", "", "1.0"})
        EXPECT_THROW(findAnimation(scene, wrong), Error) << wrong;
    try {
        findAnimation(scene, "wlak");
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what())
                      .find("no animation 'wlak' (did you mean 'walk'?): there are 'bend', 'walk'"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Pose, AMatrixIsTakenApartIntoWhatMovesIt) {
    const Transform t{{1, 2, 3}, glm::normalize(glm::dquat(0.5, 0.1, -0.7, 0.2)), {2, 3, -0.5}};
    const glm::dmat4 m = toMatrix(t), again = toMatrix(toTransform(m));
    for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(m[c], again[c]), 1e-12) << c;
    const glm::dmat4 flat = glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 1));
    for (int c = 0; c < 4; ++c) EXPECT_EQ(toMatrix(toTransform(flat))[c], flat[c]) << c;
}

}  // namespace
}  // namespace cutis
