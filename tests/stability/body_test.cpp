// Bodies, their texture coordinates and their place in the world at and beyond their ends.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "extreme.h"

namespace cutis::test {
namespace {

constexpr double kFurnace = 0.03;  // of these coarse pictures; tests/figures holds finer ones to 0.01

Light key() {
    return directionalLight("key", {0.5, -0.5, -1}, 1);
}

// The body in a uniform environment of radiance 1.
Extreme body(const std::string& name, const std::function<Primitive()>& mesh,
             Bounds3 bounds = Bounds3::atMost(1 + kFurnace)) {
    return {name,
            [=] {
                SceneBuilder builder;
                builder.addObject("body", mesh(), builder.addSkin(SceneBuilder::plainSkin()));
                return inUniformLight(pictureOf(builder));
            },
            bounds};
}

std::vector<Extreme> thicknesses() {
    std::vector<Extreme> cases;
    for (const double metres : {0.0, 1e-6, 1e-4, 1e-3, 1.0}) {
        // Two plates back to back, lit from behind: no more can come through than falls on.
        cases.push_back(
            {"slab_of_1e" + std::to_string(metres > 0 ? std::lround(std::log10(metres)) + 6 : -0) +
                 (metres > 0 ? "_micrometres" : "_thickness"),
             [metres] {
                 SceneBuilder builder;
                 Primitive front = makePlate(0.15), back = makePlate(0.15);
                 for (glm::vec3& p : back.positions) p = {-p.x, p.y, static_cast<float>(-metres)};
                 for (glm::vec3& n : back.normals) n = {0, 0, -1};
                 const int skin = builder.addSkin(SceneBuilder::plainSkin());
                 const auto count = static_cast<std::uint32_t>(front.positions.size());
                 front.positions.insert(front.positions.end(), back.positions.begin(), back.positions.end());
                 front.normals.insert(front.normals.end(), back.normals.begin(), back.normals.end());
                 for (glm::vec2& uv : front.uv0) uv.x *= 0.5f;
                 for (const glm::vec2& uv : back.uv0) front.uv0.push_back({0.5f + 0.5f * uv.x, uv.y});
                 for (const std::uint32_t i : back.indices) front.indices.push_back(count + i);
                 builder.addObject("slab", front, skin);
                 return inLight(pictureOf(builder), {directionalLight("behind", {0, 0, 1}, 1)});
             },
             // Without thickness all of it.
             metres < 1e-5 ? Bounds3::near(1 / 3.14159, 0.03) : Bounds3::atMost(1.01 / 3.14159)});
    }
    // A card: one sheet, seen and lit from both sides.
    cases.push_back({"card_of_two_sides",
                     [] {
                         SceneBuilder builder;
                         const int skin = builder.addSkin(SceneBuilder::plainSkin());
                         builder.addObject("card", makePlate(0.15), skin);
                         RenderJob job =
                             inLight(pictureOf(builder), {directionalLight("front", {0, 0, -1}, 1),
                                                          directionalLight("behind", {0, 0, 1}, 1)});
                         job.scene.materials[skin].doubleSided = true;
                         return job;
                     },
                     Bounds3::atMost(2.02 / 3.14159)});
    return cases;
}

// Appends a mesh to another.
void append(Primitive& to, const Primitive& mesh) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
    to.normals.insert(to.normals.end(), mesh.normals.begin(), mesh.normals.end());
    to.uv0.insert(to.uv0.end(), mesh.uv0.begin(), mesh.uv0.end());
    for (const std::uint32_t i : mesh.indices) to.indices.push_back(first + i);
}

// Two bodies in one mesh, their charts side by side, the second moved by `offset`.
Primitive joined(Primitive a, Primitive b, const glm::vec3& offset) {
    for (glm::vec3& p : b.positions) p += offset;
    for (glm::vec2& uv : a.uv0) uv.x *= 0.5f;
    for (glm::vec2& uv : b.uv0) uv.x = 0.5f + 0.5f * uv.x;
    append(a, b);
    return a;
}

// The sphere without a shared vertex: three for each triangle.
Primitive withoutSharedVertices() {
    const Primitive shared = sphere();
    Primitive mesh;
    for (const std::uint32_t i : shared.indices) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(shared.positions[i]);
        mesh.normals.push_back(shared.normals[i]);
        mesh.uv0.push_back(shared.uv0[i]);
    }
    return mesh;
}

