#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "renderer/core/error.h"
#include "renderer/scene/gltf_parts.h"
#include "renderer/scene/skin_material.h"

namespace cutis::gltf {
namespace {

Wrap readWrap(const JsonView& sampler, const char* key) {
    const auto value = sampler.find(key);
    if (!value) return Wrap::repeat;
    switch (value->integer()) {
        case 10497:
            return Wrap::repeat;
        case 33648:
            return Wrap::mirroredRepeat;
        case 33071:
            return Wrap::clampToEdge;
    }
    value->fail("no wrapping mode has this number");
}

Sampler readSampler(const JsonView& sampler) {
    // Between kNearestMipmapNearest and kLinearMipmapLinear: 9985 and 9986, linear and nearest by turns.
    constexpr std::int64_t kNearest = 9728, kLinear = 9729, kNearestMipmapNearest = 9984,
                           kLinearMipmapNearest = 9985, kLinearMipmapLinear = 9987;
    Sampler s;
    s.wrapU = readWrap(sampler, "wrapS");
    s.wrapV = readWrap(sampler, "wrapT");
    std::int64_t minification = kLinearMipmapLinear, magnification = kLinear;
    if (const auto filter = sampler.find("minFilter")) {
        minification = filter->integer();
        const bool known = minification == kNearest || minification == kLinear ||
                           (minification >= kNearestMipmapNearest && minification <= kLinearMipmapLinear);
        if (!known) filter->fail("no minification filter has this number");
    }
    if (const auto filter = sampler.find("magFilter")) {
        magnification = filter->integer();
        if (magnification != kNearest && magnification != kLinear) {
            filter->fail("no magnification filter has this number");
        }
    }
    s.mipmapped = minification != kNearest && minification != kLinear;
    s.nearest = magnification == kNearest && minification != kLinear &&
                minification != kLinearMipmapNearest && minification != kLinearMipmapLinear;
    return s;
}

// KHR_texture_transform: uv' = T R S uv, where R turns so that the extension's own example (rotation π/2,
// "the lower left quadrant, rotated clockwise") comes out: u' = cos u + sin v, v' = cos v - sin u.
glm::mat3 readTransform(const JsonView& transform) {
    glm::dvec2 offset(0), scale(1);
    if (const auto value = transform.find("offset")) {
        const auto v = value->numbers(2);
        offset = {v[0], v[1]};
    }
    if (const auto value = transform.find("scale")) {
        const auto v = value->numbers(2);
        scale = {v[0], v[1]};
    }
    const double rotation = transform.number("rotation", 0);
    const double c = std::cos(rotation), s = std::sin(rotation);
    return {glm::dvec3(c * scale.x, -s * scale.x, 0), glm::dvec3(s * scale.y, c * scale.y, 0),
            glm::dvec3(offset, 1)};
}

std::optional<JsonView> extensionOf(const JsonView& object, const char* name) {
    const auto extensions = object.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

float factor(const JsonView& object, const char* key, double fallback) {
    return float(std::clamp(object.number(key, fallback), 0.0, 1.0));
}

class MaterialReader {
  public:
    MaterialReader(Document& document, Scene& scene) : document_(document), scene_(scene) {}

    MaterialMap run() {
        const std::size_t count = document_.count("materials");
        map_.sceneMaterial.assign(count, kNone);
        const std::vector<bool> used = usedMaterials();
        for (std::size_t i = 0; i < count; ++i) {
            const JsonView entry = document_.entry("materials", i);
            const auto extras = entry.find("extras");
            const bool marked = extras && extras->json().is_object() && extras->find("skin");
            map_.skinMarked |= marked;
            if (!used[i]) continue;
            map_.sceneMaterial[i] = int(scene_.materials.size());
            scene_.materials.push_back(readMaterial(entry));
            hints_.resize(scene_.materials.size());
            if (!marked) hints_.back() = hintedSkin(entry);
            if (marked) scene_.materials.back().skin = parseSkinMaterial(extras->member("skin"));
        }
        if (!map_.skinMarked) takeHints();
        if (needsDefault_) {
            Material material;
            material.name = "default";
            scene_.materials.push_back(std::move(material));
        }
        scene_.images.resize(map_.images.size());
        return std::move(map_);
    }

  private:
    // Where no material says whether it is skin, those that scatter light through a volume are.
    void takeHints() {
        std::string names;
        for (std::size_t i = 0; i < hints_.size(); ++i) {
            if (!hints_[i]) continue;
            scene_.materials[i].skin = hints_[i];
            names += (names.empty() ? "'" : ", '") + scene_.materials[i].name + "'";
        }
        if (names.empty()) return;
        map_.skinMarked = true;
        warn("no material has extras.skin: taken as skin by its diffuse transmission and volume: " + names +
             " (--skin decides otherwise), " + document_.file().string());
    }

    std::vector<bool> usedMaterials() {
        std::vector<bool> used(document_.count("materials"), false);
        std::vector<bool> meshSeen(document_.count("meshes"), false);
        for (const Node& node : scene_.nodes) {
            if (node.mesh == kNone || meshSeen[node.mesh]) continue;
            meshSeen[node.mesh] = true;
            for (const JsonView& primitive :
                 document_.entry("meshes", std::size_t(node.mesh)).member("primitives").elements()) {
                const auto material = primitive.find("material");
                if (material) used[material->index(used.size(), "materials")] = true;
                needsDefault_ |= !material;
            }
        }
        return used;
    }

    Material readMaterial(const JsonView& entry) {
        Material m;
        m.name = entry.string("name");
        if (const auto pbr = entry.find("pbrMetallicRoughness")) {
            if (const auto color = pbr->find("baseColorFactor")) {
                const auto v = color->numbers(4);
                for (int i = 0; i < 4; ++i) m.baseColor[i] = float(std::clamp(v[i], 0.0, 1.0));
            }
            m.metallic = factor(*pbr, "metallicFactor", 1);
            m.roughness = factor(*pbr, "roughnessFactor", 1);
            m.baseColorTexture = readSlot(*pbr, "baseColorTexture", true);
            m.metallicRoughnessTexture = readSlot(*pbr, "metallicRoughnessTexture", false);
        }
        m.normalTexture = readSlot(entry, "normalTexture", false);
        if (m.normalTexture) m.normalScale = float(entry.member("normalTexture").number("scale", 1));
        m.occlusionTexture = readSlot(entry, "occlusionTexture", false);
        if (m.occlusionTexture) m.occlusionStrength = factor(entry.member("occlusionTexture"), "strength", 1);
        m.emissiveTexture = readSlot(entry, "emissiveTexture", true);
        if (const auto color = entry.find("emissiveFactor")) {
            m.emissive = readColor(*color, 1);
        }
        if (const auto strength = extensionOf(entry, "KHR_materials_emissive_strength")) {
            const double value = strength->number("emissiveStrength", 1);
            if (value < 0 || value > 1e9) strength->member("emissiveStrength").fail("must be in [0, 1e9]");
            m.emissive *= float(value);
        }
        m.unlit = extensionOf(entry, "KHR_materials_unlit").has_value();
        readLayers(entry, m);
        const std::string mode = entry.string("alphaMode", "OPAQUE");
        if (mode == "MASK") {
            m.alphaMode = AlphaMode::mask;
        } else if (mode == "BLEND") {
            m.alphaMode = AlphaMode::blend;
        } else if (mode != "OPAQUE") {
            entry.member("alphaMode").fail("must be OPAQUE, MASK or BLEND");
        }
        m.alphaCutoff = float(entry.number("alphaCutoff", 0.5));
        m.doubleSided = entry.boolean("doubleSided", false);
        return m;
    }

    // The extensions over metallic-roughness, with the ranges that their specifications give.
    void readLayers(const JsonView& entry, Material& m) {
        if (const auto ior = extensionOf(entry, "KHR_materials_ior")) {
            const double value = ior->number("ior", 1.5);
            if (value != 0 && !(value >= 1 && value <= 1e6))
                ior->member("ior").fail("must be 0 or in [1, 1e6]");
            m.dielectric.ior = float(value);
        }
        if (const auto specular = extensionOf(entry, "KHR_materials_specular")) {
            m.dielectric.specular = factor(*specular, "specularFactor", 1);
            m.dielectric.specularTexture = readSlot(*specular, "specularTexture", false);
            if (const auto color = specular->find("specularColorFactor")) {
                m.dielectric.specularColor = readColor(*color, 1e6);
            }
            m.dielectric.specularColorTexture = readSlot(*specular, "specularColorTexture", true);
        }
        if (const auto coat = extensionOf(entry, "KHR_materials_clearcoat")) {
            m.clearcoat.factor = factor(*coat, "clearcoatFactor", 0);
            m.clearcoat.roughness = factor(*coat, "clearcoatRoughnessFactor", 0);
            m.clearcoat.texture = readSlot(*coat, "clearcoatTexture", false);
            m.clearcoat.roughnessTexture = readSlot(*coat, "clearcoatRoughnessTexture", false);
            m.clearcoat.normalTexture = readSlot(*coat, "clearcoatNormalTexture", false);
            if (m.clearcoat.normalTexture) {
                m.clearcoat.normalScale = float(coat->member("clearcoatNormalTexture").number("scale", 1));
            }
        }
        if (const auto sheen = extensionOf(entry, "KHR_materials_sheen")) {
            if (const auto color = sheen->find("sheenColorFactor")) m.sheen.color = readColor(*color, 1);
            m.sheen.roughness = factor(*sheen, "sheenRoughnessFactor", 0);
            m.sheen.colorTexture = readSlot(*sheen, "sheenColorTexture", true);
            m.sheen.roughnessTexture = readSlot(*sheen, "sheenRoughnessTexture", false);
        }
        if (const auto through = extensionOf(entry, "KHR_materials_transmission")) {
            m.transmission = factor(*through, "transmissionFactor", 0);
            m.transmissionTexture = readSlot(*through, "transmissionTexture", false);
        }
    }

    static glm::vec3 readColor(const JsonView& value, double largest) {
        const auto v = value.numbers(3);
        return {std::clamp(v[0], 0.0, largest), std::clamp(v[1], 0.0, largest),
                std::clamp(v[2], 0.0, largest)};
    }

    TextureSlot readSlot(const JsonView& owner, const char* key, bool color) {
        TextureSlot slot;
        const auto info = owner.find(key);
        if (!info) return slot;
        slot.texture = useTexture(info->member("index"), color);
        std::size_t texCoord = info->natural("texCoord", 0);
        if (const auto transform = extensionOf(*info, "KHR_texture_transform")) {
            slot.transform = readTransform(*transform);
            texCoord = transform->natural("texCoord", texCoord);
        }
        if (texCoord > 1) info->fail("TEXCOORD_" + std::to_string(texCoord) + ", only 0 and 1 are supported");
        slot.texCoord = int(texCoord);
        return slot;
    }

    // Index into Scene::textures of a texture of the file sampled as colour or as data; kNone when it has no
    // image.
    int useTexture(const JsonView& reference, bool color) {
        const JsonView entry = document_.resolve(reference, "textures");
        const auto webp = extensionOf(entry, "EXT_texture_webp");
        const auto source = webp ? webp->find("source") : entry.find("source");
        if (!source) {
            warn("a texture without an image of a supported kind is left out, " + entry.where());
            return kNone;
        }
        Texture texture;
        texture.image = useImage(source->index(document_.count("images"), "images"), color);
        texture.srgb = color;
        if (const auto sampler = entry.find("sampler")) {
            texture.sampler = readSampler(document_.resolve(*sampler, "samplers"));
        }
        const Sampler& t = texture.sampler;
        const auto [known, isNew] = textures_.try_emplace(
            {texture.image, color, t.wrapU, t.wrapV, t.nearest, t.mipmapped}, scene_.textures.size());
        if (isNew) scene_.textures.push_back(texture);
        return int(known->second);
    }

    // What tells images apart: entries that name one file or buffer view are one image, decoded once.
    std::string sourceOf(std::size_t fileImage) const {
        const JsonView entry = document_.entry("images", fileImage);
        const auto uri = entry.find("uri"), view = entry.find("bufferView");
        if (view) return "view " + std::to_string(view->integer());
        const bool isFile = uri && !uri->string().starts_with("data:");
        return isFile ? "file " + uri->string() : "image " + std::to_string(fileImage);
    }

    int useImage(std::size_t fileImage, bool color) {
        const auto [known, isNew] = images_.try_emplace(sourceOf(fileImage), map_.images.size());
        if (isNew) map_.images.push_back({fileImage});
        ImageUse& use = map_.images[known->second];
        (color ? use.asColor : use.asData) = true;
        return int(known->second);
    }

    Document& document_;
    Scene& scene_;
    MaterialMap map_;
    std::map<std::tuple<int, bool, Wrap, Wrap, bool, bool>, std::size_t>
        textures_;                                    // their place in the scene
    std::map<std::string, std::size_t> images_;       // per source: its place in the scene
    std::vector<std::optional<SkinMaterial>> hints_;  // per material of the scene
    bool needsDefault_ = false;
};

}  // namespace

MaterialMap readMaterials(Document& document, Scene& scene) {
    return MaterialReader(document, scene).run();
}

}  // namespace cutis::gltf
