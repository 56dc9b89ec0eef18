#include "renderer/scene/skin_material.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "renderer/core/error.h"
#include "renderer/scene/fields.h"

namespace cutis {
namespace {

constexpr const char* kThreeLayer = "three-layer";

std::string plain(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

double checked(const JsonView& value, const Field& field) {
    const double number = value.number();
    if (number >= field.min && number <= field.max && !(field.openMin && number == field.min)) return number;
    value.fail("must be " + std::string(field.openMin ? "above " : "from ") + plain(field.min) +
               (field.openMin ? " and at most " : " to ") + plain(field.max));
}

// Leaves `number` as it is where the object has no such field.
void read(const JsonView& object, const Field& field, double& number) {
    if (const auto found = object.find(field.key)) number = checked(*found, field);
}

skin::Profile parseProfile(const JsonView& value) {
    if (value.json().is_string()) {
        if (value.string() != kThreeLayer) value.fail("the named profile is \"three-layer\"");
        return skin::threeLayerProfile();
    }
    skin::Profile profile;
    for (const JsonView& entry : value.elements()) {
        entry.allowOnly({fields::kVariance.key, fields::kWeight.key});
        const double variance = checked(entry.member(fields::kVariance.key), fields::kVariance);
        const JsonView weights = entry.member(fields::kWeight.key);
        const std::vector<double> w = weights.numbers(3);
        if (w[0] < 0 || w[1] < 0 || w[2] < 0) weights.fail("must not be negative");
        profile.gaussians.push_back({variance, {w[0], w[1], w[2]}});
    }
    skin::validate(profile, value.where());
    constexpr double kRounding = 1.01;  // published fits sum to 1.00x
    const glm::dvec3 total = skin::totalWeight(profile);
    if (glm::any(glm::greaterThan(total, glm::dvec3(kRounding)))) {
        value.fail("weights of a channel sum to more than 1: skin would give off more light than it gets");
    }
    return skin::sorted(profile);
}

// Of KHR_materials_volume_scatter: how far light gets for each mean free path. Kulla & Conty 2017 give the
// single-scatter albedo of a medium that looks `color` after many bounces; in a medium of albedo α and mean
// cosine g light falls off by the effective attenuation √(3 σ_a (σ_a + σ_s (1 - g))) (Ishimaru 1978), σ_s = α
// σ_t, σ_a = (1 - α) σ_t.
double reachOfScattering(double color, double g) {
    const double s =
        4.09712 + 4.20863 * color - std::sqrt(9.59217 + 41.6808 * color + 17.7126 * color * color);
    const double absorbed = std::clamp(s * s, 1e-8, 1.0);
    return 1 / std::sqrt(3 * absorbed * (absorbed + (1 - absorbed) * (1 - g)));
}

// Light that falls off as exp(-r/ℓ)/(2πℓr) is a mixture of Gaussians whose variances are ℓ²·x², x normally
// distributed: the nodes of Gauss-Hermite quadrature with six points give the second moment, ⟨r²⟩ = 2ℓ²,
// exactly.
skin::Profile exponentialProfile(const glm::dvec3& lengthsMm) {
    constexpr struct {
        double squared, weight;
    } kNodes[] = {{0.380327, 0.8176569}, {3.568986, 0.1772315}, {11.050688, 0.0051116}};
    skin::Profile profile;
    for (int channel = 0; channel < 3; ++channel) {
        for (const auto& node : kNodes) {
            glm::dvec3 weight(0);
            weight[channel] = node.weight;
            const double variance = node.squared * lengthsMm[channel] * lengthsMm[channel];
            const auto same = std::find_if(profile.gaussians.begin(), profile.gaussians.end(),
                                           [&](const skin::Gaussian& g) { return g.variance == variance; });
            if (same != profile.gaussians.end()) {
                same->weight += weight;
            } else {
                profile.gaussians.push_back({variance, weight});
            }
        }
    }
    return skin::sorted(profile);
}

}  // namespace

std::optional<SkinMaterial> parseSkinMaterial(const JsonView& value) {
    if (value.json().is_boolean()) return value.boolean() ? std::optional(SkinMaterial{}) : std::nullopt;
    if (!value.json().is_object()) value.fail("must be true, false or an object");
    value.allowOnly({fields::kProfile.key, fields::kScale.key, fields::kMix.key, fields::kRoughness.key,
                     fields::kSpecular.key, fields::kLobeWeight.key, fields::kLobeRatio.key,
                     fields::kDetail.key, fields::kDetailScale.key, fields::kTranslucency.key,
                     fields::kMmPerUnit.key});
    SkinMaterial skin;
    if (const auto profile = value.find(fields::kProfile.key)) skin.profile = parseProfile(*profile);
    read(value, fields::kScale, skin.scale);
    read(value, fields::kMix, skin.mix);
    read(value, fields::kRoughness, skin.roughness);
    read(value, fields::kSpecular, skin.specular);
    read(value, fields::kLobeWeight, skin.lobeWeight);
    read(value, fields::kLobeRatio, skin.lobeRatio);
    read(value, fields::kDetail, skin.detail);
    read(value, fields::kDetailScale, skin.detailScale);
    skin.translucency = value.boolean(fields::kTranslucency.key, skin.translucency);
    read(value, fields::kMmPerUnit, skin.mmPerUnit);
    return skin;
}

std::optional<SkinMaterial> hintedSkin(const JsonView& material) {
    const auto extensions = material.find("extensions");
    if (!extensions || extensions->find("KHR_materials_transmission")) return std::nullopt;
    const auto diffuse = extensions->find("KHR_materials_diffuse_transmission");
    const auto volume = extensions->find("KHR_materials_volume");
    const auto scatter = extensions->find("KHR_materials_volume_scatter");
    if (!(diffuse || scatter) || !volume || !(volume->number("thicknessFactor", 0) > 0)) return std::nullopt;
    SkinMaterial skin;
    skin.translucency = !diffuse || diffuse->number("diffuseTransmissionFactor", 0) > 0;
    const auto distance = volume->find("attenuationDistance");  // metres; none: endless
    if (!distance) return skin;
    constexpr double kShortestMm = 0.01, kLongestMm = 100;
    std::vector<double> color{1, 1, 1}, reach{1, 1, 1};  // reach: in mean free paths
    if (const auto given = volume->find("attenuationColor")) color = given->numbers(3);
    if (scatter) {
        const double g = std::clamp(scatter->number("scatterAnisotropy", 0), -0.99, 0.99);
        for (const char* name :
             {"multiscatterColor", "multiscatterColorFactor"}) {  // of drafts before 2025 and since
            const auto given = scatter->find(name);
            if (!given) continue;
            for (double& c : reach = given->numbers(3)) c = reachOfScattering(std::clamp(c, 0.0, 1.0), g);
        }
    }
    glm::dvec3 lengths;
    for (int c = 0; c < 3; ++c) {
        const double depth = -std::log(std::clamp(color[c], 1e-6, 1 - 1e-6));  // optical, of that distance
        lengths[c] =
            std::clamp(reach[c] * distance->number() * skin.mmPerUnit / depth, kShortestMm, kLongestMm);
    }
    skin.profile = exponentialProfile(lengths);
    return skin;
}

nlohmann::json skinMaterialJson(const SkinMaterial& skin) {
    const SkinMaterial defaults;
    nlohmann::json json = nlohmann::json::object();
    if (!(skin.profile == defaults.profile)) {
        json[fields::kProfile.key] = nlohmann::json::array();
        for (const skin::Gaussian& g : skin.profile.gaussians) {
            json[fields::kProfile.key].push_back(
                {{fields::kVariance.key, g.variance},
                 {fields::kWeight.key, {g.weight.r, g.weight.g, g.weight.b}}});
        }
    }
    if (skin.scale != defaults.scale) json[fields::kScale.key] = skin.scale;
    if (skin.mix != defaults.mix) json[fields::kMix.key] = skin.mix;
    if (skin.roughness != defaults.roughness) json[fields::kRoughness.key] = skin.roughness;
    if (skin.specular != defaults.specular) json[fields::kSpecular.key] = skin.specular;
    if (skin.lobeWeight != defaults.lobeWeight) json[fields::kLobeWeight.key] = skin.lobeWeight;
    if (skin.lobeRatio != defaults.lobeRatio) json[fields::kLobeRatio.key] = skin.lobeRatio;
    if (skin.detail != defaults.detail) json[fields::kDetail.key] = skin.detail;
    if (skin.detailScale != defaults.detailScale) json[fields::kDetailScale.key] = skin.detailScale;
    if (skin.translucency != defaults.translucency) json[fields::kTranslucency.key] = skin.translucency;
    if (skin.mmPerUnit != defaults.mmPerUnit) json[fields::kMmPerUnit.key] = skin.mmPerUnit;
    return json.empty() ? nlohmann::json(true) : json;
}

std::vector<FieldGroup> skinFields() {
    return {{"Skin",
             {fields::kProfile, fields::kScale, fields::kMix, fields::kRoughness, fields::kSpecular,
              fields::kLobeWeight, fields::kLobeRatio, fields::kDetail, fields::kDetailScale,
              fields::kTranslucency, fields::kMmPerUnit}},
            {"A Gaussian of a profile", {fields::kVariance, fields::kWeight}}};
}

}  // namespace cutis
