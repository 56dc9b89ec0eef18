#include "renderer/frame/plan.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace cutis {
namespace {

std::string count(int n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace

Needs computeNeeds(const NeedsInput& input) {
    Needs needs;
    const auto set = [&](Need need, bool met, std::string reason) {
        needs.met[static_cast<int>(need)] = met;
        needs.reason[static_cast<int>(need)] = std::move(reason);
    };
    const bool lights = input.lightSamples > 0;
    const bool lit = lights || input.environment;
    const bool skin = input.skinDraws > 0;
    set(Need::always, true, "every picture");
    set(Need::skin, skin && lit,
        !skin  ? "nothing is skin"
        : !lit ? "no light"
               : count(input.skinDraws, "piece") + " of skin");
    set(Need::litSkin, skin && lit,
        !skin  ? "nothing is skin"
        : !lit ? "no light reaches the skin"
               : "skin is lit");
    const bool published = input.chain == Chain::published, wide = input.wideGaussians > 0;
    set(Need::hiddenSkin, skin && lit && input.prune && !input.anyView && !published,
        !skin           ? "nothing is skin"
        : !lit          ? "no light reaches the skin"
        : !input.prune  ? "--no-prune: skin is lit whether it is seen or not"
        : input.anyView ? "skin is lit for every view"
        : published     ? "the published chain blurs the whole atlas"
                        : "only what the picture shows of the skin is worth lighting");
    set(Need::lights, lights, lights ? count(input.lightSamples, "light sample") : "no lights");
    set(Need::areaLights, input.areaSamples > 0,
        input.areaSamples > 0 ? count(input.areaSamples, "sample") + " of area lights"
                              : "every light is a point or a direction: one sample each, and no penumbras");
    set(Need::shadows, input.shadowedSamples > 0,
        input.shadowedSamples > 0 ? count(input.shadowedSamples, "light sample") + " with shadows"
                                  : "no light casts shadows");
    const bool translucent = skin && lit && input.translucentSkinMaterials > 0;
    const bool fromLights = input.merge == Merge::min;
    const std::string materials = count(input.translucentSkinMaterials, "translucent material");
    set(Need::translucency, translucent && fromLights && input.shadowedSamples > 0,
        !translucent                 ? "no skin is translucent"
        : !fromLights                ? "thickness comes from the shape alone"
        : input.shadowedSamples == 0 ? "no light map to find thickness with"
                                     : materials);
    set(Need::oppositeSides, translucent && !fromLights,
        !translucent ? "no skin is translucent"
        : fromLights ? "thickness comes from light maps"
                     : materials);
    set(Need::environment, input.environment,
        input.environment ? "an environment lights the scene" : "no environment");
    set(Need::skinSpecular, skin && lit && (input.shinySkinMaterials > 0 || !input.prune),
        !skin                          ? "nothing is skin"
        : !lit                         ? "no light"
        : input.shinySkinMaterials > 0 ? count(input.shinySkinMaterials, "material") + " of skin that shines"
                                       : "no skin shines: its specular scale is 0");
    set(Need::seams, skin && lit && input.seams > 0 && input.chain == Chain::exact,
        !skin             ? "nothing is skin"
        : !lit            ? "no light reaches the skin"
        : input.seams < 1 ? "no skin goes on beyond the border of its UV island"
        : published
            ? "the published chain stops at the borders of UV islands"
            : count(static_cast<int>(input.seams), "edge") + " of UV islands beyond which skin goes on");
    set(Need::wideGaussians, skin && lit && wide,
        !skin   ? "nothing is skin"
        : !lit  ? "no light reaches the skin"
        : !wide ? "no Gaussian is wide beside the body"
                : count(input.wideGaussians, "Gaussian") + " wide beside the body");
    set(Need::motion, skin && lit && (input.animations > 0 || !input.prune),
        !skin                  ? "nothing is skin"
        : !lit                 ? "no light"
        : input.animations > 0 ? count(input.animations, "animation") + " may stretch the skin"
                               : "nothing moves");
    set(Need::transparency, input.blendedDraws > 0 || !input.prune,
        input.blendedDraws > 0 ? count(input.blendedDraws, "surface") + " seen through"
                               : "nothing is seen through: one layer of surfaces");
    const auto setLayer = [&](Need need, int having, const char* has, const char* none) {
        set(need, having > 0 || !input.prune, having > 0 ? count(having, "material") + has : none);
    };
    setLayer(Need::clearcoat, input.coatedMaterials, " with a clear coat", "no material has a clear coat");
    setLayer(Need::sheen, input.sheenMaterials, " with a sheen", "no material has a sheen");
    setLayer(Need::secondLobe, input.twoLobedMaterials, " of skin with two specular lobes",
             "no skin has a second specular lobe");
    const bool pores = input.poredMaterials > 0;
    set(Need::detail, (pores && input.poresResolved) || !input.prune,
        !pores                 ? "no skin has pores"
        : !input.poresResolved ? "pores are below a pixel: roughness stands for them"
                               : count(input.poredMaterials, "material") + " of skin with pores");
    setLayer(Need::transmission, input.glassMaterials, " that light goes straight through",
             "nothing is of glass");
    return needs;
}

std::vector<LeftOut> leftOutWithinRows(const Needs& needs) {
    constexpr std::pair<Need, const char*> kParts[] = {
        {Need::translucency, "translucency"},  {Need::areaLights, "area_lights"},
        {Need::skinSpecular, "skin_specular"}, {Need::transparency, "transparency"},
        {Need::clearcoat, "clearcoat"},        {Need::sheen, "sheen"},
        {Need::transmission, "transmission"},  {Need::secondLobe, "second_lobe"},
        {Need::detail, "skin_pores"}};
    std::vector<LeftOut> parts;
    for (const auto& [need, name] : kParts) {
        if (!needs[need]) parts.push_back({name, needs.why(need)});
    }
    return parts;
}

Plan makePlan(const Needs& needs) {
    Plan plan;
    std::set<Resource> written;
    for (const PassRow& row : passTable()) {
        if (!needs[row.need]) {
            (row.phase == Phase::frame ? plan.leftOut : plan.leftOutBefore)
                .push_back({row.name, needs.why(row.need)});
            continue;
        }
        for (Resource resource : row.reads) {
            if (!written.count(resource)) {
                throw std::logic_error(std::string("pass ") + row.name +
                                       " reads what no pass before it writes");
            }
        }
        written.insert(row.writes.begin(), row.writes.end());
        plan.rows.push_back(&row);
        plan.reasons.push_back(needs.why(row.need));
    }
    return plan;
}

}  // namespace cutis
