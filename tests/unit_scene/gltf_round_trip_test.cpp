// What writeGlb writes, loadGltf reads as the same scene.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/characters.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/light_samples.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

Image makeImage(int width, int height, bool opaque) {
    Image image;
    image.name = opaque ? "opaque" : "clear";
    image.width = width;
    image.height = height;
    image.opaque = opaque;
    for (int i = 0; i < width * height * 4; ++i) {
        image.texels.push_back(std::byte(opaque && i % 4 == 3 ? 255 : (i * 37 + 11) % 256));
    }
    return image;
}

Primitive makeQuad(int material) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0.25f}, {1, 1, 0}, {0, 1, 0}};
    p.normals.assign(4, glm::vec3(0, 0, 1));
    p.tangents.assign(4, glm::vec4(1, 0, 0, 1));
    p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    p.uv1 = {{0.5f, 1}, {1, 1}, {1, 0.5f}, {0.5f, 0.5f}};
    p.colors = {{1, 0, 0, 1}, {0, 1, 0, 0.5f}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

Scene makeScene() {
    Scene scene;
    scene.name = "everything";
    scene.images = {makeImage(3, 2, true), makeImage(2, 5, false)};
    scene.textures = {{0, true, {}},
                      {0, false, {Wrap::clampToEdge, Wrap::mirroredRepeat, true, true}},
                      {1, false, {Wrap::repeat, Wrap::repeat, false, false}}};
    Material skin;
    skin.name = "Anna's skin";
    skin.baseColor = {0.5f, 0.25f, 0.125f, 1};
    skin.baseColorTexture = {0, 0, glm::mat3(1)};
    // Scale (2, 3), then a turn by 0.5, then an offset: uv' = T R S uv.
    const float c = std::cos(0.5f), s = std::sin(0.5f);
    skin.normalTexture = {1, 1, glm::mat3(2 * c, -2 * s, 0, 3 * s, 3 * c, 0, 0.25f, -4, 1)};
    skin.normalScale = 0.75f;
    skin.occlusionTexture = {2, 0, glm::mat3(1)};
    skin.occlusionStrength = 0.5f;
    skin.metallic = 0;
    skin.roughness = 0.3f;
    skin.emissive = {6, 3, 0};
    skin.doubleSided = true;
    skin.skin = SkinMaterial{};
    skin.skin->profile.gaussians = {{0.1, {0.75, 0.5, 1}}, {3, {0.25, 0.5, 0}}};
    skin.skin->scale = 1.5;
    skin.skin->mmPerUnit = 10;
    skin.skin->lobeWeight = 0.25;
    skin.skin->lobeRatio = 0.375;
    skin.skin->detail = 1.5;
    skin.skin->detailScale = 12;
    skin.skin->translucency = false;
    Material glass;
    glass.name = "glass";
    glass.alphaMode = AlphaMode::blend;
    glass.unlit = true;
    Material eye;
    eye.name = "cornea";
    eye.dielectric = {.ior = 1.375f,
                      .specular = 0.5f,
                      .specularColor = {1, 2, 0.5f},
                      .specularTexture = {1, 0, glm::mat3(1)},
                      .specularColorTexture = {0, 1, glm::mat3(1)}};
    eye.clearcoat = {.factor = 0.75f,
                     .roughness = 0.125f,
                     .texture = {1, 0, glm::mat3(1)},
                     .roughnessTexture = {2, 0, glm::mat3(1)},
                     .normalTexture = {1, 1, glm::mat3(1)},
                     .normalScale = 0.25f};
    eye.sheen = {.color = {0.25f, 0.5f, 1},
                 .roughness = 0.375f,
                 .colorTexture = {0, 0, glm::mat3(1)},
                 .roughnessTexture = {1, 0, glm::mat3(1)}};
    eye.transmission = 0.875f;
    eye.transmissionTexture = {2, 1, glm::mat3(1)};
    Material lash;
    lash.alphaMode = AlphaMode::mask;
    lash.alphaCutoff = 0.75f;
    scene.materials = {skin, glass, lash, eye};
    scene.meshes = {{"face", {makeQuad(0), makeQuad(1), makeQuad(3)}}, {"lashes", {makeQuad(2)}}};
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& p : mesh.primitives) {
            if (!scene.materials[p.material].tangentTexture()) p.tangents.clear();
        }
    }

    scene.nodes.resize(5);
    scene.nodes[0].name = "Anna";
    scene.nodes[0].children = {2, 1};
    scene.nodes[0].local = glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3));
    scene.nodes[1].parent = scene.nodes[2].parent = 0;
    scene.nodes[1].mesh = 0;
    scene.nodes[2].mesh = 1;
    scene.nodes[2].local = glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 0, 1));
    scene.nodes[3].name = "Lens";
    scene.nodes[3].camera = 0;
    scene.nodes[3].local = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 9));
    scene.nodes[4].name = "Lamp";
    scene.nodes[4].light = 0;
    Camera lens, flat;
    lens.name = "Lens";
    lens.yfov = 0.4;
    lens.zfar = 100;
    flat.name = "Flat";
    flat.orthographic = true;
    flat.ymag = 2;
    flat.zfar = 20;
    flat.world = glm::translate(glm::dmat4(1), glm::dvec3(0, 7, 0));
    scene.cameras = {lens, flat};
    Light lamp, sun;
    lamp.name = "Lamp";
    lamp.type = LightType::spot;
    lamp.color = {1, 0.5, 0.25};
    lamp.intensity = 12;
    lamp.innerConeAngle = 0.2;
    lamp.outerConeAngle = 0.5;
    lamp.range = 4;
    sun.name = "Sun";
    sun.type = LightType::directional;
    sun.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
    scene.lights = {lamp, sun};
    prepareScene(scene);
    return scene;
}

