// Writes the scenes of docs/materials.md: material_scenes FOLDER. materials.glb: a coat, velvet, a glass card
// over skin, hair cards and an eye; pores.glb: a finger's breadth of skin with pores and a second lobe.
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderer/scene/gltf_writer.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;

Image paint(const std::string& name, int width, int height,
            const std::function<glm::dvec4(double u, double v)>& color) {
    Image image;
    image.name = name, image.width = width, image.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec4 c = glm::clamp(color((x + 0.5) / width, (y + 0.5) / height), 0.0, 1.0);
            for (int i = 0; i < 4; ++i)
                image.texels.push_back(static_cast<std::byte>(std::lround(255 * c[i])));
            image.opaque = image.opaque && c.a == 1;
        }
    return image;
}

// The front pole of the ball: pupil, iris with spokes, limbus, sclera.
glm::dvec4 eyeColor(double u, double v) {
    const double angle = v * kPi;
    const double spokes = 0.5 + 0.5 * std::sin(60 * 2 * kPi * u + 3 * std::sin(14 * kPi * u));
    glm::dvec3 color(0.93, 0.89, 0.87);
    if (angle < 0.5) color = glm::mix(glm::dvec3(0.25, 0.42, 0.5), glm::dvec3(0.5, 0.62, 0.6), spokes);
    if (angle < 0.5 && angle > 0.45) color *= 0.45;
    if (angle < 0.17) color = glm::dvec3(0.02);
    return {color, 1};
}

// Strands along v that thin out towards their tips.
glm::dvec4 hairColor(double u, double v) {
    const double strand = 0.5 + 0.5 * std::cos(40 * 2 * kPi * (u + 0.02 * std::sin(5 * v)));
    return {glm::dvec3(0.32, 0.2, 0.12) * (0.7 + 0.3 * strand), std::clamp(1.6 * strand - 0.9 * v, 0.0, 1.0)};
}

Material named(const std::string& name, const glm::vec3& color, float roughness) {
    Material material;
    material.name = name, material.baseColor = glm::vec4(color, 1);
    material.metallic = 0, material.roughness = roughness;
    return material;
}

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z) * kMm);
}

SkinMaterial skinOf(double lobeWeight, double detail) {
    SkinMaterial skin;
    skin.lobeWeight = lobeWeight, skin.detail = detail;
    return skin;
}

Scene materials() {
    SceneBuilder builder;
    const int skin = builder.addSkin(skinOf(0, 0), {0.75, 0.5, 0.42});
    builder.addObject("back", makeBox(glm::dvec3(-140, -48, -50) * kMm, glm::dvec3(140, 60, -30) * kMm),
                      skin);
    const auto ball = [](double radius) { return makeSphere(radius * kMm, SphereMapping::latLong); };
    Material coat = named("lacquer", {0.55f, 0.02f, 0.03f}, 0.55f);
    coat.clearcoat.factor = 1, coat.clearcoat.roughness = 0.03f;
    builder.addObject("lacquer", ball(26), builder.addMaterial(coat), at(-100, 0, 0));
    Material velvet = named("velvet", {0.08f, 0.02f, 0.1f}, 1);
    velvet.sheen.color = {0.75f, 0.4f, 0.85f}, velvet.sheen.roughness = 0.35f;
    builder.addObject("velvet", ball(26), builder.addMaterial(velvet), at(-40, 0, 0));
    // The eye's front, the pole of its texture, turns from +Y to +Z.
    Material eye = named("eye", {1, 1, 1}, 0.5f);
    eye.baseColorTexture.texture = 0;
    const glm::dmat4 forward = glm::rotate(glm::dmat4(1), kPi / 2, glm::dvec3(1, 0, 0));
    builder.addObject("eye", ball(24), builder.addMaterial(eye), at(20, 0, 0) * forward);
    Material cornea = named("cornea", {1, 1, 1}, 0);
    cornea.transmission = 1, cornea.dielectric.ior = 1.376f;
    builder.addObject("cornea", ball(15.6), builder.addMaterial(cornea), at(20, 0, 11.5));
    Material glass = named("glass", {0.55f, 0.85f, 0.75f}, 0);
    glass.transmission = 1, glass.doubleSided = true;
    builder.addObject("glass", makePlate(44 * kMm), builder.addMaterial(glass),
                      at(72, 18, -10) * glm::rotate(glm::dmat4(1), 0.25, glm::dvec3(1, 1, 0)));
    for (const bool mask : {false, true}) {
        Material hair = named(mask ? "masked hair" : "blended hair", {1, 1, 1}, 0.45f);
        hair.baseColorTexture.texture = 1, hair.doubleSided = true;
        hair.alphaMode = mask ? AlphaMode::mask : AlphaMode::blend;
        builder.addObject(hair.name, makePlate(34 * kMm), builder.addMaterial(hair),
                          at(mask ? 115 : 75, -22, -18));
    }
    builder.setOrthographicCamera(glm::dvec3(0, 30, 400) * kMm, {0, 0.004, 0}, 290 * kMm);
    Scene scene = builder.scene();
    scene.images = {paint("eye", 1024, 512, eyeColor), paint("hair", 512, 256, hairColor)};
    scene.textures = {{0, true, {}}, {1, true, {Wrap::clampToEdge, Wrap::clampToEdge, false, true}}};
    return scene;
}

Scene pores() {
    SceneBuilder builder;
    builder.addObject("plain skin", makeSphere(8 * kMm, SphereMapping::latLong),
                      builder.addSkin(skinOf(0, 0), {0.75, 0.5, 0.42}), at(-18, 0, 0));
    builder.addObject("pored skin", makeSphere(8 * kMm, SphereMapping::latLong),
                      builder.addSkin(skinOf(0, 1), {0.75, 0.5, 0.42}));
    builder.addObject("two-lobed skin", makeSphere(8 * kMm, SphereMapping::latLong),
                      builder.addSkin(skinOf(0.35, 0.7), {0.75, 0.5, 0.42}), at(18, 0, 0));
    builder.setOrthographicCamera(glm::dvec3(0, 0, 100) * kMm, {0, 0, 0}, 20 * kMm);
    return builder.scene();
}

}  // namespace
}  // namespace cutis::test

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: material_scenes FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    cutis::writeGlb(cutis::test::materials(), folder / "materials.glb");
    cutis::writeGlb(cutis::test::pores(), folder / "pores.glb");
}
