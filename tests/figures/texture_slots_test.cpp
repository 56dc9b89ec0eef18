// Every texture of a material, extensions included: what the renderer reads of it is what the reference
// reads.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/scene/gltf.h"
#include "renderer/scene/gltf_writer.h"
#include "tests/reference/evaluate.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kColumns = 4, kPixels = 40;  // balls side by side, and the pixels of each one's square
constexpr double kPitch = 24 * kMm, kRadius = 10 * kMm;

Image paint(const std::function<glm::dvec4(double u, double v)>& color) {
    constexpr int kSize = 64;
    Image image;
    image.width = image.height = kSize;
    image.opaque = false;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec4 c = color((x + 0.5) / kSize, (y + 0.5) / kSize);
            for (int i = 0; i < 4; ++i)
                image.texels.push_back(static_cast<std::byte>(std::lround(255 * c[i])));
        }
    return image;
}

// Waves, other ones in each channel: whoever reads the wrong one sees another picture.
glm::dvec4 waves(double u, double v) {
    const auto wave = [](double x) { return 0.5 + 0.45 * std::sin(2 * kPi * x); };
    return {wave(3 * u), wave(2 * v + 0.1), wave(2 * u + v), wave(2 * u - v + 0.3)};
}

glm::dvec4 bumps(double u, double v) {
    const glm::dvec3 n =
        glm::normalize(glm::dvec3(0.5 * std::sin(2 * kPi * 3 * u), 0.5 * std::sin(2 * kPi * 2 * v), 1));
    return {n * 0.5 + 0.5, 1};
}

// Black, dielectric without a reflection of its own.
Material black() {
    Material material;
    material.baseColor = {0, 0, 0, 1};
    material.metallic = 0;
    material.dielectric.specular = 0;
    return material;
}

struct Slot {
    const char* name;
    Material material;  // shows nothing but what the texture goes into
    TextureSlot Material::*slot = nullptr;
    TextureSlot& (*part)(Material&) = nullptr;  // a slot of an extension
    TextureSlot& in(Material& m) const { return part ? part(m) : m.*slot; }
    enum { color, data, normal } kind = data;
    double limit = 0.08;
};

// The renderer sums a sheen over 16 directions of the sky.
constexpr double kSheenLimit = 0.12;

std::vector<Slot> slots() {
    Material matte = black(), metal = black(), shiny = black(), glow = black(), coat = black(),
             velvet = black();
    Material glass = black();
    matte.baseColor = {0.8f, 0.7f, 0.6f, 1};
    metal.baseColor = matte.baseColor, metal.metallic = 1, metal.roughness = 0.8f;
    shiny.dielectric.specular = 1, shiny.dielectric.ior = 2, shiny.roughness = 0.6f;
    glow.emissive = {0.5f, 0.6f, 0.7f};
    coat.clearcoat.factor = 1, coat.clearcoat.roughness = 0.6f;
    velvet.sheen.color = {0.9f, 0.8f, 0.7f}, velvet.sheen.roughness = 0.9f;
    glass.baseColor = {1, 1, 1, 1}, glass.transmission = 1;
    const auto of = [](TextureSlot& (*part)(Material&)) { return part; };
    return {
        {"base colour", matte, &Material::baseColorTexture, nullptr, Slot::color},
        {"metallic-roughness", metal, &Material::metallicRoughnessTexture},
        {"normal", shiny, &Material::normalTexture, nullptr, Slot::normal},
        {"occlusion", matte, &Material::occlusionTexture},
        {"emissive", glow, &Material::emissiveTexture, nullptr, Slot::color},
        {"specular", shiny, nullptr,
         of([](Material& m) -> TextureSlot& { return m.dielectric.specularTexture; })},
        {"specular colour", shiny, nullptr,
         of([](Material& m) -> TextureSlot& { return m.dielectric.specularColorTexture; }), Slot::color},
        {"coat", coat, nullptr, of([](Material& m) -> TextureSlot& { return m.clearcoat.texture; })},
        {"coat roughness", coat, nullptr,
         of([](Material& m) -> TextureSlot& { return m.clearcoat.roughnessTexture; })},
        {"coat normal", coat, nullptr,
         of([](Material& m) -> TextureSlot& { return m.clearcoat.normalTexture; }), Slot::normal},
        {"sheen colour", velvet, nullptr,
         of([](Material& m) -> TextureSlot& { return m.sheen.colorTexture; }), Slot::color, kSheenLimit},
        {"sheen roughness", velvet, nullptr,
         of([](Material& m) -> TextureSlot& { return m.sheen.roughnessTexture; }), Slot::data, kSheenLimit},
        {"transmission", glass, &Material::transmissionTexture},
    };
}

