#include "renderer/frame/plan.h"

#include <algorithm>
#include <set>
#include <stdexcept>

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
        !skin ? "nothing is skin" : !lit ? "no light" : count(input.skinDraws, "piece") + " of skin");
    set(Need::litSkin, skin && lit,
        !skin ? "nothing is skin" : !lit ? "no light reaches the skin" : "skin is lit");
    const bool wholeSkin = input.chain == Chain::published;
    set(Need::hiddenSkin, skin && lit && input.prune && !input.anyView && !wholeSkin,
        !skin           ? "nothing is skin"
        : !lit          ? "no light reaches the skin"
        : !input.prune  ? "--no-prune: skin is lit whether it is seen or not"
        : input.anyView ? "skin is lit for every view"
        : wholeSkin     ? "the published chain blurs the whole atlas"
                        : "only what the picture shows of the skin is worth lighting");
    set(Need::lights, lights, lights ? count(input.lightSamples, "light sample") : "no lights");
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
        !translucent ? "no skin is translucent" : fromLights ? "thickness comes from light maps" : materials);
    set(Need::environment, input.environment, input.environment ? "an environment lights the scene" : "no environment");
    return needs;
}

Plan makePlan(const Needs& needs) {
    Plan plan;
    std::set<Resource> written;
    for (const PassRow& row : passTable()) {
        if (!needs[row.need]) {
            if (row.phase == Phase::frame) plan.leftOut.push_back({row.name, needs.why(row.need)});
            continue;
        }
        for (Resource resource : row.reads) {
            if (!written.count(resource)) {
                throw std::logic_error(std::string("pass ") + row.name + " reads what no pass before it writes");
            }
        }
        written.insert(row.writes.begin(), row.writes.end());
        plan.rows.push_back(&row);
        plan.reasons.push_back(needs.why(row.need));
    }
    return plan;
}

}  // namespace cutis
