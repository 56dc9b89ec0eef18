#include "renderer/frame/inputs.h"

#include "renderer/core/hash.h"
#include "renderer/frame/frame.h"
#include "renderer/passes/diffusion.h"

namespace cutis {
namespace {

void addSlot(ContentHash& hash, const TextureSlot& slot) {
    hash.add(slot.texture);
    if (slot) hash.add(slot.texCoord, slot.transform);
}

std::uint64_t hashMaterials(const Scene& scene) {
    ContentHash hash;
    for (const Material& m : scene.materials) {
        hash.add(m.baseColor, m.metallic, m.roughness, m.normalScale, m.occlusionStrength, m.emissive, m.alphaMode,
                 m.alphaCutoff, m.doubleSided, m.unlit);
        hash.add(m.dielectric.ior, m.dielectric.specular, m.dielectric.specularColor, m.clearcoat.factor,
                 m.clearcoat.roughness, m.clearcoat.normalScale, m.sheen.color, m.sheen.roughness, m.transmission);
        for (const TextureSlot* slot : m.slots()) addSlot(hash, *slot);
    }
    return hash.value();
}

std::uint64_t hashTextures(const FrameContext& frame) {
    ContentHash hash;
    hash.add(frame.input->scene, frame.input->sceneRevision);
    for (const TextureUse use : textureUses(*frame.input->scene, frame.geometry, frame.settings->prune)) hash.add(use);
    return hash.value();
}

std::uint64_t hashProfiles(const FrameContext& frame) {
    const Scene& scene = *frame.input->scene;
    ContentHash hash;
    for (const int material : skinMaterials(scene, frame.geometry)) {
        const skin::Profile profile = profileOf(scene, material, frame.settings->gaussians);
        hash.add(material, scene.materials[material].skin->translucency, profile.gaussians.size());
        for (const skin::Gaussian& g : profile.gaussians) hash.add(g.variance, g.weight);
    }
    return hash.value();
}

// On the layout that is there. Where there is none yet, or it is to be made anew, nothing is kept that this could save.
std::uint64_t hashLevels(const FrameContext& frame) {
    const std::vector<ChartRange> charts = chartRanges(*frame.input->scene, frame.atlas, *frame.settings);
    ContentHash hash;
    for (const ChartRange& chart : charts) hash.add(chart.profile.gaussians.size(), chart.blurred);
    return hash.add(profileNumbers(charts)).add(levelShifts(charts, reducesLevels(*frame.settings))).value();
}

void hashLights(const std::vector<LightSample>& samples, ContentHash& places, ContentHash& power) {
    for (const LightSample& s : samples) {
        places.add(s.light, s.directional, s.position, s.direction, s.cosineEmission, s.cosInner, s.cosOuter, s.range,
                   s.shadow, s.radius);
        power.add(s.intensity);
    }
}

std::uint64_t hashEnvironment(const FrameContext& frame) {
    const RenderInput& input = *frame.input;
    return ContentHash()
        .add(frame.lighting.environment, input.environment, input.environmentRevision,
             input.rig.environment.shadowSamples, frame.settings->seed)
        .value();
}

std::uint64_t hashCamera(const Camera& c) {
    return ContentHash().add(c.orthographic, c.yfov, c.xmag, c.ymag, c.aspect, c.znear, c.zfar, c.world).value();
}

std::uint64_t hashAtlasDetail(const FrameContext& frame) {
    ContentHash hash;
    hash.add(frame.settings->irradianceSize);
    if (frame.settings->irradianceSize == 0) hash.add(frame.detail.mmPerTexel);
    hash.add(reachBeyondBorders(*frame.input->scene, frame.geometry, *frame.settings));
    return hash.value();
}

}  // namespace

std::uint64_t hashGeometry(const RenderInput& input) {
    ContentHash hash;
    hash.add(input.scene, input.sceneRevision);
    for (const Material& material : input.scene->materials) {
        hash.add(material.skin.has_value());
        if (material.skin) hash.add(material.skin->mmPerUnit);
    }
    return hash.value();
}

InputHashes hashInputs(const FrameContext& frame) {
    const Scene& scene = *frame.input->scene;
    const RenderSettings& settings = *frame.settings;
    const EnvironmentSettings& environment = frame.input->rig.environment;
    InputHashes hashes{};
    const auto set = [&](Input input, std::uint64_t hash) { hashes[static_cast<std::size_t>(input)] = hash; };
    set(Input::geometry, hashGeometry(*frame.input));
    ContentHash pose;
    for (const GeometryDraw& draw : frame.geometry.draws) pose.add(draw.pose);
    set(Input::pose, pose.value());
    set(Input::textures, hashTextures(frame));
    ContentHash layer, mix, pores;
    for (const int material : skinMaterials(scene, frame.geometry)) {
        const SkinMaterial& skin = *scene.materials[material].skin;
        layer.add(material, skin.roughness, skin.specular, skin.lobeWeight, skin.lobeRatio);
        pores.add(material, skin.detail, skin.detailScale, skin.roughness, skin.lobeWeight, skin.lobeRatio);
        mix.add(material, skin.mix);
    }
    set(Input::materials, hashMaterials(scene));
    set(Input::pores, pores.value());
    set(Input::skinLayer, layer.value());
    set(Input::skinMix, mix.value());
    set(Input::profiles, hashProfiles(frame));
    set(Input::levels, hashLevels(frame));
    set(Input::chain, ContentHash().add(settings.chain, settings.taps).value());
    set(Input::atlasDetail, hashAtlasDetail(frame));
    set(Input::lightMapSize, ContentHash().add(frame.detail.lightMapSize).value());
    ContentHash places, power;
    hashLights(frame.lighting.samples, places, power);
    set(Input::lightPlaces, places.value());
    set(Input::lightPower, power.value());
    ContentHash needed, seen;
    for (const bool map : frame.lighting.mapsNeeded) needed.add(map);
    for (const bool group : frame.groupsSeen) seen.add(group);
    set(Input::lightMapsNeeded, needed.value());
    set(Input::groupsSeen, seen.value());
    set(Input::environment, hashEnvironment(frame));
    set(Input::environmentRotation, ContentHash().add(environment.rotation).value());
    set(Input::environmentPower, ContentHash().add(environment.intensity).value());
    set(Input::camera, hashCamera(frame.input->camera));
    set(Input::pictureSize, ContentHash().add(settings.width, settings.height).value());
    set(Input::aovs,
        ContentHash().add(settings.aovs).add(settings.inspect.what != Inspect::What::none).value());
    return hashes;
}

}  // namespace cutis
