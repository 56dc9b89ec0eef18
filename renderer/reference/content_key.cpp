#include "renderer/reference/content_key.h"

#include <algorithm>
#include <span>

#include "renderer/core/files.h"

namespace cutis::reference {
namespace {

// Changes whenever the same input gives other numbers than before.
constexpr std::uint32_t kEstimatorVersion = 6;

class Hash {
  public:
    template <class T>
    void add(const std::vector<T>& values) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
                      sizeof(T) % sizeof(float) == 0);
        add(values.size());
        hash_ = hashBytes(std::as_bytes(std::span(values)), hash_);
    }
    // Numbers, vectors and matrices: types without padding.
    template <class... T>
    void add(const T&... values) {
        ((hash_ = hashBytes(std::as_bytes(std::span(&values, 1)), hash_)), ...);
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

void addSlot(Hash& hash, const Scene& scene, const TextureSlot& slot) {
    hash.add(slot.texture);
    if (!slot) return;
    const Texture& texture = scene.textures[slot.texture];
    hash.add(slot.texCoord, slot.transform, texture.image, texture.srgb, texture.sampler.wrapU,
             texture.sampler.wrapV, texture.sampler.nearest);
}

void addMaterial(Hash& hash, const Scene& scene, const Material& m) {
    hash.add(m.baseColor, m.metallic, m.roughness, m.normalScale, m.occlusionStrength, m.emissive,
             m.alphaMode, m.alphaCutoff, m.doubleSided, m.unlit);
    hash.add(m.dielectric.ior, m.dielectric.specular, m.dielectric.specularColor, m.clearcoat.factor,
             m.clearcoat.roughness, m.clearcoat.normalScale, m.sheen.color, m.sheen.roughness, m.transmission);
    for (const TextureSlot* slot : m.slots()) addSlot(hash, scene, *slot);
    hash.add(m.skin.has_value());
    if (!m.skin) return;
    const SkinMaterial& s = *m.skin;
    hash.add(s.scale, s.mix, s.roughness, s.specular, s.translucency, s.mmPerUnit, s.lobeWeight, s.lobeRatio,
             s.detail, s.detailScale);
    for (const skin::Gaussian& g : s.profile.gaussians) hash.add(g.variance, g.weight);
}

void addLight(Hash& hash, const Light& l) {
    hash.add(l.type, l.color, l.temperature.value_or(0), l.intensity, l.innerConeAngle, l.outerConeAngle,
             l.radius, l.size, l.range, l.shadow, l.position, l.direction);
}

void addMeshes(Hash& hash, const PlacedScene& placed) {
    for (const PlacedMesh& mesh : placed.meshes) {
        hash.add(mesh.character, mesh.skin, mesh.primitive->material);
        hash.add(mesh.positions);
        hash.add(mesh.normals);
        hash.add(mesh.tangents);
        hash.add(mesh.indices);
        hash.add(mesh.primitive->uv0);
        hash.add(mesh.primitive->uv1);
        hash.add(mesh.primitive->colors);
    }
}

// Materials, textures, lights and the environment.
void addLook(Hash& hash, const Input& input) {
    for (const Material& material : input.scene->materials) addMaterial(hash, *input.scene, material);
    for (const Image& image : input.scene->images) {
        hash.add(image.width, image.height, image.format);
        hash.add(image.texels);
    }
    for (const Light& light : input.rig.lights) {
        if (light.enabled) addLight(hash, light);
    }
    const EnvironmentSettings& e = input.rig.environment;
    if (input.environment && e.enabled) {
        hash.add(e.intensity, e.rotation, input.environment->width, input.environment->height);
        hash.add(input.environment->radiance);
    }
}

}  // namespace

std::uint64_t subjectKey(const Input& input) {
    Hash hash;
    addMeshes(hash, placeScene(*input.scene));
    addLook(hash, input);
    return hash.value();
}

std::uint64_t contentKey(const Input& input, const Settings& settings, const PlacedScene& placed) {
    Hash hash;
    const bool irradiance =
        std::find(settings.aovs.begin(), settings.aovs.end(), "irradiance") != settings.aovs.end();
    hash.add(kEstimatorVersion, settings.width, settings.height, settings.gaussians, settings.seed,
             irradiance);
    const Camera& c = input.camera;
    hash.add(c.orthographic, c.yfov, c.xmag, c.ymag, c.znear, c.zfar, c.world, placed.origin);
    addMeshes(hash, placed);
    addLook(hash, input);
    return hash.value();
}

}  // namespace cutis::reference
