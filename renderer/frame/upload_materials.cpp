// Materials on the device: what shaders read of them, which textures they sample, and how what they cover is
// drawn.
#include <algorithm>
#include <iterator>

#include "renderer/frame/frame.h"
#include "renderer/frame/upload.h"
#include "renderer/frame/upload_parts.h"
#include "renderer/skin/specular.h"
#include "renderer/skin/specular_lobes.h"

namespace cutis {
namespace {

// SLOT_ bits of the textures that a material is shaded with. Skin has its own roughness; a layer that is not
// there reads nothing.
std::uint32_t sampledSlots(const Material& material, bool skin) {
    using namespace shared;
    std::uint32_t slots = 0;
    for (std::uint32_t i = 0; i < material.slots().size(); ++i) {
        if (*material.slots()[i]) slots |= 1u << i;
    }
    if (skin) slots &= SLOT_BASE_COLOR | SLOT_NORMAL | SLOT_OCCLUSION | SLOT_EMISSIVE;
    if (!(material.clearcoat.factor > 0)) slots &= ~(SLOT_COAT | SLOT_COAT_ROUGHNESS | SLOT_COAT_NORMAL);
    if (material.sheen.color == glm::vec3(0)) slots &= ~(SLOT_SHEEN_COLOR | SLOT_SHEEN_ROUGHNESS);
    if (!(material.transmission > 0)) slots &= ~SLOT_TRANSMISSION;
    return slots;
}

std::uint32_t usedSlots(const Scene& scene, const Geometry& geometry) {
    std::uint32_t slots = 0;
    for (const GeometryDraw& draw : geometry.draws)
        slots |= sampledSlots(scene.materials[draw.material], draw.skin);
    return slots;
}

shared::TextureRef textureRef(const TextureSlot& slot, const std::vector<TextureArrays::Place>& places) {
    shared::TextureRef ref{};
    ref.group = slot ? places[slot.texture].group : -1;
    if (ref.group < 0) return ref;
    ref.layer = places[slot.texture].layer;
    ref.texCoord = slot.texCoord;
    const glm::mat3 rows = glm::transpose(slot.transform);
    ref.u = rows[0];
    ref.v = rows[1];
    return ref;
}

std::uint32_t flagsOf(const Material& material) {
    std::uint32_t flags = 0;
    if (material.skin) flags |= shared::MATERIAL_SKIN;
    if (material.skin && material.skin->translucency) flags |= shared::MATERIAL_TRANSLUCENT;
    if (material.unlit) flags |= shared::MATERIAL_UNLIT;
    if (material.doubleSided) flags |= shared::MATERIAL_DOUBLE_SIDED;
    if (material.alphaMode == AlphaMode::mask) flags |= shared::MATERIAL_MASK;
    if (material.alphaMode == AlphaMode::blend) flags |= shared::MATERIAL_BLEND;
    return flags;
}

float slopeOf(const SkinMaterial& skin) {
    return static_cast<float>(std::max(skin.roughness, skin::kMinRoughness));
}

bool hasSecondLobe(const SkinMaterial& skin) {
    return skin.lobeWeight > 0;
}

float narrowerSlopeOf(const SkinMaterial& skin) {
    return static_cast<float>(std::max(skin.roughness * skin.lobeRatio, skin::kMinRoughness));
}

SkinSpecular layerOf(const SkinMaterial& skin) {
    SkinSpecular layer{slopeOf(skin), static_cast<float>(skin.specular)};
    if (hasSecondLobe(skin)) {
        layer.narrower = narrowerSlopeOf(skin);
        layer.weight = static_cast<float>(skin.lobeWeight);
    }
    return layer;
}

// A row of the table of the specular layer: the albedo of both lobes together, and the shape of the first.
struct TableRow {
    float roughness, narrower, weight;
    bool operator==(const TableRow&) const = default;
};

// At normal incidence: ((n - 1) / (n + 1))² of each colour.
glm::vec3 reflectanceOf(const Dielectric& dielectric) {
    const double n = dielectric.ior, root = n > 0 ? (n - 1) / (n + 1) : 1;
    return glm::vec3(static_cast<float>(root * root)) * dielectric.specularColor;
}

// What passes straight through at normal incidence of light that base colour and textures leave alone. The
// coat's share is that of its factor: light maps read no more than one texture of each kind.
float clearnessOf(const Material& material) {
    const glm::vec3 f0 =
        glm::min(reflectanceOf(material.dielectric), glm::vec3(1)) * material.dielectric.specular;
    return material.transmission * (1 - material.metallic) * (1 - std::max({f0.x, f0.y, f0.z})) *
           (1 - 0.04f * material.clearcoat.factor);
}

shared::Material toShared(const Material& from, const std::vector<TextureArrays::Place>& places) {
    shared::Material to{};
    to.baseColor = from.baseColor;
    to.emissive = from.emissive;
    to.metallic = from.metallic;
    to.roughness = from.roughness;
    to.normalScale = from.normalScale;
    to.occlusionStrength = from.occlusionStrength;
    to.alphaCutoff = from.alphaCutoff;
    to.flags = flagsOf(from);
    shared::TextureRef* const refs[] = {&to.baseColorTexture,     &to.metallicRoughnessTexture,
                                        &to.normalTexture,        &to.occlusionTexture,
                                        &to.emissiveTexture,      &to.specularTexture,
                                        &to.specularColorTexture, &to.coatTexture,
                                        &to.coatRoughnessTexture, &to.coatNormalTexture,
                                        &to.sheenColorTexture,    &to.sheenRoughnessTexture,
                                        &to.transmissionTexture};
    for (std::size_t i = 0; i < from.slots().size(); ++i) *refs[i] = textureRef(*from.slots()[i], places);
    to.reflectance = reflectanceOf(from.dielectric);
    to.specular = from.dielectric.specular;
    if (!from.layered()) return to;
    to.sheen = from.sheen.color;
    to.sheenRoughness = from.sheen.roughness;
    to.coat = from.clearcoat.factor;
    to.coatRoughness = from.clearcoat.roughness;
    to.coatNormalScale = from.clearcoat.normalScale;
    to.transmission = from.transmission;
    to.clear = clearnessOf(from);
    return to;
}

// Glass as clear as a cornea: what little it stops is worth less than the noise of a light map that stops it
// here and there.
bool letsAllLightThrough(const Material& material) {
    if (material.alphaMode != AlphaMode::opaque || !material.layered()) return false;
    if (material.baseColorTexture || material.transmissionTexture) return false;
    const glm::vec4 base = material.baseColor;
    return clearnessOf(material) * (base.x + base.y + base.z) / 3 > 0.9f;
}

std::vector<DrawRange> makeRanges(const Scene& scene, const Geometry& geometry, const SkinMesh& mesh,
                                  const std::vector<TextureArrays::Place>& places) {
    std::vector<DrawRange> ranges;
    for (const GeometryDraw& draw : geometry.draws) {
        const Material& material = scene.materials[draw.material];
        DrawRange range;
        range.firstIndex = draw.firstIndex;
        range.indexCount = draw.indexCount;
        range.firstProxyIndex = draw.firstProxyIndex;
        range.proxyIndexCount = draw.proxyIndexCount;
        range.material = static_cast<std::uint32_t>(draw.material);
        range.skin = draw.skin;
        range.blended = material.seenThrough();
        range.doubleSided = material.doubleSided;
        range.cutOut = material.alphaMode == AlphaMode::mask;
        range.masked = range.cutOut || range.blended;
        range.closed = range.skin && !range.doubleSided && !range.masked;
        range.sealed = range.closed && mesh.sealed[draw.character];
        range.clear = letsAllLightThrough(material);
        const bool second = sampledSlots(material, draw.skin) & shared::SLOT_TRANSMISSION;
        if (material.baseColorTexture && !second) {
            range.alphaGroup = static_cast<std::uint32_t>(places[material.baseColorTexture.texture].group);
        }
        // Textures and vertex colours only lower alpha.
        const float needed = range.cutOut ? material.alphaCutoff : 1.0f / 255;
        if (material.alphaMode != AlphaMode::opaque && material.baseColor.a < needed) continue;
        range.boundsMin = glm::vec3(draw.bounds.min - geometry.origin);
        range.boundsMax = glm::vec3(draw.bounds.max - geometry.origin);
        ranges.push_back(range);
    }
    return ranges;
}

}  // namespace

std::vector<TextureUse> textureUses(const Scene& scene, const Geometry& geometry, bool prune) {
    std::vector<TextureUse> uses(scene.textures.size(), TextureUse::none);
    for (const GeometryDraw& draw : geometry.draws) {
        const Material& material = scene.materials[draw.material];
        const std::uint32_t sampled = sampledSlots(material, draw.skin);
        for (std::uint32_t i = 0; i < material.slots().size(); ++i) {
            if (!(sampled & 1u << i)) continue;
            TextureUse& use = uses[material.slots()[i]->texture];
            const bool normals = (shared::SLOTS_OF_NORMALS & 1u << i) && use != TextureUse::values;
            use = normals ? TextureUse::normals : TextureUse::values;
        }
    }
    if (!prune) std::replace(uses.begin(), uses.end(), TextureUse::none, TextureUse::values);
    return uses;
}

std::vector<int> skinMaterials(const Scene& scene, const Geometry& geometry) {
    std::vector<int> materials;
    std::vector<bool> seen(scene.materials.size(), false);
    for (const GeometryDraw& draw : geometry.draws) {
        if (draw.skin && !seen[draw.material]) materials.push_back(draw.material);
        if (draw.skin) seen[draw.material] = true;
    }
    return materials;
}

std::vector<SkinSpecular> skinLayers(const Scene& scene, const Geometry& geometry) {
    std::vector<SkinSpecular> layers;
    for (const int material : skinMaterials(scene, geometry))
        indexOf(layers, layerOf(*scene.materials[material].skin));
    return layers;
}

// The materials, and the tables of the specular layer for each distinct roughness of skin.
void uploadMaterials(FrameContext& frame) {
    const Scene& scene = *frame.input->scene;
    std::vector<shared::Material> materials;
    for (const Material& material : scene.materials)
        materials.push_back(toShared(material, frame.scene.texturePlaces));
    std::vector<SkinSpecular> layers;
    std::vector<TableRow> rows;
    std::vector<std::vector<float>> albedo;
    const auto rowOf = [&](const TableRow& row) {
        const std::size_t place = indexOf(rows, row);
        if (place == albedo.size())
            albedo.push_back(skin::mixedAlbedoRow(row.roughness, row.narrower, row.weight));
        return static_cast<std::uint32_t>(place);
    };
    for (const int index : skinMaterials(scene, frame.geometry)) {
        const SkinMaterial& skin = *scene.materials[index].skin;
        const SkinSpecular layer = layerOf(skin);
        shared::Material& to = materials[index];
        to.slope = layer.roughness;
        to.specularScale = layer.scale;
        to.mix = static_cast<float>(skin.mix);
        to.mmPerUnit = static_cast<float>(skin.mmPerUnit);
        to.albedoRow = rowOf({layer.roughness, layer.narrower, layer.weight});
        to.meanAlbedo = static_cast<float>(skin::meanAlbedo(albedo[to.albedoRow], skin.specular));
        to.matteLayer = static_cast<std::uint32_t>(indexOf(layers, layer));
        to.slope2 = layer.narrower;
        to.lobeWeight = layer.weight;
        if (hasSecondLobe(skin)) to.albedoRow2 = rowOf({layer.narrower, 0, 0});
    }
    std::vector<float> table;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::vector<float> lobes = skin::specularLobeTable(rows[i].roughness);
        table.insert(table.end(), albedo[i].begin(), albedo[i].end());
        table.insert(table.end(), lobes.begin(), lobes.end());
    }
    SceneBuffers& buffers = frame.scene.buffers;
    buffers.materials = uploadBuffer(*frame.device, *frame.commands, "materials", materials);
    buffers.albedoTable = uploadBuffer(*frame.device, *frame.commands, "directional albedo", table);
    buffers.textureSlots = usedSlots(scene, frame.geometry);
    buffers.seenThrough = frame.needs[Need::transparency];
    buffers.skinShines = frame.needs[Need::skinSpecular];
    buffers.layers = (frame.needs[Need::clearcoat] ? shared::LAYER_COAT : 0u) |
                     (frame.needs[Need::sheen] ? shared::LAYER_SHEEN : 0u) |
                     (frame.needs[Need::transmission] ? shared::LAYER_THROUGH : 0u) |
                     (frame.needs[Need::secondLobe] ? shared::LAYER_SECOND_LOBE : 0u);
}

void findDrawRanges(FrameContext& frame) {
    frame.scene.buffers.ranges =
        makeRanges(*frame.input->scene, frame.geometry, frame.skinMesh, frame.scene.texturePlaces);
}

}  // namespace cutis