// The sphere under a flat normal map, for which its tangents do not serve.
RenderJob withTangents(const glm::vec4& tangent) {
    RenderJob job = sphereJob(SceneBuilder::plainSkin());
    Image flat;
    flat.width = flat.height = 1;
    flat.texels = {std::byte(128), std::byte(128), std::byte(255), std::byte(255)};
    job.scene.images.push_back(flat);
    Texture texture;
    texture.image = 0;
    job.scene.textures.push_back(texture);
    job.scene.materials[0].normalTexture.texture = 0;
    Primitive& mesh = job.scene.meshes[0].primitives[0];
    mesh.tangents.assign(mesh.positions.size(), tangent);
    return inUniformLight(job);
}

std::vector<Extreme> meshes() {
    return {body("vertices_not_shared", withoutSharedVertices, Bounds3::near(1, kFurnace)),
            {"tangents_of_zero", [] { return withTangents(glm::vec4(0)); }, Bounds3::near(1, kFurnace)},
            {"tangents_along_normals",
             [] {
                 return withTangents({0, 0, 1, 1});
             },
             Bounds3::near(1, kFurnace)},
            body("self_intersecting",
                 [] {
                     return joined(sphere(), sphere(80 * kMm), {0.05f, 0, 0});
                 }),
            body("three_sheets_at_an_edge",
                 [] {
                     Primitive fin = makePlate(0.1);
                     for (glm::vec3& p : fin.positions) p = {0, p.y, p.x};
                     for (glm::vec3& n : fin.normals) n = {-1, 0, 0};
                     return joined(makePlate(0.2), fin, {0, 0, 0.05f});
                 }),
            body(
                "normals_of_zero",
                [] {
                    Primitive mesh = sphere();
                    mesh.normals.assign(mesh.normals.size(), glm::vec3(0));
                    return mesh;
                },
                Bounds3::near(1, kFurnace)),
            body(
                "no_normals",
                [] {
                    Primitive mesh = sphere();
                    mesh.normals.clear();
                    return mesh;
                },
                Bounds3::near(1, kFurnace)),
            body(
                "inside_out",
                [] {
                    Primitive mesh = sphere();
                    for (glm::vec3& n : mesh.normals) n = -n;
                    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
                        std::swap(mesh.indices[i], mesh.indices[i + 1]);
                    return mesh;
                },
                Bounds3::near(1, kFurnace)),
            body("open",
                 [] {
                     Primitive mesh = sphere();
                     mesh.indices.resize(mesh.indices.size() / 6 * 3);
                     return mesh;
                 }),
            body("each_triangle_twice",
                 [] {
                     Primitive mesh = sphere();
                     const std::vector<std::uint32_t> once = mesh.indices;
                     mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
                     return mesh;
                 }),
            body(
                "three_vertices",
                [] {
                    Primitive mesh;
                    mesh.positions = {{-0.1f, -0.1f, 0}, {0.1f, -0.1f, 0}, {0, 0.1f, 0}};
                    mesh.normals.assign(3, {0, 0, 1});
                    mesh.uv0 = {{0, 1}, {1, 1}, {0.5f, 0}};
                    mesh.indices = {0, 1, 2};
                    return mesh;
                },
                Bounds3::near(1, kFurnace)),
            {"one_inside_another",
             [] {
                 SceneBuilder builder;
                 const int skin = builder.addSkin(SceneBuilder::plainSkin());
                 builder.addObject("outer", sphere(), skin);
                 builder.addObject("inner", sphere(50 * kMm), skin);
                 return inLight(inUniformLight(pictureOf(builder)), {key()});
             },
             Bounds3::atMost(1.4)},
            {"two_that_cross",
             [] {
                 SceneBuilder builder;
                 const int skin = builder.addSkin(SceneBuilder::plainSkin());
                 builder.addObject("left", sphere(), skin, glm::translate(glm::dmat4(1), {-0.03, 0, 0}));
                 builder.addObject("right", sphere(), skin, glm::translate(glm::dmat4(1), {0.03, 0, 0}));
                 return inUniformLight(pictureOf(builder));
             },
             Bounds3::atMost(1 + kFurnace)}};
}