void expectSameSlot(const Scene& a, const TextureSlot& s, const Scene& b, const TextureSlot& t) {
    ASSERT_EQ(bool(s), bool(t));
    if (!s) return;
    EXPECT_EQ(s.texCoord, t.texCoord);
    for (int c = 0; c < 3; ++c) EXPECT_LT(glm::distance(s.transform[c], t.transform[c]), 1e-5f);
    const Texture &x = a.textures[s.texture], &y = b.textures[t.texture];
    EXPECT_EQ(x.srgb, y.srgb);
    EXPECT_EQ(x.sampler, y.sampler);
    EXPECT_EQ(a.images[x.image].texels, b.images[y.image].texels);
    EXPECT_EQ(a.images[x.image].opaque, b.images[y.image].opaque);
    EXPECT_EQ(a.images[x.image].width, b.images[y.image].width);
}

void expectSameMaterial(const Scene& a, const Material& m, const Scene& b, const Material& n) {
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.baseColor, n.baseColor);
    EXPECT_EQ(m.metallic, n.metallic);
    EXPECT_EQ(m.roughness, n.roughness);
    EXPECT_EQ(m.normalScale, n.normalScale);
    EXPECT_EQ(m.occlusionStrength, n.occlusionStrength);
    EXPECT_LT(glm::distance(m.emissive, n.emissive), 1e-6f);
    EXPECT_EQ(m.alphaMode, n.alphaMode);
    EXPECT_EQ(m.alphaCutoff, n.alphaCutoff);
    EXPECT_EQ(m.doubleSided, n.doubleSided);
    EXPECT_EQ(m.unlit, n.unlit);
    for (std::size_t i = 0; i < m.slots().size(); ++i) expectSameSlot(a, *m.slots()[i], b, *n.slots()[i]);
    EXPECT_EQ(m.dielectric.ior, n.dielectric.ior);
    EXPECT_EQ(m.dielectric.specular, n.dielectric.specular);
    EXPECT_EQ(m.dielectric.specularColor, n.dielectric.specularColor);
    EXPECT_EQ(m.clearcoat.factor, n.clearcoat.factor);
    EXPECT_EQ(m.clearcoat.roughness, n.clearcoat.roughness);
    EXPECT_EQ(m.clearcoat.normalScale, n.clearcoat.normalScale);
    EXPECT_EQ(m.sheen.color, n.sheen.color);
    EXPECT_EQ(m.sheen.roughness, n.sheen.roughness);
    EXPECT_EQ(m.transmission, n.transmission);
    ASSERT_EQ(m.skin.has_value(), n.skin.has_value());
    if (!m.skin) return;
    EXPECT_EQ(m.skin->profile, n.skin->profile);
    EXPECT_EQ(m.skin->scale, n.skin->scale);
    EXPECT_EQ(m.skin->mix, n.skin->mix);
    EXPECT_EQ(m.skin->mmPerUnit, n.skin->mmPerUnit);
    EXPECT_EQ(m.skin->translucency, n.skin->translucency);
    EXPECT_EQ(m.skin->lobeWeight, n.skin->lobeWeight);
    EXPECT_EQ(m.skin->lobeRatio, n.skin->lobeRatio);
    EXPECT_EQ(m.skin->detail, n.skin->detail);
    EXPECT_EQ(m.skin->detailScale, n.skin->detailScale);
}

