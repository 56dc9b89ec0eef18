// cutis compare: two rigs, or each light alone against all of them.

#include "app/command.h"
#include "app/output_folder.h"
#include "app/prepared.h"
#include "app/progress.h"
#include "app/usage_error.h"
#include "renderer/core/error.h"
#include "renderer/measure/comparison.h"

namespace cutis::app {
namespace {

// A picture that the comparison needs: what lights it.
struct Lighting {
    std::string name;
    Rig rig;
    const Environment* environment;
};

// All lights; each alone; the environment alone.
std::vector<Lighting> soloLightings(const Inputs& inputs) {
    const Environment* environment = inputs.environment ? &*inputs.environment : nullptr;
    std::vector<Lighting> lightings{{"all", inputs.rig, environment}};
    for (std::size_t i = 0; i < inputs.rig.lights.size(); ++i) {
        if (!inputs.rig.lights[i].enabled) continue;
        Rig solo = inputs.rig;
        for (std::size_t j = 0; j < solo.lights.size(); ++j) solo.lights[j].enabled = i == j;
        lightings.push_back({inputs.rig.lights[i].name, solo, nullptr});
    }
    if (environment) {
        Rig ambient = inputs.rig;
        ambient.lights.clear();
        lightings.push_back({"environment", ambient, environment});
    }
    return lightings;
}

Picture renderLighting(gpu::Device& device, const Inputs& inputs, const Request& request,
                       const Lighting& lighting) {
    const RenderInput input{.scene = &inputs.scene,
                            .rig = lighting.rig,
                            .environment = lighting.environment,
                            .camera = inputs.camera};
    return renderPicture(device, input, request.settings).picture;
}

}  // namespace

int runCompare(const Request& request) {
    if (request.rigA.has_value() != request.rigB.has_value())
        throw UsageError("--a and --b belong together", "compare");
    if (request.rigA && (request.rig || !request.lights.empty()))
        throw UsageError("--a and --b exclude --rig and --light", "compare");
    prepareOutputFolder(request.outputs.front(), "compare.json");
    Progress progress;
    progress.setStage("loading");
    Request first = request, second = request;
    if (request.rigA) first.rig = request.rigA, second.rig = request.rigB;
    Prepared prepared(first);
    const Inputs& inputs = prepared.inputs;
    gpu::Device& device = prepared.device;

    std::vector<ComparedPicture> pictures;
    const auto add = [&](const Inputs& from, const Lighting& lighting) {
        progress.setStage("rendering " + lighting.name);
        pictures.push_back({lighting.name, renderLighting(device, from, request, lighting),
                            from.rig.exposure + request.exposure});
    };
    std::string title;
    if (request.rigA) {
        const Inputs other = loadInputs(second);
        const auto lighting = [](const Inputs& from, const std::string& name) {
            return Lighting{name, from.rig, from.environment ? &*from.environment : nullptr};
        };
        add(inputs, lighting(inputs, "A " + *request.rigA));
        add(other, lighting(other, "B " + *request.rigB));
        title = *request.rigA + " and " + *request.rigB;
    } else {
        for (const Lighting& lighting : soloLightings(inputs)) add(inputs, lighting);
        title = "Each light of " + (inputs.rig.name.empty() ? "the rig" : inputs.rig.name) + " alone";
    }
    progress.setStage("writing");
    writeComparison(request.outputs.front(), title, pictures);
    checkValidation(device);
    return 0;
}

}  // namespace cutis::app