// The sphere with other texture coordinates.
Extreme mapped(const std::string& name, const std::function<glm::vec2(glm::vec2)>& map) {
    return body("uv_" + name, [map] {
        Primitive mesh = sphere();
        for (glm::vec2& uv : mesh.uv0) uv = map(uv);
        return mesh;
    });
}

std::vector<Extreme> charts() {
    return {body("uv_missing",
                 [] {
                     Primitive mesh = sphere();
                     mesh.uv0.clear();
                     return mesh;
                 }),
            mapped("of_no_area", [](glm::vec2) { return glm::vec2(0.5f); }),
            mapped("needle", [](glm::vec2 uv) { return glm::vec2(uv.x, uv.y * 1e-6f); }),
            mapped("sheared", [](glm::vec2 uv) { return glm::vec2(uv.x + 1000 * uv.y, uv.y); }),
            mapped("stretched_1_to_1000",
                   [](glm::vec2 uv) { return glm::vec2(uv.x, std::exp(6.9f * (uv.y - 1))); }),
            mapped("outside", [](glm::vec2 uv) { return uv * 10.f - 5.f; }),
            mapped("far_outside", [](glm::vec2 uv) { return uv + 1e6f; }),
            mapped("mirrored", [](glm::vec2 uv) { return glm::vec2(-uv.x, uv.y); })};
}

// The same body, lights and camera in a world `scale` times as large, moved by `offset`: the same picture.
RenderJob placed(double scale, const glm::dvec3& offset = glm::dvec3(0),
                 const glm::dvec3& turn = glm::dvec3(1)) {
    SceneBuilder builder;
    SkinMaterial skin;
    skin.mmPerUnit = 1000 / scale;
    const glm::dmat4 world = glm::scale(glm::translate(glm::dmat4(1), offset), scale * turn);
    builder.addObject("body", sphere(), builder.addSkin(skin), world);
    builder.setOrthographicCamera(offset + glm::dvec3(0, 0, 0.5 * scale), offset, 0.21 * scale);
    return inLight(inUniformLight(pictureOf(builder)), {key()});
}

// The same with other planes of the camera.
RenderJob between(double znear, double zfar) {
    RenderJob job = placed(1);
    job.scene.cameras[0].znear = znear, job.scene.cameras[0].zfar = zfar;
    return job;
}

std::vector<Extreme> worlds() {
    std::vector<Extreme> cases;
    const Expected still = rendered([] { return placed(1); });
    cases.push_back({"planes_far_apart", [] { return between(1e-6, 1e9); }, {}, still, 1, 2e-3});
    cases.push_back({"planes_close_together", [] { return between(0.4, 0.402); }});
    cases.back().leastPixels = 0;
    cases.push_back({"near_plane_through_the_body", [] { return between(0.45, 10); }});
    for (const int exponent : {-4, 4}) {
        cases.push_back({"scale_1e" + std::to_string(exponent + 4),
                         [exponent] { return placed(std::pow(10.0, exponent)); },
                         {},
                         still,
                         1,
                         2e-3});
    }
    cases.push_back({"a_kilometre_away", [] { return placed(1, {1e3, 0, 0}); }, {}, still, 1, 2e-3});
    cases.push_back({"a_thousand_kilometres_away",
                     [] {
                         return placed(1, {1e6, 1e6, 0});
                     },
                     {},
                     still,
                     1,
                     2e-3});
    cases.push_back({"negative_scale", [] { return placed(1, {}, {-1, 1, 1}); }, {}, still, 1, 2e-3});
    cases.push_back({"nonuniform_scale", [] { return placed(1, {}, {1, 0.2, 1}); }});
    return cases;
}

CUTIS_EXTREME_CASES(Thickness, thicknesses());
CUTIS_EXTREME_CASES(Meshes, meshes());
CUTIS_EXTREME_CASES(Charts, charts());
CUTIS_EXTREME_CASES(Worlds, worlds());

}  // namespace
}  // namespace cutis::test