TEST(GltfRoundTrip, EverythingComesBack) {
    const test::TemporaryFolder folder;
    const test::CapturedWarnings warnings;
    const Scene a = makeScene();
    writeGlb(a, folder / "a.glb");
    const Scene b = loadGltf(folder / "a.glb");
    EXPECT_TRUE(warnings.all().empty());

    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i)
        expectSameMaterial(a, a.materials[i], b, b.materials[i]);
    // Cameras and lights without a node got one each.
    ASSERT_EQ(b.nodes.size(), a.nodes.size() + 2);
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        const Node &x = a.nodes[i], &y = b.nodes[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.parent, y.parent);
        EXPECT_EQ(x.children, y.children);
        EXPECT_EQ(x.world, y.world);
        ASSERT_EQ(x.mesh < 0, y.mesh < 0);
        if (x.mesh < 0) continue;
        const Mesh &m = a.meshes[x.mesh], &n = b.meshes[y.mesh];
        EXPECT_EQ(m.name, n.name);
        ASSERT_EQ(m.primitives.size(), n.primitives.size());
        for (std::size_t k = 0; k < m.primitives.size(); ++k) {
            const Primitive &p = m.primitives[k], &q = n.primitives[k];
            EXPECT_EQ(p.positions, q.positions);
            EXPECT_EQ(p.normals, q.normals);
            EXPECT_EQ(p.tangents, q.tangents);
            EXPECT_EQ(p.uv0, q.uv0);
            EXPECT_EQ(p.uv1, q.uv1);
            EXPECT_EQ(p.colors, q.colors);
            EXPECT_EQ(p.indices, q.indices);
            EXPECT_EQ(p.material, q.material);
        }
    }
    ASSERT_EQ(b.cameras.size(), 2u);
    EXPECT_EQ(b.cameras[0].name, "Lens");
    EXPECT_EQ(b.cameras[0].yfov, 0.4);
    EXPECT_EQ(b.cameras[0].zfar, 100);
    EXPECT_EQ(b.cameras[1].world, a.cameras[1].world);
    EXPECT_EQ(b.cameras[1].ymag, 2);
    ASSERT_EQ(b.lights.size(), 2u);
    EXPECT_EQ(a.lights[0], b.lights[0]);
    EXPECT_EQ(b.lights[1].name, "Sun");
    EXPECT_LT(glm::distance(a.lights[1].direction, b.lights[1].direction), 1e-12);
    ASSERT_EQ(b.characters.size(), 1u);
    EXPECT_EQ(b.characters[0].name, "Anna");
    EXPECT_EQ(b.characters[0].nodes, a.characters[0].nodes);
    EXPECT_EQ(b.bounds.min, a.bounds.min);
}

TEST(GltfRoundTrip, TemperaturesBecomeColoursOfTheSameLight) {
    Scene scene;
    Light lamp;
    lamp.name = "lamp";
    lamp.temperature = 3000;
    lamp.color = {1, 0.5, 1};
    lamp.intensity = 7;
    scene.lights = {lamp};
    prepareScene(scene);
    const test::TemporaryFolder folder;
    writeGlb(scene, folder / "lamp.glb");
    const Light back = loadGltf(folder / "lamp.glb").lights.at(0);
    const glm::dvec3 expected = lamp.color * colorFromTemperature(3000) * 7.0;
    EXPECT_LT(glm::distance(back.color * back.intensity, expected), 1e-9);
    EXPECT_LE(std::max({back.color.r, back.color.g, back.color.b}), 1);
}

TEST(GltfRoundTrip, WhatCannotBeWrittenIsSaid) {
    const test::TemporaryFolder folder;
    Scene scene;
    Light softbox;
    softbox.name = "softbox";
    softbox.type = LightType::rect;
    scene.lights = {softbox};
    {
        const test::CapturedWarnings warnings;
        writeGlb(scene, folder / "rect.glb");
        EXPECT_EQ(warnings.count("softbox"), 1);
        EXPECT_TRUE(loadGltf(folder / "rect.glb").lights.empty());
    }
    Image deep = makeImage(1, 1, true);
    deep.format = TexelFormat::rgba16f;
    scene.images = {deep};
    EXPECT_THROW(writeGlb(scene, folder / "deep.glb"), Error);
    EXPECT_THROW(writeGlb(Scene{}, folder / "absent" / "scene.glb"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "deep.glb"));
}

}  // namespace
}  // namespace cutis
