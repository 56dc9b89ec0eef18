#include "renderer/frame/upload.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/frame/textures.h"
#include "renderer/gpu/device.h"
#include "renderer/skin/specular.h"
#include "renderer/skin/specular_lobes.h"

namespace cutis {
namespace {

template <class T>
gpu::Buffer uploadBuffer(gpu::Device& device, gpu::Commands& commands, const char* name, const std::vector<T>& values,
                         bool index = false) {
    gpu::Buffer buffer(device, {.name = name, .bytes = values.size() * sizeof(T), .index = index});
    if (!values.empty()) commands.upload(buffer, values);
    return buffer;
}

// Place of a value in a list of distinct ones, appended when it is new.
template <class T>
std::size_t indexOf(std::vector<T>& list, const T& value) {
    const auto known = std::find(list.begin(), list.end(), value);
    if (known != list.end()) return static_cast<std::size_t>(known - list.begin());
    list.push_back(value);
    return list.size() - 1;
}

constexpr TextureSlot Material::*kSlots[] = {&Material::baseColorTexture, &Material::metallicRoughnessTexture,
                                             &Material::normalTexture, &Material::occlusionTexture,
                                             &Material::emissiveTexture};

// Textures that some drawn material samples. Skin has its own roughness, so its metallic-roughness map never is.
std::vector<TextureUse> textureUses(const Scene& scene, const Geometry& geometry) {
    std::vector<TextureUse> uses(scene.textures.size(), TextureUse::none);
    for (const GeometryDraw& draw : geometry.draws) {
        const Material& material = scene.materials[draw.material];
        for (const auto slot : kSlots) {
            if (draw.skin && slot == &Material::metallicRoughnessTexture) continue;
            if (!(material.*slot)) continue;
            TextureUse& use = uses[(material.*slot).texture];
            const bool normals = slot == &Material::normalTexture && use != TextureUse::values;
            use = normals ? TextureUse::normals : TextureUse::values;
        }
    }
    return uses;
}

std::uint32_t usedSlots(const Scene& scene, const Geometry& geometry) {
    std::uint32_t slots = 0;
    for (const GeometryDraw& draw : geometry.draws) {
        for (std::uint32_t i = 0; i < std::size(kSlots); ++i) {
            if (scene.materials[draw.material].*kSlots[i]) slots |= 1u << i;
        }
    }
    return slots;
}

shared::TextureRef textureRef(const TextureSlot& slot, const TextureArrays& arrays) {
    shared::TextureRef ref{};
    ref.group = slot ? arrays.places[slot.texture].group : -1;
    if (ref.group < 0) return ref;
    ref.layer = arrays.places[slot.texture].layer;
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

// The materials, and the tables of the specular layer for each distinct roughness of skin.
void uploadMaterials(gpu::Device& device, gpu::Commands& commands, const Scene& scene, const Geometry& geometry,
                     const TextureArrays& arrays, UploadedScene& uploaded) {
    std::vector<bool> drawnAsSkin(scene.materials.size(), false);
    for (const GeometryDraw& draw : geometry.draws) {
        if (draw.skin) drawnAsSkin[draw.material] = true;
    }
    std::vector<shared::Material> materials;
    std::vector<float> roughness;
    std::vector<std::vector<float>> rows;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& from = scene.materials[i];
        shared::Material to{};
        to.baseColor = from.baseColor;
        to.emissive = from.emissive;
        to.metallic = from.metallic;
        to.roughness = from.roughness;
        to.normalScale = from.normalScale;
        to.occlusionStrength = from.occlusionStrength;
        to.alphaCutoff = from.alphaCutoff;
        to.flags = flagsOf(from);
        to.baseColorTexture = textureRef(from.baseColorTexture, arrays);
        to.metallicRoughnessTexture = textureRef(from.metallicRoughnessTexture, arrays);
        to.normalTexture = textureRef(from.normalTexture, arrays);
        to.occlusionTexture = textureRef(from.occlusionTexture, arrays);
        to.emissiveTexture = textureRef(from.emissiveTexture, arrays);
        if (drawnAsSkin[i]) {
            const SkinMaterial& skin = *from.skin;
            uploaded.translucent |= skin.translucency;
            const auto m = static_cast<float>(std::max(skin.roughness, skin::kMinRoughness));
            const std::size_t row = indexOf(roughness, m);
            if (row == rows.size()) rows.push_back(skin::directionalAlbedoRow(m));
            to.slope = m;
            to.specularScale = static_cast<float>(skin.specular);
            to.mix = static_cast<float>(skin.mix);
            to.mmPerUnit = static_cast<float>(skin.mmPerUnit);
            to.meanAlbedo = static_cast<float>(skin::meanAlbedo(rows[row], skin.specular));
            to.albedoRow = static_cast<std::uint32_t>(row);
            to.matteLayer = static_cast<std::uint32_t>(
                indexOf(uploaded.skins, SkinSpecular{m, static_cast<float>(skin.specular)}));
        }
        materials.push_back(to);
    }
    uploaded.buffers.materials = uploadBuffer(device, commands, "materials", materials);
    std::vector<float> table;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::vector<float> lobes = skin::specularLobeTable(roughness[i]);
        table.insert(table.end(), rows[i].begin(), rows[i].end());
        table.insert(table.end(), lobes.begin(), lobes.end());
    }
    uploaded.buffers.albedoTable = uploadBuffer(device, commands, "directional albedo", table);
}

void uploadCharts(gpu::Device& device, gpu::Commands& commands, const Scene& scene, const Atlas& atlas, int gaussians,
                  UploadedScene& uploaded) {
    std::vector<shared::GaussianTerm> terms;
    for (const AtlasChart& chart : atlas.charts) {
        const SkinMaterial& material = *scene.materials[chart.material].skin;
        skin::Profile profile = skin::scaled(skin::sorted(material.profile), material.scale);
        // A Gaussian that no channel uses is a blur that nothing reads.
        std::erase_if(profile.gaussians, [](const skin::Gaussian& g) { return g.weight == glm::dvec3(0); });
        if (gaussians > 0) profile = skin::reduced(profile, gaussians);
        ChartRange range;
        range.rect = chart.rect;
        range.firstGaussian = static_cast<std::uint32_t>(terms.size());
        range.profile = profile;
        range.mmPerUnit = static_cast<float>(material.mmPerUnit);
        range.coarsestMm = chart.coarsestMm;
        range.receiverGroup = static_cast<std::uint32_t>(chart.character);
        for (const skin::Gaussian& g : profile.gaussians) {
            terms.push_back({glm::vec3(g.weight), static_cast<float>(g.variance)});
        }
        uploaded.gaussians = std::max(uploaded.gaussians, static_cast<int>(profile.gaussians.size()));
        uploaded.charts.push_back(range);
    }
    uploaded.buffers.gaussians = uploadBuffer(device, commands, "gaussians", terms);
}

std::vector<DrawRange> makeRanges(const Scene& scene, const Geometry& geometry, const TextureArrays& arrays) {
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
        range.blended = material.alphaMode == AlphaMode::blend;
        range.doubleSided = material.doubleSided;
        range.masked = material.alphaMode != AlphaMode::opaque;
        range.closed = range.skin && !range.doubleSided && !range.masked;
        if (material.baseColorTexture) {
            range.alphaGroup = static_cast<std::uint32_t>(arrays.places[material.baseColorTexture.texture].group);
        }
        // Textures and vertex colours only lower alpha.
        const float needed = material.alphaMode == AlphaMode::mask ? material.alphaCutoff : 1.0f / 255;
        if (range.masked && material.baseColor.a < needed) continue;
        range.boundsMin = glm::vec3(draw.bounds.min - geometry.origin);
        range.boundsMax = glm::vec3(draw.bounds.max - geometry.origin);
        ranges.push_back(range);
    }
    return ranges;
}

}  // namespace

