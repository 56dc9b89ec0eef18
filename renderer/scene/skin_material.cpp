#include "renderer/scene/skin_material.h"

#include <nlohmann/json.hpp>

#include "renderer/core/error.h"

namespace cutis {
namespace {

constexpr const char* kThreeLayer = "three-layer";

double numberIn(const JsonView& object, const char* key, double fallback, double low, double high,
                bool lowIncluded, const char* range) {
    const auto found = object.find(key);
    if (!found) return fallback;
    const double value = found->number();
    if (value < low || value > high || (!lowIncluded && value == low))
        found->fail(std::string("must be ") + range);
    return value;
}

skin::Profile parseProfile(const JsonView& value) {
    if (value.json().is_string()) {
        if (value.string() != kThreeLayer) value.fail("the named profile is \"three-layer\"");
        return skin::threeLayerProfile();
    }
    skin::Profile profile;
    for (const JsonView& entry : value.elements()) {
        entry.allowOnly({"variance_mm2", "weight"});
        const JsonView variance = entry.member("variance_mm2");
        if (variance.number() <= 0) variance.fail("must be above 0");
        const JsonView weights = entry.member("weight");
        const std::vector<double> w = weights.numbers(3);
        if (w[0] < 0 || w[1] < 0 || w[2] < 0) weights.fail("must not be negative");
        profile.gaussians.push_back({variance.number(), {w[0], w[1], w[2]}});
    }
    skin::validate(profile, value.where());
    constexpr double kRounding = 1.01;  // published fits sum to 1.00x
    const glm::dvec3 total = skin::totalWeight(profile);
    if (glm::any(glm::greaterThan(total, glm::dvec3(kRounding)))) {
        value.fail("weights of a channel sum to more than 1: skin would give off more light than it gets");
    }
    return skin::sorted(profile);
}

}  // namespace

std::optional<SkinMaterial> parseSkinMaterial(const JsonView& value) {
    if (value.json().is_boolean()) return value.boolean() ? std::optional(SkinMaterial{}) : std::nullopt;
    if (!value.json().is_object()) value.fail("must be true, false or an object");
    value.allowOnly({"profile", "scale", "mix", "roughness", "specular", "translucency", "mm_per_unit"});
    constexpr double kLargest = 1e9;
    SkinMaterial skin;
    if (const auto profile = value.find("profile")) skin.profile = parseProfile(*profile);
    skin.scale = numberIn(value, "scale", skin.scale, 0, kLargest, false, "above 0");
    skin.mix = numberIn(value, "mix", skin.mix, 0, 1, true, "in [0, 1]");
    skin.roughness = numberIn(value, "roughness", skin.roughness, 0, 1, false, "in (0, 1]");
    skin.specular = numberIn(value, "specular", skin.specular, 0, kLargest, true, "0 or more");
    skin.translucency = value.boolean("translucency", skin.translucency);
    skin.mmPerUnit = numberIn(value, "mm_per_unit", skin.mmPerUnit, 0, kLargest, false, "above 0");
    return skin;
}

nlohmann::json skinMaterialJson(const SkinMaterial& skin) {
    const SkinMaterial defaults;
    nlohmann::json json = nlohmann::json::object();
    if (!(skin.profile == defaults.profile)) {
        json["profile"] = nlohmann::json::array();
        for (const skin::Gaussian& g : skin.profile.gaussians) {
            json["profile"].push_back(
                {{"variance_mm2", g.variance}, {"weight", {g.weight.r, g.weight.g, g.weight.b}}});
        }
    }
    if (skin.scale != defaults.scale) json["scale"] = skin.scale;
    if (skin.mix != defaults.mix) json["mix"] = skin.mix;
    if (skin.roughness != defaults.roughness) json["roughness"] = skin.roughness;
    if (skin.specular != defaults.specular) json["specular"] = skin.specular;
    if (skin.translucency != defaults.translucency) json["translucency"] = skin.translucency;
    if (skin.mmPerUnit != defaults.mmPerUnit) json["mm_per_unit"] = skin.mmPerUnit;
    return json.empty() ? nlohmann::json(true) : json;
}

}  // namespace cutis
