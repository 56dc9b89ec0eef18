#include "app/viewer/mixer.h"

#include <algorithm>

#include "renderer/core/parallel.h"
#include "renderer/scene/light_samples.h"

namespace cutis::app {
namespace {

// The light without what a mixer changes.
Light shapeOf(Light light) {
    light.name.clear();
    light.enabled = true;
    light.color = glm::dvec3(1);
    light.temperature.reset();
    light.intensity = 1;
    return light;
}

EnvironmentSettings shapeOf(EnvironmentSettings environment) {
    environment.enabled = true;
    environment.intensity = 1;
    return environment;
}

bool hasEnvironment(const Document& document) {
    return !document.rig.environment.file.empty();
}

}  // namespace

std::vector<Contribution> contributionsOf(const Document& document) {
    std::vector<Contribution> contributions;
    for (const Light& light : document.rig.lights) {
        Contribution& contribution = contributions.emplace_back();
        contribution.light = light;
        contribution.light.enabled = true;
        if (!(light.intensity > 0)) contribution.light.intensity = 1;
        for (int c = 0; c < 3; ++c)
            if (!(light.color[c] > 0)) contribution.light.color = glm::dvec3(1);
    }
    if (hasEnvironment(document)) {
        Contribution& contribution = contributions.emplace_back();
        contribution.ofEnvironment = true;
        contribution.environment = document.rig.environment;
        contribution.environment.enabled = true;
        if (!(contribution.environment.intensity > 0)) contribution.environment.intensity = 1;
    }
    return contributions;
}

Rig aloneRig(const Document& document, const Contribution& contribution) {
    Rig rig = document.rig;
    rig.lights.clear();
    rig.environment = {};
    if (contribution.ofEnvironment) {
        rig.environment = contribution.environment;
    } else {
        rig.lights = {contribution.light};
    }
    return rig;
}

bool sameShape(const Contribution& a, const Contribution& b) {
    if (a.ofEnvironment != b.ofEnvironment) return false;
    const EnvironmentSettings ofA = shapeOf(a.environment), ofB = shapeOf(b.environment);
    return shapeOf(a.light) == shapeOf(b.light) && ofA == ofB;
}

bool canMix(const std::vector<Contribution>& contributions, const Document& document) {
    const std::vector<Light>& lights = document.rig.lights;
    if (contributions.size() != lights.size() + (hasEnvironment(document) ? 1 : 0)) return false;
    for (std::size_t i = 0; i < contributions.size(); ++i) {
        const Contribution& contribution = contributions[i];
        if (contribution.ofEnvironment != (i == lights.size())) return false;
        const bool same = contribution.ofEnvironment
                              ? shapeOf(contribution.environment) == shapeOf(document.rig.environment)
                              : shapeOf(contribution.light) == shapeOf(lights[i]);
        if (!same) return false;
    }
    return true;
}

glm::dvec3 shareOf(const Contribution& contribution, std::size_t index, const Document& document) {
    const Rig rig = effectiveRig(document);
    if (contribution.ofEnvironment)
        return glm::dvec3(
            rig.environment.enabled ? rig.environment.intensity / contribution.environment.intensity : 0);
    const Light& light = rig.lights[index];
    return light.enabled ? lightIntensity(light) / lightIntensity(contribution.light) : glm::dvec3(0);
}

Picture mix(const std::vector<Contribution>& contributions, const Document& document) {
    Picture sum;
    for (std::size_t i = 0; i < contributions.size(); ++i) {
        if (!contributions[i].picture) continue;
        const Picture& own = *contributions[i].picture;
        if (sum.values.empty())
            sum = {own.width, own.height, own.channels, std::vector<float>(own.values.size(), 0.0f)};
        if (own.values.size() != sum.values.size() || own.channels != 4) continue;
        const glm::vec3 share(shareOf(contributions[i], i, document));
        const std::size_t row = static_cast<std::size_t>(own.width) * 4;
        parallelFor(static_cast<std::size_t>(own.height), [&](std::size_t y) {
            for (std::size_t p = y * row; p < (y + 1) * row; p += 4) {
                for (std::size_t c = 0; c < 3; ++c) sum.values[p + c] += share[int(c)] * own.values[p + c];
                sum.values[p + 3] = std::max(sum.values[p + 3], own.values[p + 3]);
            }
        });
    }
    return sum;
}

}  // namespace cutis::app