UploadedScene uploadScene(gpu::Device& device, gpu::Commands& commands, const Scene& scene, const Geometry& geometry,
                          const Atlas& atlas, int gaussians) {
    UploadedScene uploaded;
    SceneBuffers& buffers = uploaded.buffers;
    TextureArrays arrays = uploadTextures(device, commands, scene, textureUses(scene, geometry));
    uploadMaterials(device, commands, scene, geometry, arrays, uploaded);
    uploadCharts(device, commands, scene, atlas, gaussians, uploaded);
    buffers.textureGroups = static_cast<std::uint32_t>(arrays.images.size());
    buffers.textureSlots = usedSlots(scene, geometry);
    buffers.textureArrays = std::move(arrays.images);
    buffers.materialTextures = std::move(arrays.sampled);
    buffers.indices = uploadBuffer(device, commands, "indices", geometry.indices, true);
    buffers.positions = uploadBuffer(device, commands, "positions", geometry.positions);
    buffers.attributes = uploadBuffer(device, commands, "attributes", geometry.attributes);
    buffers.triangleDraws = uploadBuffer(device, commands, "triangle draws", geometry.triangleDraws);
    buffers.draws = uploadBuffer(device, commands, "draws", geometry.drawInfos);
    buffers.ranges = makeRanges(scene, geometry, arrays);
    if (!atlas.charts.empty()) {
        buffers.atlasVertices = uploadBuffer(device, commands, "atlas vertices", atlas.vertices);
        std::vector<std::uint32_t> all(geometry.skinTriangleCount);
        std::iota(all.begin(), all.end(), 0u);
        buffers.skinTriangles = uploadBuffer(device, commands, "skin triangles", all);
        buffers.skinTriangleCount = geometry.skinTriangleCount;
        buffers.borderTriangles = uploadBuffer(device, commands, "border triangles", atlas.borderTriangles);
        buffers.borderTriangleCount = static_cast<std::uint32_t>(atlas.borderTriangles.size());
    }
    return uploaded;
}

}  // namespace cutis
