#include "tests/frame/small_scene.h"

#include <cstdlib>

#include "tests/support/pictures.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

// Few triangles: what is tested is which passes run.
Primitive smallBox(const glm::dvec3& min, const glm::dvec3& max) {
    ChartedMesh mesh(0.01);
    const glm::dvec3 x(max.x - min.x, 0, 0), y(0, max.y - min.y, 0), z(0, 0, max.z - min.z);
    mesh.addQuad(min, y, x, 2), mesh.addQuad(min + z, x, y, 2);
    mesh.addQuad(min, z, y, 2), mesh.addQuad(min + x, y, z, 2);
    mesh.addQuad(min, x, z, 2), mesh.addQuad(min + y, z, x, 2);
    return mesh.finish();
}

// Two shades in a check of 4 × 4.
int addCheck(Scene& scene) {
    Image image;
    image.width = image.height = 4;
    for (int i = 0; i < 16; ++i) {
        const auto shade = static_cast<std::byte>((i + i / 4) % 2 ? 255 : 200);
        image.texels.insert(image.texels.end(), {shade, shade, shade, std::byte{255}});
    }
    scene.images.push_back(image);
    Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

}  // namespace

SmallScene::SmallScene() : sky(skyOf(0.3, 4)) {
    SceneBuilder builder;
    skinMaterial = builder.addSkin(SkinMaterial(), {0.8, 0.6, 0.5});
    Material glass;
    glass.name = "glass";
    glass.baseColor = {0.9f, 0.9f, 1, 0.4f};
    glass.metallic = 0;
    glass.alphaMode = AlphaMode::blend;
    glassMaterial = builder.addMaterial(glass);
    builder.addObject("head", smallBox({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), skinMaterial);
    builder.addObject("ear", smallBox({0.11, -0.02, 0}, {0.15, 0.04, 0.004}), skinMaterial);
    builder.addObject("other", smallBox({-0.3, -0.05, -0.05}, {-0.2, 0.05, 0.05}), skinMaterial);
    builder.addObject("pane", smallBox({-0.2, -0.2, -0.23}, {0.3, 0.2, -0.22}), glassMaterial);
    builder.addObject("wall", smallBox({-0.5, -0.3, -0.32}, {0.5, 0.3, -0.3}), builder.addMatte());
    scene = builder.scene();
    scene.materials[skinMaterial].baseColorTexture.texture = addCheck(scene);
    prepareScene(scene);
    input.scene = &scene;
    input.environment = &sky;
    input.camera = cameraAt(-0.05);
    input.rig.lights = {pointLight("key", {0.4, 0.3, 0.5}, 0.6), directionalLight("back", normalize(glm::dvec3(-0.4, -0.2, 1)), 1.5),
                        rectLight("box", {-0.5, 0.4, 0.3}, normalize(glm::dvec3(0.7, -0.5, -0.5)), 6, 0.2, 0.2, 4)};
    settings.width = 80;
    settings.height = 60;
    settings.irradianceSize = 160;
    settings.lightMapSize = 128;
}

Camera SmallScene::cameraAt(double x, double width) const {
    SceneBuilder builder;
    builder.setOrthographicCamera({x + 0.07, 0.05, 0.6}, {x, 0, 0}, width);
    return builder.scene().cameras[0];
}

Environment skyOf(double low, double high) {
    const Picture picture = makeEnvironment(
        32, 16, [&](const glm::dvec3& w) { return glm::dvec3(w.x > 0.5 && w.y > 0 ? high : low); });
    Environment environment{"sky", 32, 16, {}};
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) environment.radiance.push_back(glm::vec3(rgbAt(picture, x, y)));
    }
    return environment;
}

gpu::Device& SmallSceneTest::device() {
    setenv("CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR, 1);
    static gpu::Device shared({.select = "cpu", .validation = true});
    return shared;
}

}  // namespace cutis::test