// Side by side in the picture, but far from each other, so that none shades another.
glm::dvec3 placeOf(std::size_t i) {
    const double column = double(i % kColumns), row = double(i / kColumns), middle = 0.5 * (kColumns - 1);
    return {(column - middle) * kPitch, (middle - row) * kPitch, -0.2 * double(i)};
}

// A ball for each slot; behind the last one, which is seen through, a plate that shines.
Scene balls(bool textured) {
    SceneBuilder builder;
    const std::vector<Slot> all = slots();
    for (std::size_t i = 0; i < all.size(); ++i) {
        Material material = all[i].material;
        material.name = all[i].name;
        if (textured) all[i].in(material).texture = all[i].kind;
        builder.addObject(all[i].name, makeSphere(kRadius, SphereMapping::latLong, glm::dmat3(1), 0.25),
                          builder.addMaterial(material), glm::translate(glm::dmat4(1), placeOf(i)));
    }
    Material lamp;
    lamp.baseColor = {0.02f, 0.1f, 0.9f, 1};
    lamp.unlit = true;
    builder.addObject("plate", makePlate(kPitch), builder.addMaterial(lamp),
                      glm::translate(glm::dmat4(1), placeOf(all.size() - 1) - glm::dvec3(0, 0, 0.5)));
    builder.setOrthographicCamera({0, 0, 1.5}, {0, 0, 0}, kColumns * kPitch);
    Scene scene = builder.scene();
    scene.images = {paint(waves), paint(bumps)};
    scene.textures = {{0, true, {}}, {0, false, {}}, {1, false, {}}};
    return scene;
}

// Written and read again, as the renderer reads it: with tangents.
Scene asLoaded(const Scene& scene) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "cutis-texture-slots.glb";
    writeGlb(scene, file);
    Scene loaded = loadGltf(file);
    std::filesystem::remove(file);
    return loaded;
}

// ‖a - b‖ / ‖b‖ over the inner pixels of ball i.
double differenceOn(std::size_t i, const Picture& a, const Picture& b) {
    NormRatio ratio;
    const int left = int(i % kColumns) * kPixels, top = int(i / kColumns) * kPixels;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
            const glm::dvec2 p = (glm::dvec2(x, y) + 0.5 - 0.5 * kPixels) * (kPitch / kPixels);
            if (glm::length(p) > 0.7 * kRadius) continue;
            const glm::dvec3 there = rgbAt(b, left + x, top + y), here = rgbAt(a, left + x, top + y);
            for (int c = 0; c < 3; ++c) ratio.add(here[c] - there[c], there[c]);
        }
    return ratio.value();
}

// Under a sky with a bright side as wide as the lobes, which pixels resolve. Limit: bilinear against
// mipmapped lookups, what the environment's prefilter leaves, and the noise of the reference. A slot that is
// not read, or read from another channel, is wrong by what the second line asks for at the least.
TEST(TextureSlots, TheRendererReadsThemAsTheReferenceDoes) {
    const glm::dvec3 bright = glm::normalize(glm::dvec3(-0.4, 0.5, 1));
    const Picture sky = makeEnvironment(64, 32, [&](const glm::dvec3& d) {
        return glm::dvec3(0.3, 0.35, 0.4) + 2 * std::pow(std::max(glm::dot(d, bright), 0.0), 8.0);
    });
    constexpr int kSize = kColumns * kPixels;
    const auto picture = [&](bool textured) {
        return render({.scene = balls(textured), .environment = sky, .width = kSize, .height = kSize})
            .picture;
    };
    const Picture fast = picture(true), plain = picture(false);
    const reference::Result exact = evaluate(
        {.scene = asLoaded(balls(true)), .environment = sky, .width = kSize, .height = kSize, .passes = 16});
    reportFigure("texture slots: noise of the reference", exact.pictureError);
    const std::vector<Slot> all = slots();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string name = std::string("texture of ") + all[i].name;
        expectAtMost(name, differenceOn(i, fast, exact.picture), all[i].limit);
        const double without = differenceOn(i, plain, exact.picture);
        reportFigure(name + ", left out", without);
        EXPECT_GT(without, 2 * all[i].limit) << name << " makes a difference";
    }
}

}  // namespace
}  // namespace cutis::test
